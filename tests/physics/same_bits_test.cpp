// SPDX-License-Identifier: Apache-2.0
// The same scene gives the same bits: again, on two threads, with the other instruction set.
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <gtest/gtest.h>

namespace sturz::test {
namespace {

/// Long enough to slide, bend and spread; more than one block of the ordered sums.
Scenario scene() {
  Scenario s = ramp_slide(60, 2);
  s.release.thickness_m = Uncertain(16);
  s.numerics.end_time_s = 2;
  return s;
}

std::uint64_t hash_of(int threads, InstructionSet set) {
  const Finished f = run(build(scene(), threads, set));
  EXPECT_GT(f.result.scalars.n_particles, 1024);
  EXPECT_NE(f.result.state_hash, 0);
  return f.result.state_hash;
}

TEST(SameBits, AgainAndOnTwoThreads) {
  const std::uint64_t first = hash_of(1, best_instruction_set());
  EXPECT_EQ(hash_of(1, best_instruction_set()), first);
  EXPECT_EQ(hash_of(2, best_instruction_set()), first);
}

TEST(SameBits, OnBothVectorInstructionSets) {
  if (!supports(InstructionSet::avx2) || !supports(InstructionSet::avx512))
    GTEST_SKIP() << "this processor has not both AVX2 and AVX-512";
  EXPECT_EQ(hash_of(1, InstructionSet::avx2), hash_of(1, InstructionSet::avx512));
}

}  // namespace
}  // namespace sturz::test
