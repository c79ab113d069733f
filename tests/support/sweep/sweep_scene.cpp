// SPDX-License-Identifier: Apache-2.0
#include "tests/support/sweep/sweep_scene.hpp"

#include "engine/neighbors/neighbor_lists.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

#include <cmath>
#include <optional>

namespace sturz::test {
namespace {

constexpr std::array<std::array<int, 2>, 6> entries{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

NeighborRecord record_of(const SlowParticle& p, NeighborRecord r) {
  r.volume = static_cast<float>(p.volume);
  r.vx = static_cast<float>(p.velocity.x());
  r.vy = static_cast<float>(p.velocity.y());
  r.vz = static_cast<float>(p.velocity.z());
  r.density_change = static_cast<float>(p.density_change);
  float* stress[6] = {&r.sxx, &r.syy, &r.szz, &r.sxy, &r.syz, &r.szx};
  for (int k = 0; k < 6; ++k)
    *stress[k] = static_cast<float>(p.stress(entries[k][0], entries[k][1]));
  r.viscosity = static_cast<float>(p.viscosity_share);
  r.tension = static_cast<float>(p.tension + p.held_viscosity);
  return r;
}

/// Room for the sweep's results and inputs of walls, [padded].
struct Rooms {
  std::array<std::vector<float>, 36> results;
  std::array<std::vector<float>, 12> wall;
  std::array<std::vector<float>, 3> normal;

  explicit Rooms(std::size_t n) {
    for (auto& r : results) r.assign(n, 0);
    for (auto& w : wall) w.assign(n, 0);
    for (auto& g : normal) g.assign(n, 0);
  }
  SweepOutput output() {
    SweepOutput o{};
    float** slots[] = {&o.ax,  &o.ay,  &o.az,  &o.lxx, &o.lxy, &o.lxz,      &o.lyx,
                       &o.lyy, &o.lyz, &o.lzx, &o.lzy, &o.lzz, &o.diffusion};
    for (int k = 0; k < 13; ++k) *slots[k] = results[k].data();
    for (int k = 0; k < 6; ++k) o.smooth[k] = results[13 + k].data();
    o.mirror_weight = results[19].data();
    o.support_completeness = results[20].data(), o.neighbors = results[21].data(),
    o.conducted = results[22].data();
    for (int k = 0; k < 6; ++k) o.pair_gradient[k] = results[23 + k].data();
    for (int k = 0; k < 3; ++k) o.from_ground[k] = results[29 + k].data();
    for (int k = 0; k < 3; ++k) o.density_gradient[k] = results[32 + k].data();
    o.ground_weight = results[35].data();
    return o;
  }
  BoundaryView boundary(const std::vector<GroundRecord>& ground) const {
    BoundaryView b{ground.data(), normal[0].data(), normal[1].data(), normal[2].data(), {}, {}};
    for (int k = 0; k < 6; ++k) b.moment[k] = wall[k].data(), b.gradient[k] = wall[6 + k].data();
    return b;
  }
  SlowRates rates(std::size_t i) const {
    SlowRates r;
    for (int k = 0; k < 3; ++k) {
      r.acceleration[k] = results[k][i];
      for (int m = 0; m < 3; ++m) r.gradient(k, m) = results[3 + 3 * k + m][i];
    }
    for (int k = 0; k < 3; ++k) {
      r.from_ground[k] = results[29 + k][i];
      r.density_gradient[k] = results[32 + k][i];
    }
    r.ground_weight = results[35][i];
    r.diffusion = results[12][i];
    r.mirror_weight = results[19][i];
    r.support_completeness = results[20][i], r.conducted = results[22][i];
    r.neighbors = static_cast<int>(results[21][i]);
    for (int k = 0; k < 6; ++k) {
      r.smoothing(entries[k][0], entries[k][1]) = results[13 + k][i];
      r.smoothing(entries[k][1], entries[k][0]) = results[13 + k][i];
      r.pair_gradient(entries[k][0], entries[k][1]) =
          r.pair_gradient(entries[k][1], entries[k][0]) = results[23 + k][i];
    }
    return r;
  }
};

}  // namespace

SweepConstants usual_constants(double spacing) {
  const double h = 1.3 * spacing;
  return {
      h,  SmoothingKernel{h}.discrete_gradient_factor(), 1560, 100, 0.1, 0.1, false, spacing, 0.16,
      300};
}

namespace {

/// Lists over copies of the particles, with everything the sweeps read.
struct Prepared {
  ParticleSet set;
  NeighborLists lists;
  std::optional<Rooms> rooms;
  std::vector<KineticRecord> kinetic;
  std::vector<GroundRecord> ground;
  std::vector<HalfDensityGradient> density_gradient;
  std::vector<std::uint8_t> dense_group;

  Prepared(const std::vector<SlowParticle>& particles, const SweepConstants& constants,
           InstructionSet isa, const Domain& domain)
      : lists(2 * constants.h, 0.15 * constants.h, sweeps(isa).tight_list) {
    set.grow(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
      set.x[i] = particles[i].position.x();
      set.y[i] = particles[i].position.y();
      set.z[i] = particles[i].position.z();
    }
    lists.rebuild(set, domain, 1);
    lists.gather_positions(set, 0, set.size());
    rooms.emplace(lists.padded_size());
    kinetic.resize(lists.n_records_rounded());
    dense_group.assign(kinetic.size() / group_size, 1);
    const double unit = lists.view().unit_m;
    ground.assign(kinetic.size(),
                  {static_cast<float>(GroundRecord::far * 2 * constants.h / unit), 0});
    density_gradient.resize(kinetic.size());
    for (std::size_t i = 0; i < set.size(); ++i) take(particles[set.id[i]], i, unit, constants.h);
    lists.copy_images();
    lists.for_each_image([&](std::size_t image, std::size_t source) {
      kinetic[image] = kinetic[source];
      ground[image] = ground[source], density_gradient[image] = density_gradient[source];
      if (!dense_group[source / group_size]) dense_group[image / group_size] = 0;
    });
  }

  NeighborView view() const {
    NeighborView v = lists.view();
    v.density_gradient = density_gradient.data();
    return v;
  }

  SweepRun results() const {
    SweepRun run;
    run.rates.resize(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) run.rates[set.id[i]] = rooms->rates(i);
    for (const auto& r : rooms->results)
      run.raw.insert(run.raw.end(), r.begin(), r.begin() + static_cast<std::ptrdiff_t>(set.size()));
    return run;
  }

 private:
  void take(const SlowParticle& p, std::size_t i, double unit, double h) {
    lists.records()[i] = record_of(p, lists.records()[i]);
    if (p.ground_distance < 2 * h)
      ground[i] = {static_cast<float>(p.ground_distance / unit),
                   static_cast<float>(p.ground_weight)};
    const Vec3 half = 0.5 * unit * p.density_gradient;
    density_gradient[i] = {static_cast<float>(half.x()), static_cast<float>(half.y()),
                           static_cast<float>(half.z()), 0};
    for (int k = 0; k < 3; ++k) rooms->normal[k][i] = static_cast<float>(p.ground_normal[k]);
    for (int k = 0; k < 6; ++k) {
      rooms->wall[k][i] = static_cast<float>(p.wall_moment(entries[k][0], entries[k][1]));
      rooms->wall[6 + k][i] = static_cast<float>(p.wall_gradient(entries[k][0], entries[k][1]));
    }
    KineticRecord& k = kinetic[i];
    k.dilation_ratio = static_cast<float>(p.dilation_ratio);
    k.weight = static_cast<float>(p.weight);
    k.theta = static_cast<float>(p.theta);
    k.resistance = static_cast<float>(1 / p.conductivity);
    k.viscosity = static_cast<float>(p.viscosity_share);
    float* stress[6] = {&k.xx, &k.yy, &k.zz, &k.xy, &k.yz, &k.zx};
    for (int n = 0; n < 6; ++n)
      *stress[n] = static_cast<float>(p.kinetic_stress(entries[n][0], entries[n][1]));
    if (p.dilation_ratio != 1 || p.theta != 0) dense_group[i / group_size] = 0;
  }
};

}  // namespace

SweepRun fast_sweep(const std::vector<SlowParticle>& particles, const SweepConstants& constants,
                    InstructionSet isa, const Domain& domain, bool no_slip) {
  Prepared p(particles, constants, isa, domain);
  BoundaryView boundary = p.rooms->boundary(p.ground);
  boundary.no_slip = no_slip;
  sweeps(isa).dense(p.view(), constants, boundary, p.rooms->output(), 0, p.lists.n_groups());
  return p.results();
}

SweepRun kinetic_sweep(const std::vector<SlowParticle>& particles, const SweepConstants& constants,
                       InstructionSet isa, const Domain& domain, DispersedClock* clock) {
  Prepared p(particles, constants, isa, domain);
  sweeps(isa).kinetic(p.view(), {p.kinetic.data(), p.dense_group.data(), clock}, constants,
                      p.rooms->boundary(p.ground), p.rooms->output(), 0, p.lists.n_groups());
  return p.results();
}

std::vector<SlowParticle> lattice(std::array<int, 3> n, double dx, double jitter,
                                  const Vec3& center, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter * dx, jitter * dx);
  std::vector<SlowParticle> out;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) {
        SlowParticle p;
        const Vec3 at(i - 0.5 * (n[0] - 1), j - 0.5 * (n[1] - 1), k - 0.5 * (n[2] - 1));
        p.position = center + dx * at + Vec3(shift(random), shift(random), shift(random));
        p.volume = dx * dx * dx;
        out.push_back(p);
      }
  return out;
}

void roughen(std::vector<SlowParticle>& particles, double dx, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  for (SlowParticle& p : particles) {
    p.velocity = 5 * Vec3(u(random), u(random), u(random));
    p.density_change = 0.01 * u(random);
    p.volume = dx * dx * dx * (1 + 0.1 * u(random));
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b) p.stress(a, b) = p.stress(b, a) = 3e4 * u(random);
    p.stress -= 5e4 * Eigen::Matrix3d::Identity();
    p.viscosity_share = 0.6 + 0.4 * u(random);
  }
}

double relative_error(const std::vector<SlowRates>& a, const std::vector<SlowRates>& b,
                      const std::function<Eigen::MatrixXd(const SlowRates&)>& part) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    error += (part(a[i]) - part(b[i])).squaredNorm();
    size += part(b[i]).squaredNorm();
  }
  return std::sqrt(error / size);
}

}  // namespace sturz::test
