// SPDX-License-Identifier: Apache-2.0
#include "tests/support/slow_columns.hpp"

#include "engine/neighbors/column_cells.hpp"
#include "engine/neighbors/column_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sturz::test {
namespace {

double wave_speed(const SlowColumn& c) { return std::sqrt(c.lateral * c.thickness); }

/// r_ij with the rise times the shares of both columns to some power: 1 in distances, 2 in
/// gradients.
Vec3 known(const SlowColumn& a, const SlowColumn& b, int power) {
  const Vec3 r = a.position - b.position;
  return {r.x(), r.y(), std::pow(a.share * b.share, power) * r.z()};
}

/// Monaghan's viscosity between approaching columns: Pi = -alpha c_ij mu / h_ij for mu < 0.
double viscous(const SlowColumn& a, const SlowColumn& b, double support_radius, double alpha) {
  const Vec3 r = known(a, b, 1), v = a.velocity - b.velocity;
  const Vec3 rises = known(a, b, 2);
  const double smoothing = 0.5 * support_radius;
  const double mu = smoothing * v.dot(rises) / (r.squaredNorm() + 0.01 * smoothing * smoothing);
  if (mu >= 0) return 0;
  const double speed = 0.5 * (wave_speed(a) + wave_speed(b));
  const double thickness = 0.5 * (a.thickness + b.thickness);
  return -alpha * speed * mu / thickness;
}

void add_pair(const SlowColumn& a, const SlowColumn& b, const ColumnConstants& k,
              ColumnRates& out) {
  const double distance = known(a, b, 1).norm(),
               support_radius = std::min(a.support_radius, b.support_radius);
  if (distance >= support_radius) return;
  const ColumnSmoothing w{support_radius};
  out.thickness += b.volume * w.value(distance);
  out.density += w.value(distance);
  const Vec3 gradient = -w.gradient(distance) * known(a, b, 2);
  const double lateral = 0.5 * (a.lateral + b.lateral);
  const Vec3 pair = -b.volume * (lateral + viscous(a, b, support_radius, k.viscosity)) * gradient;
  out.acceleration += pair;
  out.pull += pair.norm();
  out.divergence += b.volume * (b.velocity - a.velocity).dot(gradient);
  out.approach = std::max(out.approach, (a.velocity - b.velocity).squaredNorm());
}

ColumnRecord record_of(const SlowColumn& c, ColumnRecord r) {
  r.volume = static_cast<float>(c.volume);
  r.vx = static_cast<float>(c.velocity.x());
  r.vy = static_cast<float>(c.velocity.y());
  r.vz = static_cast<float>(c.velocity.z());
  r.inverse_radius = static_cast<float>(1 / c.support_radius);
  r.thickness = static_cast<float>(c.thickness);
  r.lateral = static_cast<float>(c.lateral);
  r.wave_speed = static_cast<float>(wave_speed(c));
  r.share = static_cast<float>(c.share);
  return r;
}

ColumnCells cells_of(const std::vector<SlowColumn>& columns, const Domain& domain) {
  ParticleSet set;
  set.grow(columns.size());
  std::vector<double> support_radius;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Vec3& p = columns[i].position;
    set.x[i] = p.x(), set.y[i] = p.y(), set.z[i] = p.z();
    support_radius.push_back(columns[i].support_radius);
  }
  ColumnCells cells;
  cells.build(set, domain, support_radius);
  for (std::size_t k = 0; k < cells.size(); ++k)
    cells.records()[k] = record_of(columns[cells.source(k)], cells.records()[k]);
  return cells;
}

}  // namespace

std::vector<ColumnRates> slow_columns(const std::vector<SlowColumn>& columns,
                                      const std::vector<SlowColumn>& images,
                                      const ColumnConstants& constants) {
  std::vector<ColumnRates> out(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const auto* others : {&columns, &images})
      for (const SlowColumn& other : *others) add_pair(columns[i], other, constants, out[i]);
  return out;
}

FastColumns fast_columns(const std::vector<SlowColumn>& columns, const ColumnConstants& constants,
                         InstructionSet isa, const Domain& domain) {
  const ColumnCells cells = cells_of(columns, domain);
  std::array<std::vector<float>, 7> room;
  for (auto& r : room) r.assign(cells.size(), 0);
  sweeps(isa).columns(cells.view(), constants,
                      {room[0].data(), room[1].data(), room[2].data(), room[3].data(),
                       room[4].data(), room[5].data(), room[6].data()},
                      0, cells.n_groups());
  FastColumns out;
  out.rates.resize(columns.size());
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (!cells.is_image(k))
      out.rates[cells.source(k)] = {
          room[0][k], room[1][k], {room[2][k], room[3][k], room[4][k]}, room[5][k], room[6][k]};
  for (const auto& r : room) out.raw.insert(out.raw.end(), r.begin(), r.end());
  return out;
}

}  // namespace sturz::test
