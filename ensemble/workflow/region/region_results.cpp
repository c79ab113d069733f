// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/region/region_results.hpp"

#include "engine/core/error.hpp"
#include "engine/core/hash.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/region/region_page.hpp"
#include "ensemble/workflow/region/region_record.hpp"
#include "ensemble/workflow/region/source_table.hpp"
#include "ensemble/workflow/results/gis/gis_files.hpp"
#include "ensemble/workflow/results/ground_source.hpp"
#include "ensemble/workflow/results/maps.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/netcdf/source_lists_netcdf.hpp"
#include "io/site/map_ground.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace sturz::workflow {
namespace {

using Clock = std::chrono::steady_clock;

/// The ground below one row of blocks after the other: no more than a band of it is held.
class GroundBands {
 public:
  GroundBands(const Scene& scene, const Grid& maps, const Window& extent)
      : scene_(scene), maps_(maps), extent_(extent) {}

  std::shared_ptr<const Raster<double>> operator()(const Window& block) {
    if (band_ == nullptr || block.row0 != row0_) {
      const Window band{block.row0, extent_.col0, block.n_rows, extent_.n_cols};
      band_.reset();
      band_ = ground_of_map(scene_.scenario, scene_.inputs, grid_of(band, maps_));
      row0_ = block.row0;
    }
    return band_;
  }

 private:
  const Scene& scene_;
  const Grid& maps_;
  Window extent_;
  int row0_ = -1;
  std::shared_ptr<const Raster<double>> band_;
};

Window extent_of(const StoredMembers& members) {
  return map_extent(MemberCells(members).touched(), members.grid());
}

std::uint64_t hash_of(std::uint64_t layers, const SourceLists& lists) {
  Hash64 hash;
  hash.add(layers);
  for (std::size_t i = 0; i < lists.cells.size(); ++i)
    hash.add(lists.cells[i]).add(static_cast<std::uint64_t>(lists.begin[i + 1]));
  for (const SourceHit& hit : lists.hits) hash.add(hit.source).add(hit.probability);
  return hash.value();
}

/// \return the lists, and the hash of everything that the file holds
std::pair<SourceLists, std::string> write_region_file(const RegionJob& job,
                                                      const StoredMembers& members,
                                                      CancelFlag cancel) {
  const Manifest& manifest = job.manifest;
  const std::vector<RegionSource> sources = members.region_sources();
  const RegionMembers region{members, sources, members.source_of_valid(), members.row_of_valid(),
                             job.members_per_source()};
  RegionContext context;
  context.ground = GroundBands(job.typical, members.grid(), extent_of(members));
  context.whole_ground = job.typical.inputs.terrain_grid();
  context.memory_bytes = records_memory_bytes();
  context.cancel = cancel;
  const std::string& title = job.scenario.title;
  context.attributes = {
      {"title", title.empty() ? "Landslide hazard of a region" : title},
      {"source", fmt::format("sturz {} ({})", version, git_commit)},
      {"history", fmt::format("sturz {}", manifest.command)},
      {"design", fmt::format("{}, {} members of each source, seed {}", to_string(job.design.design),
                             job.members_per_source(), job.design.seed)}};
  LayersFileWriter writer(job.folder.hazard_nc());
  HashingSink hashed(writer);
  SourceLists lists = make_region_maps(region, job.scenario.hazard.quantiles, context, hashed);
  cancel.check();
  write_source_lists(writer.file(), lists);
  writer.commit();
  const std::uint64_t hash = hash_of(hashed.value(), lists);
  return {std::move(lists), fmt::format("{:016x}", hash)};
}

/// What the sources' scenes were warned of, the most frequent first.
std::vector<std::string> warning_lines(const StoredMembers& members) {
  constexpr std::size_t most = 8;
  std::vector<std::pair<std::int64_t, std::string>> all;
  for (const auto& [words, w] : members.warnings()) all.emplace_back(w.sources, w.first);
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
    lines.push_back(fmt::format("{} of {} sources, such as {}", all[i].first,
                                members.sources().size(), all[i].second));
  if (all.size() > most)
    lines.push_back(fmt::format("{} other warnings of single sources stand in their manifest.json",
                                all.size() - most));
  return lines;
}

RegionMade counts_of(const RegionJob& job, const StoredMembers& members) {
  RegionMade made;
  made.folder = job.folder;
  made.max_failed_fraction = job.scenario.ensemble.max_failed_fraction;
  made.n_sources = members.sources().size();
  for (const SourceState& s : members.sources()) {
    made.planned += s.counts.planned;
    made.finished += s.finished;
    made.valid += s.counts.valid;
    made.cut_off += s.cut_off;
    made.failed += s.failure.empty() ? s.finished - s.counts.valid : s.counts.planned;
    if (s.failure.empty()) continue;
    if (made.n_failed_sources++ == 0) made.first_failure = s.counts.name + ": " + s.failure;
  }
  return made;
}

/// What to do about sources that are not complete.
enum class Missing { compute_again, refuse, leave_out };

void require_complete(const RegionJob& job, const StoredMembers& members, Missing rule,
                      Observer& observer) {
  const auto& missing = members.missing();
  if (missing.empty()) return;
  const std::string what =
      fmt::format("{}: {}{}", job.folder.root.string(), missing.front(),
                  missing.size() > 1
                      ? fmt::format(", and {} other sources are not complete", missing.size() - 1)
                      : "");
  forget_finished_sources(job.folder);  // each is to be looked at
  if (rule == Missing::compute_again)
    throw MembersMissing(what + " though all were computed. The same command computes them again.");
  require(rule == Missing::leave_out,
          what +
              ". Resume with the command that computed them, or make maps from the others with "
              "--partial.");
  observer.warning(what + "; the maps are made from the others.");
}

void write_gis(const RegionJob& job, const LayerSource& maps, const LayerStack& coarse,
               const RegionMade& made, CancelFlag cancel) {
  GisContent content;
  content.title = job.scenario.title.empty() ? "Landslide hazard of a region" : job.scenario.title;
  content.maps = &maps;
  content.coarse = &coarse;
  content.elevation = ground_source(maps.about().grid, [&scene = job.typical](const Grid& cells) {
    return ground_of_map(scene.scenario, scene.inputs, cells);
  });
  content.n_members = static_cast<std::size_t>(made.valid);
  content.started = job.manifest.started;
  content.hazard_hash = made.hazard_hash;
  content.cancel = cancel;
  write_all_for_gis(job.folder, job.scenario, content);
}

RegionMade make_results(RegionJob& job, Missing rule, Observer& observer, CancelFlag cancel) {
  const auto begin = Clock::now();
  observer.maps_begin();
  const StoredMembers members(job.folder, job.sources, job.members_per_source(),
                              job.manifest.design_hash, observer, cancel);
  require_complete(job, members, rule, observer);
  RegionMade made = counts_of(job, members);
  require(made.valid > 0,
          fmt::format("{}: no source has a valid member (there is nothing to map){}",
                      job.folder.root.string(),
                      made.first_failure.empty() ? "." : "; " + made.first_failure));
  Manifest& manifest = job.manifest;
  manifest.hazard_hash.clear();
  manifest.maps_of.clear();
  manifest.warnings = warning_lines(members);
  if (made.n_failed_sources > 0)
    manifest.warnings.insert(
        manifest.warnings.begin(),
        fmt::format("{} of {} sources could not be computed and are in no map; the first: {}",
                    made.n_failed_sources, made.n_sources, made.first_failure));
  manifest.write(job.folder.manifest());
  auto [lists, hash] = write_region_file(job, members, cancel);
  const LayersFileReader maps(job.folder.hazard_nc());
  LayerStack coarse = coarse_layers(maps, page_cells, cancel);
  write_text_atomic(sources_csv(job.folder), source_table(members, lists));
  made.reached_cells = lists.cells.size();
  for (std::size_t i = 0; i < lists.cells.size(); ++i)
    made.most_sources = std::max(made.most_sources, lists.begin[i + 1] - lists.begin[i]);
  manifest.hazard_hash = made.hazard_hash = hash;
  manifest.maps_of = members.hash();
  write_gis(job, maps, coarse, made, cancel);
  write_region_page(job, members, std::move(lists), std::move(coarse), extent_of(members), cancel);
  manifest.write(job.folder.manifest());
  made.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return made;
}

}  // namespace

RegionMade make_region_results(RegionJob& job, Observer& observer, CancelFlag cancel) {
  return make_results(job, Missing::compute_again, observer, cancel);
}

RegionMade merge_region(const RegionMergeRequest& request, Observer& observer, CancelFlag cancel) {
  RegionJob job = reopen_region(request.folder, observer, cancel);
  return make_results(job, request.partial ? Missing::leave_out : Missing::refuse, observer,
                      cancel);
}

}  // namespace sturz::workflow
