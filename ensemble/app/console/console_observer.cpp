// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/console/console_observer.hpp"

#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/console/progress_bar.hpp"
#include "ensemble/workflow/folder/stop_rule_json.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace sturz::app {

void ConsoleObserver::warning(std::string_view text) { console_.warn(text); }

void ConsoleObserver::folder_ready(const workflow::OutputFolder& folder) {
  console_.log_to(folder.log().string());
}

void ConsoleObserver::run_progress(const Progress& progress) {
  console_.progress(member_bar(progress, console_.columns()));
}

void ConsoleObserver::ensemble_progress(const RunnerProgress& progress,
                                        std::int64_t finished_before) {
  console_.progress(ensemble_bar(progress, finished_before, console_.columns()));
}

void ConsoleObserver::source_member_stored(const std::string& source, const MemberResult& result) {
  console_.note(fmt::format("source {}, member {} {}{}{} ({:.1f} s)", source, result.member,
                            to_string(result.outcome), result.reason.empty() ? "" : ": ",
                            result.reason, result.scalars.wall_s));
  console_.event(json_text(nlohmann::json{{"event", "member"},
                                          {"source", source},
                                          {"member", result.member},
                                          {"outcome", to_string(result.outcome)},
                                          {"reason", result.reason},
                                          {"wall_s", result.scalars.wall_s}}));
}

void ConsoleObserver::member_stored(const MemberResult& result) {
  const MemberScalars& s = result.scalars;
  console_.note(fmt::format("member {} {}{}{} ({:.1f} s, front {:.0f} m)", result.member,
                            to_string(result.outcome), result.reason.empty() ? "" : ": ",
                            result.reason, s.wall_s, s.front_travel_m));
  console_.event(json_text(nlohmann::json{{"event", "member"},
                                          {"member", result.member},
                                          {"outcome", to_string(result.outcome)},
                                          {"censored", to_string(result.censoring)},
                                          {"reason", result.reason},
                                          {"wall_s", s.wall_s},
                                          {"front_travel_m", s.front_travel_m}}));
}

void ConsoleObserver::looked(const StopRecord& stop) {
  console_.note(stop_text(stop));
  nlohmann::json look = workflow::stop_json(stop);
  look.erase("looks");
  look["event"] = "look";
  look["look"] = stop.n_looks;
  console_.event(json_text(look));
}

void ConsoleObserver::maps_begin() { console_.progress("making maps ..."); }

}  // namespace sturz::app
