// SPDX-License-Identifier: Apache-2.0
// sturz calibrate: an ensemble, what was observed, and what is then known of the uncertain values.
#include "ensemble/workflow/calibration/calibrate.hpp"

#include "engine/core/cancel.hpp"
#include "engine/core/error.hpp"
#include "ensemble/app/back_analysis/calibration_text.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/speed_cache.hpp"
#include "ensemble/workflow/calibration/posterior_files.hpp"
#include "ensemble/workflow/calibration/shared_events.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/results/maps.hpp"
#include "ensemble/workflow/results/report_page.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace sturz::app {
namespace {

struct Options {
  std::vector<std::string> inputs;  ///< a scenario, or folders of finished ensembles
  std::vector<std::string> set;
  MembersOptions of;
  std::string method;  ///< empty: by the number of members
  double discrepancy = default_discrepancy;
  int active = 0;
  int active_members = 0;
  bool no_check = false;
};

std::string command_text(const Options& o) {
  std::string text = "calibrate " + o.inputs.front();
  for (const std::string& set : o.set) text += " --set " + set;
  if (o.of.members > 0) text += fmt::format(" -n {}", o.of.members);
  if (!o.method.empty()) text += " --method " + o.method;
  if (o.discrepancy != default_discrepancy) text += fmt::format(" --discrepancy {}", o.discrepancy);
  if (o.active > 0) text += fmt::format(" --active {}", o.active);
  return text;
}

std::optional<PosteriorMethod> method_of(const Options& o) {
  if (o.method.empty()) return std::nullopt;
  return o.method == "weights" ? PosteriorMethod::weights : PosteriorMethod::emulator;
}

workflow::CalibrateRequest request_of(const Options& o) {
  workflow::CalibrateRequest request;
  request.ensemble.scene = {o.inputs.front(), o.set, speed_cache()};
  if (o.of.members > 0)
    request.ensemble.scene.overrides.push_back(fmt::format("ensemble.members={}", o.of.members));
  request.ensemble.folder =
      o.of.out.empty() ? workflow::default_folder(o.inputs.front()) : o.of.out;
  request.ensemble.workers = o.of.workers;
  request.ensemble.command = command_text(o);
  request.method = method_of(o);
  request.discrepancy = o.discrepancy;
  request.active_rounds = o.active;
  request.active_members = o.active_members;
  request.check_best = !o.no_check;
  return request;
}

void tell(const workflow::Calibrated& c, const std::string& folder, bool has_page,
          Console& console) {
  for (const std::string& line : calibration_lines(c, console.said_columns())) console.say(line);
  console.say("In " + folder + ":");
  if (has_page) console.say("  report.html     with what the observations tell");
  console.say("  posterior.csv   equal rows, for `sturz ensemble --posterior`");
  console.say("  posterior.json  every number");
  for (const std::string& warning : c.found.warnings) console.warn(warning);
  auto event = nlohmann::ordered_json::parse(workflow::posterior_json(c));
  nlohmann::ordered_json done{{"event", "done"}, {"folder", folder}};
  done.update(event);
  console.event(json_text(done));  // the last line, so that a reader may stop there
}

struct Computed {
  workflow::Calibrated found;
  bool too_many_failed = false;
};

/// Members, maps, posterior and its files.
Computed compute(const Options& options, const workflow::CalibrateRequest& request,
                 ConsoleObserver& observer, Console& console) {
  workflow::EnsembleJob job = workflow::prepare_calibration(request, observer);
  console.event(json_text(nlohmann::ordered_json{{"event", "start"},
                                                 {"folder", job.folder.root.string()},
                                                 {"members", job.design.n_members()},
                                                 {"finished_before", job.finished_before},
                                                 {"to_do", job.to_do.size()},
                                                 {"workers", job.workers},
                                                 {"threads_per_member", job.threads}}));
  for (const std::string& warning : job.scene.description.warnings) console.warn(warning);
  console.note(command_text(options));
  console.say(
      fmt::format("{} members, {} finished before", job.design.n_members(), job.finished_before));
  const workflow::MembersRun run = workflow::run_ensemble(job, observer, interrupt_flag());
  console.clear_progress();
  require(run.stop_error.empty(), run.stop_error);
  if (run.interrupted) throw Cancelled();
  const workflow::MapsMade maps = workflow::make_maps(job, observer, interrupt_flag());
  if (maps.failed() > 0)
    console.warn(
        fmt::format("{} of {} members failed and say nothing of the uncertain values; "
                    "their reasons are in members.csv.",
                    maps.failed(), maps.finished));
  Computed c{workflow::calibrate_ensemble(request, job, maps, observer, interrupt_flag()),
             maps.too_many_failed()};
  workflow::write_posterior(job.folder, c.found);
  console.clear_progress();
  return c;
}

std::string first_file(const std::vector<std::string>& inputs) {
  const auto found = std::find_if(inputs.begin(), inputs.end(), [](const std::string& input) {
    return !std::filesystem::is_directory(input);
  });
  return found == inputs.end() ? "" : *found;
}

bool all_folders(const std::vector<std::string>& inputs) { return first_file(inputs).empty(); }

/// What finished ensembles tell, together where there are several.
int calibrate_finished(const Options& o, Console& console) {
  require(o.set.empty() && o.of.members == 0 && o.active == 0 && o.active_members == 0 &&
              o.of.workers == 0,
          "calibrate with folders computes no members (--set, --members, --workers and --active "
          "belong to a scenario). Leave them out, or name the scenario.");
  ConsoleObserver observer(console);
  const workflow::EventsRequest request{
      {o.inputs.begin(), o.inputs.end()}, o.of.out, method_of(o), o.discrepancy};
  const workflow::Calibrated found =
      workflow::calibrate_events(request, observer, interrupt_flag());
  const std::string folder = o.of.out.empty() ? o.inputs.front() : o.of.out;
  if (o.of.out.empty()) workflow::rewrite_page(folder, observer, interrupt_flag());
  console.clear_progress();
  tell(found, folder, o.of.out.empty(), console);
  return ok;
}

int calibrate(const Options& options, Console& console) {
  if (all_folders(options.inputs)) return calibrate_finished(options, console);
  require(options.inputs.size() == 1,
          fmt::format("calibrate takes one scenario, or folders of finished ensembles ({} is no "
                      "folder). Compute each event with `sturz ensemble` first.",
                      first_file(options.inputs)));
  ConsoleObserver observer(console);
  const workflow::CalibrateRequest request = request_of(options);
  // The job and its lock are gone when the page takes the folder's.
  const Computed c = compute(options, request, observer, console);
  workflow::rewrite_page(request.ensemble.folder, observer, interrupt_flag());
  tell(c.found, request.ensemble.folder.string(), true, console);
  return c.too_many_failed ? too_many_failed : ok;
}

}  // namespace

void add_calibrate(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "calibrate",
      "Compute an ensemble and what the observations say of its uncertain values", calibrate);
  parser
      .add_option(
          "scenario", options.inputs,
          "Scenario file (YAML), or folders of finished ensembles that share their uncertain "
          "values")
      ->type_name("SCENARIO")
      ->required();
  add_remote(parser);
  add_set(parser, options.set, "key=value: replaces one value of the scenario; may be repeated");
  add_members(parser, options.of);
  parser
      .add_option("--method", options.method,
                  "weights of the members, or chains on an emulator (default: emulator from ten "
                  "members per uncertain value on)")
      ->check(CLI::IsMember({"weights", "emulator"}));
  parser
      .add_option("--discrepancy", options.discrepancy,
                  "What the model cannot do, as a share of the observed value: scale of its prior; "
                  "0 for a perfect model")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  parser
      .add_option("--active", options.active,
                  "Rounds of more members where the emulator knows the posterior least")
      ->check(CLI::Range(1, 1000));
  parser
      .add_option("--active-members", options.active_members,
                  "Members of a round (default: two per uncertain value, four at least)")
      ->check(CLI::Range(1, 1000));
  parser.add_flag("--no-check", options.no_check, "Do not compute the member at the best fit");
  add_json(grammar, parser);
}

}  // namespace sturz::app
