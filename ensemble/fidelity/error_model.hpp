// SPDX-License-Identifier: Apache-2.0
/// How far a result at a spacing is off, from the same members at several spacings.
///
/// A member's result at spacing d is taken to be
///   Q_m(d) = limit_m + (bias + slope_m) x^p + (common(d) + own_m(d)) x^q,   x = d / finest
///   spacing,
/// with slope_m, common(d) and own_m(d) normal numbers of unknown deviation: Richardson's law with
/// an order p, members that do not all err alike, and what lattice and ground do to one spacing by
/// chance, to all members together and to each. own_m(d) has the noise of a displaced twin on top.
/// Which values of the unknowns fit is told by the mean and the covariance of the n members'
/// differences between spacings (normal and Wishart likelihoods; the mean of n slopes has the
/// variance slope^2 / n, and cannot be told from bias); they are summed over a grid, with the order
/// that a scheme with fronts of one particle has as prior (p and q about 1), and each size of a
/// deviation as likely in logarithms, from nothing on. A random-effects form of Richardson
/// extrapolation; see Gelman et al. 2013, Bayesian Data Analysis, ch. 5 and 15.
#pragma once

#include "engine/terrain/raster.hpp"

#include <span>
#include <vector>

namespace sturz {

/// Expected size of an error or a difference, in the result's unit: root mean square for given
/// deviations and orders, averaged over those that may be.
struct ExpectedSize {
  double member = nan_d;  ///< over the members
  double mean = nan_d;    ///< of their mean
};

/// A spacing whose results are compared with the limit or with a finer one.
struct ErrorQuestion {
  double spacing_m = 0;
  double finer_m = 0;  ///< 0: the limit
};

/// \param spacings_m coarsest first, two or more
/// \param values [n_spacings][n_members], the same members at every spacing
/// \param noise deviation of a member's result under next to no change; 0 where it is not known
/// \param questions distance of a spacing from its limit, of the mean over very many members; or
/// from a
///   finer spacing that was not computed, of the mean over as many members as there are
/// \return one per question; NaN with fewer than two spacings
/// \throws std::logic_error for spacings that do not descend, or columns of other lengths
std::vector<ExpectedSize> expected_sizes(std::span<const double> spacings_m,
                                         const std::vector<std::vector<double>>& values,
                                         double noise, std::span<const ErrorQuestion> questions);

/// The same of maps, whose distances are sizes already: distance(d, e)^2 = bias^2 (x^p - y^p)^2 +
/// scatter^2 (x^2q + y^2q) + noise^2.
/// \param distances [n_spacings][n_spacings] of each pair, relative; symmetric
std::vector<double> expected_distances(std::span<const double> spacings_m,
                                       const std::vector<std::vector<double>>& distances,
                                       double noise, std::span<const ErrorQuestion> questions);

}  // namespace sturz
