// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/fidelity/cost_words.hpp"

#include "ensemble/workflow/readable.hpp"
#include "reports/fidelity/result_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sturz::workflow {
namespace {

std::string plain(const std::string& name) {
  return name == map_word ? std::string("the map") : result_words(name);
}

std::string plain(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  all.reserve(names.size());
  for (const std::string& name : names) all.push_back(plain(name));
  return fmt::format("{}", fmt::join(all, ", "));
}

/// "depth_averaged_8m": "depth averaged at 8 m".
std::string plain_level(const std::string& name) {
  const std::size_t at = name.rfind('_');
  if (at == std::string::npos || name.back() != 'm') return name;
  std::string formulation = name.substr(0, at);
  std::replace(formulation.begin(), formulation.end(), '_', ' ');
  return fmt::format("{} at {} m", formulation, name.substr(at + 1, name.size() - at - 2));
}

/// Results that few members tell, together where as many do.
void add_counts(const LadderAccuracy& ladder, std::vector<std::string>& lines) {
  std::map<std::int64_t, std::vector<std::string>> by_count;
  for (const ResultAccuracy& r : ladder.results)
    if (r.n_members < static_cast<std::int64_t>(ladder.members.size()))
      by_count[r.n_members].push_back(r.name);
  for (const auto& [n, names] : by_count)
    lines.push_back(
        fmt::format("Known by {} of {} members only: {}. The others were cut off, by an edge or "
                    "their end time.",
                    n, ladder.members.size(), plain(names)));
}

/// What the table of errors cannot say.
void add_notes(const LadderAccuracy& ladder, std::vector<std::string>& lines) {
  if (!ladder.not_told.empty())
    lines.push_back(
        fmt::format("Not told: {}. Every member was cut off, by an edge or its end "
                    "time, at one spacing or another.",
                    plain(ladder.not_told)));
  add_counts(ladder, lines);
  std::vector<std::string> without;
  double noise = nan_d;
  for (const ResultAccuracy& r : ladder.results) {
    if (!r.refinement.converges) without.push_back(r.name);
    if (std::isfinite(r.noise) && !(r.noise / r.scale() <= noise)) noise = r.noise / r.scale();
  }
  if (!without.empty())
    lines.push_back(
        fmt::format("No order: at these spacings the means of {} approach no limit from one side; "
                    "their errors rest on how far members and means scatter.",
                    plain(without)));
  if (std::isfinite(noise))
    lines.push_back(fmt::format(
        "Noise: values displaced by 1e-7 move a member by up to {:.2g} %; no spacing tells "
        "less than that apart.",
        100 * noise));
}

std::string choice_sentence(const LadderAccuracy& ladder, const CostQuestions& questions) {
  const Choice choice = cheapest_for(ladder, questions.wanted, questions.wanted_error);
  const std::string wanted = fmt::format("Within {:g} %", 100 * questions.wanted_error);
  if (std::isfinite(choice.spacing_m))
    return fmt::format("{}: {:.3g} m{}, about {} of one core a member (largest: {}, {}).", wanted,
                       choice.spacing_m,
                       choice.coarsest ? " or coarser (the coarsest that was computed)" : "",
                       duration_text(choice.member_cpu_s), plain(choice.predicted.of),
                       share_text(choice.predicted.error));
  if (std::isfinite(choice.finer_spacing_m))
    return fmt::format(
        "{}: finer than was computed; about {:.2g} m, {} of one core a member (extrapolated; at "
        "the "
        "finest {} is {} off).",
        wanted, choice.finer_spacing_m, duration_text(ladder.seconds.at(choice.finer_spacing_m)),
        plain(choice.predicted.of), share_text(choice.predicted.error));
  if (choice.predicted.of.empty())
    return fmt::format("{}: nothing of what was asked for is told.", wanted);
  if (std::isnan(choice.predicted.error))
    return fmt::format("{}: not told, as the error of {} is not known.", wanted,
                       plain(choice.predicted.of));
  return fmt::format(
      "{}: not at these spacings ({} is {} off at the finest), nor at an eighth of the finest. Add "
      "finer ones, or ask for less.",
      wanted, plain(choice.predicted.of), share_text(choice.predicted.error));
}

std::string split_text(const Split& s) {
  return fmt::format("{:.0f} members at {:.3g} m are {} off (resolution {}, sampling {})",
                     s.members, s.spacing_m, share_text(s.error), share_text(s.resolution),
                     share_text(s.sampling));
}

void add_split(const CostStudy& study, const LadderAccuracy& ladder, const CostQuestions& questions,
               std::vector<std::string>& lines) {
  const double core_s = core_seconds(study, ladder, questions);
  const Split best = best_split(ladder, core_s, questions.wanted);
  if (!std::isfinite(best.error)) return;
  std::string text = fmt::format(
      "Best for {} of one core{}, over {}: {}", duration_text(core_s),
      questions.core_s > 0 ? std::string()
                           : fmt::format(" ({} at the finest spacing)", planned_text(study)),
      plain(best.of), split_text(best));
  if (best.coarsest) text += "; that is the coarsest computed, coarser may be better";
  if (best.finest) text += "; that is the finest computed, finer may be better";
  const Split finest = split_at(ladder, core_s, ladder.spacings_m.back(), questions.wanted);
  if (std::isfinite(finest.error) && finest.error > 1.1 * best.error)
    text += "; against that, " + split_text(finest);
  lines.push_back(text + ".");
}

}  // namespace

std::string share_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100 * share) : "unknown";
}

std::string planned_text(const CostStudy& study) {
  return study.planned_given
             ? fmt::format("{} planned members", study.planned_members)
             : fmt::format("as many members as the study has, {} (ensemble.members is not given),",
                           study.planned_members);
}

std::vector<std::string> ladder_sentences(const CostStudy& study, std::size_t i,
                                          const CostQuestions& questions) {
  const LadderAccuracy& ladder = study.ladders[i];
  std::vector<std::string> lines;
  lines.push_back(choice_sentence(ladder, questions));
  add_split(study, ladder, questions, lines);
  if (!ladder.checked.empty()) lines.push_back(check_sentence(ladder, questions));
  add_notes(ladder, lines);
  return lines;
}

std::string name_of(const CheckedError& c) {
  return c.name == map_word ? fmt::format("map > {:g} m", c.threshold_m) : c.name;
}

double checked_spacing(const LadderAccuracy& ladder, const CostQuestions& questions) {
  const Choice choice = cheapest_for(ladder, questions.wanted, questions.wanted_error);
  for (const double d : ladder.spacings_m)
    if (d <= choice.spacing_m * (1 + 1e-9)) return d;
  return ladder.spacings_m.back();
}

std::string check_sentence(const LadderAccuracy& ladder, const CostQuestions& questions) {
  const double where = checked_spacing(ladder, questions);
  std::int64_t met = 0, of = 0, all_met = 0, all = 0;
  for (const CheckedError& c : ladder.checked) {
    if (!c.is_told()) continue;
    all_met += c.is_met();
    ++all;
    if (c.spacing_m != where) continue;
    met += c.is_met();
    ++of;
  }
  return fmt::format(
      "Checked by members at {:g} m that no estimate knew: at {:g} m {} of {} differences were "
      "predicted to a factor of two, at all spacings {} of {}.",
      ladder.held_out_m, where, met, of, all_met, all);
}

std::string multilevel_sentence(const MultilevelForecast& f) {
  std::string with;
  for (std::size_t i = 1; i < f.gain.levels.size(); ++i)
    with += fmt::format("{}{:.3g} of {}", i > 1 ? " and " : "", f.gain.members[i],
                        plain_level(f.levels[f.gain.levels[i]]));
  const std::string what = fmt::format("Forecast of a multilevel estimate of {}", plain(f.results));
  if (with.empty())
    return fmt::format(
        "{}: cheaper members would not help those of {}, their correlation is too "
        "low for what they cost.",
        what, plain_level(f.levels.front()));
  return fmt::format(
      "{}: {} beside each member of {} give the same sampling error for 1/{:.3g} of "
      "the seconds (90 %: 1/{:.3g} to 1/{:.3g}).",
      what, with, plain_level(f.levels.front()), f.gain.gain, f.gain.gain_90.low,
      f.gain.gain_90.high);
}

std::string title_of(const ModelDifference& m) {
  return fmt::format("{} less {}, each at its finest, with the same values", m.to, m.from);
}

std::string title_of(const VariantCost& v) {
  return fmt::format("{} in {} at {:g} m: {:.2f} times the seconds", v.variant, v.formulation,
                     v.spacing_m, v.seconds_ratio);
}

}  // namespace sturz::workflow
