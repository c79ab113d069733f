// SPDX-License-Identifier: Apache-2.0
// sturz report: write the page of a results folder again.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console_observer.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/workflow/results/report_page.hpp"

namespace sturz::app {

int report_command(const ReportOptions& options, Console& console) {
  ConsoleObserver observer(console);
  console.say(workflow::rewrite_page(options.folder, observer).string());
  return ok;
}

}  // namespace sturz::app
