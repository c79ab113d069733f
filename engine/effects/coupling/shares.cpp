// SPDX-License-Identifier: Apache-2.0
// Which pairs there are, how much of the liquid each grain meets, and how much room grains take
// there.
#include "engine/core/parallel.hpp"
#include "engine/effects/coupling/shared.hpp"
#include "engine/effects/fields.hpp"
#include "engine/laws/mixture_sound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr std::size_t rows = 256;  // of a range of threads' work

/// Extremes of velocity components.
struct VelocityBox {
  Eigen::Array3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(const VelocityBox& o) { low = low.min(o.low), high = high.max(o.high); }
  double width() const { return (high - low).matrix().norm(); }
};

VelocityBox velocities(const MovingSet& p, int threads) {
  return ordered_reduce(
      p.size(), threads, VelocityBox{},
      [&](std::size_t begin, std::size_t end, VelocityBox& out) {
        for (std::size_t i = begin; i < end; ++i) {
          const Eigen::Array3d v(p.vx[i], p.vy[i], p.vz[i]);
          out.low = out.low.min(v), out.high = out.high.max(v);
        }
      },
      [](VelocityBox& total, const VelocityBox& block) { total.add(block); });
}

class ListsAcross final : public Pass {
 public:
  explicit ListsAcross(std::shared_ptr<Coupling> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "pairs across sets"; }
  std::string_view effect() const override { return EffectName::coupling; }
  Stage stage() const override { return Stage::across; }

  void apply(State& s, double) override {
    const MovingSet &grains = s.sets[shared_->grains], &liquid = s.sets[shared_->liquid];
    VelocityBox box = velocities(grains, s.threads);
    box.add(velocities(liquid, s.threads));
    const bool both = grains.size() > 0 && liquid.size() > 0;
    shared_->pairs.update({grains, grains.n_sorts, ground_of(grains, known_[0])},
                          {liquid, liquid.n_sorts, ground_of(liquid, known_[1])}, s.domain,
                          both ? box.width() * s.previous_dt : 0, s.time, s.threads);
  }
  std::size_t bytes() const override {
    return shared_->pairs.bytes() + (known_[0].capacity() + known_[1].capacity()) * sizeof(float);
  }

 private:
  /// \param known  room for the distances where some particle has no ground
  static CrossPairs::Ground ground_of(const MovingSet& p, std::vector<float>& known) {
    const BoundarySupport& b = p.boundary;
    if (b.distance.size() < p.size()) return {};  // no pass looks up the ground of this set
    const float* distance = b.distance.data();
    if (p.any_leaving) {
      fit(known, p.size());
      for (std::size_t i = 0; i < p.size(); ++i)
        known[i] =
            p.fate[i] == Fate::off_terrain ? std::numeric_limits<float>::infinity() : distance[i];
      distance = known.data();
    }
    return {distance, b.nx.data(), b.ny.data(), b.nz.data()};
  }

  std::shared_ptr<Coupling> shared_;
  std::vector<float> known_[2];  ///< of grains and liquid [m]
};

/// Velocities as they are, and extrapolated to v_{n+1/2}, as the pair sweeps see them.
class Velocities {
 public:
  Velocities(const MovingSet& p, double ahead)
      : set_(p), before_(p.components(fields::velocity_before)), ahead_(ahead) {}
  Vec3 now(std::size_t i) const { return {set_.vx[i], set_.vy[i], set_.vz[i]}; }
  Vec3 ahead(std::size_t i) const {
    const Vec3 v = now(i);
    return v + ahead_ * (v - Vec3(before_[0][i], before_[1][i], before_[2][i]));
  }

 private:
  const MovingSet& set_;
  const std::vector<std::vector<double>>& before_;
  double ahead_;
};

class SharesPass final : public Pass {
 public:
  explicit SharesPass(std::shared_ptr<Coupling> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "shares and slip"; }
  std::string_view effect() const override { return EffectName::coupling; }
  Stage stage() const override { return Stage::across; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const CouplingSettings& c = shared_->settings;
    const MovingSet& liquid = s.sets[shared_->liquid];
    if (!(liquid.sound_speed > 0)) return;
    const MixtureSound sound{liquid.sound_speed, s.sets[shared_->grains].sound_speed,
                             c.shear_stiffness,
                             c.buoyancy ? c.liquid_density / c.grain_density : 0};
    out.push_back({"acoustic among grains",
                   c.courant * c.smoothing_length /
                       (sound.fastest(shared_->largest_share) + liquid.motion.max_speed)});
  }

  void apply(State& s, double dt) override {
    const double ahead = s.extrapolation(dt);
    Coupling& c = *shared_;
    anew_ = weighings_ != c.pairs.n_weighings();
    weighings_ = c.pairs.n_weighings();
    make_room(s);
    if (anew_) {
      measure_grains(s);
      divide_liquid(s);
    }
    start_liquid(s, ahead);
    meet(s, ahead);
    fill(s);
  }
  std::size_t bytes() const override {
    const Coupling& c = *shared_;
    return c.met.capacity() * (sizeof(MetLiquid) + 2 * sizeof(Vec3)) +
           c.volume.capacity() * (2 * sizeof(double) + 2 * sizeof(Quads<1>)) +
           c.take.capacity() * (3 * sizeof(double) + 2 * sizeof(Quads<2>) + 2 * sizeof(Vec3));
  }

 private:
  void make_room(const State& s) {
    Coupling& c = *shared_;
    c.met.resize(c.of_grains().n_rows());
    for (auto* v : {&c.lift, &c.drag}) v->resize(c.of_grains().n_rows());
    for (auto* v : {&c.drawn, &c.held}) v->resize(c.of_liquid().n_rows());
    if (!s.domain.walls.empty()) c.walled.resize(c.of_grains().n_rows());
    c.share.resize(c.of_liquid().n_rows());
    c.filled.resize(c.of_liquid().n_rows());
    fit(c.volume, c.of_grains().n_sources());
    fit(c.room, c.of_grains().n_sources());
    fit(c.flux, c.of_grains().n_sources());
    fit(c.impulse, c.of_grains().n_sources());
    c.take.resize(c.of_liquid().n_rows());
    fit(c.liquid_start, c.of_liquid().n_sources());
    fit(c.liquid_now, c.of_liquid().n_sources());
  }

  /// The volumes that grains fill, pores included.
  void measure_grains(const State& s) {
    Coupling& c = *shared_;
    const MovingSet& p = s.sets[c.grains];
    const Field *change = p.find(fields::density_change), *packing = p.find(fields::packing_change);
    parallel_ranges(
        c.met.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
          for (std::size_t r = begin; r < end; ++r) {
            const std::uint32_t i = c.of_grains().index(r);
            const double pressed = change ? 1 + change->component[0][i] : 1;
            const double packed = packing ? 1 + packing->component[0][i] : 1;
            const double fraction =
                std::clamp(p.reference_fraction * packed * pressed,
                           CouplingSettings::least_fraction, CouplingSettings::most_fraction);
            c.met[r] = {p.mass[i] / (c.settings.grain_density * fraction), 0, 1 - fraction};
            c.volume[r] = c.met[r].volume;
          }
        });
    c.of_grains().copy_images(c.volume);
  }

  /// q_j
  void divide_liquid(const State& s) {
    Coupling& c = *shared_;
    const MovingSet& p = s.sets[c.liquid];
    const PairSide& side = c.of_liquid();
    parallel_ranges(side.n_rows(), rows, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r)
        c.take[r] = p.mass[side.index(r)] / std::max(1.0, gather(side.pairs(r), c.volume));
    });
  }

  /// What grains will sum over the liquid around them.
  void start_liquid(const State& s, double ahead) {
    Coupling& c = *shared_;
    const MovingSet& p = s.sets[c.liquid];
    const Velocities velocity(p, ahead);
    const Field* change = p.find(fields::density_change);
    const PairSide& side = c.of_liquid();
    parallel_ranges(side.n_rows(), rows, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        const std::uint32_t j = side.index(r);
        const double q = c.take[r];
        const Vec3 v = q * velocity.now(j), next = q * velocity.ahead(j);
        const double density = c.settings.liquid_density * relative_density(change, j);
        c.liquid_start[r].quad[0] = Quad{q, v.x(), v.y(), v.z()};
        c.liquid_start[r].quad[1] = Quad{p.mass[j] / density, next.x(), next.y(), next.z()};
      }
    });
    side.copy_images(c.liquid_start);
  }

  /// M_i and omega_i, and what liquid particles will sum over the grains around them.
  void meet(const State& s, double ahead) {
    Coupling& c = *shared_;
    const MovingSet& p = s.sets[c.grains];
    const Velocities velocity(p, ahead);
    const PairSide& side = c.of_grains();
    parallel_ranges(side.n_rows(), rows, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        const std::uint32_t i = side.index(r);
        const PairSide::Pairs pairs = side.pairs(r);
        Quads<2> sum = gather(pairs, pairs.weight, c.liquid_start);
        turn_images(side, r, c.liquid_start, {1, 5}, sum);
        MetLiquid& met = c.met[r];
        if (anew_) {
          met.met = sum[0];
          met.wet = std::min(1.0, sum[4] / (CouplingSettings::wet_support * met.wet));
        }
        const double around = met.met;
        c.room[r] = 0;
        c.flux[r] = {};
        if (!(around > 0)) continue;
        const double solid = met.wet * p.mass[i] / c.settings.grain_density;
        const Vec3 flux = solid * (velocity.ahead(i) - sum.vector(5) / around);
        met.velocity = sum.vector(1) / around;
        c.room[r] = solid / around;
        c.flux[r].quad[0] = Quad{flux.x(), flux.y(), flux.z(), 0};
      }
    });
    if (anew_) side.copy_images(c.room);
    side.copy_images(c.flux);
    parallel_ranges(side.n_sources(), rows, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        c.flux[i].quad[0][3] = c.flux[i].vector(0).dot(c.pairs.unit() * side.place(i));
    });
  }

  /// Divergence at a row of the flux f of sources at x: sum slope f.(x - here) over those
  /// themselves and their images in the plane under the row, for which f'.(x' - here) is f.(x -
  /// here + 2 d n).
  static double divergence(const Coupling& c, std::size_t row, const Quads<1>& sum) {
    const PairSide& side = c.of_liquid();
    const Vec3 here = c.pairs.unit() * side.place(row);
    double flux = sum[3] - sum.vector(0).dot(here);
    for (std::size_t m = 0; m < side.n_mirrors(); ++m) {
      const PairSide::Pairs images = side.image_pairs(row, m);
      if (images.n == 0) continue;
      const Quads<1> turned = gather(images, images.slope, c.flux);
      const double away = 2 * c.pairs.unit() * side.gap(row, m);
      flux += turned[3] - turned.vector(0).dot(here - away * side.normal(row, m));
    }
    return flux;
  }

  /// X_j and the divergence of the grains' flux past the liquid: sum f_i.(x_i - x_j) slope.
  void fill(State& s) {
    Coupling& c = *shared_;
    MovingSet& p = s.sets[c.liquid];
    const Field* change = p.find(fields::density_change);
    auto &share = p.scalar(fields::grain_share), &slip = p.scalar(fields::slip_divergence);
    const PairSide& side = c.of_liquid();
    c.largest_share = ordered_reduce(
        side.n_rows(), s.threads, 0.0,
        [&](std::size_t begin, std::size_t end, double& largest) {
          for (std::size_t r = begin; r < end; ++r) {
            const std::uint32_t j = side.index(r);
            const PairSide::Pairs pairs = side.pairs(r);
            if (anew_) c.filled[r] = c.take[r] / p.mass[j] * gather(pairs, c.room);
            const double flux = divergence(c, r, gather(pairs, pairs.slope, c.flux));
            const double density = c.settings.liquid_density * relative_density(change, j);
            const double x = c.filled[r] * density;
            c.share[r] = x;
            share[j] = std::min(x, CouplingSettings::largest_share);
            slip[j] = flux * (x > 0 ? share[j] / x : 0);
            largest = std::max(largest, share[j]);
          }
        },
        [](double& total, double block) { total = std::max(total, block); });
  }

  std::shared_ptr<Coupling> shared_;
  std::size_t weighings_ = 0;
  bool anew_ = true;  ///< weights are not those of the step before
};

}  // namespace

void add_shares(Step& step, const std::shared_ptr<Coupling>& shared) {
  step.add(std::make_unique<ListsAcross>(shared));
  step.add(std::make_unique<SharesPass>(shared));
}

}  // namespace sturz
