// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/rank_agreement.hpp"

#include "engine/core/error.hpp"

#include <cmath>
#include <vector>

namespace sturz {
namespace {

/// 1: a is the larger one, -1: b, 0: not known or equal.
int order(const Observation& a, const Observation& b) {
  const bool a_known = a.known == Known::exactly, b_known = b.known == Known::exactly;
  if (a_known && b_known) return (a.value > b.value) - (a.value < b.value);
  if (b_known && a.known == Known::at_least && a.value >= b.value) return 1;
  if (a_known && b.known == Known::at_least && b.value >= a.value) return -1;
  return 0;
}

}  // namespace

RankAgreement rank_agreement(std::span<const double> parameter,
                             std::span<const Observation> result) {
  expect(parameter.size() == result.size(), "rank_agreement: one parameter per result");
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < result.size(); ++i)
    if (std::isfinite(parameter[i]) && std::isfinite(result[i].value)) rows.push_back(i);
  RankAgreement found;
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t l = 0; l < k; ++l) {
      const std::size_t i = rows[k], j = rows[l];
      const int sign = (parameter[i] > parameter[j]) - (parameter[i] < parameter[j]);
      if (sign == 0) continue;
      ++found.pairs;
      const int larger = order(result[i], result[j]);
      if (larger == 0) continue;
      ++found.ordered;
      sum += sign * larger;
    }
  if (found.ordered > 0) found.tau = static_cast<double>(sum) / static_cast<double>(found.ordered);
  return found;
}

}  // namespace sturz
