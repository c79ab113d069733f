// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/run_warnings.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace sturz {
namespace {

std::string percent(double share) {
  if (std::abs(share) >= 0.1) return std::to_string(std::lround(100 * share)) + " %";
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.begin(), text.end(), 100 * share, std::chars_format::general, 2).ptr;
  return std::string(text.begin(), end) + " %";
}

}  // namespace

std::string run_warnings(const MemberScalars& m) {
  std::string text;
  if (m.take_off_fraction > much_take_off)
    text = percent(m.take_off_fraction) +
           " of mass and time was on ground that falls away faster than the mass (it would fly "
           "there; columns keep to the ground, so speed and runout beyond are uncertain)";
  if (!(std::abs(m.energy_residual) <= much_residual))
    text += (text.empty() ? "" : "; ") + percent(m.energy_residual) +
            " of the energy is not accounted for (single cells of the terrain that stick out, or a "
            "spacing too coarse for it, are the usual reasons)";
  return text;
}

}  // namespace sturz
