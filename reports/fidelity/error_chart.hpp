// SPDX-License-Identifier: Apache-2.0
/// Error against seconds, both as powers of ten: one line per way of computing.
#pragma once

#include <string>
#include <vector>

namespace sturz {

struct ErrorLine {
  std::string label;               ///< for the legend
  std::string paint;               ///< name of its colour in the style sheet: front, centre, ...
  std::vector<double> seconds;     ///< > 0
  std::vector<double> errors;      ///< relative; points without a finite positive one are left out
  std::vector<std::string> notes;  ///< of each point, shown at it: "4 m"
};

/// Ends of both axes, whole powers of ten; the same for charts that stand beside each other.
struct ErrorAxes {
  double least_s = 0.01, most_s = 1, least_error = 0.001, most_error = 1;
};
ErrorAxes axes_for(const std::vector<ErrorLine>& lines);

/// A still picture with its own axes, for the page's style. \param wanted a line across at this
/// error; 0: none
std::string error_chart_svg(const std::string& title, const std::vector<ErrorLine>& lines,
                            const ErrorAxes& axes, double wanted);

}  // namespace sturz
