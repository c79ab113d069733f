// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/multilevel/multilevel_words.hpp"

#include "ensemble/workflow/readable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sturz::workflow {
namespace {

std::string row_of(const std::string& name, const std::vector<std::string>& cells) {
  std::string text = fmt::format("  {:<20}", name);
  for (const std::string& cell : cells) text += fmt::format(" {:>15}", cell);
  return text;
}

std::string number_or(double v, const char* otherwise) {
  return std::isfinite(v) ? fmt::format("{:.3g}", v) : otherwise;
}

/// Bounds of a skewed mean lie farther on one side; half their width would put them elsewhere.
std::string off_by(const MultilevelMean& m) {
  const Interval bounds = m.bounds_90();
  const double below = m.mean - bounds.low, above = bounds.high - m.mean;
  if (!(std::abs(above - below) > 0.05 * (above + below)))
    return "+- " + number_or((above + below) / 2, "?");
  return fmt::format("-{:.3g} +{:.3g}", below, above);
}

bool knows_results(const MultilevelLook& look) {
  for (std::size_t r = 0; r < headline_results().size(); ++r)
    for (std::size_t p = 1; p < look.squared_correlations[r].size(); ++p)
      if (std::isfinite(look.squared_correlations[r][p])) return true;
  return false;
}
bool knows_results(const MultilevelMade& made) {
  return std::any_of(made.headlines.begin(), made.headlines.end(), [](const auto& h) {
    return std::find(headline_results().begin(), headline_results().end(), h.name) !=
           headline_results().end();
  });
}

/// \param first the round that chose the levels \param known whether members tell some result
std::string why_plain(const PlanRound& first, int pilot, bool known) {
  double spent = 0;
  for (const double cost : first.cost_s) spent += pilot * cost;
  if (!known) return "No result is known of enough members to tell what cheaper levels are worth.";
  if (first.budget_s > 0 && spent >= first.budget_s)
    return fmt::format("The pilots took {} of one core, and ensemble.target.core_hours gives {}.",
                       duration_text(spent), duration_text(first.budget_s));
  if (!(first.budget_s > 0) && first.members.front() <= pilot)
    return "Its pilot alone reaches the target.";
  return "Cheaper levels know too little of what the scene's own members do for what they cost.";
}

std::string share_or_dash(double v) {
  return std::isfinite(v) ? fmt::format("{:.0f} %", 100 * v) : "-";
}

}  // namespace

std::vector<std::string> pilot_lines(const MultilevelJob& job, const MultilevelLook& look) {
  std::vector<std::string> lines;
  lines.push_back(
      fmt::format("Pilot of {} shared draws (of the variance of {}, each level alone "
                  "tells):",
                  job.plan.pilot, job.parts.front().name));
  std::vector<std::string> names, seconds;
  for (std::size_t p = 0; p < job.parts.size(); ++p) {
    names.push_back(job.parts[p].name);
    seconds.push_back(fmt::format("{:.3g}", look.cost_s[p]));
  }
  for (std::string& name : names)
    if (name.starts_with("depth_averaged")) name.replace(0, 14, "columns");
  lines.push_back(row_of("", names));
  lines.push_back(row_of("CPU s a member", seconds));
  for (std::size_t r = 0; r < look.results.size(); ++r) {
    std::vector<std::string> cells;
    for (const double v : look.squared_correlations[r]) cells.push_back(number_or(v, "-"));
    lines.push_back(row_of(look.results[r], cells));
  }
  return lines;
}

std::string round_text(const MultilevelJob& job, const MultilevelLook& look) {
  const PlanRound& round = look.rounds.back();
  std::string what;
  for (std::size_t l = 0; l < round.plan.levels.size(); ++l) {
    const std::size_t p = round.plan.levels[l];
    what +=
        fmt::format("{}{} members of {}", l == 0 ? "" : ", ", round.members[p], job.parts[p].name);
  }
  if (round.plan.levels.size() == 1)
    return fmt::format("Plain sampling: {}, {} of one core. {}", what,
                       duration_text(round.plan.seconds),
                       why_plain(look.rounds.front(), job.plan.pilot, knows_results(look)));
  return fmt::format("{}: {} of one core, 1/{:.3g} of independent draws of {} alone.", what,
                     duration_text(round.plan.seconds), round.plan.gain, job.parts.front().name);
}

std::string gain_text(const MultilevelMade& made) {
  if (made.used.size() == 1)
    return "Plain sampling. " + why_plain(made.rounds.front(), made.pilot, knows_results(made));
  std::string text = fmt::format("{} of one core in all.", duration_text(made.seconds));
  const auto add = [&](const std::string& name, double plain) {
    if (std::isfinite(plain))
      text +=
          fmt::format(" The same error of {} by independent draws of {} alone: {} (1/{:.3g}).",
                      name, made.levels.front().name, duration_text(plain), plain / made.seconds);
  };
  for (const MultilevelHeadline& h : made.headlines)
    if (std::find(headline_results().begin(), headline_results().end(), h.name) !=
        headline_results().end())
      add(h.name, h.plain_seconds);
  add("the map", made.map_plain_seconds);
  return text +
         " Latin hypercubes and Sobol' designs of it scatter less than independent draws do where "
         "results follow few values smoothly; their bounds do not tell by how much.";
}

std::string model_text(const MultilevelMade& made) {
  for (const MultilevelHeadline& h : made.headlines)
    if (std::isfinite(h.model))
      return fmt::format(
          "Model: how far the mean of {} lies away with the same draws, {} of {} +- {:.2g} (90 %). "
          "What the two spacings differ by is part of it.",
          h.model_of, number_or(h.model, "?"), h.name, 1.645 * h.model_error);
  return "";
}

std::string upper_bound_text(const MultilevelMade& made) {
  // Probabilities come from draws that all used levels have.
  return fmt::format(
      "Upper bounds are nowhere on the maps below {0:.0f} %: so much may what none of {1} members "
      "of {2} does, whatever cheaper ones do. Where none of them comes and cheaper ones foretell "
      "none (no chance above {3:.3g} % for any draw), no upper bound is drawn: these {0:.0f} % are "
      "all that is known there, and beyond the maps as well.",
      100 * unseen_share(made.dear_draws), made.dear_draws, made.levels.front().name,
      100 * least_foretold);
}

std::vector<std::string> open_quantiles(const MultilevelMade& made) {
  std::vector<std::string> lines;
  const std::size_t n_levels = made.headlines.empty() ? 0 : made.headlines.front().quantiles.size();
  for (std::size_t q = 0; q < n_levels; ++q)
    for (const bool upper : {false, true}) {
      std::vector<std::string> names;
      std::size_t needed = 0;
      double members = std::numeric_limits<double>::infinity();
      for (const MultilevelHeadline& h : made.headlines) {
        const Interval& bounds = h.quantiles[q].bounds_90;
        if (!std::isinf(upper ? bounds.high : bounds.low)) continue;
        names.push_back(h.name);
        members = std::min(members, h.scalar.draws.front());
        needed = std::max(needed, h.quantiles[q].draws_needed);
      }
      if (names.empty()) continue;
      std::string of;
      if (names.size() < made.headlines.size()) of = fmt::format(" of {}", fmt::join(names, ", "));
      lines.push_back(fmt::format(
          "No {} bound of the {:.3g} % quantile{}: {:.0f} members of {} are too few{}. At least {} "
          "are needed.",
          upper ? "upper" : "lower", 100 * made.headlines.front().quantiles[q].level, of, members,
          made.levels.front().name, made.used.size() > 1 ? ", whatever cheaper ones tell" : "",
          needed));
    }
  return lines;
}

std::vector<std::string> page_sentences(const MultilevelMade& made) {
  std::vector<std::string> lines = made.cut_off;
  lines.insert(lines.end(), made.missed.begin(), made.missed.end());
  if (std::isfinite(made.map_error))
    lines.push_back(
        fmt::format("P(reached) where it is between 0.05 and 0.95: standard error "
                    "{:.3g} (root mean square of {} cells).",
                    made.map_error, made.maps.front().maps.front().doubtful));
  if (!made.maps.empty()) lines.push_back(upper_bound_text(made));
  for (std::string& sentence : open_quantiles(made)) lines.push_back(std::move(sentence));
  if (std::string model = model_text(made); !model.empty()) lines.push_back(std::move(model));
  lines.push_back(gain_text(made));
  if (made.failed > 0)
    lines.push_back(
        fmt::format("{} members failed; their draws count where a level and all cheaper ones "
                    "have them.",
                    made.failed));
  for (const LevelShare& l : made.levels)
    if (l.unpaired > 0)
      lines.push_back(
          fmt::format("{} valid members of {} are not used: a cheaper member of the same draw "
                      "failed, and nothing foretells them.",
                      l.unpaired, l.name));
  if (made.censored > 0)
    lines.push_back(
        fmt::format("The end of {} members was not seen: results are of the others, and "
                    "probabilities are lower bounds.",
                    made.censored));
  for (const MultilevelHeadline& h : made.headlines)
    if (h.left_out > 0)
      lines.push_back(fmt::format("{}: {} of {} members of {} do not tell it and are left out.",
                                  h.name, h.left_out,
                                  h.left_out + static_cast<std::int64_t>(h.scalar.draws.front()),
                                  made.levels.front().name));
  return lines;
}

std::vector<std::string> result_lines(const MultilevelMade& made) {
  std::vector<std::string> lines{"Means, and by how much they may be off:"};
  lines.push_back(row_of("", {"mean", "sampling (90 %)", "resolution", "model"}));
  for (const MultilevelHeadline& h : made.headlines)
    lines.push_back(
        row_of(h.name, {fmt::format("{:.4g}", h.scalar.mean.mean), off_by(h.scalar.mean),
                        "+- " + number_or(h.resolution, "?"), "+- " + number_or(h.model, "?")}));
  std::vector<std::string> names;
  for (const MultilevelHeadline& h : made.headlines)
    if (names.size() < 3) names.push_back(h.name);
  names.emplace_back("map");
  lines.emplace_back("Share of the variance that each level leaves, and of the seconds:");
  std::vector<std::string> heads{"members", "seconds"};
  heads.insert(heads.end(), names.begin(), names.end());
  lines.push_back(row_of("", heads));
  for (const LevelShare& l : made.levels) {
    std::vector<std::string> cells{std::to_string(l.members),
                                   share_or_dash(l.seconds / made.seconds)};
    const std::size_t n = l.variance_shares.size(), n_headlines = made.headlines.size();
    for (std::size_t i = 0; i < std::min<std::size_t>(3, n_headlines); ++i)
      cells.push_back(share_or_dash(i < n ? l.variance_shares[i] : nan_d));
    cells.push_back(share_or_dash(n > n_headlines ? l.variance_shares[n_headlines] : nan_d));
    lines.push_back(row_of(l.name, cells));
  }
  for (std::string& sentence : page_sentences(made)) lines.push_back(std::move(sentence));
  return lines;
}

}  // namespace sturz::workflow
