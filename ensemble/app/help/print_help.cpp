// SPDX-License-Identifier: Apache-2.0
// sturz print-help: the command table as manual page or completion, for the build; not in `--help`.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/help/bash_completion.hpp"
#include "ensemble/app/help/man_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "scenarios/shapes/synthetic_terrain.hpp"

namespace sturz::app {
namespace {

struct Options {
  const CLI::App* program = nullptr;
  std::string format;
  std::string out;  ///< file; empty: stdout
};

int print_help(const Options& options, Console& console) {
  const CommandTable table = command_table(*options.program);
  const std::string text = options.format == "man" ? man_page(table, workflow::version)
                                                   : bash_completion(table, synthetic_shapes());
  if (options.out.empty())
    console.say(text);
  else
    write_text_atomic(options.out, text + "\n");
  return ok;
}

}  // namespace

void add_print_help(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "print-help", "Print this program's help in another format", print_help);
  options.program = &grammar.program;
  parser.group("");
  parser.add_option("format", options.format)->required()->check(CLI::IsMember({"man", "bash"}));
  parser.add_option("-o,--out", options.out, "File instead of the screen");
}

}  // namespace sturz::app
