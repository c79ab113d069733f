// SPDX-License-Identifier: Apache-2.0
/// How sure a probability is that few draws of the dearest level correct.
#pragma once

#include "ensemble/fidelity/refinement.hpp"

#include <cstddef>

namespace sturz {

/// What draws of the dearest level did that the cheaper levels had not foretold.
struct Surprises {
  double draws = 0, squares = 0, cubes = 0;
  /// \param residual of one draw: whether it did (1 or 0) less the probability that was foretold
  void add(double residual) {
    draws += 1;
    squares += residual * residual;
    cubes += residual * residual * residual;
  }
};

/// 90 % bounds of a probability, within 0 and 1, by the score interval of Wilson (1927, J. Am.
/// Statist. Ass. 22, 209-212) for the remainder: if the probability lay higher by d, then by draws
/// that surprise, and the remainder would scatter by some d / n more than those few draws show that
/// happened to have no such one. How much more is the third moment of the remainder over its second
/// (1 - 2 p for draws that are counted), with one surprise beside those that were seen. Plain
/// counts give the end of Wilson's interval that lies nearer to a half; bounds are never nearer to
/// 0 and 1 than unseen_share(). In the middle, where 1 - 2 p is small, they rest on the standard
/// error: a branch that neither a dear draw nor the cheaper levels show does not widen them.
/// \param degrees of freedom of the standard error
Interval share_bounds(double share, double standard_error, double degrees, const Surprises&);

/// What so many draws of the dearest level may still do that all agree: of n of n, the upper end of
/// the 90 % interval of Clopper and Pearson (1934). Cheaper draws are no draws of that level, and
/// do not count, however many they are.
double unseen_share(std::size_t n_dear);

/// So many draws of the dearest level, at least, tell both bounds of a quantile: with fewer its far
/// side may hold less than unseen_share() of all, of which nothing is known.
/// \param level within 0 and 1, neither of them
std::size_t draws_for_quantile(double level);

}  // namespace sturz
