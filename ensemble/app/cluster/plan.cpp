// SPDX-License-Identifier: Apache-2.0
// sturz plan: into how many shards an ensemble is divided, and what each asks of a cluster.
#include "ensemble/app/cluster/plan_options.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/speed_cache.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"

#include <string>

namespace sturz::app {
namespace {

struct Options {
  PlanOptions plan;
};

int plan(const Options& options, Console& console) {
  workflow::EnsembleRequest request;
  request.scene = {options.plan.scenario, options.plan.set, speed_cache()};
  request.members = options.plan.members;
  const workflow::Scene scene = workflow::load_scene(workflow::scene_of(request));
  const workflow::ShardPlan made = workflow::plan_shards(scene, plan_request(options.plan));
  for (const std::string& line : workflow::plan_lines(made)) console.say(line);
  console.event(json_text(plan_json(made)));
  return ok;
}

}  // namespace

void add_plan(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "plan", "Say into how many shards to divide an ensemble, and what each needs", plan);
  add_plan_options(parser, options.plan);
  add_json(grammar, parser, "One JSON object instead of words");
}

}  // namespace sturz::app
