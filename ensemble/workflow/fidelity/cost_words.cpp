// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/fidelity/cost_words.hpp"

#include "ensemble/workflow/readable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sturz::workflow {
namespace {

/// What the table of errors cannot say.
void add_notes(const LadderAccuracy& ladder, std::vector<std::string>& lines) {
  if (!ladder.not_told.empty())
    lines.push_back(
        fmt::format("Not told: {}. Every member was cut off, by an edge or its end "
                    "time, at one spacing or another.",
                    fmt::join(ladder.not_told, ", ")));
  std::vector<std::string> without;
  double noise = nan_d;
  for (const ResultAccuracy& r : ladder.results) {
    if (r.n_members < static_cast<std::int64_t>(ladder.members.size()))
      lines.push_back(
          fmt::format("{} is told by {} members: the others were cut off, by an edge or "
                      "their end time.",
                      r.name, r.n_members));
    if (!r.refinement.converges) without.push_back(r.name);
    if (std::isfinite(r.noise) && !(r.noise / r.scale() <= noise)) noise = r.noise / r.scale();
  }
  if (!without.empty())
    lines.push_back(
        fmt::format("No order: at these spacings the means of {} approach no limit; "
                    "their errors are guessed from the range of the means.",
                    fmt::join(without, ", ")));
  if (std::isfinite(noise))
    lines.push_back(
        fmt::format("A displacement of 1e-7 of the values moves a member by up to "
                    "{:.2g} %.",
                    100 * noise));
}

std::string choice_sentence(const LadderAccuracy& ladder, const CostQuestions& questions) {
  const Choice choice = cheapest_for(ladder, questions.wanted, questions.wanted_error);
  const std::string wanted = fmt::format("Within {:g} %", 100 * questions.wanted_error);
  if (std::isfinite(choice.spacing_m))
    return fmt::format("{}: {:.3g} m{}, about {} of one core a member (largest: {}, {}).", wanted,
                       choice.spacing_m,
                       choice.coarsest ? " or coarser (the coarsest that was computed)" : "",
                       duration_text(choice.member_cpu_s), choice.predicted.of,
                       share_text(choice.predicted.error));
  if (std::isfinite(choice.finer_spacing_m))
    return fmt::format(
        "{}: finer than was computed; by the orders about {:.2g} m, {} of one core a member "
        "(extrapolated).",
        wanted, choice.finer_spacing_m, duration_text(ladder.seconds.at(choice.finer_spacing_m)));
  if (choice.predicted.of.empty())
    return fmt::format("{}: nothing of what was asked for is told.", wanted);
  return fmt::format(
      "{}: not at these spacings ({} is {} off at the finest), and no order says "
      "where. Add finer ones.",
      wanted, choice.predicted.of, share_text(choice.predicted.error));
}

std::string split_text(const Split& s) {
  return fmt::format("{:.0f} members at {:.3g} m are {} off (resolution {}, sampling {})",
                     s.members, s.spacing_m, share_text(s.error), share_text(s.resolution),
                     share_text(s.sampling));
}

void add_split(const CostStudy& study, const LadderAccuracy& ladder, const CostQuestions& questions,
               std::vector<std::string>& lines) {
  const double core_s = core_seconds(study, ladder, questions);
  const Split best = best_split(ladder, core_s);
  if (!std::isfinite(best.error)) return;
  std::string text = fmt::format(
      "Best for {} of one core{}: {}", duration_text(core_s),
      questions.core_s > 0 ? "" : " (the planned members at the finest spacing)", split_text(best));
  const Split finest = split_at(ladder, core_s, ladder.spacings_m.back());
  if (std::isfinite(finest.error) && finest.error > 1.1 * best.error)
    text += "; against that, " + split_text(finest);
  lines.push_back(text + ".");
}

}  // namespace

std::string share_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100 * share) : "unknown";
}

std::vector<std::string> ladder_sentences(const CostStudy& study, std::size_t i,
                                          const CostQuestions& questions) {
  const LadderAccuracy& ladder = study.ladders[i];
  std::vector<std::string> lines;
  lines.push_back(choice_sentence(ladder, questions));
  add_split(study, ladder, questions, lines);
  add_notes(ladder, lines);
  return lines;
}

std::string multilevel_sentence(const MultilevelForecast& f) {
  std::string with;
  for (std::size_t i = 1; i < f.gain.levels.size(); ++i)
    with += fmt::format("{}{:.3g} of {}", i > 1 ? " and " : "", f.gain.members[i],
                        f.levels[f.gain.levels[i]]);
  const std::string what =
      fmt::format("Forecast of a multilevel estimate of {}", fmt::join(f.results, ", "));
  if (with.empty())
    return fmt::format(
        "{}: cheaper members would not help those of {}, their correlation is too "
        "low for what they cost.",
        what, f.levels.front());
  return fmt::format(
      "{}: {} beside each member of {} give the same sampling error for 1/{:.3g} of "
      "the seconds (90 %: 1/{:.3g} to 1/{:.3g}).",
      what, with, f.levels.front(), f.gain.gain, f.gain.gain_90.low, f.gain.gain_90.high);
}

std::string title_of(const ModelDifference& m) {
  return fmt::format("{} less {}, each at its finest, with the same values", m.to, m.from);
}

std::string title_of(const VariantCost& v) {
  return fmt::format("{} in {} at {:g} m: {:.2f} times the seconds", v.variant, v.formulation,
                     v.spacing_m, v.seconds_ratio);
}

}  // namespace sturz::workflow
