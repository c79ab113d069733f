// SPDX-License-Identifier: Apache-2.0
/// What the members of an ensemble saw at their gauges.
#pragma once

#include "engine/simulation/gauges/gauge_result.hpp"
#include "engine/simulation/outcome.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace sturz {

/// One quantity at one gauge over all members. What is not a number says so in words: "never" (not
/// reached in so many members that the quantile is one of them), "> 120" (members were cut off
/// before), "not reached", ">= 3.1", "not known".
struct GaugeRow {
  std::string gauge, quantity, units;
  std::size_t members = 0, reached = 0;
  std::size_t unknown = 0;          ///< cut off before it was known
  std::vector<std::string> values;  ///< one per quantile
};

/// A quantity over time; NaN where no member knows it.
struct GaugeBand {
  std::string gauge, quantity, units;
  std::vector<double> time_s;
  std::vector<std::size_t> members;         ///< that know it, by time
  std::vector<std::vector<double>> values;  ///< [quantile][time]
};

struct GaugeFindings {
  std::vector<double> quantiles;  ///< one, 0.5, for a single member
  bool one_member = false;
  std::vector<GaugeRow> rows;
  std::vector<GaugeBand> bands;  ///< thickness and speed at points, discharge at lines
  bool empty() const { return rows.empty(); }
};

/// Collects member by member; the result does not depend on their order.
///
/// A quantile is the smallest value that at least this share of the members does not exceed. It is
/// looked for twice, with what is not known at its least and at its most; where both agree, it is
/// known.
class GaugeStatistics {
 public:
  /// Only of valid members; those without gauges count for nothing.
  void add(const GaugeResult&, Censoring);
  GaugeFindings findings(std::vector<double> quantiles, bool one_member = false) const;

 private:
  struct Seen {
    GaugeResult result;
    bool cut_off = false;  ///< it still moved at its end
  };
  std::vector<Seen> members_;
};

/// gauge,quantity,units,members,reached,unknown and one column per quantile.
std::string gauges_csv(const GaugeFindings&);
/// gauge,quantity,units,time_s,members and one column per quantile; empty cells are not known.
std::string gauge_series_csv(const GaugeFindings&);
/// "q05"; "value" of a single member.
std::string quantile_name(const GaugeFindings&, std::size_t k);

}  // namespace sturz
