// SPDX-License-Identifier: Apache-2.0
/// Numbers as JSON, which knows no NaN.
#pragma once

#include "ensemble/fidelity/refinement.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <vector>

namespace sturz::workflow {

using Json = nlohmann::ordered_json;

/// null where it is not finite
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
inline Json interval(const Interval& i) { return {number(i.low), number(i.high)}; }
inline Json numbers(const std::vector<double>& values) {
  Json all = Json::array();
  for (const double v : values) all.push_back(number(v));
  return all;
}

}  // namespace sturz::workflow
