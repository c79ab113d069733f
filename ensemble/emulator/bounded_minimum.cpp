// SPDX-License-Identifier: Apache-2.0
#include "ensemble/emulator/bounded_minimum.hpp"

#include "engine/core/error.hpp"
#include "ensemble/emulator/openturns_function.hpp"

#include <openturns/Cobyla.hxx>
#include <openturns/Exception.hxx>
#include <openturns/Interval.hxx>
#include <openturns/Log.hxx>
#include <openturns/OptimizationProblem.hxx>

#include <algorithm>

namespace sturz {

Minimum bounded_minimum(const std::function<double(std::span<const double>)>& function,
                        std::vector<double> start, int evaluations) {
  const std::size_t n = start.size();
  expect(n > 0, "a search needs a coordinate");
  OT::Log::Show(OT::Log::NONE);
  Minimum best{start, function(start)};
  std::vector<double> inside(n);
  // The simplex may step over the edge: it sees the value at the nearest point of the box.
  const auto looked_at = [&](std::span<const double> x) {
    for (std::size_t d = 0; d < n; ++d) inside[d] = std::clamp(x[d], 0.0, 1.0);
    const double value = function(inside);
    if (value < best.value) best = {inside, value};
    return value;
  };
  try {
    OT::OptimizationProblem problem(openturns_function(n, looked_at));
    problem.setBounds(OT::Interval(OT::Point(n, 0.0), OT::Point(n, 1.0)));
    OT::Cobyla search(problem);
    search.setStartingPoint(openturns_point(start));
    search.setRhoBeg(0.15);
    search.setMaximumAbsoluteError(1e-4);
    search.setMaximumEvaluationNumber(static_cast<OT::UnsignedInteger>(evaluations));
    search.setIgnoreFailure(true);
    search.run();
  } catch (const OT::Exception&) {  // it gave up: the best point so far is what there is
  }
  return best;
}

}  // namespace sturz
