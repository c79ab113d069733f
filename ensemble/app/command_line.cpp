// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/command_line.hpp"

#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/help/hint.hpp"
#include "ensemble/workflow/version.hpp"

#include <fmt/core.h>

#include <exception>
#include <new>
#include <string_view>

namespace sturz::app {
namespace {

using workflow::build_type;
using workflow::compiler;
using workflow::git_commit;
using workflow::version;

/// Every sub-command with its options. Help, manual page and completion walk it.
void build(Grammar& grammar) {
  CLI::App& program = grammar.program;
  program.set_version_flag(
      "--version", fmt::format("sturz {} ({}, {}, {})", version, git_commit, compiler, build_type));
  program.require_subcommand(1);
  program.get_formatter()->column_width(34);
  program.footer(
      "Exit codes: 0 done, 1 usage or scenario error, 2 too many failed members, "
      "3 interrupted (resumable).");
  for (const auto add : sub_commands) add(grammar);
}

/// Runs the action; turns whatever it throws into one message and an exit code.
int guarded(const std::function<int(Console&)>& action, Console& console) {
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

/// `sturz help` and `sturz help run`, as many other programs have it.
bool wants_help(const Grammar& grammar, int argc, char** argv) {
  if (argc < 2 || std::string_view(argv[1]) != "help") return false;
  const CLI::App* about = &grammar.program;
  if (argc > 2)
    if (const CLI::App* named = command_named(grammar.program, argv[2])) about = named;
  fmt::print("{}", about->help());
  return true;
}

}  // namespace

int command_line(int argc, char** argv) {
  Grammar grammar;
  build(grammar);
  if (wants_help(grammar, argc, argv)) return ok;
  try {
    grammar.program.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (grammar.program.exit(problem) == 0) return ok;
    const std::string hint = hint_on_words(grammar.program, {argv + 1, argv + argc});
    if (!hint.empty()) fmt::print(stderr, "{}\n", hint);
    return usage_or_scenario_error;
  }
  Console console(grammar.json);
  return guarded(grammar.action, console);
}

}  // namespace sturz::app
