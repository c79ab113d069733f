// SPDX-License-Identifier: Apache-2.0
#include "io/risk/risk_file.hpp"

#include "engine/core/error.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/node_texts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace sturz {
namespace {

constexpr double most_per_year = 100, longest_period = 1e6;
constexpr std::size_t most_periods = 20;

class RiskReader {
 public:
  RiskReader(const std::string& name, FileProblems& problems) : name_(name), problems_(problems) {}

  RiskSpec read(const YamlNode& root) {
    RiskSpec spec;
    if (root.kind != YamlNode::Kind::map) {
      add_mismatch("risk", root, "keys, scenarios first", "", problems_);
      return spec;
    }
    for (const YamlEntry& entry : root.entries) {
      if (entry.key == "scenarios")
        scenarios(entry.value, spec);
      else if (entry.key == "return_periods_years")
        rising(entry, spec.return_periods_years);
      else if (entry.key == "probability_classes_years")
        classes(entry, spec.probability_classes_years);
      else if (entry.key == "strong_thickness_m")
        threshold(entry, spec.strong_thickness_m);
      else if (entry.key == "strong_speed_m_s")
        threshold(entry, spec.strong_speed_m_s);
      else
        problems_.push_back({entry.at, unknown_text("risk", entry.key,
                                                    {"scenarios", "return_periods_years",
                                                     "probability_classes_years",
                                                     "strong_thickness_m", "strong_speed_m_s"})});
    }
    if (spec.scenarios.empty() && problems_.empty()) {
      FileProblem& none = problems_.emplace_back();
      none.at.source = name_;
      none.message = fmt::format("names no scenario. Add {}.",
                                 "`scenarios: [{folder: out/small, frequency_per_year: 0.01}]`");
    }
    return spec;
  }

 private:
  void scenarios(const YamlNode& node, RiskSpec& spec) {
    if (node.kind != YamlNode::Kind::list)
      return add_mismatch("scenarios", node, "a list of folders with their frequencies", "",
                          problems_);
    for (std::size_t i = 0; i < node.items.size(); ++i)
      scenario(fmt::format("scenarios[{}]", i), node.items[i], spec);
  }

  void scenario(const std::string& path, const YamlNode& node, RiskSpec& spec) {
    if (node.kind != YamlNode::Kind::map)
      return add_mismatch(path, node, "{folder: out/small, frequency_per_year: 0.01}", "",
                          problems_);
    const std::size_t before = problems_.size();
    RiskScenario one;
    for (const YamlEntry& entry : node.entries) {
      const std::string key = path + "." + entry.key;
      if (entry.key == "folder") {
        if (const auto text = sturz::read_text(key, "a folder", entry.value, problems_))
          one.folder = *text;
      } else if (entry.key == "frequency_per_year") {
        frequency(key, entry.value, one);
      } else {
        problems_.push_back(
            {entry.at, unknown_text(path, entry.key, {"folder", "frequency_per_year"})});
      }
    }
    if (problems_.size() > before) return;
    for (const char* key : {"folder", "frequency_per_year"})
      if (node.find(key) == nullptr)
        problems_.push_back({node.at, fmt::format("{} ({} is missing). Add it.", path, key)});
    const bool twice = std::any_of(spec.scenarios.begin(), spec.scenarios.end(),
                                   [&](const RiskScenario& s) { return s.folder == one.folder; });
    if (twice)
      problems_.push_back({node.at, fmt::format("{}.folder = {} (is named twice). Add its "
                                                "frequencies up.",
                                                path, one.folder)});
    spec.scenarios.push_back(one);
  }

  void frequency(const std::string& key, const YamlNode& node, RiskScenario& one) {
    const auto number = read_number(key, node, "a number", problems_);
    if (!number) return;
    one.frequency_per_year = *number;
    if (!(*number > 0 && *number <= most_per_year))
      problems_.push_back({node.at, fmt::format("{} = {:g} (must be > 0 and <= 100). Give events a "
                                                "year, 0.01 for one in a hundred years.",
                                                key, *number)});
  }

  void threshold(const YamlEntry& entry, double& out) {
    const auto number = read_number(entry.key, entry.value, "a number", problems_);
    if (!number) return;
    out = *number;
    if (!(*number > 0))
      problems_.push_back(
          {entry.value.at, fmt::format("{} = {:g} (must be > 0).", entry.key, *number)});
  }

  void rising(const YamlEntry& entry, std::vector<double>& out) {
    const auto numbers = read_numbers(entry.key, entry.value, problems_);
    if (!numbers) return;
    out = *numbers;
    const bool good =
        !out.empty() && out.size() <= most_periods && out.front() > 0 &&
        out.back() <= longest_period &&
        std::adjacent_find(out.begin(), out.end(), std::greater_equal<>()) == out.end();
    if (!good)
      problems_.push_back({entry.value.at, fmt::format("{} = {} (must be 1 to 20 rising numbers of "
                                                       "years, > 0 and <= 1e6).",
                                                       entry.key, entry.value.shown())});
  }

  void classes(const YamlEntry& entry, std::vector<double>& out) {
    rising(entry, out);
    if (out.size() != 3)
      problems_.push_back(
          {entry.value.at, fmt::format("{} (must be three numbers: up to which return period a "
                                       "probability is high, medium, low).",
                                       entry.key)});
  }

  const std::string& name_;
  FileProblems& problems_;
};

}  // namespace

RiskSpec parse_risk(std::string_view text, const std::string& name) {
  FileProblems problems;
  RiskSpec spec;
  const bool blank = text.find_first_not_of(" \t\r\n") == std::string_view::npos;
  YamlNode nothing;
  nothing.kind = YamlNode::Kind::map;
  const auto root = blank ? std::optional(nothing) : parse_yaml(text, name, problems);
  if (root) spec = RiskReader(name, problems).read(*root);
  std::vector<std::string> lines;
  for (const FileProblem& p : problems)
    lines.push_back(fmt::format("{}: {}", p.at.text(), p.message));
  require(problems.empty(), fmt::format("{}", fmt::join(lines, "\n")));
  return spec;
}

RiskSpec read_risk(const std::filesystem::path& file) {
  return parse_risk(read_text(file), file.string());
}

}  // namespace sturz
