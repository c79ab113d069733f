// SPDX-License-Identifier: Apache-2.0
// sturz report: write the page of a results folder again.
#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/finished_folder.hpp"
#include "ensemble/app/report_page.hpp"
#include "ensemble/app/saved_design.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_store.hpp"
#include "io/netcdf/netcdf_layers.hpp"

#include <fmt/core.h>

namespace sturz::app {

int report_command(const ReportOptions& options, Console& console) {
  const FinishedFolder finished = open_finished(options.folder, console);
  const bool one_run = finished.manifest.kind == "run";
  const auto maps = one_run ? finished.folder.peaks_nc() : finished.folder.hazard_nc();
  require(std::filesystem::exists(maps),
          fmt::format("{} does not exist (the page shows its maps). {}", maps.string(),
                      one_run ? "Run the scene again." : "Make it with `sturz merge`."));
  const LayerStack stack = read_layers(maps);
  const MemberStore store(finished.folder.members());
  DesignTable design;
  std::vector<ConvergencePoint> convergence;
  MemberResult run;
  PageContent page;
  (one_run ? page.peaks : page.hazard) = &stack;
  if (!one_run) {
    design = saved_design(finished.folder);
    page.design = &design;
    convergence = probability_convergence(store);
    page.convergence = convergence;
  }
  page.elevation = finished.elevation.get();
  page.members = store.members();
  if (one_run && !page.members.empty()) {
    run = read_member(finished.folder.members() / member_file_name(page.members.front().member));
    page.run = &run;
  }
  write_page(finished.folder, finished.manifest, finished.scenario, page);
  console.say(finished.folder.report().string());
  return ok;
}

}  // namespace sturz::app
