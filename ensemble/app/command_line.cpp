// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/command_line.hpp"

#include "engine/core/error.hpp"
#include "ensemble/app/cases.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/help/bash_completion.hpp"
#include "ensemble/app/help/man_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "scenarios/shapes/synthetic_terrain.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <new>
#include <string>

namespace sturz::app {
namespace {

using workflow::build_type;
using workflow::compiler;
using workflow::git_commit;
using workflow::version;

using Action = std::function<int(Console&)>;

/// Everything the parser fills in; lives as long as the parser.
struct ParsedOptions {
  RunOptions run;
  EnsembleOptions ensemble;
  MergeOptions merge;
  DescribeOptions describe;
  TerrainOptions terrain;
  SchemaOptions schema;
  ReportOptions report;
  CasesOptions cases;
  std::string help_format, help_out;
  bool json = false;
  Action action;
};

/// A sub-command that calls `function` with its options.
template <class Options>
CLI::App* add_command(CLI::App& app, ParsedOptions& parsed, const char* name, const char* help,
                      Options& options, int (*function)(const Options&, Console&)) {
  CLI::App* command = app.add_subcommand(name, help);
  command->callback([&parsed, &options, function] {
    parsed.action = [&options, function](Console& console) { return function(options, console); };
  });
  return command;
}

void add_scenario(CLI::App* command, std::string& scenario, std::vector<std::string>& set) {
  command->add_option("scenario", scenario, "Scenario file (YAML)")
      ->type_name("SCENARIO")
      ->required();
  command
      ->add_option("--set", set, "key=value: replaces one value of the scenario; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_json(CLI::App* command, bool& json, const char* help) {
  command->add_flag("--json", json, help);
}

void add_run(CLI::App& app, ParsedOptions& w) {
  auto* c = add_command(app, w, "run", "Compute one member: medians of all distributions", w.run,
                        &run_command);
  add_scenario(c, w.run.scenario, w.run.set);
  c->add_option("-o,--out", w.run.out, "Folder of the results (default: out/NAME_run)")
      ->type_name("DIR");
  c->add_option("--threads", w.run.threads, "Threads of this one member (default: all cores)")
      ->check(CLI::Range(1, 1024));
  c->add_option("--particles", w.run.particles_every_s,
                "Write particle frames for ParaView, this many simulated seconds apart")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
  add_json(c, w.json, "JSON lines instead of words");
}

void add_ensemble(CLI::App& app, ParsedOptions& w) {
  auto* c = add_command(app, w, "ensemble",
                        "Compute many members and the hazard maps; the same command resumes",
                        w.ensemble, &ensemble_command);
  add_scenario(c, w.ensemble.scenario, w.ensemble.set);
  c->add_option("-o,--out", w.ensemble.out, "Folder of the results (default: out/NAME)")
      ->type_name("DIR");
  c->add_option("-n,--members", w.ensemble.members, "Number of members, instead of the scenario's")
      ->check(CLI::Range(1, 100000000));
  c->add_option("--workers", w.ensemble.workers, "Members at a time (default: all cores)")
      ->check(CLI::Range(1, 4096));
  c->add_option("--shard", w.ensemble.shard,
                "Compute only part K of N of the members and no maps; `merge` makes them")
      ->type_name("K/N");
  c->add_flag("--retry-failed", w.ensemble.retry_failed,
              "Compute members again that failed, for instance at a wall-time limit");
  add_json(c, w.json, "JSON lines instead of words");
}

void add_others(CLI::App& app, ParsedOptions& w) {
  auto* m = add_command(app, w, "merge", "Make the maps from the members of a results folder",
                        w.merge, &merge_command);
  m->add_option("folder", w.merge.folder, "Folder of an ensemble")->type_name("DIR")->required();
  m->add_flag("--partial", w.merge.partial, "Go on although members are missing");
  add_json(m, w.json, "JSON lines instead of words");

  auto* d = add_command(app, w, "describe",
                        "Say what a scene is and how long it will take, without computing it",
                        w.describe, &describe_command);
  add_scenario(d, w.describe.scenario, w.describe.set);
  d->add_flag("--measure-again", w.describe.measure_again, "Measure this machine's speed anew");
  add_json(d, w.json, "One JSON object instead of words");

  auto* t = add_command(app, w, "terrain",
                        "Write the terrain and release of a synthetic shape or scenario as GeoTIFF",
                        w.terrain, &terrain_command);
  t->add_option("what", w.terrain.what, "Name of a shape, or a scenario file")
      ->type_name("SHAPE|SCENARIO")
      ->required();
  t->add_option("-o,--out", w.terrain.out, "Folder for the rasters")->type_name("DIR")->required();
  t->add_option("--cell", w.terrain.cell_size_m, "Cell size of a shape [m]")
      ->check(CLI::PositiveNumber);
  t->add_option("--set", w.terrain.set, "A shape's parameter=value, or a scenario's key=value")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_json(t, w.json, "JSON lines instead of words");

  auto* s = add_command(app, w, "schema", "Print the JSON Schema of scenario files, for editors",
                        w.schema, &schema_command);
  s->add_option("-o,--out", w.schema.out, "File instead of the screen")->type_name("FILE");

  auto* r = add_command(app, w, "report", "Write the report page of a results folder again",
                        w.report, &report_command);
  r->add_option("folder", w.report.folder, "Folder of an ensemble or a run")
      ->type_name("DIR")
      ->required();
  add_json(r, w.json, "JSON lines instead of words");

  auto* k = add_command(app, w, "cases", "List the shipped cases, or copy one to start from",
                        w.cases, &cases_command);
  k->add_option("name", w.cases.name, "Case to copy; without one they are listed")
      ->type_name("CASE");
  k->add_option("-o,--out", w.cases.out, "Folder of the copy (default: ./NAME)")->type_name("DIR");
  add_json(k, w.json, "JSON lines instead of words");
}

/// The table itself as manual page or completion: for the build, and so not in `--help`.
void add_print_help(CLI::App& app, ParsedOptions& w) {
  CLI::App* c = app.add_subcommand("print-help", "Print this program's help in another format");
  c->group("");
  c->add_option("format", w.help_format)->required()->check(CLI::IsMember({"man", "bash"}));
  c->add_option("-o,--out", w.help_out, "File instead of the screen");
  c->callback([&app, &w] {
    w.action = [&app, &w](Console& console) {
      const CommandTable table = command_table(app);
      const std::string text = w.help_format == "man" ? man_page(table, version)
                                                      : bash_completion(table, synthetic_shapes());
      if (w.help_out.empty())
        console.say(text);
      else
        write_text_atomic(w.help_out, text + "\n");
      return ok;
    };
  });
}

/// The grammar: every sub-command with its options. Help, manual page and completion walk it.
void build_grammar(CLI::App& app, ParsedOptions& parsed) {
  app.set_version_flag(
      "--version", fmt::format("sturz {} ({}, {}, {})", version, git_commit, compiler, build_type));
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer(
      "Exit codes: 0 done, 1 usage or scenario error, 2 too many failed members, "
      "3 interrupted (resumable).");
  add_run(app, parsed);
  add_ensemble(app, parsed);
  add_others(app, parsed);
  add_print_help(app, parsed);
}

/// Runs the action; turns whatever it throws into one message and an exit code.
int guarded(const Action& action, Console& console) {
  try {
    return action(console);
  } catch (const SetupError& problem) {
    console.error(problem.what());
  } catch (const std::bad_alloc&) {
    console.error("Out of memory. A coarser spacing, fewer workers or a larger cell needs less.");
  } catch (const std::exception& problem) {
    console.error(
        fmt::format("{} (this should not have happened; please report it)", problem.what()));
  }
  return usage_or_scenario_error;
}

}  // namespace

int command_line(int argc, char** argv) {
  CLI::App app{"sturz: from an elevation raster to a landslide hazard map", "sturz"};
  ParsedOptions parsed;
  build_grammar(app, parsed);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? ok : usage_or_scenario_error;
  }
  Console console(parsed.json);
  return guarded(parsed.action, console);
}

}  // namespace sturz::app
