// SPDX-License-Identifier: Apache-2.0
#include "tests/hard/random_members.hpp"

#include "engine/core/random.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/hard/priors.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace sturz::test {
namespace {

Scenario hard_scene(double spacing_m) {
  Scenario s;
  s.grains.emplace();
  s.formulation = Formulation::full_stress;
  s.numerics.accept_unresolved = true;  // some deposits are thinner than four layers
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 40;
  return s;
}

/// A cap somewhere on the steep ground; the member's volume scales it.
void place_source(int number, HardMember& m) {
  std::uint64_t n = 0;
  auto between = [&](double a, double b) { return a + (b - a) * unit_random(11, number, n++); };
  const double x0 = between(80, 700), y0 = between(120, 680);
  const double a = between(35, 60), b = between(35, 60);
  auto release = std::make_shared<Raster<double>>(m.inputs.elevation->grid, 0.0);
  const Grid& g = release->grid;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      const double u = (g.x_center(c) - x0) / a, v = (g.y_center(r) - y0) / b;
      release->at(r, c) = std::max(0.0, 1 - u * u - v * v);
    }
  m.inputs.release = release;
  m.inputs.pattern = ReleasePattern::thickness;
  m.scenario.release.surface =
      between(0, 1) < 0.5 ? ReleaseSurface::pre_failure : ReleaseSurface::bed;
  m.scenario.terrain.nodata = between(0, 1) < 0.2 ? TerrainEdge::wall : TerrainEdge::outflow;
  if (between(0, 1) < 0.2)
    m.scenario.release.velocity_m_s = {between(-20, 40), between(-20, 20), 0};
}

}  // namespace

RandomMembers RandomMembers::on_steep_ground(States states) {
  RandomMembers out;
  hard_points();
  out.name_ = "steep ground, 6 m";
  out.scene_.scenario = hard_scene(6);
  out.scene_.inputs.elevation = std::make_shared<const Raster<double>>(steep_ground());
  out.scene_.inputs.hazard_grid = out.scene_.inputs.elevation->grid;
  out.states_ = states;
  out.volume_m3_ = 1e5;
  out.moving_source_ = true;
  return out;
}

RandomMembers RandomMembers::on_marsicano(const std::string& folder, States states) {
  RandomMembers out;
  hard_points();
  out.name_ = "Marsicano, 12 m";
  Scenario& s = out.scene_.scenario = hard_scene(12);
  s.directory = folder;
  s.terrain.raster = "marsicano_10m.tif";
  s.release.polygon = "release_250m.geojson";
  s.release.surface = ReleaseSurface::pre_failure;
  out.states_ = states;
  out.volume_m3_ = 1.2e6;
  s.release.volume_m3 = Uncertain(out.volume_m3_);
  out.scene_.inputs = load_scene_inputs(s);
  return out;
}

HardMember RandomMembers::member(int number) const {
  HardMember m = scene_;
  m.scenario = at_point(std::move(m.scenario), number, volume_m3_);
  const double restitution = m.scenario.basal.restitution.value;
  m.scenario = with_states(std::move(m.scenario), states_, restitution, number % 4 == 0);
  if (moving_source_) place_source(number, m);
  return m;
}

Survival RandomMembers::run(int number) const {
  const HardMember m = member(number);
  const auto& v = m.scenario.release.velocity_m_s;
  return survive(assemble(m.scenario, m.inputs, number, 1),
                 std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]),
                 describe(m.scenario, m.inputs).dt_s);
}

std::vector<int> spread(int n) {
  std::vector<int> rows;
  for (int k = 0; k < std::min(n, n_points); ++k)
    rows.push_back(k * n_points / std::min(n, n_points));
  return rows;
}

std::vector<int> drawn(int n, int set) {
  if (n > 16) return spread(n);
  std::vector<int> rows;
  for (int run = set; run < 16; run += 4) {
    const int a = run & 1, b = run >> 1 & 1, c = run >> 2 & 1, d = run >> 3 & 1;
    rows.push_back(run | (a ^ b ^ c) << 4 | (b ^ c ^ d) << 5);
  }
  rows.resize(std::min<std::size_t>(rows.size(), static_cast<std::size_t>(n)));
  for (int k = 0, left = n - 4; k < left; ++k)
    rows.push_back(n_corners + (4 * k + set) * n_random / (4 * left));
  return rows;
}

}  // namespace sturz::test
