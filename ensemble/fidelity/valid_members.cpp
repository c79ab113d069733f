// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/valid_members.hpp"

#include "engine/core/error.hpp"
#include "ensemble/censoring/scalar_censoring.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

ByNumber valid_members(const MemberParts& source) {
  ByNumber found;
  for (const MemberSummary& m : source.members())
    if (is_valid(m.outcome)) found.emplace(m.member, &m);
  return found;
}

const ScalarInfo& scalar_named(const std::string& name) {
  const auto table = scalar_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const ScalarInfo& s) { return name == s.name; });
  expect(found != table.end(), "a result of scalar_table()");
  return *found;
}

bool is_known(const MemberSummary& m, double MemberScalars::*field) {
  return known(field, m.censoring) == Known::exactly && std::isfinite(m.scalars.*field);
}

std::vector<std::int64_t> common_members(std::span<const ByNumber> sources) {
  std::vector<std::int64_t> numbers;
  for (const auto& [number, summary] : sources.front())
    if (std::all_of(sources.begin(), sources.end(),
                    [n = number](const ByNumber& s) { return s.contains(n); }))
      numbers.push_back(number);
  return numbers;
}

}  // namespace sturz
