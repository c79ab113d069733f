// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/verdict.hpp"

#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/score_text.hpp"
#include "ensemble/workflow/folder/stop_rule_json.hpp"
#include "ensemble/workflow/readable.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <system_error>

namespace sturz::app {
namespace {

nlohmann::json phase_json(const CensoringReport::OfPhase& p) {
  return {{"members", p.censored},
          {"left_terrain", p.left},
          {"largest_lost_fraction", p.largest_lost_fraction}};
}

nlohmann::json censoring_json(const CensoringReport& r) {
  nlohmann::json all{{"members", r.censored()},
                     {"fraction", r.fraction()},
                     {"settled", r.settled},
                     {"out_of_time", r.still_moving},
                     {"left_terrain", r.left_terrain},
                     {"left_and_moving", r.left_and_moving},
                     {"largest_lost_fraction", r.largest_lost_fraction},
                     {"where", r.where},
                     {"max_censored_fraction", r.accepted_fraction},
                     {"too_many", r.too_many()}};
  if (r.phases) all["grains"] = phase_json(r.grains), all["liquid"] = phase_json(r.liquid);
  return all;
}

/// The best three, with all that they are compared by.
nlohmann::json nearest_json(const workflow::MapsMade& made) {
  nlohmann::json members = nlohmann::json::array();
  for (const std::size_t row : best_rows(*made.scores)) {
    if (members.size() == 3) break;
    nlohmann::json member = score_json(*made.scores, row);
    member["member"] = made.numbers[row];
    members.push_back(std::move(member));
  }
  return members;
}

void tell_stop(const StopRecord& stop, Console& console) {
  const std::string text = stop_text(stop);
  if (stop.reached())
    return console.say(fmt::format("Sure enough after {} members: {}.", stop.last.n_members, text));
  console.warn(fmt::format(
      "not as sure as was asked for: {}. {}", text,
      stop.last.found.n_valid > 0
          ? fmt::format("The same command with a larger --at-most goes on; {} is certain from {} "
                        "valid members on{}.",
                        stop.wanted_half_width, certain_count(stop.wanted_half_width),
                        stop.asset.empty() ? "" : ", of which none is cut off before it hits")
          : "No member is valid."));
}

std::string done_event(const workflow::MapsMade& made) {
  nlohmann::json event{{"event", "done"},
                       {"planned", made.planned},
                       {"finished", made.finished},
                       {"valid", made.valid},
                       {"failed", made.failed()},
                       {"censoring", censoring_json(made.censoring)},
                       {"members_with_warnings", made.warned_members},
                       {"hazard_hash", made.hazard_hash},
                       {"folder", made.folder.root.string()}};
  if (made.scores) event["nearest"] = nearest_json(made);
  if (made.stop) event["stop_rule"] = workflow::stop_json(*made.stop);
  return json_text(event);
}

/// What is cut off, and what the members themselves warn of: most of it once, with counts.
void warn_of_members(const CensoringReport& censoring, const std::vector<MemberWarning>& warnings,
                     std::int64_t members, Console& console) {
  std::string cut;
  for (const std::string& sentence : censoring_sentences(censoring))
    cut += (cut.empty() ? "" : " ") + sentence;
  if (!cut.empty() && censoring.too_many()) console.warn(cut);
  if (!cut.empty() && !censoring.too_many()) console.note(cut);
  for (const MemberWarning& w : warnings)
    console.warn(fmt::format("{} of {} members: {}", w.count, members, w.text));
}

}  // namespace

void list_maps(const workflow::OutputFolder& folder, Console& console) {
  std::error_code ignored;
  const bool gis = std::filesystem::exists(folder.project(), ignored);
  console.say(gis ? "  hazard.nc     all maps with their CRS; hazard/*.tif the same for GIS"
                  : "  hazard.nc     all maps with their CRS; hazard.gis_files is false");
  if (gis) console.say("  hazard.qgz    QGIS project over all of it; hazard.gpkg outlines");
}

namespace {

/// What was made, and what each file is for.
void list_files(const workflow::OutputFolder& folder, Console& console) {
  console.say("  report.html   look here first");
  list_maps(folder, console);
  console.say("  members.csv   one row per member");
  std::error_code ignored;
  if (std::filesystem::exists(folder.assets_csv(), ignored))
    console.say("  assets.csv    one row per asset; assets.gpkg the same for GIS");
  if (std::filesystem::exists(folder.gauges_csv(), ignored))
    console.say("  gauges.csv    arrivals and peaks at gauges; gauge_series.csv over time");
}

}  // namespace

int verdict(const workflow::MapsMade& made, Console& console) {
  const std::string folder = made.folder.root.string();
  console.clear_progress();
  console.note(fmt::format("maps of {} valid members in {}, hash {}", made.valid,
                           workflow::duration_text(made.seconds), made.hazard_hash));
  console.say(fmt::format("{} of {} members are valid{}. Results are in {}:", made.valid,
                          made.planned, made.valid > 0 ? ": " + counts_text(made.censoring) : "",
                          folder));
  list_files(made.folder, console);
  if (made.scores)
    if (const std::string near = nearest_text(*made.scores, made.numbers); !near.empty())
      console.say("  " + near);
  if (made.stop) tell_stop(*made.stop, console);
  warn_of_members(made.censoring, made.warnings, made.finished, console);
  const bool too_many = made.too_many_failed();
  if (made.failed() > 0 && made.valid > 0 && !too_many)
    console.warn(
        fmt::format("{} of {} members failed; their reasons are in members.csv. The maps "
                    "are made from the others.",
                    made.failed(), made.finished));
  if (made.valid == 0)
    console.error(
        fmt::format("no member is valid, so the maps are empty: {} of {} failed. Their reasons are "
                    "in members.csv; --retry-failed computes them again once the cause is mended.",
                    made.failed(), made.finished));
  else if (too_many)
    console.error(
        fmt::format("{} of {} members failed, more than the accepted share "
                    "(ensemble.max_failed_fraction = {}). Their reasons are in "
                    "members.csv; the maps are made from the others.",
                    made.failed(), made.finished, made.max_failed_fraction));
  console.event(done_event(made));  // the last line, so that a reader may stop there
  return too_many || made.valid == 0 ? too_many_failed : ok;
}

int shard_verdict(const workflow::EnsembleJob& job, const workflow::MembersRun& run,
                  const std::string& shard, Console& console) {
  const CensoringReport censoring =
      censoring_report(run.computed, job.scene.scenario.ensemble.max_censored_fraction);
  const auto n = static_cast<std::int64_t>(run.computed.size());
  std::string counts = n == 0 ? "nothing was left to do" : fmt::format("{} members computed", n);
  if (censoring.valid > 0) counts += ": " + counts_text(censoring);
  if (!run.failed.empty()) counts += fmt::format("; {} failed", run.failed.size());
  console.say(fmt::format("Shard {} is finished ({}). When all are: sturz merge {}", shard, counts,
                          job.folder.root.string()));
  warn_of_members(censoring, member_warnings(run.computed, job.scene.description.warnings), n,
                  console);
  if (!run.failed.empty())
    console.warn(
        fmt::format("{} of {} members failed, the first of them {} ({}). They count "
                    "against ensemble.max_failed_fraction when the maps are made.",
                    run.failed.size(), n, run.failed.front().member, run.failed.front().reason));
  console.event(json_text(nlohmann::json{{"event", "shard_done"},
                                         {"computed", n},
                                         {"valid", censoring.valid},
                                         {"failed", run.failed.size()},
                                         {"censoring", censoring_json(censoring)}}));
  return ok;
}

}  // namespace sturz::app
