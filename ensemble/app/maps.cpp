// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/maps.hpp"

#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/report_page.hpp"
#include "ensemble/app/version.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/members/members_table.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/cog.hpp"
#include "io/members/member_store.hpp"
#include "io/netcdf/netcdf_layers.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>

namespace sturz::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

LayerStack hazard_of(const MemberStore& store, const Manifest& manifest, const Scenario& scenario,
                     const DesignTable& design) {
  HazardContext context;
  context.spacing_m = scenario.numerics.spacing_m;
  context.n_planned = design.n_members();
  context.attributes = {{"title", scenario.title.empty() ? "Landslide hazard" : scenario.title},
                        {"source", fmt::format("sturz {} ({})", version, git_commit)},
                        {"history", fmt::format("{} sturz {}", manifest.started, manifest.command)},
                        {"design", fmt::format("{}, {} members, seed {}", to_string(design.design),
                                               design.n_members(), design.seed)}};
  return make_hazard_map(store, scenario.hazard, context);
}

/// The folder then holds these maps and no older ones, say of other thresholds.
void write_tifs(const OutputFolder& folder, const LayerStack& hazard) {
  const auto written = write_cogs(folder.tif_folder(), hazard);
  std::set<std::filesystem::path> names;
  for (const auto& file : written) names.insert(file.filename());
  for (const auto& entry : std::filesystem::directory_iterator(folder.tif_folder()))
    if (entry.path().extension() == ".tif" && !names.contains(entry.path().filename()))
      std::filesystem::remove(entry.path());
}

}  // namespace

MapsMade make_maps(const OutputFolder& folder, Manifest& manifest, const Scenario& scenario,
                   const DesignTable& design, const Raster<double>* elevation, Console& console) {
  const auto begin = Clock::now();
  console.progress("making maps ...");
  const MemberStore store(folder.members());
  MapsMade made;
  made.planned = design.n_members();
  made.finished = static_cast<std::int64_t>(store.members().size());
  made.valid = std::count_if(store.members().begin(), store.members().end(),
                             [](const MemberSummary& m) { return is_valid(m.outcome); });

  write_text_atomic(folder.members_csv(), members_csv(design, store.members()));
  const LayerStack hazard = hazard_of(store, manifest, scenario, design);
  write_layers(folder.hazard_nc(), hazard);
  write_tifs(folder, hazard);
  manifest.hazard_hash = fmt::format("{:016x}", hash_of(hazard));
  manifest.write(folder.manifest());

  PageContent page;
  page.hazard = &hazard;
  page.design = &design;
  page.elevation = elevation;
  page.members = store.members();
  const auto convergence = probability_convergence(store);
  page.convergence = convergence;
  write_page(folder, manifest, scenario, page);
  console.clear_progress();
  console.note(fmt::format("maps of {} valid members in {}, hash {}", made.valid,
                           duration_text(seconds_since(begin)), manifest.hazard_hash));
  return made;
}

int verdict(const MapsMade& made, const OutputFolder& folder, const Manifest& manifest,
            double max_failed_fraction, Console& console) {
  const double share = made.finished > 0
                           ? static_cast<double>(made.failed()) / static_cast<double>(made.finished)
                           : 1;
  const bool too_many = share > max_failed_fraction;
  console.event(nlohmann::json{{"event", "done"},
                               {"planned", made.planned},
                               {"finished", made.finished},
                               {"valid", made.valid},
                               {"failed", made.failed()},
                               {"hazard_hash", manifest.hazard_hash},
                               {"folder", folder.root.string()}}
                    .dump());
  console.say(fmt::format("{} of {} members are valid. Results are in {}:", made.valid,
                          made.planned, folder.root.string()));
  console.say("  report.html   look here first");
  console.say("  hazard.nc     all maps with their CRS; hazard/*.tif the same for GIS");
  console.say("  members.csv   one row per member");
  if (made.failed() > 0 && !too_many)
    console.warn(
        fmt::format("{} of {} members failed; their reasons are in members.csv. The maps "
                    "are made from the others.",
                    made.failed(), made.finished));
  if (too_many)
    console.error(
        fmt::format("{} of {} members failed, more than the accepted share "
                    "(ensemble.max_failed_fraction = {}). Their reasons are in "
                    "members.csv; the maps are made from the others.",
                    made.failed(), made.finished, max_failed_fraction));
  return too_many ? too_many_failed : ok;
}

}  // namespace sturz::app
