// SPDX-License-Identifier: Apache-2.0
#include "engine/particles/particle_set.hpp"

#include <gtest/gtest.h>

#include <string>

namespace sturz {
namespace {

constexpr FieldKey pair{"pair", 2, "Pa", "test"};
constexpr FieldKey full{"full", 1, "1", "test", 1.0};
constexpr FieldKey absent{"absent", 1, "1", "test"};
constexpr FieldKey same_name{"pair", 2, "Pa", "another test"};
constexpr FlagKey mark{"mark", "test", 7};

ParticleSet numbered(std::size_t n) {
  ParticleSet p;
  p.grow(n);
  p.add(pair);
  p.add(mark);
  auto& values = p.components(pair);
  for (std::size_t i = 0; i < n; ++i) {
    p.x[i] = 10.0 + i, p.vz[i] = -1.0 * i, p.mass[i] = 100.0 + i;
    values[0][i] = 0.5 * i, values[1][i] = 7.0 * i;
    p.flags(mark)[i] = static_cast<std::uint8_t>(3 * i);
  }
  return p;
}

TEST(ParticleSet, GrowsWithNewNumbersAtRest) {
  ParticleSet p;
  EXPECT_EQ(p.grow(3), 0u);
  EXPECT_EQ(p.grow(2), 3u);
  EXPECT_EQ(p.size(), 5u);
  EXPECT_EQ(p.id, (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(p.vx[4], 0);
}

TEST(ParticleSet, NeverGivesANumberTwice) {
  ParticleSet p = numbered(5);
  p.compact(std::vector<std::uint8_t>{1, 0, 1, 0, 0});
  EXPECT_EQ(p.grow(2), 2u);
  EXPECT_EQ(p.id, (std::vector<std::uint32_t>{0, 2, 5, 6}));
  EXPECT_EQ(p.n_created(), 7u);
}

TEST(ParticleSet, FieldsGrowAlongFromTheirInitialValues) {
  ParticleSet p;
  p.grow(2);
  const Field& f = p.add(full);
  p.add(mark);
  EXPECT_EQ(f.component[0], (std::vector<double>{1, 1}));
  p.scalar(full)[0] = 5;
  p.flags(mark)[1] = 0;
  p.grow(2);
  EXPECT_EQ(f.component[0], (std::vector<double>{5, 1, 1, 1}));
  EXPECT_EQ(p.flags(mark), (std::vector<std::uint8_t>{7, 0, 7, 7}));
  EXPECT_EQ(p.find(full), &f);
}

TEST(ParticleSet, AFieldIsItsKeyNotItsName) {
  ParticleSet p;
  p.add(pair);
  EXPECT_TRUE(p.has(pair));
  EXPECT_FALSE(p.has(same_name));
  EXPECT_EQ(p.find(absent), nullptr);
  EXPECT_THROW(p.add(pair), std::logic_error);
}

TEST(ParticleSet, AMissingFieldIsNamed) {
  const ParticleSet p;
  try {
    p.scalar(absent);
    FAIL() << "nothing was thrown";
  } catch (const std::logic_error& error) {
    EXPECT_NE(std::string(error.what()).find("the field absent"), std::string::npos)
        << error.what();
  }
}

TEST(ParticleSet, PermuteMovesEverythingOfAParticle) {
  ParticleSet p = numbered(4);
  p.permute(std::vector<std::uint32_t>{2, 0, 3, 1});
  EXPECT_EQ(p.id, (std::vector<std::uint32_t>{2, 0, 3, 1}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(p.x[i], 10.0 + p.id[i]);
    EXPECT_EQ(p.vz[i], -1.0 * p.id[i]);
    EXPECT_EQ(p.mass[i], 100.0 + p.id[i]);
    EXPECT_EQ(p.components(pair)[1][i], 7.0 * p.id[i]);
    EXPECT_EQ(p.flags(mark)[i], 3 * p.id[i]);
  }
  EXPECT_THROW(p.permute(std::vector<std::uint32_t>{0}), std::logic_error);
}

TEST(ParticleSet, CompactKeepsOrderAndNumbers) {
  ParticleSet p = numbered(5);
  p.compact(std::vector<std::uint8_t>{1, 0, 0, 1, 1});
  EXPECT_EQ(p.id, (std::vector<std::uint32_t>{0, 3, 4}));
  EXPECT_EQ(p.x, (std::vector<double>{10, 13, 14}));
  EXPECT_EQ(p.components(pair)[0], (std::vector<double>{0, 1.5, 2}));
  EXPECT_EQ(p.flags(mark), (std::vector<std::uint8_t>{0, 9, 12}));
}

TEST(ParticleSet, AbsentFieldsTakeNoMemory) {
  ParticleSet p;
  p.grow(10);
  const std::size_t bare = p.bytes_per_particle();
  p.add(pair);
  EXPECT_EQ(p.bytes_per_particle(), bare + 2 * sizeof(double));
  p.add(mark);
  EXPECT_EQ(p.bytes_per_particle(), bare + 2 * sizeof(double) + 1);
}

}  // namespace
}  // namespace sturz
