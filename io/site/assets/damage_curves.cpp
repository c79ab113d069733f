// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "io/scenario/number_nodes.hpp"
#include "io/site/assets/asset_files.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

namespace sturz {
namespace {

struct Intensity {
  const char* name;
  PeakLayer layer;
  double si_per_unit;
};
constexpr std::array<Intensity, 4> intensities{{{"thickness_m", PeakLayer::thickness, 1},
                                                {"speed_m_s", PeakLayer::speed, 1},
                                                {"energy_kj_m2", PeakLayer::energy, 1e3},
                                                {"pressure_kpa", PeakLayer::pressure, 1e3}}};
constexpr double most_intensity = 1e6;

std::vector<std::string> names_of_intensities() {
  std::vector<std::string> names;
  for (const Intensity& i : intensities) names.emplace_back(i.name);
  return names;
}

const Intensity* find_intensity(const std::string& name) {
  for (const Intensity& i : intensities)
    if (name == i.name) return &i;
  return nullptr;
}

/// One class of the file.
class CurveReader {
 public:
  CurveReader(const YamlEntry& entry, FileProblems& problems)
      : entry_(entry), problems_(problems) {}

  std::optional<DamageCurve> read() {
    const std::size_t before = problems_.size();
    const YamlNode& node = entry_.value;
    if (node.kind != YamlNode::Kind::map || node.entries.size() != 1) {
      add_mismatch(entry_.key, node, "one curve, {pressure_kpa: [[5, 0], [30, 1]]}", "", problems_);
      return std::nullopt;
    }
    const YamlEntry& curve = node.entries.front();
    const Intensity* intensity = find_intensity(curve.key);
    if (intensity == nullptr) {
      const std::string near = nearest_name(curve.key, names_of_intensities());
      problems_.push_back(
          {curve.at,
           fmt::format("{}.{} (no intensity of the maps). {}", entry_.key, curve.key,
                       near.empty() ? "Known: " + comma_separated(names_of_intensities()) + "."
                                    : "Did you mean " + near + "?")});
      return std::nullopt;
    }
    DamageCurve out{entry_.key, intensity->layer, {}};
    read_points(fmt::format("{}.{}", entry_.key, curve.key), curve.value, *intensity, out);
    return problems_.size() == before ? std::optional(std::move(out)) : std::nullopt;
  }

 private:
  void read_points(const std::string& path, const YamlNode& node, const Intensity& intensity,
                   DamageCurve& out) {
    if (node.kind != YamlNode::Kind::list || node.items.empty())
      return add_mismatch(path, node, "a list of [intensity, damage]", "", problems_);
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const std::string at = fmt::format("{}[{}]", path, i);
      const auto pair = read_numbers(at, node.items[i], problems_);
      if (!pair) continue;
      if (pair->size() != 2) {
        add_mismatch(at, node.items[i], "[intensity, damage]", "", problems_);
        continue;
      }
      add_point(at, node.items[i].at, *pair, intensity, out);
    }
  }

  void add_point(const std::string& path, const Position& at, const std::vector<double>& pair,
                 const Intensity& intensity, DamageCurve& out) {
    const double x = pair[0], damage = pair[1];
    const auto refuse = [&](const std::string& rest) {
      problems_.push_back({at, fmt::format("{} = [{:g}, {:g}] ({}", path, x, damage, rest)});
    };
    if (!(x >= 0 && x <= most_intensity)) return refuse("an intensity must be in 0..1e6).");
    if (!(damage >= 0 && damage <= 1))
      return refuse("a damage is a share of the value, in 0..1). Divide per cent by 100.");
    const double si = x * intensity.si_per_unit;
    if (!out.points.empty() && !(si > out.points.back().intensity))
      return refuse("intensities must rise from point to point). Sort them.");
    if (!out.points.empty() && damage < out.points.back().damage)
      return refuse("more intensity cannot do less damage). Correct the curve.");
    out.points.push_back({si, damage});
  }

  const YamlEntry& entry_;
  FileProblems& problems_;
};

}  // namespace

std::vector<DamageCurve> parse_damage_curves(std::string_view text, const std::string& name) {
  FileProblems problems;
  std::vector<DamageCurve> curves;
  const bool blank = text.find_first_not_of(" \t\r\n") == std::string_view::npos;
  const auto root = blank ? std::nullopt : parse_yaml(text, name, problems);
  if (root && root->kind == YamlNode::Kind::map)
    for (const YamlEntry& entry : root->entries)
      if (auto curve = CurveReader(entry, problems).read()) curves.push_back(std::move(*curve));
  if (curves.empty() && problems.empty()) {
    FileProblem& none = problems.emplace_back();
    none.at.source = name;
    none.message = fmt::format("holds no class (a curve for each is needed). Write {}, say.",
                               "`timber: {pressure_kpa: [[5, 0], [30, 1]]}`");
  }
  std::vector<std::string> lines;
  for (const FileProblem& p : problems)
    lines.push_back(fmt::format("{}: {}", p.at.text(), p.message));
  require(problems.empty(), fmt::format("{}", fmt::join(lines, "\n")));
  return curves;
}

}  // namespace sturz
