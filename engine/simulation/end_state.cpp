// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/end_state.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/sum.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr double moving_share = 1.0 / 20;  // of the largest mean speed

constexpr double most_take_off = 0.01;
constexpr double most_energy_residual = 0.05;

/// Three digits, as a percentage.
std::string percent(double share) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), 100 * share,
                                 std::chars_format::general, 3);
  return std::string(text.data(), end.ptr) + " %";
}

/// Sums over what is there and what left.
struct EndSums {
  double mass = 0, mdx = 0, mdy = 0;             // with travel from the start
  double present = 0, mx = 0, my = 0, fast = 0;  // of what is there, on the map
  double front2 = 0, lowest = std::numeric_limits<double>::infinity();

  /// \param d of the particle, \param mean of its mass, which is less where it took some up
  void add_travel(double m, const Vec2& d, const Vec2& mean, double z) {
    mass += m;
    mdx += m * mean.x();
    mdy += m * mean.y();
    front2 = std::max(front2, d.x() * d.x() + d.y() * d.y());
    lowest = std::min(lowest, z);
  }
};

void add_set(const MovingSet& p, double fast, EndSums& sums) {
  const auto travel = [&](std::uint32_t id, double x, double y) {
    const bool wraps = !p.wrapped_x.empty();
    return Vec2(x - p.start_x[id] + (wraps ? p.wrapped_x[id] : 0),
                y - p.start_y[id] + (wraps ? p.wrapped_y[id] : 0));
  };
  const auto mean = [&](std::uint32_t id, const Vec2& d) {
    return p.lag_x.empty() ? d : Vec2(d - Vec2(p.lag_x[id], p.lag_y[id]));
  };
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double m = p.mass[i];
    const Vec2 d = travel(p.id[i], p.x[i], p.y[i]);
    sums.add_travel(m, d, mean(p.id[i], d), p.z[i]);
    sums.present += m;
    sums.mx += m * p.x[i];
    sums.my += m * p.y[i];
    if (Vec3(p.vx[i], p.vy[i], p.vz[i]).norm() > fast) sums.fast += m;
  }
  for (const Departure& gone : p.departures) {
    const Vec2 d = travel(gone.id, gone.x, gone.y);
    sums.add_travel(gone.mass, d, mean(gone.id, d), gone.z);
  }
}

}  // namespace

void write_travel(const State& s, const ReleaseFacts& release, MemberScalars& m) {
  EndSums sums;
  for (const MovingSet& set : s.sets) add_set(set, moving_share * m.max_mean_speed_m_s, sums);
  if (!(sums.mass > 0)) return;
  const Ledger ledger = s.ledger();
  m.front_travel_m = std::max(m.front_travel_m, std::sqrt(sums.front2));
  m.com_travel_m = std::hypot(sums.mdx, sums.mdy) / sums.mass;
  m.com_drop_m = 0 - ledger.potential / (s.gravity * ledger.brought_mass());  // 0, not -0
  m.com_ratio = m.com_travel_m > 0 ? m.com_drop_m / m.com_travel_m : nan_d;
  m.drop_m = release.top_m - sums.lowest;
  m.end_moving_fraction = sums.fast / ledger.brought_mass();
  m.deposit_com_x_m = sums.present > 0 ? sums.mx / sums.present : nan_d;
  m.deposit_com_y_m = sums.present > 0 ? sums.my / sums.present : nan_d;
}

double runout_of(const MemberResult& result, const ReleaseFacts& release) {
  const Window& w = result.window;
  double far2 = 0;
  for (int r = 0; r < w.n_rows; ++r)
    for (int c = 0; c < w.n_cols; ++c) {
      if (std::isnan(result.layer(PeakLayer::arrival)[std::size_t(r) * w.n_cols + c])) continue;
      const double dx = result.grid.x_center(w.col0 + c) - release.x_m;
      const double dy = result.grid.y_center(w.row0 + r) - release.y_m;
      far2 = std::max(far2, dx * dx + dy * dy);
    }
  return std::sqrt(far2);
}

double mass_on_terrain(const State& s) {
  Sum total;
  for (const MovingSet& set : s.sets)
    for (double m : set.mass) total.add(m);
  return total.value();
}

std::vector<Vec2> places_left(const State& s) {
  std::vector<Vec2> places;
  for (const MovingSet& set : s.sets)
    for (const Departure& gone : set.departures) places.emplace_back(gone.x, gone.y);
  return places;
}

void write_crown_to_toe(const Terrain& ground, const ReleaseFacts& release,
                        std::span<const PeakMaps::Cell> deposit, std::span<const Vec2> left,
                        const Grid& grid, MemberScalars& m) {
  const Vec2 centre(release.x_m, release.y_m), crown(release.crown_x_m, release.crown_y_m);
  double front2 = -1, length2 = -1;
  Vec2 toe(0, 0);
  const auto lies = [&](const Vec2& at) {
    front2 = std::max(front2, (at - centre).squaredNorm());
    const double from_crown = (at - crown).squaredNorm();
    if (from_crown <= length2) return false;
    length2 = from_crown, toe = at;
    return true;
  };
  for (const PeakMaps::Cell& cell : deposit)
    lies({grid.x_center(cell.col), grid.y_center(cell.row)});
  bool toe_is_beyond = false;
  for (const Vec2& at : left)
    if (lies(at)) toe_is_beyond = true;
  m.deposit_front_m = m.crown_to_toe_length_m = m.crown_to_toe_drop_m = m.crown_to_toe_ratio =
      nan_d;
  if (length2 < 0) return;
  m.deposit_front_m = std::sqrt(front2);
  m.crown_to_toe_length_m = std::sqrt(length2);
  if (toe_is_beyond) return;
  m.crown_to_toe_drop_m = release.crown_z_m - ground.height(toe.x(), toe.y());
  if (length2 > 0) m.crown_to_toe_ratio = m.crown_to_toe_drop_m / m.crown_to_toe_length_m;
}

std::vector<std::string> doubts(const MemberScalars& m, const Ledger& ledger, double spacing_m) {
  std::vector<std::string> out;
  if (m.take_off_fraction > most_take_off)
    out.push_back("detachment: for " + percent(m.take_off_fraction) +
                  " of mass and time (take_off_fraction, over 1 %) the ground curves away faster "
                  "than the mass falls: it would fly there, columns stay on the ground");
  const double unexplained = std::abs(m.energy_residual) * ledger.available_energy();
  const double least = 0.01 * spacing_m * standard_gravity * ledger.brought_mass();
  if (std::abs(m.energy_residual) > most_energy_residual && unexplained > least)
    out.push_back(
        "energy: " + percent(m.energy_residual) +
        " of the released energy is not accounted for (more than 5 % either way): speed "
        "and runout of this member are in doubt. Look for spikes and steps in the terrain");
  return out;
}

}  // namespace sturz
