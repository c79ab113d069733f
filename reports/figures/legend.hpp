// SPDX-License-Identifier: Apache-2.0
/// The classes and colours in which a layer of results is drawn.
#pragma once

#include "reports/figures/colours.hpp"
#include "reports/layer_titles.hpp"
#include "reports/page/text.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <string>
#include <vector>

namespace sturz {

/// One class of a legend: from `lower` (shown units) to the next class's lower.
struct LegendClass {
  double lower = 0;
  std::string label;
  Rgb colour;
};

struct Legend {
  std::string title;  ///< what the classes are of, with its unit: "Flow speed [m/s]"
  DisplayUnit unit;
  bool probability = false;  ///< shown in per cent
  bool clear_zero = true;    ///< cells with 0 are not painted (NaN never is)
  bool nominal = false;      ///< values are names: their order means nothing
  bool diverging = false;    ///< values below 0 are painted as those above are
  std::vector<LegendClass> classes;

  /// Index of the class of a stored value; -1 where the cell stays clear.
  int class_of(float stored) const;
};
/// Classes that cover all planes of `layer`: its own where its numbers stand for classes; fixed
/// ones for probabilities, and for differences of them, symmetric about 0; a 1-2-5 series up to the
/// largest value for magnitudes, even steps for times. Never empty.
Legend legend_for(const Layer& layer);

}  // namespace sturz
