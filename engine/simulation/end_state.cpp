// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/end_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr double moving_share = 1.0 / 20;  // of the largest mean speed

/// Sums over what is there and what left.
struct EndSums {
  double mass = 0, mdx = 0, mdy = 0;             // with travel from the start
  double present = 0, mx = 0, my = 0, fast = 0;  // of what is there, on the map
  double front2 = 0, lowest = std::numeric_limits<double>::infinity();

  void add_travel(double m, double dx, double dy, double z) {
    mass += m;
    mdx += m * dx;
    mdy += m * dy;
    front2 = std::max(front2, dx * dx + dy * dy);
    lowest = std::min(lowest, z);
  }
};

void add_set(const MovingSet& p, double fast, EndSums& sums) {
  const auto travel = [&](std::uint32_t id, double x, double y) {
    const bool wraps = !p.wrapped_x.empty();
    return Vec2(x - p.start_x[id] + (wraps ? p.wrapped_x[id] : 0),
                y - p.start_y[id] + (wraps ? p.wrapped_y[id] : 0));
  };
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double m = p.mass[i];
    const Vec2 d = travel(p.id[i], p.x[i], p.y[i]);
    sums.add_travel(m, d.x(), d.y(), p.z[i]);
    sums.present += m;
    sums.mx += m * p.x[i];
    sums.my += m * p.y[i];
    if (Vec3(p.vx[i], p.vy[i], p.vz[i]).norm() > fast) sums.fast += m;
  }
  for (const Departure& gone : p.departures) {
    const Vec2 d = travel(gone.id, gone.x, gone.y);
    sums.add_travel(gone.mass, d.x(), d.y(), gone.z);
  }
}

/// Calls use(x, y) for the centre of every cell of the deposit.
template <class Use>
void for_deposit_cells(const MemberResult& r, double limit, Use&& use) {
  const std::vector<float>& deposit = r.layer(PeakLayer::deposit);
  std::size_t k = 0;
  for (int row = 0; row < r.window.n_rows; ++row)
    for (int col = 0; col < r.window.n_cols; ++col, ++k)
      if (deposit[k] > limit)
        use(r.grid.x_center(r.window.col0 + col), r.grid.y_center(r.window.row0 + row));
}

}  // namespace

void write_travel(const State& s, const ReleaseFacts& release, MemberScalars& m) {
  EndSums sums;
  for (const MovingSet& set : s.sets) add_set(set, moving_share * m.max_mean_speed_m_s, sums);
  if (!(sums.mass > 0)) return;
  const Ledger ledger = s.ledger();
  m.front_travel_m = std::max(m.front_travel_m, std::sqrt(sums.front2));
  m.com_travel_m = std::hypot(sums.mdx, sums.mdy) / sums.mass;
  m.com_drop_m = -ledger.potential / (s.gravity * ledger.brought_mass());
  m.com_ratio = m.com_travel_m > 0 ? m.com_drop_m / m.com_travel_m : nan_d;
  m.drop_m = release.top_m - sums.lowest;
  m.end_moving_fraction = sums.fast / ledger.brought_mass();
  m.deposit_com_x_m = sums.present > 0 ? sums.mx / sums.present : nan_d;
  m.deposit_com_y_m = sums.present > 0 ? sums.my / sums.present : nan_d;
}

void write_crown_to_toe(const Terrain& ground, const ReleaseFacts& release, double runout_limit_m,
                        MemberResult& result) {
  double front2 = -1, length2 = -1;
  Vec2 toe(0, 0);
  for_deposit_cells(result, runout_limit_m, [&](double x, double y) {
    front2 = std::max(front2, (Vec2(x, y) - Vec2(release.x_m, release.y_m)).squaredNorm());
    const double from_crown =
        (Vec2(x, y) - Vec2(release.crown_x_m, release.crown_y_m)).squaredNorm();
    if (from_crown > length2) length2 = from_crown, toe = Vec2(x, y);
  });
  MemberScalars& m = result.scalars;
  m.deposit_front_m = m.crown_to_toe_length_m = m.crown_to_toe_drop_m = m.crown_to_toe_ratio =
      nan_d;
  if (length2 < 0) return;
  m.deposit_front_m = std::sqrt(front2);
  m.crown_to_toe_length_m = std::sqrt(length2);
  m.crown_to_toe_drop_m = release.crown_z_m - ground.height(toe.x(), toe.y());
  if (length2 > 0) m.crown_to_toe_ratio = m.crown_to_toe_drop_m / m.crown_to_toe_length_m;
}

}  // namespace sturz
