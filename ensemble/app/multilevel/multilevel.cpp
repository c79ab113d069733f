// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/multilevel/multilevel.hpp"

#include "engine/core/error.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/workflow/multilevel/multilevel_results.hpp"
#include "ensemble/workflow/multilevel/multilevel_words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace sturz::app {
namespace {

using Json = nlohmann::ordered_json;
using workflow::MultilevelJob;
using workflow::MultilevelLook;
using workflow::MultilevelMade;

class Decisions final : public workflow::PlanListener {
 public:
  explicit Decisions(Console& console) : console_(console) {}
  void decided(const MultilevelJob& job, const MultilevelLook& look) override {
    console_.clear_progress();
    if (look.rounds.size() == 1)
      for (const std::string& line : workflow::pilot_lines(job, look)) console_.say(line);
    const std::string text = workflow::round_text(job, look);
    console_.say(text);
    console_.event(json_text(Json{{"event", "decided"},
                                  {"round", look.rounds.size()},
                                  {"members", look.rounds.back().members},
                                  {"words", text}}));
  }

 private:
  Console& console_;
};

void require_usable(const workflow::EnsembleRequest& request) {
  const auto refuse = [](bool given, const char* option, const char* why) {
    require(!given,
            fmt::format("{} with ensemble.estimator: multilevel ({}). Leave it away, or use "
                        "--set ensemble.estimator=plain.",
                        option, why));
  };
  refuse(request.shard.n > 1, "--shard", "numbers of members are chosen from all of them");
  refuse(request.until_half_width.has_value(), "--until-converged",
         "ensemble.target says what is to be reached");
  refuse(!request.posterior.empty(), "--posterior", "levels draw anew from the distributions");
  refuse(request.members > 0, "-n", "numbers of members follow from ensemble.target");
}

int verdict(const MultilevelMade& made, Console& console) {
  for (const std::string& cut : made.cut_off) console.warn(cut);
  for (const std::string& line : workflow::result_lines(made)) console.say(line);
  for (const std::string& warning : made.warnings) console.warn(warning);
  const bool too_many = made.too_many_failed();
  if (too_many)
    console.error(
        fmt::format("more members of a level failed than the accepted share "
                    "(ensemble.max_failed_fraction = {}). `sturz merge {}/levels/NAME` writes "
                    "members.csv with their reasons; the results are of the others.",
                    made.max_failed_fraction, made.folder.string()));
  console.say("In " + made.folder.string() +
              ": report.html (look here first), multilevel.json, hazard.nc and hazard/*.tif, " +
              (made.assets == nullptr ? "" : "assets.csv and assets.gpkg, ") +
              "and an ensemble per level in levels/");
  Json done{{"event", "done"}, {"folder", made.folder.string()}};
  done["multilevel"] = Json::parse(workflow::multilevel_json_text(made));
  console.event(json_text(done));
  return too_many ? too_many_failed : ok;
}

}  // namespace

int multilevel_ensemble(const workflow::EnsembleRequest& request, Console& console) {
  require_usable(request);
  ConsoleObserver observer(console);
  MultilevelJob job = workflow::prepare_multilevel(request, observer);
  std::string names;
  for (const workflow::LevelPart& part : job.parts)
    names += (names.empty() ? "" : ", ") + part.name;
  console.say(fmt::format("Multilevel: {} members of each of {}, then as many as are best",
                          job.plan.pilot, names));
  console.event(json_text(Json{{"event", "start"},
                               {"folder", request.folder.string()},
                               {"levels", job.plan.levels},
                               {"pilot", job.plan.pilot}}));
  Decisions decisions(console);
  const workflow::MultilevelMembers found =
      workflow::run_multilevel(job, observer, decisions, interrupt_flag());
  console.clear_progress();
  const MultilevelMade made = workflow::look_at_members(job, found, interrupt_flag());
  workflow::write_multilevel_files(job, found, made, interrupt_flag());
  return verdict(made, console);
}

}  // namespace sturz::app
