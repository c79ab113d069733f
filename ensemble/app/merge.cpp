// SPDX-License-Identifier: Apache-2.0
// sturz merge: maps from the members that shards have left in a folder.
#include "ensemble/workflow/results/merge.hpp"

#include "ensemble/app/commands.hpp"
#include "ensemble/app/console_observer.hpp"
#include "ensemble/app/verdict.hpp"

namespace sturz::app {

int merge_command(const MergeOptions& options, Console& console) {
  ConsoleObserver observer(console);
  return verdict(workflow::merge_members({options.folder, options.partial}, observer), console);
}

}  // namespace sturz::app
