// SPDX-License-Identifier: Apache-2.0
#include "reports/page/estimate_text.hpp"

#include "reports/page/headline.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace sturz {

std::string value_text(const CensoredEstimate& e, const NumberWriter& number) {
  if (!std::isnan(e.least)) {
    const std::string least = number(e.least), most = number(e.most);
    return least == most ? least : least + " to " + most;
  }
  if (std::isnan(e.value)) return e.n > 0 ? "not known" : "\u2013";
  return (e.at_least ? "\u2265\u00A0" : "") + number(e.value);
}

std::string interval_text(const CensoredEstimate& e, const NumberWriter& number) {
  if (std::isnan(e.lower) || std::isnan(e.upper)) return "too few simulations for an interval";
  const std::string level = percent_text(interval_confidence) + " interval ";
  if (std::isinf(e.lower) && std::isinf(e.upper)) return "no interval: too many are cut off";
  if (std::isinf(e.upper)) return level + "from " + number(e.lower) + ", upper end not known";
  if (std::isinf(e.lower)) return level + "up to " + number(e.upper) + ", lower end not known";
  return level + number(e.lower) + " \u2013 " + number(e.upper);
}

std::string cut_text(const CensoredEstimate& e) {
  const std::size_t n = e.n_at_least + e.n_not_at_all;
  return n == 0 ? std::string() : fmt::format("{} of {} cut off", n, e.n);
}

}  // namespace sturz
