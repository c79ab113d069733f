// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure/peers.hpp"

#include <fmt/core.h>

namespace sturz::bench {
namespace {

struct Peer {
  const char *code, *what;
  double m_updates_s;
  const char* source;
};

constexpr Peer fastest{"DualSPHysics 5.4, tuned", "water, scalar pressure, no density diffusion",
                       0.589, "commit ef3721a, -march=native, -cellmode:half, 59,447 particles"};
constexpr Peer soil{"SPHinXsys, repose angle", "soil, Drucker-Prager, full stress, double", 0.038,
                    "commit 9f33297, 25,120 particles of soil"};
constexpr Peer peers[] = {
    fastest,
    {"DualSPHysics 5.4, tuned, SPS", "water, six components of stress", 0.451,
     "the same build, Laminar+SPS"},
    {"DualSPHysics 5.4, as shipped", "water, no density diffusion", 0.389,
     "commit ef3721a, -O3 -ffast-math"},
    {"DualSPHysics 5.4, as shipped", "water, density diffusion of Fourtakas", 0.244,
     "the same build, its example's default"},
    {"SPHinXsys, dam break", "water, double", 0.139, "commit 9f33297, 52,022 particles"},
    {"SPlisHSPlasH 2.16", "water, support as wide as ours", 0.133,
     "commit c5a063d, AVX2, 46,410 particles"},
    soil,
};

}  // namespace

Table peers_table(const std::string& scene, double ours) {
  Table table("peers", "Other codes, one core, beside " + scene,
              {{"code", "code"},
               {"what", "what it computes"},
               {"m_updates_s", "M updates/s/core"},
               {"ours_over_theirs", "ours/theirs"},
               {"source", "built and run from"}});
  for (const Peer& p : peers)
    table.add({cell(p.code), cell(p.what), cell(p.m_updates_s, 3),
               cell(1e-6 * ours / p.m_updates_s, 1), cell(p.source)});
  return table;
}

std::string peers_sentence(const std::string& scene, double ours) {
  return fmt::format(
      "{}: {:.2f} million particle-updates a second on one core; {:.1f} times what the fastest "
      "build of {} did with {}, and {:.0f} times {} ({}). Theirs were measured on another machine "
      "(2 vCPU Xeon with AVX-512): good to a half.",
      scene, 1e-6 * ours, 1e-6 * ours / fastest.m_updates_s, fastest.code, fastest.what,
      1e-6 * ours / soil.m_updates_s, soil.code, soil.what);
}

}  // namespace sturz::bench
