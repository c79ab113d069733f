// SPDX-License-Identifier: Apache-2.0
// sturz report: write the page of a results folder again.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/workflow/results/report_page.hpp"

namespace sturz::app {
namespace {

struct Options {
  std::string folder, language;
};

int report(const Options& options, Console& console) {
  ConsoleObserver observer(console);
  console.say(workflow::rewrite_page(options.folder, observer, interrupt_flag(), options.language)
                  .string());
  return ok;
}

}  // namespace

void add_report(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "report", "Write the report page of a results folder again", report);
  parser.add_option("folder", options.folder, "Folder of an ensemble or a run")
      ->type_name("DIR")
      ->required();
  parser
      .add_option("--language", options.language,
                  "Language of the page: en, de (default: report.language of the scenario)")
      ->type_name("LANGUAGE");
  add_remote(parser);
  add_json(grammar, parser);
}

}  // namespace sturz::app
