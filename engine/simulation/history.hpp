// SPDX-License-Identifier: Apache-2.0
/// A member's motion over time in a few hundred rows: front and tail, speeds, states of the grains.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

/// One instant, of the mass that is still on the terrain. Travel is the horizontal displacement of
/// a particle from where it started.
struct HistoryRow {
  float time_s = 0;
  float front_travel_m = 0;   ///< of the farthest particle
  float tail_travel_m = 0;    ///< that 5 % of the mass have not passed
  float com_travel_m = 0;     ///< of the centre of mass
  float front_speed_m_s = 0;  ///< mean of the 1 % of the mass that has come farthest
  float tail_speed_m_s = 0;   ///< mean of the 1 % of the mass that has come least far
  float mean_speed_m_s = 0;   ///< of the mass
  float max_speed_m_s = 0;    ///< fastest particle
  float kinetic_energy_j = 0;
  float dense = 0, transition = 0, dilute = 0, ultradilute = 0;  ///< shares of the mass present
  float mean_granular_temperature_m2_s2 = 0;                     ///< of the mass present
  float max_granular_temperature_m2_s2 = 0;
  float mean_solid_fraction = 0;       ///< of a mixture, over its mass
  float mean_pore_pressure_ratio = 0;  ///< basal pore pressure over total normal stress
  float film_m3 = 0;                   ///< water that it has given off and carries
};

/// What a scene must have for a column to mean something.
enum class HistoryPart { motion, states, temperature, mixture };

struct HistoryColumn {
  const char* name;  ///< of the variable, e.g. "front_travel"
  const char* units;
  const char* long_name;
  HistoryPart part;
  float HistoryRow::*field;
};
/// Every column in file order, time first; the one table that netCDF and report share.
std::span<const HistoryColumn> history_table();

/// Not part of any hash: it depends on when the state was sampled, not on what happened.
struct MemberHistory {
  std::vector<HistoryRow> rows;  ///< time rises strictly
  bool has_states = false;       ///< grains.states was asked for
  bool has_temperature = false;  ///< and grains.states.dilute
  bool has_mixture = false;      ///< mixture was asked for

  bool has(HistoryPart part) const {
    switch (part) {
      case HistoryPart::motion:
        return true;
      case HistoryPart::states:
        return has_states;
      case HistoryPart::temperature:
        return has_temperature;
      case HistoryPart::mixture:
        return has_mixture;
    }
    return false;
  }
};

/// Keeps the first row in each interval of simulated time. When there are too many, the interval
/// doubles and the rows that are no longer the first in theirs go: what is left is what the wider
/// interval would have kept from the beginning. Asks for memory once, when it is made.
class HistoryRecorder {
 public:
  static constexpr std::size_t most_rows = 400;

  explicit HistoryRecorder(double interval_s) : interval_s_(interval_s) {
    rows_.reserve(most_rows);
  }
  /// Whether a row of this time would be kept, so that nothing is measured in vain.
  bool wants(double time_s) const;
  /// Takes in a row that is wanted.
  void add(const HistoryRow& row);
  /// Takes in the end of the run, wanted or not; of two rows of one time the later stays.
  void add_last(const HistoryRow& row);

  std::span<const HistoryRow> rows() const { return rows_; }
  double interval_s() const { return interval_s_; }

 private:
  double bin(double time_s) const;
  void thin_out();

  std::vector<HistoryRow> rows_;
  double interval_s_;
};

}  // namespace sturz
