// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/sweep/fused_sweep.hpp"

namespace sturz {

extern const Sweeps sweeps_plain;
#if defined(__x86_64__)
extern const Sweeps sweeps_avx2;
extern const Sweeps sweeps_avx512;
#endif

std::string_view to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::plain:
      break;
  }
  return "plain";
}

bool supports(InstructionSet set) {
#if defined(__x86_64__)
  switch (set) {
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f");
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case InstructionSet::plain:
      break;
  }
  return true;
#else
  return set == InstructionSet::plain;
#endif
}

InstructionSet best_instruction_set() {
  for (auto set : {InstructionSet::avx512, InstructionSet::avx2})
    if (supports(set)) return set;
  return InstructionSet::plain;
}

const Sweeps& sweeps(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return sweeps_avx512;
  if (set == InstructionSet::avx2) return sweeps_avx2;
#endif
  (void)set;
  return sweeps_plain;
}

}  // namespace sturz
