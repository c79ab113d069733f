// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/choice.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

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

bool is_asked(std::span<const std::string> what, const std::string& name) {
  return std::find(what.begin(), what.end(), name) != what.end();
}

/// Where all is within `wanted`, down to an eighth of the finest spacing; NaN: not there either.
double spacing_beyond(const LadderAccuracy& ladder, std::span<const std::string> what,
                      double wanted) {
  const double finest = ladder.spacings_m.back();
  for (int k = 1; k <= n_between; ++k) {
    const double spacing = finest * std::pow(8.0, -static_cast<double>(k) / n_between);
    if (error_at(ladder, what, spacing).error <= wanted) return spacing;
  }
  return nan_d;
}

}  // namespace

ErrorAt error_at(const LadderAccuracy& ladder, std::span<const std::string> what,
                 double spacing_m) {
  ErrorAt worst;
  const auto look = [&](double error, const std::string& of) {
    if (!is_asked(what, of)) return;
    // What is not known may be larger than all that is.
    const bool unknown = !worst.of.empty() && std::isnan(worst.error);
    if (!unknown && !(error <= worst.error)) worst = {error, of};
  };
  for (const ResultAccuracy& r : ladder.results) look(r.member_error(spacing_m), r.name);
  if (!ladder.maps.empty()) look(ladder.maps.front().errors.at(spacing_m), map_word);
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
  if (std::isnan(choice.spacing_m)) choice.finer_spacing_m = spacing_beyond(ladder, what, wanted);
  return choice;
}

Split split_at(const LadderAccuracy& ladder, double core_s, double spacing_m,
               std::span<const std::string> what) {
  Split split;
  const double members = core_s / ladder.seconds.at(spacing_m);
  if (!(members >= 2)) return split;
  double resolution = 0, sampling = 0;
  int n = 0;
  for (const ResultAccuracy& r : ladder.results) {
    if (!what.empty() && !is_asked(what, r.name)) continue;
    const double error = r.mean_error(spacing_m);
    if (!std::isfinite(error) || !std::isfinite(r.spread)) continue;
    resolution += error * error;
    sampling += std::pow(r.spread / r.scale(), 2) / members;
    split.of.push_back(r.name);
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

Split best_split(const LadderAccuracy& ladder, double core_s, std::span<const std::string> what) {
  Split best;
  for (int k = 0; k <= n_between; ++k) {
    Split split = split_at(ladder, core_s, spacing_number(ladder, k), what);
    if (!std::isfinite(split.error) || split.error >= best.error) continue;
    split.coarsest = k == 0;
    split.finest = k == n_between;
    best = std::move(split);
  }
  return best;
}

}  // namespace sturz
