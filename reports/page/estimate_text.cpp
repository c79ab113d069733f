// SPDX-License-Identifier: Apache-2.0
#include "reports/page/estimate_text.hpp"

#include "reports/page/headline.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <cmath>

namespace sturz {

std::string value_text(const CensoredEstimate& e, const NumberWriter& number) {
  if (!std::isnan(e.least)) {
    const std::string least = number(e.least), most = number(e.most);
    return least == most ? least : least + tr("cards.to") + most;
  }
  if (std::isnan(e.value)) return e.n > 0 ? tr("cards.not_known") : "\u2013";
  return (e.at_least ? "\u2265\u00A0" : "") + number(e.value);
}

std::string interval_text(const CensoredEstimate& e, const NumberWriter& number) {
  if (std::isnan(e.lower) || std::isnan(e.upper)) return tr("cards.few_for_interval");
  const std::string level = tr("cards.interval", percent_text(interval_confidence));
  if (std::isinf(e.lower) && std::isinf(e.upper)) return tr("cards.no_interval");
  if (std::isinf(e.upper)) return level + tr("cards.from_open", number(e.lower));
  if (std::isinf(e.lower)) return level + tr("cards.to_open", number(e.upper));
  return level + number(e.lower) + " \u2013 " + number(e.upper);
}

std::string cut_text(const CensoredEstimate& e) {
  const std::size_t n = e.n_at_least + e.n_not_at_all;
  return n == 0 ? std::string() : tr("cards.cut_of", n, e.n);
}

}  // namespace sturz
