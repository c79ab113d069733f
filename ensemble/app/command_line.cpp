// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/command_line.hpp"

#include "engine/core/cancel.hpp"
#include "engine/core/error.hpp"
#include "ensemble/app/cluster/task_shard.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/fitted.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/help/hint.hpp"
#include "ensemble/workflow/results/maps.hpp"
#include "ensemble/workflow/version.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

namespace sturz::app {
namespace {

using workflow::build_type;
using workflow::compiler;
using workflow::git_commit;
using workflow::version;

/// Where the text of an option begins in the help.
constexpr int text_column = 34;

/// Every sub-command with its options. Help, manual page and completion walk it.
void build(Grammar& grammar) {
  CLI::App& program = grammar.program;
  program.set_version_flag(
      "--version", fmt::format("sturz {} ({}, {}, {})", version, git_commit, compiler, build_type));
  program.require_subcommand(1);
  program.failure_message([](const CLI::App*, const CLI::Error& problem) {
    return fmt::format("error: {}\n`sturz help COMMAND` says what it takes.\n", problem.what());
  });
  program.get_formatter()->column_width(text_column);
  program.footer(
      "Exit codes: 0 done, 1 usage or scenario error, 2 too many failed members, "
      "3 stopped, run the same again.");
  for (const auto add : sub_commands) add(grammar);
}

/// Runs the action; turns whatever it throws into one message and an exit code.
int guarded(const std::function<int(Console&)>& action, Console& console) {
  try {
    return action(console);
  } catch (const workflow::MembersMissing& problem) {
    console.error(problem.what());
    return interrupted;
  } catch (const SetupError& problem) {
    console.error(problem.what());
  } catch (const Cancelled&) {
    console.clear_progress();
    console.event(nlohmann::json{{"event", "interrupted"}}.dump());
    console.warn("interrupted; members are safe. The same command goes on.");
    return interrupted;
  } catch (const std::bad_alloc&) {
    console.error(
        "Out of memory. What is finished is kept: the same command goes on where more memory is "
        "free. A new folder with a coarser spacing or a larger cell, and fewer workers, need "
        "less.");
  } catch (const std::filesystem::filesystem_error& problem) {
    console.error(fmt::format("{}: {}. Check the name and who may read and write there.",
                              problem.path1().string(), problem.code().message()));
  } catch (const std::exception& problem) {
    console.error(
        fmt::format("{} (this should not have happened; please report it)", problem.what()));
  }
  return usage_or_scenario_error;
}

/// A signal that came too late to stop anything is still no plain success: who sent it waits for
/// that code. One that the action spoke of is what it waited for.
int after_signals(int code, Console& console) {
  if (!interrupt_flag().load() || code != ok || interruption_was_told()) return code;
  console.warn("a signal to stop came when all was done: the results are whole.");
  interruption_told();
  return interrupted;
}

/// Full disks and closed streams show themselves at the latest here.
int after_output(int code) {
  std::cout.flush();
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout;
  if (!failed) return code;
  const std::string words = fmt::format(
      "error: the output could not be written (is standard output closed, or its disk full?).{}\n",
      code == ok ? " Files in the results folder are whole." : "");
  std::fwrite(words.data(), 1, words.size(), stderr);
  return code == ok ? usage_or_scenario_error : code;
}

/// Ranges as people write them: the parser says "INT:INT in [1 - 64]" and "FLOAT:POSITIVE". The
/// text of the option stays in its column.
std::string in_plain_words(std::string line) {
  const bool has_text = line.size() > text_column && line[text_column - 1] == ' ';
  for (const auto& [said, plain] :
       {std::pair<std::string_view, std::string_view>{":INT in [", " in ["},
        {":FLOAT in [", " in ["},
        {":POSITIVE", " > 0"},
        {":NONNEGATIVE", " >= 0"}})
    if (const auto at = line.find(said); at < text_column) {
      const auto end = said.ends_with('[') ? line.find(']', at) : at + said.size();
      line.replace(at, said.size(), plain);
      const std::size_t shorter = said.size() - plain.size();
      if (has_text && end < text_column) line.insert(text_column - shorter, shorter, ' ');
    }
  return line;
}

/// Help of the program, or of one of its commands, as wide as the terminal.
void print_help(const Grammar& grammar, const CLI::App* one) {
  const std::string text = one ? one->help(grammar.program.get_name()) : grammar.program.help();
  const int columns = help_columns(STDOUT_FILENO);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::optional<int> hang;  // what lies in the two columns of options
    if (line.starts_with("  ") && columns >= 2 * text_column) hang = text_column;
    std::cout << folded(in_plain_words(line), columns, hang) << "\n";
  }
}

/// `sturz help` and `sturz help run`, as many other programs have it.
/// \return the exit code, or nothing where no help was asked for
std::optional<int> help_command(const Grammar& grammar, int argc, char** argv) {
  if (argc < 2 || std::string_view(argv[1]) != "help") return std::nullopt;
  const CLI::App* one = argc > 2 ? command_named(grammar.program, argv[2]) : nullptr;
  const std::string hint =
      argc > 2 && one == nullptr ? hint_on_words(grammar.program, {argv[2]}) : "";
  if (!hint.empty()) {
    std::cerr << folded("error: " + hint, columns_of(STDERR_FILENO)) << "\n";
    return usage_or_scenario_error;
  }
  print_help(grammar, one);
  return ok;
}

/// The command whose --help was asked for, or nullptr for the program's own.
const CLI::App* parsed_command(const Grammar& grammar) {
  const auto parsed = grammar.program.get_subcommands();
  return parsed.empty() ? nullptr : parsed.front();
}

}  // namespace

int command_line(int argc, char** argv) {
  Grammar grammar;
  build(grammar);
  if (const auto code = help_command(grammar, argc, argv)) return after_output(*code);
  try {
    grammar.program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print_help(grammar, parsed_command(grammar));
    return after_output(ok);
  } catch (const CLI::ParseError& problem) {
    const std::string hint = hint_on_words(grammar.program, {argv + 1, argv + argc});
    if (argc < 2) {
      std::cerr << folded(
                       "error: a command is missing. `sturz help` lists them; `sturz init` begins "
                       "with your own elevation raster.",
                       columns_of(STDERR_FILENO))
                << "\n";
      return usage_or_scenario_error;
    }
    // One was given: that "a subcommand is required" says less than the hint.
    if (!hint.empty() && command_named(grammar.program, argv[1]) == nullptr) {
      std::cerr << folded("error: " + hint, columns_of(STDERR_FILENO))
                << "\n`sturz help` says more.\n";
      return usage_or_scenario_error;
    }
    if (grammar.program.exit(problem) == 0) return after_output(ok);
    if (!hint.empty()) std::cerr << folded(hint, columns_of(STDERR_FILENO)) << "\n";
    return usage_or_scenario_error;
  }
  watch_for_interrupts(grammar.json);
  tell_scheduler_job();
  Console console(grammar.json);
  const int code = guarded(grammar.action, console);
  return after_output(after_signals(code, console));
}

}  // namespace sturz::app
