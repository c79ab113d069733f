// SPDX-License-Identifier: Apache-2.0
// How far multilevel estimates from random parts of stored members lie from the members of the
// dearest level that were not used (docs/studies/multilevel.py).
//
// usage: multilevel_repeats REPEATS SEED N0,N1,... FOLDER SPACING [FOLDER SPACING ...]
// Folders are those of ensembles of the same independent draws on one grid, the dearest first; N0,
// N1, ... draws of each are taken. One line of JSON per repeat: errors of means, and of P(reached)
// over cells where the reference is between 0.05 and 0.95, its own variance taken off.
#include "engine/core/random.hpp"
#include "ensemble/fidelity/multilevel/multilevel_map.hpp"
#include "io/members/member_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

namespace sturz {
namespace {

const std::array<const char*, 3> headlines{"runout_m", "reached_area_m2", "com_travel_m"};

struct Stored {
  std::vector<std::unique_ptr<MemberStore>> stores;
  std::vector<ByNumber> valid;
  std::vector<double> spacings;
};

/// Draws in random order. Cheaper levels take theirs from beyond those of the dearest: the
/// reference, its other members, then shares nothing with the estimate.
std::vector<LevelDraw> chosen(const Stored& all, const std::vector<std::size_t>& counts,
                              std::uint64_t seed) {
  std::vector<std::pair<double, std::int64_t>> order;
  for (const auto& [number, member] : all.valid.front())
    if (std::all_of(all.valid.begin(), all.valid.end(),
                    [n = number](const ByNumber& v) { return v.contains(n); }))
      order.emplace_back(unit_random(seed, static_cast<std::uint64_t>(number)), number);
  std::sort(order.begin(), order.end());
  std::vector<LevelDraw> draws;
  for (std::size_t k = 0; k < std::min(order.size(), counts.front()); ++k)
    draws.push_back({order[k].second, 0, {}});
  const std::int64_t beyond = all.valid.front().rbegin()->first;
  for (std::size_t l = 1; l < counts.size(); ++l) {
    std::vector<std::pair<double, std::int64_t>> more;
    for (const auto& [number, member] : all.valid[l]) {
      const bool taken = std::any_of(draws.begin(), draws.end(),
                                     [n = number](const LevelDraw& d) { return d.number == n; });
      const bool cheap =
          std::all_of(all.valid.begin() + static_cast<std::ptrdiff_t>(l), all.valid.end(),
                      [n = number](const ByNumber& v) { return v.contains(n); });
      if (number > beyond && !taken && cheap)
        more.emplace_back(unit_random(seed + 1, static_cast<std::uint64_t>(number)), number);
    }
    std::sort(more.begin(), more.end());
    for (std::size_t k = 0; k < more.size() && draws.size() < counts[l]; ++k)
      draws.push_back({more[k].second, l, {}});
  }
  return draws;
}

double value_of(const MemberSummary& m, const char* name) {
  return m.scalars.*scalar_named(name).field;
}

std::string means_json(const Stored& all, std::vector<LevelDraw> draws) {
  std::string json;
  for (const char* name : headlines) {
    double plain = 0, n = 0, sum = 0, squares = 0, rest = 0;
    for (LevelDraw& d : draws)
      for (std::size_t l = d.from; l < all.valid.size(); ++l)
        d.values[l] = value_of(*all.valid[l].at(d.number), name);
    for (const auto& [number, member] : all.valid.front()) {
      const bool used = std::any_of(draws.begin(), draws.end(), [k = number](const LevelDraw& d) {
        return d.number == k && d.from == 0;
      });
      const double v = value_of(*member, name);
      (used ? plain : sum) += v;
      (used ? n : rest) += 1;
      if (!used) squares += v * v;
    }
    const MultilevelMean m = multilevel_scalar(draws, all.valid.size()).mean;
    const Interval bounds = m.bounds_90();
    const double reference = sum / rest;
    json += fmt::format(
        "{}{{\"name\":\"{}\",\"mean\":{},\"se\":{},\"low\":{},\"high\":{},\"plain\":{},"
        "\"reference\":{},\"reference_variance\":{}}}",
        json.empty() ? "" : ",", name, m.mean, m.standard_error, bounds.low, bounds.high, plain / n,
        reference, (squares / rest - reference * reference) / (rest - 1));
  }
  return json;
}

/// Shares of members that reach the cells of a window.
std::vector<double> shares(const MemberStore& store, const std::vector<std::size_t>& which,
                           const Window& extent) {
  std::vector<double> share(extent.n_cells(), 0);
  for (const std::size_t i : which) {
    const auto cells = covered_cells(store, i, {}, extent);
    for (std::size_t c = 0; c < share.size(); ++c)
      share[c] += cells.values[c] / static_cast<double>(which.size());
  }
  return share;
}

std::string map_json(const Stored& all, const std::vector<LevelDraw>& draws) {
  MapLevels levels;
  for (const auto& store : all.stores) levels.levels.push_back(store.get());
  levels.spacings_m = all.spacings;
  levels.draws = draws;
  const MultilevelMap map = multilevel_map(levels, {});
  std::vector<std::size_t> rest, used;
  const MemberStore& dear = *all.stores.front();
  for (std::size_t i = 0; i < dear.members().size(); ++i) {
    const std::int64_t number = dear.members()[i].member;
    if (!all.valid.front().contains(number)) continue;
    const bool is_used = std::any_of(draws.begin(), draws.end(), [&](const LevelDraw& d) {
      return d.number == number && d.from == 0;
    });
    (is_used ? used : rest).push_back(i);
  }
  const std::vector<double> reference = shares(dear, rest, map.extent);
  const std::vector<double> plain = shares(dear, used, map.extent);
  const auto n = static_cast<double>(rest.size());
  double error = 0, plain_error = 0, own = 0, spread = 0, cells = 0, covered = 0;
  for (std::size_t c = 0; c < reference.size(); ++c) {
    const double p = reference[c];
    if (p <= 0.05 || p >= 0.95) continue;
    const double found = map.probability.values[c], variance = p * (1 - p) / (n - 1);
    cells += 1;
    own += variance;
    spread += p * (1 - p);
    error += (found - p) * (found - p);
    plain_error += (plain[c] - p) * (plain[c] - p);
    const double half = p > found ? map.high.values[c] - found : found - map.low.values[c];
    covered += std::abs(found - p) <= std::hypot(half, 1.645 * std::sqrt(variance)) ? 1 : 0;
  }
  return fmt::format(
      "{{\"cells\":{},\"mse\":{},\"plain_mse\":{},\"reference_variance\":{},\"spread\":{},"
      "\"covered\":{},\"told\":{},\"smoothed\":{},\"reference_members\":{}}}",
      cells, error / cells, plain_error / cells, own / cells, spread / cells, covered / cells,
      map.rms_error, map.smoothed_cells, rest.size());
}

/// What a cheap level alone is off by, however many members it has.
std::string cheap_json(const Stored& all) {
  std::string json;
  for (std::size_t l = 1; l < all.stores.size(); ++l) {
    std::vector<std::size_t> dear(all.stores[0]->members().size()),
        cheap(all.stores[l]->members().size());
    std::iota(dear.begin(), dear.end(), std::size_t{0});
    std::iota(cheap.begin(), cheap.end(), std::size_t{0});
    const Window extent = whole_of(all.stores[0]->grid());
    const auto p = shares(*all.stores[0], dear, extent), q = shares(*all.stores[l], cheap, extent);
    double error = 0, cells = 0;
    for (std::size_t c = 0; c < p.size(); ++c) {
      if (p[c] <= 0.05 || p[c] >= 0.95) continue;
      error += (p[c] - q[c]) * (p[c] - q[c]);
      cells += 1;
    }
    json += fmt::format("{}{{\"level\":{},\"map_rms\":{}", l == 1 ? "" : ",", l,
                        std::sqrt(error / cells));
    for (const char* name : headlines) {
      double a = 0, b = 0;
      for (const auto& [number, m] : all.valid[0]) a += value_of(*m, name);
      for (const auto& [number, m] : all.valid[l]) b += value_of(*m, name);
      json += fmt::format(",\"{}\":{}", name,
                          b / static_cast<double>(all.valid[l].size()) -
                              a / static_cast<double>(all.valid[0].size()));
    }
    json += "}";
  }
  return json;
}

int work(const std::vector<std::string>& args) {
  if (args.size() < 7 || args.size() % 2 == 0)
    throw std::runtime_error(
        "usage: multilevel_repeats REPEATS SEED N0,N1,... FOLDER SPACING FOLDER SPACING ...");
  std::vector<std::size_t> counts;
  std::istringstream list(args[2]);
  for (std::string n; std::getline(list, n, ',');) counts.push_back(std::stoul(n));
  Stored all;
  for (std::size_t i = 3; i < args.size(); i += 2) {
    all.stores.push_back(std::make_unique<MemberStore>(args[i] + "/members"));
    all.valid.push_back(valid_members(*all.stores.back()));
    all.spacings.push_back(std::stod(args[i + 1]));
  }
  std::vector<double> cost;
  for (const ByNumber& level : all.valid) {
    double sum = 0;
    for (const auto& [number, m] : level) sum += m->scalars.cpu_s;
    cost.push_back(sum / static_cast<double>(level.size()));
  }
  fmt::print("{{\"counts\":[{}],\"cpu_s\":[{}],\"cheap\":[{}]}}\n", fmt::join(counts, ","),
             fmt::join(cost, ","), cheap_json(all));
  for (std::uint64_t r = 0; r < std::stoul(args[0]); ++r) {
    const auto draws = chosen(all, counts, std::stoul(args[1]) + 1000 * r);
    fmt::print("{{\"means\":[{}],\"map\":{}}}\n", means_json(all, draws), map_json(all, draws));
    std::fflush(stdout);
  }
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace sturz

int main(int argc, char** argv) {
  try {
    return sturz::work({argv + 1, argv + argc});
  } catch (const std::exception& problem) {
    fmt::print(stderr, "multilevel_repeats: {}\n", problem.what());
    return EXIT_FAILURE;
  }
}
