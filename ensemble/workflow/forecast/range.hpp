// SPDX-License-Identifier: Apache-2.0
/// A number that is not known, and between what it will probably lie.
#pragma once

namespace sturz::workflow {

struct Range {
  double likely = 0, low = 0, high = 0;

  /// Off by that factor (>= 1) either way.
  static Range within(double likely, double factor) {
    return {likely, likely / factor, likely * factor};
  }
  Range operator+(const Range& o) const { return {likely + o.likely, low + o.low, high + o.high}; }
  Range operator*(double factor) const { return {likely * factor, low * factor, high * factor}; }
};

}  // namespace sturz::workflow
