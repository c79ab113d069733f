// SPDX-License-Identifier: Apache-2.0
/// The charts of a run over time, defined once for the still pictures and for the script.
#pragma once

#include "engine/simulation/history.hpp"

#include <string>
#include <vector>

namespace sturz {

struct MotionLine {
  std::string label;           ///< for the legend
  std::string paint;           ///< name of its colour in the style sheet: --front, --dense, ...
  std::vector<double> values;  ///< [time], in the chart's unit; stacked: upper edges
};

struct MotionChart {
  std::string name;  ///< "travel", "speed", "states"
  std::string title;
  std::string unit;      ///< of the vertical axis
  double top = 1;        ///< end of the vertical axis, which begins at 0
  bool stacked = false;  ///< lines from the bottom up, the area under each belongs to it
  std::vector<MotionLine> lines;
};

/// Travel, speed, and where the scene has them states. Empty for fewer than two rows.
std::vector<MotionChart> motion_charts(const MemberHistory& history);
/// End of an axis that holds `most`.
double round_top(double most);
/// [time] s
std::vector<double> motion_times(const MemberHistory& history);

/// A still picture for readers without script and for print; the legend is the page's.
std::string motion_chart_svg(const MotionChart& chart, const std::vector<double>& times);

}  // namespace sturz
