// SPDX-License-Identifier: Apache-2.0
// V14: liquid that is driven through grains which are held where they are.
#include "engine/laws/drag.hpp"
#include "tests/physics/coupled/coupled_books.hpp"

#include <fmt/core.h>

#include <random>
#include <vector>

namespace sturz::test {
namespace {

struct FixedBed {
  const char* name = "";
  double viscosity = 1e-3;  ///< [Pa s]
  double drive = 1;         ///< pressure drop over rho_f [m/s^2]
};

ImmersedGrains bed_of(const FixedBed& bed, int layers) {
  ImmersedGrains g;
  g.spacing = 1.0 / layers;
  g.grain_length = g.liquid_length = 6 * g.spacing;
  g.viscosity = bed.viscosity;
  g.drag_diameter = 5e-3;
  g.gravity = 0;
  return g;
}

/// Sets grains back to where they were, by id: storage order changes.
class Hold {
 public:
  explicit Hold(MovingSet& p) : at_(p.size()) {
    std::mt19937 random(3);
    for (std::size_t i = 0; i < p.size(); ++i) {
      double shift[3];
      for (double& d : shift) d = 0.4 * p.spacing * ((random() >> 8) * 0x1p-24 - 0.5);
      at_[p.id[i]] = Vec3(p.x[i] + shift[0], p.y[i] + shift[1], p.z[i] + shift[2]);
    }
    hold(p);
  }
  void hold(MovingSet& p) const {
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3& at = at_[p.id[i]];
      p.x[i] = at.x(), p.y[i] = at.y(), p.z[i] = at.z();
      p.vx[i] = p.vy[i] = p.vz[i] = 0;
    }
  }

 private:
  std::vector<Vec3> at_;
};

/// Steady speed of the liquid, mean before and after the drag of a step [m/s].
/// \param middle  of the middle half of the depth, else of all
struct Seepage {
  double middle = 0, all = 0;
};
Seepage seep(const FixedBed& bed, int layers) {
  const ImmersedGrains g = bed_of(bed, layers);
  HandMade made = immersed(g);
  MovingSet &grains = made.state.sets[0], &liquid = made.state.sets[1];
  const Hold where(grains);
  Seepage sum;
  double n = 0;
  while (made.state.time < 0.4) {
    const double dt = made.advance();
    where.hold(grains);
    double middle = 0, n_middle = 0, all = 0;
    for (std::size_t i = 0; i < liquid.size(); ++i) {
      const double mean = liquid.vx[i] + 0.5 * bed.drive * dt;
      liquid.vx[i] += bed.drive * dt;
      all += mean / static_cast<double>(liquid.size());
      if (std::abs(liquid.z[i] - 0.5) < 0.25) middle += mean, ++n_middle;
    }
    if (made.state.time > 0.2) sum.middle += middle / n_middle, sum.all += all, ++n;
  }
  return {sum.middle / n, sum.all / n};
}

/// Ergun (1952): pressure drop per length at the speed u = U/alpha_f in the pores [Pa/m].
double ergun(const ImmersedGrains& g, double speed) {
  const double solids = g.solid_fraction, pores = 1 - solids, flux = pores * speed;
  const double d = g.drag_diameter, cubed = pores * pores * pores;
  return 150 * solids * solids * g.viscosity * flux / (cubed * d * d) +
         1.75 * solids * g.liquid_density * flux * flux / (cubed * d);
}

class FixedGrains : public testing::TestWithParam<FixedBed> {};
INSTANTIATE_TEST_SUITE_P(At, FixedGrains,
                         testing::Values(FixedBed{"Darcy", 0.02, 1}, FixedBed{"inertia", 1e-3, 6}),
                         [](const auto& i) { return std::string(i.param.name); });

TEST_P(FixedGrains, TakeErgunsPressureDrop) {
  const FixedBed& bed = GetParam();
  for (const int layers : {6, 9, 12}) {
    const ImmersedGrains g = bed_of(bed, layers);
    const Seepage u = seep(bed, layers);
    const double drop = g.liquid_density * bed.drive;
    const std::string name = fmt::format("V14 fixed bed, {}, layers {}", bed.name, layers);
    const double middle = ergun(g, u.middle), all = ergun(g, u.all);
    expect_within(
        relative(name + ", middle", "Pa/m by Ergun at the speed seen", middle, drop, 0.02));
    record(relative(name + ", with top and bottom", "Pa/m", all, drop));
  }
}

}  // namespace
}  // namespace sturz::test
