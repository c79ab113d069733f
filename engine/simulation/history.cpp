// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/history.hpp"

#include <array>
#include <cmath>

namespace sturz {
namespace {

using R = HistoryRow;
using enum HistoryPart;

constexpr std::array columns{
    HistoryColumn{"time", "s", "time since the release", motion, &R::time_s},
    HistoryColumn{"front_travel", "m", "horizontal travel of the farthest particle", motion,
                  &R::front_travel_m},
    HistoryColumn{"tail_travel", "m", "horizontal travel that 5 % of the mass have not reached",
                  motion, &R::tail_travel_m},
    HistoryColumn{"com_travel", "m", "horizontal travel of the centre of mass", motion,
                  &R::com_travel_m},
    HistoryColumn{"front_speed", "m s-1", "mean speed of the foremost 1 % of the mass", motion,
                  &R::front_speed_m_s},
    HistoryColumn{"tail_speed", "m s-1", "mean speed of the rearmost 1 % of the mass", motion,
                  &R::tail_speed_m_s},
    HistoryColumn{"mean_speed", "m s-1", "mean speed of the mass", motion, &R::mean_speed_m_s},
    HistoryColumn{"max_speed", "m s-1", "speed of the fastest particle", motion, &R::max_speed_m_s},
    HistoryColumn{"kinetic_energy", "J", "kinetic energy of the mass", motion,
                  &R::kinetic_energy_j},
    HistoryColumn{"dense_share", "1", "share of the mass in the dense state", states, &R::dense},
    HistoryColumn{"transition_share", "1", "share of the mass between dense and dilute", states,
                  &R::transition},
    HistoryColumn{"dilute_share", "1", "share of the mass in the dilute state", states, &R::dilute},
    HistoryColumn{"ultradilute_share", "1",
                  "share of the mass in the ultradilute state: grains on their own", states,
                  &R::ultradilute},
    HistoryColumn{"mean_granular_temperature", "m2 s-2", "mean granular temperature of the mass",
                  temperature, &R::mean_granular_temperature_m2_s2},
    HistoryColumn{"max_granular_temperature", "m2 s-2", "largest granular temperature", temperature,
                  &R::max_granular_temperature_m2_s2},
    HistoryColumn{"mean_solid_fraction", "1", "mean solid fraction of the mixture", mixture,
                  &R::mean_solid_fraction},
    HistoryColumn{"mean_pore_pressure_ratio", "1",
                  "mean basal pore pressure over total normal stress", mixture,
                  &R::mean_pore_pressure_ratio},
    HistoryColumn{"film_water", "m3", "water that the mixture has given off and carries", mixture,
                  &R::film_m3},
};
// A column that is added to the row but forgotten here would silently miss from every file.
static_assert(columns.size() * sizeof(float) == sizeof(HistoryRow));

}  // namespace

std::span<const HistoryColumn> history_table() { return columns; }

double HistoryRecorder::bin(double time_s) const { return std::floor(time_s / interval_s_); }

bool HistoryRecorder::wants(double time_s) const {
  return rows_.empty() || bin(static_cast<float>(time_s)) > bin(rows_.back().time_s);
}

void HistoryRecorder::add(const HistoryRow& row) {
  if (!wants(row.time_s)) return;
  while (rows_.size() >= most_rows) thin_out();
  if (wants(row.time_s)) rows_.push_back(row);
}

void HistoryRecorder::add_last(const HistoryRow& row) {
  if (!rows_.empty() && rows_.back().time_s >= row.time_s) rows_.pop_back();
  while (rows_.size() >= most_rows) thin_out();
  rows_.push_back(row);
}

void HistoryRecorder::thin_out() {
  interval_s_ *= 2;
  std::size_t kept = 1;
  for (std::size_t i = 1; i < rows_.size(); ++i)
    if (bin(rows_[i].time_s) > bin(rows_[kept - 1].time_s)) rows_[kept++] = rows_[i];
  rows_.resize(kept);
}

}  // namespace sturz
