// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/fidelity/cost_files.hpp"

#include "ensemble/workflow/fidelity/cost_words.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/results/json_numbers.hpp"
#include "io/files/text_files.hpp"
#include "reports/fidelity/cost_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {
namespace {

constexpr double half_90 = 1.6448536269514722;  // standard errors of a normal mean

Json errors_json(const ErrorCurve& curve, const std::vector<double>& spacings_m) {
  Json all = Json::array();
  for (const double d : spacings_m) all.push_back(number(curve.at(d)));
  return all;
}

Json result_json(const ResultAccuracy& r) {
  const Refinement& f = r.refinement;
  return {{"name", r.name},
          {"units", r.units},
          {"members", r.n_members},
          {"means", numbers(f.means)},
          {"converges", f.converges},
          {"order", number(f.order)},
          {"order_90", interval(f.order_90)},
          {"limit", number(f.limit)},
          {"limit_90", interval(f.limit_90)},
          {"resampled_converging", f.resampled_converging},
          {"mean_errors", errors_json(r.mean_errors, f.spacings_m)},
          {"member_errors", errors_json(r.member_errors, f.spacings_m)},
          {"member_rms_to_finest", numbers(r.member_rms)},
          {"spread", number(r.spread)},
          {"noise_of_a_member", number(r.noise)}};
}

Json map_json(const MapAccuracy& map, const std::vector<double>& spacings_m) {
  Json distances = Json::array();
  for (const MapDistance& d : map.distances)
    distances.push_back({{"area_between_m2", d.area_between_m2},
                         {"mean_area_m2", d.mean_area_m2},
                         {"worst_cell", d.worst_cell},
                         {"boundary_m", number(d.boundary_m)}});
  return {{"threshold_m", map.threshold_m},
          {"to_finest", distances},
          {"relative_errors", errors_json(map.errors, spacings_m)},
          {"noise", number(map.noise)}};
}

Json checked_json(const CheckedError& c) {
  return {{"name", name_of(c)},
          {"spacing_m", c.spacing_m},
          {"said", number(c.said)},
          {"found", number(c.found)},
          {"said_mean", number(c.said_mean)},
          {"found_mean", number(c.found_mean)},
          {"noise", number(c.noise)},
          {"met", c.is_told() ? Json(c.is_met()) : Json()}};
}

Json split_json(const Split& s) {
  return {{"spacing_m", number(s.spacing_m)}, {"members", number(s.members)},
          {"error", number(s.error)},         {"resolution", number(s.resolution)},
          {"sampling", number(s.sampling)},   {"of", s.of},
          {"coarsest_computed", s.coarsest},  {"finest_computed", s.finest}};
}

Json choice_json(const Choice& c) {
  return {{"spacing_m", number(c.spacing_m)},   {"member_cpu_s", number(c.member_cpu_s)},
          {"error", number(c.predicted.error)}, {"bound_by", c.predicted.of},
          {"coarsest_computed", c.coarsest},    {"finer_spacing_m", number(c.finer_spacing_m)}};
}

Json changes_json(const std::vector<Change>& changes) {
  Json all = Json::array();
  for (const Change& c : changes)
    all.push_back({{"name", c.name},
                   {"units", c.units},
                   {"change", number(c.mean)},
                   {"standard_error", number(c.standard_error)},
                   {"from", number(c.rung_mean)},
                   {"members", c.n_members}});
  return all;
}

Json certainty_json(const std::vector<Certainty>& all) {
  Json list = Json::array();
  for (const Certainty& c : all)
    list.push_back({{"name", c.result},
                    {"sampling_90", number(c.sampling)},
                    {"resolution", number(c.resolution)},
                    {"model", number(c.model)}});
  return list;
}

Json ladder_json(const CostStudy& study, std::size_t i, const CostQuestions& questions) {
  const LadderAccuracy& ladder = study.ladders[i];
  const double core_s = core_seconds(study, ladder, questions);
  const Choice choice = cheapest_for(ladder, questions.wanted, questions.wanted_error);
  Json json{{"formulation", ladder.formulation},
            {"members_used", ladder.members.size()},
            {"spacings_m", ladder.spacings_m},
            {"member_cpu_s", ladder.member_cpu_s},
            {"seconds_factor", number(ladder.seconds.factor)},
            {"seconds_exponent", number(ladder.seconds.exponent)},
            {"seconds_fit_worst_ratio", number(ladder.seconds.worst_ratio)},
            {"results", Json::array()},
            {"not_told", ladder.not_told},
            {"maps", Json::array()},
            {"checked", Json::array()}};
  for (const CheckedError& c : ladder.checked) json["checked"].push_back(checked_json(c));
  for (const ResultAccuracy& r : ladder.results) json["results"].push_back(result_json(r));
  for (const MapAccuracy& map : ladder.maps)
    json["maps"].push_back(map_json(map, ladder.spacings_m));
  json["cheapest"] = choice_json(choice);
  json["core_s"] = core_s;
  json["best_split"] = split_json(best_split(ladder, core_s, questions.wanted));
  json["at_finest"] =
      split_json(split_at(ladder, core_s, ladder.spacings_m.back(), questions.wanted));
  json["certainty_at_finest"] =
      certainty_json(certainty_at(study, i, ladder.spacings_m.back(), study.planned_members));
  return json;
}

Json multilevel_json(const MultilevelForecast& f) {
  Json results = Json::array();
  for (std::size_t r = 0; r < f.results.size(); ++r)
    results.push_back({{"name", f.results[r]},
                       {"squared_correlations", numbers(f.squared_correlations[r])},
                       {"gain", number(f.gain.gains[r])}});
  Json used = Json::array();
  for (std::size_t i = 0; i < f.gain.levels.size(); ++i)
    used.push_back({{"name", f.levels[f.gain.levels[i]]}, {"members", number(f.gain.members[i])}});
  return {{"levels", f.levels}, {"member_cpu_s", f.cost_s}, {"results", results},
          {"used", used},       {"gain", f.gain.gain},      {"gain_90", interval(f.gain.gain_90)}};
}

std::string csv_of(const CostStudy& study) {
  std::string text =
      "formulation,spacing_m,member_cpu_s,result,units,mean,member_error,mean_error,"
      "member_rms_to_finest,members\n";
  const auto cell = [](double v) {
    return std::isfinite(v) ? fmt::format("{}", v) : std::string();
  };
  for (const LadderAccuracy& ladder : study.ladders)
    for (std::size_t l = 0; l < ladder.spacings_m.size(); ++l)
      for (const ResultAccuracy& r : ladder.results)
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", ladder.formulation,
                            ladder.spacings_m[l], ladder.member_cpu_s[l], r.name, r.units,
                            cell(r.refinement.means[l]), cell(r.member_error(ladder.spacings_m[l])),
                            cell(r.mean_error(ladder.spacings_m[l])), cell(r.member_rms[l]),
                            r.n_members);
  return text;
}

std::string page_of(const CostStudy& study, const CostQuestions& questions) {
  CostPage page;
  page.title = study.title.empty() ? study.folder.filename().string() : study.title;
  page.when = utc_now();
  page.program = build_text(this_build());
  page.planned = planned_text(study);
  page.wanted_error = questions.wanted_error;
  page.warnings = study.warnings;
  for (std::size_t i = 0; i < study.ladders.size(); ++i) {
    CostPageLadder& ladder = page.ladders.emplace_back();
    ladder.ladder = &study.ladders[i];
    ladder.sentences = ladder_sentences(study, i, questions);
    for (const Certainty& c :
         certainty_at(study, i, study.ladders[i].spacings_m.back(), study.planned_members))
      ladder.parts.push_back({c.result, c.sampling, c.resolution, c.model});
  }
  for (const MultilevelForecast& f : study.multilevel)
    page.multilevel.push_back(multilevel_sentence(f));
  for (const ModelDifference& m : study.models) page.changes.push_back({title_of(m), m.changes});
  for (const VariantCost& v : study.variants) page.changes.push_back({title_of(v), v.changes});
  return make_cost_page(page);
}

}  // namespace

double core_seconds(const CostStudy& study, const LadderAccuracy& ladder,
                    const CostQuestions& questions) {
  return questions.core_s > 0 ? questions.core_s
                              : study.planned_members * ladder.member_cpu_s.back();
}

std::vector<Certainty> certainty_at(const CostStudy& study, std::size_t ladder, double spacing_m,
                                    double members) {
  std::vector<Certainty> all;
  for (const ResultAccuracy& r : study.ladders[ladder].results) {
    Certainty c;
    c.result = r.name;
    c.sampling = half_90 * r.spread / r.scale() / std::sqrt(members);
    c.resolution = r.mean_error(spacing_m);
    for (const ModelDifference& model : study.models) {
      const std::string& mine = study.ladders[ladder].formulation;
      if (model.from != mine && model.to != mine) continue;
      for (const Change& change : model.changes)
        if (change.name == r.name && !(std::abs(change.mean) / r.scale() <= c.model))
          c.model = std::abs(change.mean) / r.scale();
    }
    all.push_back(std::move(c));
  }
  return all;
}

std::string cost_json_text(const CostStudy& study, const CostQuestions& questions) {
  Json json{{"members_per_spacing", study.members},
            {"planned_members", study.planned_members},
            {"planned_members_given", study.planned_given},
            {"wanted_error", questions.wanted_error},
            {"wanted", questions.wanted},
            {"ladders", Json::array()},
            {"variants", Json::array()},
            {"models", Json::array()},
            {"warnings", study.warnings}};
  for (std::size_t i = 0; i < study.ladders.size(); ++i)
    json["ladders"].push_back(ladder_json(study, i, questions));
  for (const VariantCost& v : study.variants)
    json["variants"].push_back({{"set", v.variant},
                                {"formulation", v.formulation},
                                {"spacing_m", v.spacing_m},
                                {"seconds_ratio", number(v.seconds_ratio)},
                                {"changes", changes_json(v.changes)}});
  for (const ModelDifference& m : study.models)
    json["models"].push_back(
        {{"from", m.from}, {"to", m.to}, {"changes", changes_json(m.changes)}});
  json["multilevel"] = Json::array();
  for (const MultilevelForecast& f : study.multilevel)
    json["multilevel"].push_back(multilevel_json(f));
  return json.dump(2) + "\n";
}

void write_cost_files(const CostStudy& study, const CostQuestions& questions) {
  write_text_atomic(study.folder / "cost.json", cost_json_text(study, questions));
  write_text_atomic(study.folder / "cost.csv", csv_of(study));
  write_text_atomic(study.folder / "cost.html", page_of(study, questions));
}

}  // namespace sturz::workflow
