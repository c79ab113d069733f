// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/start/scene_text.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

namespace sturz::workflow {
namespace {

constexpr std::size_t comment_column = 58;

std::string with_comment(std::string line, const std::string& comment) {
  if (comment.empty()) return line + "\n";
  line.resize(std::max(line.size() + 2, comment_column), ' ');
  return line + "# " + comment + "\n";
}

/// The values of a process that belong to one block, "  key: value  # source".
std::string values_of(const Material& process, std::string_view block) {
  std::string text;
  for (const MaterialValue& v : process.values) {
    const std::string_view key(v.key);
    if (!key.starts_with(block) || key[block.size()] != '.') continue;
    text += with_comment(fmt::format("  {}: {}", key.substr(block.size() + 1), v.value),
                         std::string(v.source) + (v.checked ? "" : " (not yet checked)"));
  }
  return text;
}

}  // namespace

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string scene_text(const SceneDraft& d) {
  std::string text =
      "# Written by `sturz init`. Any number may be a distribution, as those below:\n"
      "# {uniform: [low, high]}, {log_uniform: [low, high]}, {triangular: [low, mode, high]}.\n"
      "# `sturz describe` says what will be computed and how long it takes; all keys are in the\n"
      "# user guide.\n";
  text += fmt::format("title: {}\n\nterrain:\n", quoted(d.title));
  text += with_comment(fmt::format("  raster: {}", quoted(d.terrain)), d.about_ground);
  if (!d.crs.empty()) text += fmt::format("  crs: {}\n", quoted(d.crs));
  text += "\nrelease:\n";
  for (const SceneDraft::Line& line : d.release)
    text += with_comment(fmt::format("  {}", line.text), line.comment);
  text += fmt::format(
      "\n# {}: {}. Ranges of events that others calculated back,\n"
      "# with their sources: a place to begin. What fits mapped events of your region is worth\n"
      "# more (`sturz calibrate`): friction decides how far the mass runs. \"Not yet checked\": "
      "written\n"
      "# from memory of the literature; look it up before you quote it.\n",
      d.process->name, d.process->what);
  text += "grains:                     # of the grains, without pores\n";
  text += values_of(*d.process, "grains");
  text +=
      "\nbasal:                      # Voellmy: friction, and drag that grows with the square of\n"
      "                            # the speed; friction alone is far too fast on real ground\n";
  text += values_of(*d.process, "basal");
  text += "\nformulation: depth_averaged # Voellmy exists in columns only\n\nnumerics:\n";
  text += with_comment(fmt::format("  {}", d.spacing.text), d.spacing.comment);
  text += fmt::format(
      "\nensemble:\n"
      "  design: sobol             # can grow: -n {} now, -n {} later\n"
      "  members: {}\n"
      "  seed: 1\n"
      "\nhazard:                     # maps of the probability that these are exceeded\n"
      "  thickness_m: [0.1, 0.5, 1, 2]\n"
      "  speed_m_s: [1, 5, 10]\n"
      "  energy_kj_m2: [10, 100, 1000]\n"
      "  pressure_kpa: [3, 10, 30]\n",
      d.members, 4 * d.members, d.members);
  return text;
}

}  // namespace sturz::workflow
