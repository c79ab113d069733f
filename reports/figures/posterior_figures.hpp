// SPDX-License-Identifier: Apache-2.0
/// Still pictures of a sample before and after it was compared with observations.
#pragma once

#include <span>
#include <string>

namespace sturz {

/// Two histograms of one value over a common axis, each of area 1: before as a line, after as an
/// area. Values that are not finite are left out; empty text where nothing is left.
std::string marginal_svg(std::span<const double> before, std::span<const double> after,
                         const std::string& label);

/// Two values against one another, a dot for each point after; the axes hold the points before.
std::string pair_svg(std::span<const double> x_before, std::span<const double> y_before,
                     std::span<const double> x_after, std::span<const double> y_after,
                     const std::string& x_label, const std::string& y_label);

}  // namespace sturz
