// SPDX-License-Identifier: Apache-2.0
// The drag of many grains at once against that of each alone.
#include "engine/effects/coupling/drag_batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace sturz {
namespace {

/// slip_taken() of laws/phase_drag.hpp without what it loses in small steps: there 1 - (1 - e^-x)/x
/// cancels to 1e-6 of itself.
Vec3 taken(const Vec3& before, const Vec3& now, double steps) {
  const double decayed = -std::expm1(-steps);
  if (before.dot(now) < 0) return decayed * now;
  const double driven =
      steps < 0.02
          ? steps *
                (1.0 / 2 -
                 steps * (1.0 / 6 - steps * (1.0 / 24 - steps * (1.0 / 120 - steps * (1.0 / 720)))))
          : 1 - decayed / steps;
  return decayed * before + driven * (now - before);
}

TEST(DragBatch, IsTheDragOfEachAlone) {
  const GranularDrag law{0.003, 1100, 0.01};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal(0, 1);
  for (const std::size_t n : {std::size_t{1}, std::size_t{7}, DragBatch::capacity}) {
    DragBatch batch(law);
    std::vector<Vec3> expected;
    for (std::size_t k = 0; k < n; ++k) {
      const double size = std::pow(10, 6 * unit(random) - 5), solids = 0.9 * unit(random);
      const Vec3 before = size * Vec3(normal(random), normal(random), normal(random));
      const Vec3 now = (k % 5 == 0 ? -1 : 1) * before +
                       size * Vec3(normal(random), normal(random), normal(random));
      const double reduced = 2 * unit(random), force = std::pow(10, 12 * unit(random) - 12);
      batch.add(static_cast<std::uint32_t>(3 * k), before, now, solids, reduced, force);
      const double first = force * law.per_grain_volume(solids, before.norm());
      const double mean = 0.5 * (before.norm() + (now - taken(before, now, first)).norm());
      expected.push_back(-reduced * taken(before, now, force * law.per_grain_volume(solids, mean)));
    }
    batch.relax();
    ASSERT_EQ(batch.size(), n);
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_EQ(batch.row(k), 3 * k);
      EXPECT_LT((batch.impulse(k) - expected[k]).norm(), 1e-11 * expected[k].norm() + 1e-300) << k;
    }
  }
}

TEST(DragBatch, AtRestGivesNothing) {
  DragBatch batch({0.003, 1100, 0.01});
  batch.add(0, {0, 0, 0}, {0, 0, 0}, 0.5, 1, 1);
  batch.add(1, {0, 0, 0}, {0, 0, 0}, 0, 0, 0);
  batch.relax();
  EXPECT_EQ(batch.impulse(0), Vec3(0, 0, 0));
  EXPECT_EQ(batch.impulse(1), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace sturz
