// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/ladder.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/valid_members.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

double deviation(std::span<const double> values) {
  if (values.size() < 2) return nan_d;
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / (n - 1));
}

double root_mean_square(std::span<const double> a, std::span<const double> b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(squares / static_cast<double>(a.size()));
}

/// A displaced member and its twin differ by the noise of both: root two of it.
double noise_of(const ByNumber& twins, const ByNumber& displaced, double MemberScalars::*field) {
  std::vector<double> a, b;
  for (const auto& [number, twin] : twins) {
    const auto other = displaced.find(number);
    if (other == displaced.end() || !is_known(*twin, field) || !is_known(*other->second, field))
      continue;
    a.push_back(twin->scalars.*field);
    b.push_back(other->second->scalars.*field);
  }
  return a.empty() ? nan_d : root_mean_square(a, b) / std::sqrt(2);
}

std::optional<ResultAccuracy> result_accuracy(const std::string& name,
                                              std::span<const double> spacings,
                                              std::span<const ByNumber> rungs,
                                              std::span<const std::int64_t> members,
                                              std::uint64_t seed) {
  const ScalarInfo& scalar = scalar_named(name);
  ResultAccuracy r;
  r.name = name;
  r.units = scalar.units;
  std::vector<std::vector<double>> values(rungs.size());
  for (const std::int64_t number : members) {
    if (!std::all_of(rungs.begin(), rungs.end(), [&](const ByNumber& rung) {
          return is_known(*rung.at(number), scalar.field);
        }))
      continue;
    for (std::size_t l = 0; l < rungs.size(); ++l)
      values[l].push_back(rungs[l].at(number)->scalars.*scalar.field);
  }
  r.n_members = static_cast<std::int64_t>(values.front().size());
  if (r.n_members == 0) return std::nullopt;
  r.refinement = refine(spacings, values, seed);
  for (const auto& level : values) r.member_rms.push_back(root_mean_square(level, values.back()));
  r.spread = deviation(values.back());
  return r;
}

/// Distances from the finest map fall as d^p - d_finest^p: an order of one unless three and more
/// spacings tell another, and from it what the finest itself is off by.
std::vector<double> map_errors(std::span<const double> spacings,
                               std::span<const MapDistance> distances) {
  const double finest = spacings.back();
  double order = 1;
  if (spacings.size() >= 3) {
    const double wanted = distances[0].relative() / distances[spacings.size() - 2].relative();
    const auto ratio = [&](double p) {
      const double f = std::pow(finest, p);
      return (std::pow(spacings.front(), p) - f) / (std::pow(spacings[spacings.size() - 2], p) - f);
    };
    double low = 0.5, high = 2;
    for (int i = 0; i < 50; ++i)
      (ratio(0.5 * (low + high)) < wanted ? low : high) = 0.5 * (low + high);
    order = 0.5 * (low + high);
  }
  std::vector<double> errors;
  if (spacings.size() < 2) return {nan_d};
  const double per_power =
      distances.front().relative() / (std::pow(spacings.front(), order) - std::pow(finest, order));
  const double rest = per_power * std::pow(finest, order);
  for (const MapDistance& d : distances) errors.push_back(d.relative() + rest);
  return errors;
}

MapAccuracy map_accuracy(std::span<const Rung> rungs, std::span<const double> spacings,
                         const std::vector<std::int64_t>& members, double threshold_m,
                         CancelFlag cancel) {
  Window extent;
  for (const Rung& rung : rungs)
    for (const MemberSummary& m : rung.members->members())
      if (std::binary_search(members.begin(), members.end(), m.member))
        extent = joined(extent, m.window);
  MapAccuracy map;
  map.threshold_m = threshold_m;
  const Raster<double> finest =
      share_thicker(*rungs.back().members, members, extent, threshold_m, cancel);
  for (const Rung& rung : rungs)
    map.distances.push_back(
        map_distance(share_thicker(*rung.members, members, extent, threshold_m, cancel), finest));
  map.relative_errors = map_errors(spacings, map.distances);
  return map;
}

void add_seconds(LadderAccuracy& ladder, std::span<const ByNumber> rungs) {
  for (const ByNumber& rung : rungs) {
    double sum = 0;
    for (const std::int64_t number : ladder.members) sum += rung.at(number)->scalars.cpu_s;
    // A member of no time at all would have no logarithm.
    ladder.member_cpu_s.push_back(std::max(1e-6, sum / static_cast<double>(ladder.members.size())));
  }
  ladder.seconds = fit_power_law(ladder.spacings_m, ladder.member_cpu_s,
                                 ladder.formulation == "depth_averaged" ? -3 : -4);
}

}  // namespace

double ResultAccuracy::scale() const { return std::abs(refinement.limit); }

double ResultAccuracy::relative_error(double spacing_m) const {
  const double left_by_noise =
      std::isfinite(noise) ? noise / std::sqrt(static_cast<double>(n_members)) : 0;
  return std::max(refinement.error_at(spacing_m), left_by_noise) / scale();
}

LadderAccuracy ladder_accuracy(std::string formulation, std::span<const Rung> rungs,
                               const MemberParts* displaced, std::size_t displaced_rung,
                               const LadderQuestions& questions, CancelFlag cancel) {
  LadderAccuracy ladder;
  ladder.formulation = std::move(formulation);
  std::vector<ByNumber> by_number;
  for (const Rung& rung : rungs) {
    ladder.spacings_m.push_back(rung.spacing_m);
    by_number.push_back(valid_members(*rung.members));
    ladder.n_asked =
        std::max(ladder.n_asked, static_cast<std::int64_t>(rung.members->members().size()));
  }
  ladder.members = common_members(by_number);
  require(
      !ladder.members.empty(),
      ladder.formulation +
          ": no member is valid at every spacing (there is nothing to compare). See members.csv "
          "in the folders of the spacings for the reasons.");
  add_seconds(ladder, by_number);
  const ByNumber twins = displaced != nullptr ? valid_members(*displaced) : ByNumber{};
  for (const std::string& name : questions.results) {
    auto result =
        result_accuracy(name, ladder.spacings_m, by_number, ladder.members, questions.seed);
    if (!result) {
      ladder.not_told.push_back(name);
      continue;
    }
    if (displaced != nullptr)
      result->noise = noise_of(by_number[displaced_rung], twins, scalar_named(name).field);
    ladder.results.push_back(std::move(*result));
  }
  for (const double threshold : questions.thickness_m)
    ladder.maps.push_back(
        map_accuracy(rungs, ladder.spacings_m, ladder.members, threshold, cancel));
  return ladder;
}

std::vector<Change> changes(const MemberParts& rung, const MemberParts& other,
                            std::span<const std::string> results) {
  const ByNumber a = valid_members(rung), b = valid_members(other);
  std::vector<Change> all;
  for (const std::string& name : results) {
    const ScalarInfo& scalar = scalar_named(name);
    std::vector<double> differences;
    double sum = 0;
    for (const auto& [number, member] : a) {
      const auto twin = b.find(number);
      if (twin == b.end() || !is_known(*member, scalar.field) ||
          !is_known(*twin->second, scalar.field))
        continue;
      differences.push_back(twin->second->scalars.*scalar.field - member->scalars.*scalar.field);
      sum += member->scalars.*scalar.field;
    }
    const auto n = static_cast<double>(differences.size());
    if (differences.empty()) continue;
    Change c;
    c.name = name;
    c.units = scalar.units;
    c.mean = 0;
    for (const double d : differences) c.mean += d / n;
    c.standard_error = deviation(differences) / std::sqrt(n);
    c.rung_mean = sum / n;
    c.n_members = static_cast<std::int64_t>(differences.size());
    all.push_back(std::move(c));
  }
  return all;
}

double seconds_ratio(const MemberParts& rung, const MemberParts& other) {
  const ByNumber a = valid_members(rung), b = valid_members(other);
  double of_rung = 0, of_other = 0;
  for (const auto& [number, member] : a) {
    const auto twin = b.find(number);
    if (twin == b.end()) continue;
    of_rung += member->scalars.cpu_s;
    of_other += twin->second->scalars.cpu_s;
  }
  return of_rung > 0 ? of_other / of_rung : nan_d;
}

}  // namespace sturz
