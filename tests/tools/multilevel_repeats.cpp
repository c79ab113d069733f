// SPDX-License-Identifier: Apache-2.0
// How far multilevel estimates from random parts of stored members lie from members of the dearest
// level that they did not use (docs/studies/multilevel.py).
//
// usage: multilevel_repeats REPEATS SEED JOBS NAME FOLDER SPACING [NAME FOLDER SPACING ...]
// Folders are those of ensembles of the same independent draws on one grid, the dearest first. JOBS
// are separated by ';': "0=16,2=600", fixed numbers of members of levels 0 and 2, or
// "error=0.05,map=0.04", the whole procedure with that target. The first line of JSON tells of the
// levels, and one per job and repeat of what was found.
//
// Each repeat takes `pool` of the dearest level's draws; cheaper levels have those too, and else a
// random half of the draws beyond the dearest level's last. The plain reference are the other
// members of the dearest level. Means are also held against a control-variate estimate from these
// and the other half, which knows more.
#include "ensemble/workflow/multilevel/decision.hpp"
#include "tests/tools/stored_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

namespace sturz {
namespace {

using workflow::headline_results;
using workflow::LevelMembers;

constexpr std::size_t pilot = 16;

struct Job {
  std::vector<std::size_t> levels;
  std::vector<std::int64_t> members;
  TargetSpec target;
  bool whole = false;  ///< the procedure decides
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

Job job_of(const std::string& text) {
  Job job;
  for (const std::string& item : split(text, ',')) {
    const auto at = item.find('=');
    if (at == std::string::npos) throw std::runtime_error("a job is LEVEL=N,... or error=E,map=E");
    const std::string key = item.substr(0, at);
    const double value = std::stod(item.substr(at + 1));
    if (key == "error" || key == "map") {
      job.whole = true;
      (key == "error" ? job.target.relative_error : job.target.map_error) = value;
    } else {
      job.levels.push_back(std::stoul(key));
      job.members.push_back(static_cast<std::int64_t>(value));
    }
  }
  return job;
}

/// What was decided, and with how many members.
struct Chosen {
  std::vector<std::size_t> levels;
  std::size_t rounds = 0;
  bool capped = false;  ///< more were asked for than are stored
};

Chosen decide(LevelMembers& all, const Job& job, const std::vector<double>& costs) {
  const auto take = [&](const std::vector<std::int64_t>& wanted) {
    bool capped = false;
    for (std::size_t p = 0; p < wanted.size(); ++p) {
      const auto stored = static_cast<std::int64_t>(all.members[p]->members().size());
      capped = capped || wanted[p] > stored;
      all.counts[p] = std::max(all.counts[p], std::min(wanted[p], stored));
    }
    return capped;
  };
  Chosen chosen;
  if (!job.whole) {
    std::vector<std::int64_t> counts(all.parts.size(), 0);
    for (std::size_t l = 0; l < job.levels.size(); ++l) counts[job.levels[l]] = job.members[l];
    chosen.levels = job.levels;
    chosen.capped = take(counts);
    return chosen;
  }
  take(std::vector<std::int64_t>(all.parts.size(), pilot));
  std::vector<workflow::PlanRound> rounds;
  while (!chosen.capped) {
    auto round = workflow::next_round(all, rounds, job.target, costs, {});
    if (!round) break;
    chosen.capped = take(round->members);
    rounds.push_back(std::move(*round));
  }
  chosen.levels = rounds.back().plan.levels;
  chosen.rounds = rounds.size();
  return chosen;
}

struct Moments {
  double mean = 0, variance_of_mean = 0;
};
Moments moments(const MemberParts& members, const std::string& name) {
  double n = 0, sum = 0, squares = 0;
  for (const MemberSummary& m : members.members()) {
    const double v = m.scalars.*scalar_named(name).field;
    n += 1, sum += v, squares += v * v;
  }
  return {sum / n, (squares / n - sum / n * (sum / n)) / (n - 1)};
}

std::string means_json(const LevelMembers& all, const std::vector<std::size_t>& levels,
                       const LevelMembers& others) {
  std::string json;
  const std::vector<std::size_t> with_cheapest{0, all.parts.size() - 1};
  for (const std::string& name : headline_results()) {
    const MultilevelMean m = scalar_of(all, levels, name).mean;
    const Interval bounds = m.bounds_90();
    const Moments plain = moments(*others.members.front(), name);
    const MultilevelMean known = scalar_of(others, with_cheapest, name).mean;
    json += fmt::format(
        "{}{{\"name\":\"{}\",\"mean\":{},\"se\":{},\"low\":{},\"high\":{},\"reference\":{},"
        "\"reference_variance\":{},\"known\":{},\"known_variance\":{}}}",
        json.empty() ? "" : ",", name, m.mean, m.standard_error, bounds.low, bounds.high,
        plain.mean, plain.variance_of_mean, known.mean, std::pow(known.standard_error, 2));
  }
  return json;
}

/// Shares of members that reach the cells of a window.
std::vector<double> shares(const MemberParts& members, const Window& extent) {
  std::vector<double> share(extent.n_cells(), 0);
  const auto n = static_cast<double>(members.members().size());
  for (std::size_t i = 0; i < members.members().size(); ++i) {
    const auto cells = covered_cells(members, i, {}, extent);
    for (std::size_t c = 0; c < share.size(); ++c) share[c] += cells.values[c] / n;
  }
  return share;
}

std::string map_json(const LevelMembers& all, const std::vector<std::size_t>& levels,
                     const MemberParts& others) {
  if (levels.size() < 2) return "null";
  const MultilevelMap map = map_of(all, levels, {}, {});
  const std::vector<double> reference = shares(others, map.extent);
  const auto n = static_cast<double>(others.members().size());
  double error = 0, own = 0, spread = 0, cells = 0, covered = 0;
  for (std::size_t c = 0; c < reference.size(); ++c) {
    const double p = reference[c];
    if (p <= 0.05 || p >= 0.95) continue;
    const double found = map.probability.values[c], variance = p * (1 - p) / (n - 1);
    cells += 1;
    own += variance;
    spread += p * (1 - p);
    error += (found - p) * (found - p);
    const double half = p > found ? map.high.values[c] - found : found - map.low.values[c];
    covered += std::abs(found - p) <= std::hypot(half, 1.645 * std::sqrt(variance)) ? 1 : 0;
  }
  return fmt::format(
      "{{\"cells\":{},\"mse\":{},\"reference_variance\":{},\"spread\":{},\"covered\":{},"
      "\"told\":{},\"smoothed\":{},\"reference_members\":{}}}",
      cells, error / cells, own / cells, spread / cells, covered / cells, map.rms_error,
      map.smoothed_cells, n);
}

/// What a cheap level alone is off by, however many members it has.
std::string cheap_json(const StoredLevels& stored) {
  std::string json;
  const Window extent = whole_of(stored.levels().front()->grid());
  const auto p = shares(*stored.levels().front(), extent);
  for (std::size_t l = 1; l < stored.levels().size(); ++l) {
    const auto q = shares(*stored.levels()[l], extent);
    double error = 0, cells = 0;
    for (std::size_t c = 0; c < p.size(); ++c) {
      if (p[c] <= 0.05 || p[c] >= 0.95) continue;
      error += (p[c] - q[c]) * (p[c] - q[c]);
      cells += 1;
    }
    json += fmt::format("{}{{\"level\":{},\"map_rms\":{}", l == 1 ? "" : ",", l,
                        std::sqrt(error / cells));
    for (const std::string& name : headline_results())
      json += fmt::format(
          ",\"{}\":{}", name,
          moments(*stored.levels()[l], name).mean - moments(*stored.levels().front(), name).mean);
    json += "}";
  }
  return json;
}

int work(const std::vector<std::string>& args) {
  if (args.size() < 9 || args.size() % 3 != 0)
    throw std::runtime_error(
        "usage: multilevel_repeats REPEATS SEED JOBS NAME FOLDER SPACING NAME FOLDER SPACING ...");
  std::vector<Job> jobs;
  for (const std::string& text : split(args[2], ';')) jobs.push_back(job_of(text));
  StoredLevels stored;
  for (std::size_t i = 3; i < args.size(); i += 3)
    stored.add(args[i], args[i + 1], std::stod(args[i + 2]));
  const std::vector<double> costs = stored.costs_s();
  std::vector<std::size_t> members;
  for (const auto& level : stored.levels()) members.push_back(level->members().size());
  fmt::print("{{\"members\":[{}],\"left_out\":[{}],\"cpu_s\":[{}],\"pool\":{},\"cheap\":[{}]}}\n",
             fmt::join(members, ","), fmt::join(stored.left_out(), ","), fmt::join(costs, ","),
             StoredLevels::pool, cheap_json(stored));
  for (std::uint64_t r = 0; r < std::stoul(args[0]); ++r) {
    const StoredLevels::Parted parted = stored.part(std::stoul(args[1]) + 1000 * r);
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      LevelMembers all = parted.taken;
      const Chosen chosen = decide(all, jobs[j], costs);
      fmt::print(
          "{{\"job\":{},\"levels\":[{}],\"counts\":[{}],\"rounds\":{},\"capped\":{},"
          "\"means\":[{}],\"map\":{}}}\n",
          j, fmt::join(chosen.levels, ","), fmt::join(all.counts, ","), chosen.rounds,
          chosen.capped, means_json(all, chosen.levels, parted.others),
          map_json(all, chosen.levels, *parted.others.members.front()));
      std::fflush(stdout);
    }
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
