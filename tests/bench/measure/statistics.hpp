// SPDX-License-Identifier: Apache-2.0
/// A sample by its ranks: median, range, and an interval that assumes no distribution.
#pragma once

#include <vector>

namespace sturz::bench {

struct Summary {
  double median = 0, least = 0, most = 0;
  double low = 0, high = 0;  ///< interval of the median from order statistics
  double coverage = 0;       ///< its confidence: >= 0.95 from six values on
  int n = 0;
};

/// \pre at least one value
Summary summarize(std::vector<double> values);

/// a[k] / b[k]
std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace sturz::bench
