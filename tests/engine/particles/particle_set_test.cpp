// SPDX-License-Identifier: Apache-2.0
#include "engine/particles/particle_set.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

ParticleSet numbered(std::size_t n) {
  ParticleSet p;
  p.resize(n);
  p.add_field("stress", 2);
  Field& f = *p.find_field("stress");
  for (std::size_t i = 0; i < n; ++i) {
    p.x[i] = 10.0 + i, p.vz[i] = -1.0 * i, p.mass[i] = 100.0 + i;
    f.component[0][i] = 0.5 * i, f.component[1][i] = 7.0 * i;
  }
  return p;
}

TEST(ParticleSet, ResizeNumbersParticlesAndKeepsThemAtRest) {
  ParticleSet p;
  p.resize(3);
  p.id[2] = 40;
  p.resize(5);
  EXPECT_EQ(p.size(), 5u);
  EXPECT_EQ(p.id, (std::vector<std::uint32_t>{0, 1, 40, 3, 4}));
  EXPECT_EQ(p.vx[4], 0);
}

TEST(ParticleSet, FieldsGrowAlongAndAreFoundByName) {
  ParticleSet p;
  p.resize(2);
  Field& f = p.add_field("compression", 1);
  p.add_field("stress", 6);
  p.resize(4);
  EXPECT_EQ(f.component[0].size(), 4u);
  EXPECT_EQ(p.find_field("stress")->component.size(), 6u);
  EXPECT_EQ(p.find_field("compression"), &f);
  EXPECT_EQ(p.find_field("absent"), nullptr);
  EXPECT_THROW(p.add_field("stress", 6), std::logic_error);
}

TEST(ParticleSet, PermuteMovesEverythingOfAParticle) {
  ParticleSet p = numbered(4);
  p.permute(std::vector<std::uint32_t>{2, 0, 3, 1});
  EXPECT_EQ(p.id, (std::vector<std::uint32_t>{2, 0, 3, 1}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(p.x[i], 10.0 + p.id[i]);
    EXPECT_EQ(p.vz[i], -1.0 * p.id[i]);
    EXPECT_EQ(p.mass[i], 100.0 + p.id[i]);
    EXPECT_EQ(p.find_field("stress")->component[1][i], 7.0 * p.id[i]);
  }
  EXPECT_THROW(p.permute(std::vector<std::uint32_t>{0}), std::logic_error);
}

TEST(ParticleSet, CompactKeepsOrderAndNumbers) {
  ParticleSet p = numbered(5);
  p.compact(std::vector<std::uint8_t>{1, 0, 0, 1, 1});
  EXPECT_EQ(p.id, (std::vector<std::uint32_t>{0, 3, 4}));
  EXPECT_EQ(p.x, (std::vector<double>{10, 13, 14}));
  EXPECT_EQ(p.find_field("stress")->component[0], (std::vector<double>{0, 1.5, 2}));
}

TEST(ParticleSet, AbsentFieldsTakeNoMemory) {
  ParticleSet p;
  p.resize(10);
  const std::size_t bare = p.bytes_per_particle();
  p.add_field("stress", 6);
  EXPECT_EQ(p.bytes_per_particle(), bare + 6 * sizeof(double));
}

}  // namespace
}  // namespace sturz
