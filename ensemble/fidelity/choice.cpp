// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace sturz {
namespace {

constexpr int n_between = 100;  // spacings looked at between the coarsest and the finest

/// From the coarsest to the finest in equal ratios.
double spacing_number(const LadderAccuracy& ladder, int k) {
  const double coarsest = ladder.spacings_m.front(), finest = ladder.spacings_m.back();
  if (k == 0) return coarsest;
  if (k == n_between) return finest;
  return coarsest * std::pow(finest / coarsest, static_cast<double>(k) / n_between);
}

double between(const std::vector<double>& spacings, const std::vector<double>& values,
               double spacing_m) {
  if (spacing_m >= spacings.front()) return values.front();
  for (std::size_t l = 1; l < spacings.size(); ++l) {
    if (spacing_m < spacings[l]) continue;
    const double share = (spacing_m - spacings[l]) / (spacings[l - 1] - spacings[l]);
    return values[l] + share * (values[l - 1] - values[l]);
  }
  return values.back();
}

bool is_asked(std::span<const std::string> what, const std::string& name) {
  return std::find(what.begin(), what.end(), name) != what.end();
}

/// Where all is within `wanted` by the orders; NaN when one has none, or the map is not.
double spacing_by_orders(const LadderAccuracy& ladder, std::span<const std::string> what,
                         double wanted) {
  double spacing = ladder.spacings_m.back();
  if (is_asked(what, map_word) && !ladder.maps.empty() &&
      !(ladder.maps.front().relative_errors.back() <= wanted))
    return nan_d;
  for (const ResultAccuracy& r : ladder.results) {
    if (!is_asked(what, r.name) || r.relative_error(spacing) <= wanted) continue;
    if (!r.refinement.converges) return nan_d;
    spacing = std::min(spacing, std::pow(wanted * r.scale() / std::abs(r.refinement.coefficient),
                                         1 / r.refinement.used_order));
  }
  return spacing < ladder.spacings_m.back() ? spacing : nan_d;
}

}  // namespace

ErrorAt error_at(const LadderAccuracy& ladder, std::span<const std::string> what,
                 double spacing_m) {
  ErrorAt worst;
  const auto look = [&](double error, const std::string& of) {
    if (is_asked(what, of) && !(error <= worst.error)) worst = {error, of};
  };
  for (const ResultAccuracy& r : ladder.results) look(r.relative_error(spacing_m), r.name);
  if (!ladder.maps.empty())
    look(between(ladder.spacings_m, ladder.maps.front().relative_errors, spacing_m), map_word);
  return worst;
}

Choice cheapest_for(const LadderAccuracy& ladder, std::span<const std::string> what,
                    double wanted) {
  Choice choice;
  choice.predicted = error_at(ladder, what, ladder.spacings_m.back());
  // From the finest on: a coarse one that happens to be near does not count.
  for (int k = n_between; k >= 0; --k) {
    const double spacing = spacing_number(ladder, k);
    const ErrorAt here = error_at(ladder, what, spacing);
    if (!(here.error <= wanted)) break;
    choice.predicted = here;
    choice.spacing_m = spacing;
    choice.member_cpu_s = ladder.seconds.at(spacing);
    choice.coarsest = k == 0;
  }
  if (std::isnan(choice.spacing_m))
    choice.finer_spacing_m = spacing_by_orders(ladder, what, wanted);
  return choice;
}

Split split_at(const LadderAccuracy& ladder, double core_s, double spacing_m) {
  Split split;
  const double members = core_s / ladder.seconds.at(spacing_m);
  if (!(members >= 2)) return split;
  double resolution = 0, sampling = 0;
  int n = 0;
  for (const ResultAccuracy& r : ladder.results) {
    const double error = r.relative_error(spacing_m);
    if (!std::isfinite(error) || !std::isfinite(r.spread)) continue;
    resolution += error * error;
    sampling += std::pow(r.spread / r.scale(), 2) / members;
    ++n;
  }
  if (n == 0) return split;
  split.spacing_m = spacing_m;
  split.members = members;
  split.resolution = std::sqrt(resolution / n);
  split.sampling = std::sqrt(sampling / n);
  split.error = std::hypot(split.resolution, split.sampling);
  return split;
}

Split best_split(const LadderAccuracy& ladder, double core_s) {
  Split best;
  for (int k = 0; k <= n_between; ++k) {
    const Split split = split_at(ladder, core_s, spacing_number(ladder, k));
    if (std::isfinite(split.error) && !(split.error >= best.error)) best = split;
  }
  return best;
}

}  // namespace sturz
