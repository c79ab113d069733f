// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/scene_identity.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
#include "io/files/checksum.hpp"
#include "io/scenario/scenario_file.hpp"
#include "scenarios/schema/value_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace sturz::workflow {
namespace {

KeyValue without_file_names(const KeyInfo& key, KeyValue value) {
  for_each_path(key, value, [](std::string& path) { path.clear(); });
  return value;
}

std::string bits_of(double value) {
  return fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value));
}

/// Of the keys that count.
template <class Counts>
std::vector<std::string> differences_in(const Scenario& before, const Scenario& now,
                                        const Counts& counts) {
  std::vector<std::string> found;
  for (const KeyInfo& key : schema()) {
    if (!counts(key)) continue;
    const KeyValue was = key.get(before), is = key.get(now);
    if (without_file_names(key, was) == without_file_names(key, is)) continue;
    const auto text = [](const KeyValue& v) {
      const std::string words = value_text(v);
      return words.empty() ? std::string("absent") : words;
    };
    found.push_back(fmt::format("{}: {} -> {}", key.path, text(was), text(is)));
  }
  return found;
}

}  // namespace

bool changes_members(const KeyInfo& key) {
  const bool only_asked =
      key.path == "title" || key.path == "ensemble.members" ||
      key.path.starts_with("ensemble.max_") || key.path == "numerics.max_wall_time_s" ||
      key.path.starts_with("terrain.window.") || key.path.starts_with("observation.") ||
      key.path.starts_with("assets.") || key.path.starts_with("report.") ||
      (key.path.starts_with("hazard.") && key.path != "hazard.cell_size_m");
  return !only_asked && key.kind != ValueKind::path;
}

std::vector<std::string> differences(const Scenario& before, const Scenario& now) {
  return differences_in(before, now, changes_members);
}

std::vector<std::string> differences_of_maps(const Scenario& before, const Scenario& now) {
  return differences_in(before, now, [](const KeyInfo& key) {
    return !changes_members(key) && key.path != "ensemble.members" &&
           key.path != "numerics.max_wall_time_s" && !key.path.starts_with("terrain.window.");
  });
}

void require_same_scene(const OutputFolder& folder, const Scenario& now,
                        const std::vector<InputIdentity>& inputs) {
  const std::string what =
      as_lines(differences(read_scenario(folder.scenario()), now)) +
      as_lines(changed_inputs(now, inputs, Manifest::read(folder.manifest()).inputs));
  require(what.empty(),
          fmt::format("{} was begun with another scene (its results would be mixed or lost). "
                      "Choose another folder with --out, or take these changes back:{}",
                      folder.root.string(), what));
}

void require_own_scenario(const OutputFolder& folder, const Manifest& manifest,
                          const Scenario& in_folder) {
  require(manifest.scenario_hash.empty() || scenario_hash(in_folder) == manifest.scenario_hash,
          fmt::format("{} was changed after it was written: a value that the members depend on "
                      "(they were computed with the earlier one). Take the change back, or run the "
                      "changed scene in another folder.",
                      folder.scenario().string()));
}

std::string scenario_hash(const Scenario& scenario) {
  std::string text;
  for (const KeyInfo& key : schema())
    if (changes_members(key))
      text +=
          fmt::format("{}={}\n", key.path, value_text(without_file_names(key, key.get(scenario))));
  return text_checksum(text);
}

std::string scene_hash(const Scenario& scenario, const std::vector<InputIdentity>& inputs) {
  std::string text = scenario_hash(scenario) + "\n";
  for (const InputIdentity& input : of_members(inputs)) {
    text += fmt::format("{}: {}\n", input.role, input.shape);
    for (const auto& [part, hash] : input.parts) text += fmt::format("{}={}\n", part, hash);
  }
  return text_checksum(text);
}

std::string member_hash(const std::string& scene_hash, const DesignTable& design,
                        std::int64_t member) {
  std::string text = scene_hash + "\n";
  const auto& row = design.values.at(static_cast<std::size_t>(member));
  for (std::size_t k = 0; k < row.size(); ++k)
    text += fmt::format("{}={}\n", design.keys[k], bits_of(row[k]));
  return text_checksum(text);
}

std::string member_hash(const std::string& scene_hash) { return text_checksum(scene_hash + "\n"); }

std::string design_hash(const DesignTable& design) { return text_checksum(to_csv(design)); }

}  // namespace sturz::workflow
