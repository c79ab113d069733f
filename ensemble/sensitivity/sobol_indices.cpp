// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sensitivity/sobol_indices.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/wilson.hpp"
#include "ensemble/sampling/structured_cube.hpp"

#include <openturns/Exception.hxx>
#include <openturns/Interval.hxx>
#include <openturns/Log.hxx>
#include <openturns/MartinezSensitivityAlgorithm.hxx>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;

constexpr std::size_t least_sets = 8;
/// Evaluations of an emulator cost microseconds.
constexpr std::size_t emulated_sets = 1024;
constexpr std::size_t most_groups = 10;

/// Numbers of the sets of which every result is fully known.
std::vector<std::size_t> whole_sets(std::span<const Observation> results, std::size_t set) {
  std::vector<std::size_t> whole;
  for (std::size_t s = 0; (s + 1) * set <= results.size(); ++s) {
    const auto of_set = results.subspan(s * set, set);
    if (std::all_of(of_set.begin(), of_set.end(), [](const Observation& o) {
          return o.known == Known::exactly && std::isfinite(o.value);
        }))
      whole.push_back(s);
  }
  return whole;
}

/// Martinez' first indices are correlations r, his total ones 1 - r. Where r is 1 to rounding the
/// asymptotic interval is 0 / 0 and may be anything: it ends where a correlation does.
std::vector<Share> shares(const OT::Point& values, const OT::Interval& interval, double least,
                          double most) {
  std::vector<Share> all;
  for (OT::UnsignedInteger d = 0; d < values.getSize(); ++d) {
    const double value = std::clamp(values[d], least, most);
    all.push_back({value, std::max(least, std::min(value, interval.getLowerBound()[d])),
                   std::min(most, std::max(value, interval.getUpperBound()[d]))});
  }
  return all;
}

bool varies(const OT::Sample& results) { return results.getMax()[0] > results.getMin()[0]; }

}  // namespace

std::optional<SobolIndices> sobol_indices(const Points& cube,
                                          std::span<const Observation> results) {
  expect(cube.size() == results.size(), "one result per row");
  if (cube.empty() || cube.front().empty()) return {};
  const std::size_t n_dims = cube.front().size(), set = n_dims + 2;
  const std::vector<std::size_t> whole = whole_sets(results, set);
  SobolIndices found;
  found.n_sets = static_cast<std::int64_t>(whole.size());
  found.n_left_out = static_cast<std::int64_t>(cube.size() / set - whole.size());
  if (whole.size() < least_sets) return {};
  // OpenTURNS wants all first rows, then all second rows, and so on.
  const auto n = static_cast<OT::UnsignedInteger>(whole.size());
  OT::Sample in(n * set, n_dims), out(n * set, 1);
  for (std::size_t place = 0; place < set; ++place)
    for (std::size_t s = 0; s < whole.size(); ++s) {
      const std::size_t from = whole[s] * set + place, to = place * whole.size() + s;
      for (std::size_t d = 0; d < n_dims; ++d) in(to, d) = cube[from][d];
      out(to, 0) = results[from].value;
    }
  if (!varies(out)) return {};
  if (n_dims == 1) {  // what varies does so by this value alone
    found.first = found.total = {{1, 1, 1}};
    return found;
  }
  OT::Log::Show(OT::Log::NONE);
  try {
    OT::MartinezSensitivityAlgorithm martinez(in, out, n);
    martinez.setUseAsymptoticDistribution(true);  // draws nothing
    martinez.setConfidenceLevel(0.95);
    found.first =
        shares(martinez.getFirstOrderIndices(), martinez.getFirstOrderIndicesInterval(), -1, 1);
    found.total =
        shares(martinez.getTotalOrderIndices(), martinez.getTotalOrderIndicesInterval(), 0, 2);
  } catch (const OT::Exception&) {
    return {};
  }
  return found;
}

namespace {

SobolIndices of_emulator(const QuantityEmulator& emulator, const Points& saltelli) {
  std::vector<Observation> results;
  for (const auto& row : saltelli) results.push_back({emulator.mean_at(row), Known::exactly});
  return sobol_indices(saltelli, results).value_or(SobolIndices{});
}

/// Widens an interval by a standard error that is independent of it.
void widen(Share& share, double error) {
  const double more = z_95 * error;
  share.lower = share.value - std::hypot(share.value - share.lower, more);
  share.upper = share.value + std::hypot(share.upper - share.value, more);
}

/// Square root of (g - 1) / g times the sum of squared deviations over g groups left out.
double jackknife_error(std::span<const double> without) {
  const auto g = static_cast<double>(without.size());
  double mean = 0, squares = 0;
  for (const double v : without) mean += v / g;
  for (const double v : without) squares += (v - mean) * (v - mean);
  return std::sqrt((g - 1) / g * squares);
}

/// The indices of emulators that know all members but one group each, scales and trend of the
/// whole.
std::vector<SobolIndices> without_groups(const QuantityEmulator& whole, const Points& cube,
                                         std::span<const Observation> results,
                                         const Points& saltelli) {
  const std::vector<std::size_t> members = teaching_members(results);
  const std::size_t n_groups = std::min(most_groups, members.size());
  std::vector<SobolIndices> all;
  for (std::size_t g = 0; g < n_groups; ++g) {
    Points points;
    std::vector<double> values;
    for (std::size_t place = 0; place < members.size(); ++place) {
      if (place % n_groups == g) continue;
      points.push_back(cube[members[place]]);
      values.push_back(results[members[place]].value);
    }
    const auto others = whole.of_others(points, values);
    if (!others) continue;
    SobolIndices indices = of_emulator(*others, saltelli);
    if (!indices.first.empty()) all.push_back(std::move(indices));
  }
  return all;
}

}  // namespace

EmulatedIndices emulated_indices(const std::string& quantity, const Points& cube,
                                 std::span<const Observation> results, std::uint64_t seed) {
  const QuantityEmulator emulator = emulate(quantity, cube, results);
  const std::size_t n_dims = cube.front().size();
  const Points saltelli = saltelli_cube(emulated_sets * (n_dims + 2), n_dims, seed);
  EmulatedIndices found{of_emulator(emulator, saltelli), emulator.report()};
  const auto others = without_groups(emulator, cube, results, saltelli);
  if (others.size() < 2) return found;
  for (std::size_t d = 0; d < found.indices.first.size(); ++d) {
    std::vector<double> first, total;
    for (const SobolIndices& o : others) {
      first.push_back(o.first[d].value);
      total.push_back(o.total[d].value);
    }
    widen(found.indices.first[d], jackknife_error(first));
    widen(found.indices.total[d], jackknife_error(total));
  }
  return found;
}

}  // namespace sturz
