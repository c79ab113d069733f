// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/reference/reference_slide.hpp"

#include "engine/effects/fields.hpp"
#include "engine/laws/contact_impulse.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"
#include "tests/bench/measure/clocks.hpp"

#include <cmath>

namespace sturz::bench {
namespace {

constexpr float skin_per_h = 0.15f;

ReferenceNumbers numbers_of(const ScenePlan& plan, double gravity) {
  const GrainStressSettings& g = plan.stress;
  const ContactSettings& c = plan.contact;
  auto f = [](double v) { return static_cast<float>(v); };
  ReferenceNumbers k{};
  k.h = f(g.smoothing_length);
  k.gradient_factor = f(SmoothingKernel{g.smoothing_length}.discrete_gradient_factor());
  k.density = f(g.reference_density), k.sound_speed = f(g.sound_speed);
  k.viscosity = f(g.viscosity);
  k.bulk = f(g.bulk_modulus()), k.shear = f(g.shear_modulus());
  k.static_friction = f(g.law.static_friction), k.dynamic_friction = f(g.law.dynamic_friction);
  k.slowness = f(g.shear_modulus() * g.law.inertial_number_scale /
                 (g.law.grain_diameter * std::sqrt(g.law.grain_density)));
  k.gravity = f(gravity);
  k.spring = f(c.stiffness);
  k.damping = f(2 * damping_ratio(c.restitution) * std::sqrt(c.stiffness));
  k.contact_distance = f(0.5 * c.spacing);
  k.basal_friction = f(c.bed[0].friction_coefficient * (1 - c.bed[0].pore_pressure_ratio));
  return k;
}

/// Relative to an origin: float has 24 bits.
std::vector<float> shifted(const std::vector<double>& v, double origin) {
  std::vector<float> out(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) out[i] = static_cast<float>(v[i] - origin);
  return out;
}

std::vector<float> as_floats(const std::vector<double>& v) { return shifted(v, 0); }

}  // namespace

ReferenceSlide::ReferenceSlide(const SimulationParts& parts, const ScenePlan& plan)
    : numbers_(numbers_of(plan, parts.state.gravity)),
      neighbors_((2 + skin_per_h) * numbers_.h),
      skin_(skin_per_h * numbers_.h),
      moved_(skin_) {
  const ParticleSet& p = parts.state.grains();
  const double x0 = p.x[0], y0 = p.y[0], z0 = p.z[0];
  x_ = shifted(p.x, x0), y_ = shifted(p.y, y0), z_ = shifted(p.z, z0);
  vx_ = as_floats(p.vx), vy_ = as_floats(p.vy), vz_ = as_floats(p.vz);
  mass_ = as_floats(p.mass);
  density_change_ = as_floats(p.scalar(fields::density_change));
  for (int c = 0; c < 6; ++c) stress_[c] = as_floats(p.components(fields::stress)[c]);
  for (auto* v : {&ax_, &ay_, &az_}) v->assign(p.size(), 0);
  for (auto& v : gradient_) v.assign(p.size(), 0);
  records_.assign(record_floats * p.size(), 0);
  const Grid& g = plan.bed.grid();
  for (int row = g.n_rows - 1; row >= 0; --row)
    for (int col = 0; col < g.n_cols; ++col)
      nodes_.push_back(static_cast<float>(plan.bed.node(row, col) - z0));
  ground_ = {nodes_.data(),
             g.n_cols,
             g.n_rows,
             static_cast<float>(g.x_center(0) - x0),
             static_cast<float>(g.y_center(g.n_rows - 1) - y0),
             static_cast<float>(g.cell_m)};
  rebuild();
  choose_pass();
}

ReferenceColumns ReferenceSlide::columns() {
  ReferenceColumns c{size(),
                     x_.data(),
                     y_.data(),
                     z_.data(),
                     vx_.data(),
                     vy_.data(),
                     vz_.data(),
                     mass_.data(),
                     density_change_.data(),
                     ax_.data(),
                     ay_.data(),
                     az_.data(),
                     {},
                     {}};
  for (int k = 0; k < 6; ++k) c.stress[k] = stress_[k].data();
  for (int k = 0; k < 9; ++k) c.gradient[k] = gradient_[k].data();
  return c;
}

std::vector<std::vector<float>*> ReferenceSlide::carried() {
  std::vector<std::vector<float>*> all{&x_, &y_, &z_, &vx_, &vy_, &vz_, &mass_, &density_change_};
  for (auto& s : stress_) all.push_back(&s);
  return all;
}

void ReferenceSlide::rebuild() {
  const std::vector<int>& order = neighbors_.sort(x_, y_, z_);
  scratch_.resize(size());
  for (auto* column : carried()) {
    for (std::size_t k = 0; k < size(); ++k) scratch_[k] = (*column)[order[k]];
    column->swap(scratch_);
  }
  neighbors_.list(x_, y_, z_);
  moved_ = 0;
  ++n_rebuilds_;
}

/// Times both on the first lists; the sums are only written, so nothing moves.
void ReferenceSlide::choose_pass() {
  const ReferenceColumns c = columns();
  pass_->gather_records(c, numbers_, records_.data());
  double least = 1e300;
  for (int round = 0; round < 3; ++round)
    for (const ReferencePass* pass : {&reference_gathers, &reference_single_loads}) {
      const double s = timed(thread_seconds, [&] { pass->sum_pairs(c, numbers_, list()); });
      if (s < least) least = s, pass_ = pass;
    }
}

void ReferenceSlide::step(double step_s) {
  const auto dt = static_cast<float>(step_s);
  if (moved_ >= skin_) rebuild();
  const ReferenceColumns c = columns();
  pass_->gather_records(c, numbers_, records_.data());
  pass_->sum_pairs(c, numbers_, list());
  pass_->update_particles(c, numbers_, dt);
  pass_->meet_ground(c, numbers_, ground_, dt);
  moved_ += dt * pass_->drift(c, dt);
}

double ReferenceSlide::bytes_per_particle() const {
  const std::size_t floats = 11 + 6 + 9 + 1 + record_floats;
  return sizeof(float) * static_cast<double>(floats) +
         sizeof(int) * static_cast<double>(neighbors_.offsets().capacity() + 2 * size()) /
             static_cast<double>(size());
}

double ReferenceSlide::mean_vx() const {
  double momentum = 0, mass = 0;
  for (std::size_t i = 0; i < size(); ++i) momentum += double(mass_[i]) * vx_[i], mass += mass_[i];
  return momentum / mass;
}

}  // namespace sturz::bench
