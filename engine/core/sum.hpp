// SPDX-License-Identifier: Apache-2.0
/// A sum whose rounding error does not grow with the number of terms (Neumaier 1974).
#pragma once

#include <cmath>

namespace sturz {

class Sum {
 public:
  void add(double term) {
    const double total = total_ + term;
    lost_ += std::abs(total_) >= std::abs(term) ? (total_ - total) + term : (term - total) + total_;
    total_ = total;
  }
  double value() const { return total_ + lost_; }

 private:
  double total_ = 0, lost_ = 0;
};

}  // namespace sturz
