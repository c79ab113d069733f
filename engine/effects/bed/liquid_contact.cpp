// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/bed/liquid_contact.hpp"

#include "engine/core/parallel.hpp"
#include "engine/effects/bed/flow_depth.hpp"
#include "engine/effects/bed/mirrored.hpp"
#include "engine/laws/liquid_film.hpp"

#include <algorithm>

namespace sturz {
namespace {

/// What a film's bed does to it.
class FilmDrag {
 public:
  /// \param depth   of the flow \param layer  of its part that is braked, both normal to the bed
  /// [m]
  /// \param share  of the drag that acts [-]
  FilmDrag(const HerschelBulkley& law, double density, double depth, double layer, double share)
      : film_{law},
        per_mass_(share / (density * layer)),
        thickness_(LiquidFilm::equivalent_thickness(layer, depth)) {}
  bool even() const { return film_.law.newtonian(); }
  SurfaceDrag operator()(double speed) const {
    const double v = std::max(speed, 1e-9);  // below it the law's own power would have no slope
    return {per_mass_ * film_.law.yield_stress,
            per_mass_ * (film_.bed_stress(v, thickness_) - film_.law.yield_stress) / v};
  }

 private:
  LiquidFilm film_;
  double per_mass_, thickness_;
};

class LiquidGroundContact final : public Pass {
 public:
  LiquidGroundContact(std::size_t set, const ContactSettings& c)
      : set_(set),
        settings_(c),
        law_(smooth_contact(c)),
        depth_(c.spacing, 2 * c.smoothing_length) {}
  std::string_view name() const override { return "terrain contact, liquid"; }
  std::string_view effect() const override { return EffectName::bed; }
  Stage stage() const override { return Stage::contact; }

  void limits(const State&, std::vector<StepLimit>& out) const override {
    out.push_back({"terrain spring", 0.2 / std::sqrt(settings_.stiffness)});
  }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[set_];
    if (drags() && (p.n_sorts != sorts_ || p.size() != n_ || s.n_steps == 0)) {
      depth_.measure(s.domain, p, settings_.reference_density);
      sorts_ = p.n_sorts;
      n_ = p.size();
    }
    const ContactSums sums = ordered_reduce(
        p.size(), s.threads, ContactSums{},
        [&](std::size_t begin, std::size_t end, ContactSums& out) {
          press(s, p, dt, begin, end, out);
        },
        combine);
    account_ground(s.domain, p, sums);
  }
  std::size_t bytes() const override { return depth_.bytes(); }

 private:
  bool drags() const { return settings_.liquid->bed != LiquidBed::slip; }
  bool films() const { return settings_.liquid->bed == LiquidBed::film; }

  void press(const State& s, MovingSet& p, double dt, std::size_t begin, std::size_t end,
             ContactSums& out) const {
    const BoundarySupport& b = p.boundary;
    const StartVelocity start(p);
    const GroundImages images(p);
    const auto support_radius = static_cast<float>(2 * settings_.smoothing_length);
    const double kick = kick_time(s, dt);
    const Field *weights = p.find(fields::ground_weight), *grains = p.find(fields::grain_share);
    const double* weight = weights ? weights->component[0].data() : nullptr;
    const bool walled = !s.domain.walls.empty() && p.has(fields::velocity_before);
    for (std::size_t i = begin; i < end; ++i) {
      if (p.fate[i] != Fate::stays || b.distance[i] >= support_radius) continue;
      const Vec3 n(b.nx[i], b.ny[i], b.nz[i]), push = images(i);
      const double support = std::fmax(0.0, push.dot(n));
      out.along += p.mass[i] * dt * (push - push.dot(n) * n);
      out.pushed += p.mass[i] * dt * push.norm();
      const Vec3 before = start(i), found(p.vx[i], p.vy[i], p.vz[i]);
      out.add(apply_contact(law_, b.distance[i], n.x(), n.y(), n.z(), support, dt, before.data(),
                            p.vx[i], p.vy[i], p.vz[i]),
              p.mass[i]);
      // A sheet of one layer has no images that could hold it (BoundaryView): it is a film.
      const double film = films() ? 1 : drags() && weight ? 1 - weight[i] : 0;
      if (film > 0)
        out.friction += p.mass[i] * drag_along(n, before, kick, drag_of(p, i, n.z(), film, grains),
                                               p.vx[i], p.vy[i], p.vz[i]);
      if (walled)
        out.contact_work +=
            0.5 * p.mass[i] *
            by_walls(s, p, i, found - before, dt).dot(Vec3(p.vx[i], p.vy[i], p.vz[i]) - found);
    }
  }

  /// A flow is no thinner than one particle spread over its own square. Among grains the liquid's
  /// stress acts on its share of the bed as on that of every face inside.
  FilmDrag drag_of(const MovingSet& p, std::size_t i, double upright, double share,
                   const Field* grains) const {
    const double density = settings_.reference_density, dx = settings_.spacing;
    const double least = p.mass[i] / (density * dx * dx);
    const double depth = std::max(least, depth_.depth(i) * upright);
    const double layer = std::clamp(depth_.beside_ground(i) * upright, least, depth);
    if (grains) share /= 1 + grains->component[0][i];
    return {settings_.liquid->law, density, depth, layer, share};
  }

  std::size_t set_;
  ContactSettings settings_;
  ContactLaw law_;
  FlowDepth depth_;
  std::size_t sorts_ = 0, n_ = 0;  ///< when the depth was measured
};

}  // namespace

void add_liquid_contact(Step& step, std::size_t set, const ContactSettings& settings) {
  step.add(std::make_unique<LiquidGroundContact>(set, settings));
}

}  // namespace sturz
