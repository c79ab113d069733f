// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/plan.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/batch/reasons.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "io/batch/scene_files.hpp"
#include "io/files/checksum.hpp"
#include "io/files/file_stamp.hpp"
#include "io/files/io_error.hpp"
#include "io/members/member_numbers.hpp"
#include "io/scenario/scenario_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

const char* kind_of(const BatchJob& job) { return job.single_run ? "run" : "ensemble"; }

/// Of all that the list and the scenario file say of the job.
std::string fingerprint_of(const BatchJob& job) {
  return text_checksum(fmt::format("{}\n{}\n{}", kind_of(job),
                                   fs::absolute(fs::path(job.scenario.directory) / ".").string(),
                                   write_scenario(job.scenario)));
}

/// The files that a finished folder has.
bool results_are_there(const JobRecord& record) {
  const OutputFolder folder{record.folder};
  std::error_code ignored;
  for (const fs::path& file : {folder.manifest(), folder.scenario(), folder.report()})
    if (!fs::exists(file, ignored)) return false;
  const bool maps =
      fs::exists(folder.hazard_nc(), ignored) || fs::exists(folder.peaks_nc(), ignored);
  return maps && record.figures && count_members(folder.root) >= record.figures->finished;
}

/// What today's scene is, for comparison with folders.
struct Today {
  const BatchJob& job;
  Scene scene;
  Scenario compared;  ///< what the folder's scenario.yaml would be
  DesignTable design;
};

Today look_at(const BatchJob& job) {
  Today today{job, load_scene(job.scene), {}, {}};
  Scenario& scenario = today.scene.scenario;
  if (job.single_run) {
    today.compared = today.scene.medians;
    return today;
  }
  today.design = new_design(scenario);
  scenario.ensemble.members = static_cast<int>(today.design.n_members());
  today.compared = scenario;
  return today;
}

/// A folder of earlier results beside today's scene.
struct Found {
  OutputFolder folder;
  Manifest manifest;
  Scenario scenario;
  std::vector<std::string> differences;  ///< why its members are not today's; empty: they are
  std::vector<std::string> of_maps;      ///< what is to be made anew from the same members
};

std::string design_difference(const Found& found, const Today& today) {
  if (today.job.single_run) return {};
  try {
    continued_design(found.folder, found.manifest, today.scene.scenario, today.design);
    return {};
  } catch (const SetupError& problem) {
    if (found.manifest.members != today.design.n_members())
      return fmt::format("ensemble.members {} -> {}", found.manifest.members,
                         today.design.n_members());
    return today.scene.scenario.ensemble.design == Design::table ? "ensemble.table has other rows"
                                                                 : std::string(problem.what());
  }
}

void add(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// Nothing when the folder cannot be read.
std::optional<Found> compare(const fs::path& root, const Today& today) {
  try {
    Found found{{root}, Manifest::read(OutputFolder{root}.manifest()), {}, {}, {}};
    found.scenario = read_scenario(found.folder.scenario());
    const Manifest& m = found.manifest;
    if (m.kind != kind_of(today.job))
      found.differences.push_back(fmt::format("mode {} -> {}", m.kind, kind_of(today.job)));
    if (const std::string program = other_program(m.builds); !program.empty())
      found.differences.push_back(program);
    add(found.differences, changed_values(differences(found.scenario, today.compared)));
    add(found.differences,
        changed_files(changed_inputs(today.compared, today.scene.inputs.identities, m.inputs)));
    if (found.differences.empty())
      if (std::string design = design_difference(found, today); !design.empty())
        found.differences.push_back(std::move(design));
    found.of_maps = changed_values(differences_of_maps(found.scenario, today.compared));
    add(found.of_maps, changed_map_inputs(m.inputs, today.scene.inputs.identities));
    return found;
  } catch (const SetupError&) {
    return std::nullopt;
  }
}

/// That of the record first: it is mostly the one.
std::vector<fs::path> folders_to_ask(const BatchJob& job, const JobRecord& record) {
  std::vector<fs::path> folders = results_of(job.base);
  std::stable_partition(folders.begin(), folders.end(),
                        [&](const fs::path& f) { return f == fs::path(record.folder); });
  return folders;
}

fs::path new_folder(const BatchJob& job, const Today& today) {
  const std::string text = fmt::format(
      "{}\n{}\n{}\n{}", kind_of(job), scene_hash(today.compared, today.scene.inputs.identities),
      job.single_run ? "" : design_hash(today.design), build_text(this_build()));
  constexpr std::size_t prefix = 7, digits = 8;  // after "sha256:"
  fs::path folder = job.base;
  folder += fmt::format("-{}", text_checksum(text).substr(prefix, digits));
  std::error_code ignored;
  fs::path free = folder;
  // Only after changes beyond the part of the ground that is read first. Without scenario.yaml it
  // was killed before it had begun.
  for (int n = 2; fs::exists(OutputFolder{free}.scenario(), ignored); ++n)
    free = fs::path(folder.string() + fmt::format("-{}", n));
  return free;
}

/// Whether maps are of the members that are there; reads them all.
bool maps_are_whole(const Found& found, CancelFlag cancel) {
  const Manifest& m = found.manifest;
  std::error_code ignored;
  if (m.hazard_hash.empty() || !fs::exists(found.folder.report(), ignored)) return false;
  if (m.kind == "run")
    return fs::exists(found.folder.peaks_nc(), ignored) &&
           MemberStore(found.folder.members(), {}, cancel).members().size() == 1;
  const DesignTable design = saved_design(found.folder, m, found.scenario);
  const MemberStore store = members_of(found.folder, m, design, {}, cancel);
  return fs::exists(found.folder.hazard_nc(), ignored) &&
         what_is_missing(store, design.n_members()).empty() &&
         m.maps_of == members_hash(store, design.n_members());
}

/// A folder whose members are today's: what is left to do in it.
void plan_in(PlannedJob& plan, const Found& found, const JobRecord& before,
             const PlanOptions& options, Observer& observer, CancelFlag cancel) {
  plan.folder = found.folder.root;
  plan.finished = std::min(count_members(plan.folder), plan.members);
  const std::string last = before.end == JobEnd::failed && before.folder == plan.folder
                               ? "failed last time"
                               : "interrupted";
  std::vector<std::string> reasons;
  if (!plan.job.single_run && found.manifest.members < plan.members)
    reasons.push_back(
        fmt::format("ensemble.members {} -> {}", found.manifest.members, plan.members));
  else if (plan.finished < plan.members)
    reasons.push_back(fmt::format("{} at {} of {}", last, plan.finished, plan.members));
  add(reasons, found.of_maps);
  const bool finished = before.is_finished() && before.folder == plan.folder;
  if (options.retry_failed && finished && before.figures && before.figures->failed() > 0)
    reasons.push_back(fmt::format("{} members failed", before.figures->failed()));
  const bool known = finished && results_are_there(before) && !options.check_all;
  if (reasons.empty() && !known && !maps_are_whole(found, cancel))
    reasons.emplace_back(plan.job.single_run ? "interrupted"
                                             : "interrupted before the maps were made");
  plan.to_do = !reasons.empty();
  plan.why = joined(reasons);
  if (plan.to_do) return;
  plan.record.figures = known ? before.figures : figures_of(plan.folder, observer, cancel);
  const BatchFigures& figures = *plan.record.figures;
  const double share = static_cast<double>(figures.failed()) /
                       static_cast<double>(std::max<std::int64_t>(figures.finished, 1));
  const bool too_many =
      figures.valid == 0 || share > plan.job.scenario.ensemble.max_failed_fraction;
  plan.record.end = too_many ? JobEnd::too_many_failed : JobEnd::done;
  plan.record.utilisation = known ? before.utilisation : nan_d;
}

void add_forecast(PlannedJob& plan, const Today& today, const PlanOptions& options,
                  CancelFlag cancel) {
  ForecastRequest request;
  const std::int64_t to_do = std::max<std::int64_t>(plan.members - plan.finished, 0);
  const int cores = options.max_workers > 0 ? std::min(options.max_workers, available_cores())
                                            : available_cores();
  if (!plan.job.single_run) {
    request.design = &today.design;
    request.members = to_do;
    request.workers = static_cast<int>(std::clamp<std::int64_t>(to_do, 1, cores));
  }
  request.speed_cache = plan.job.scene.speed_cache;
  request.cancel = cancel;
  plan.forecast = forecast(today.scene, request);
}

void plan_loaded(PlannedJob& plan, const JobRecord& before, const PlanOptions& options,
                 Observer& observer, CancelFlag cancel) {
  const Today today = look_at(plan.job);
  plan.members = plan.job.single_run ? 1 : today.design.n_members();
  if (const auto stamps = stamps_of(plan.job.scenario)) {
    plan.record.stamps = *stamps;
    plan.record.has_stamps = true;
  }
  std::optional<Found> nearest;  // what the reasons are told from
  bool matched = false;
  for (const fs::path& folder : folders_to_ask(plan.job, before)) {
    cancel.check();
    const auto found = compare(folder, today);
    if (!found) continue;
    matched = found->differences.empty();
    if (matched || !nearest) nearest = found;
    if (matched) break;
  }
  if (matched) {
    plan_in(plan, *nearest, before, options, observer, cancel);
  } else {
    plan.to_do = true;
    plan.folder = new_folder(plan.job, today);
    plan.why = nearest                        ? joined(nearest->differences)
               : before.end == JobEnd::failed ? "failed last time"
                                              : "never computed";
  }
  if (options.forecast && plan.to_do) add_forecast(plan, today, options, cancel);
}

/// "0123abcd" or, where that name was taken, "0123abcd-2". No more than three digits: a job may be
/// called "NAME-20261130", and its results "NAME-20261130-" with a hash that is all digits.
bool is_hash(std::string_view text) {
  constexpr std::size_t digits = 8, most = 3;
  if (text.size() < digits ||
      text.substr(0, digits).find_first_not_of("0123456789abcdef") != std::string_view::npos)
    return false;
  if (text.size() == digits) return true;
  const std::string_view number = text.substr(digits + 1);
  return text[digits] == '-' && !number.empty() && number.size() <= most &&
         number.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::int64_t count_members(const fs::path& root) {
  try {
    return static_cast<std::int64_t>(member_numbers_in(OutputFolder{root}.members()).size());
  } catch (const IoError&) {
    return 0;  // a pack that cannot be read: who opens the folder says so
  }
}

std::vector<fs::path> results_of(const fs::path& base) {
  const std::string prefix = base.filename().string() + "-";
  std::vector<std::pair<fs::file_time_type, fs::path>> found;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(base.parent_path(), failed)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_symlink(failed) || !name.starts_with(prefix) ||
        !is_hash(std::string_view(name).substr(prefix.size())))
      continue;
    std::error_code no_manifest;
    const auto written = fs::last_write_time(OutputFolder{entry.path()}.manifest(), no_manifest);
    if (!no_manifest) found.emplace_back(written, entry.path());
  }
  std::sort(found.begin(), found.end(), std::greater<>());
  std::vector<fs::path> folders;
  for (auto& [written, path] : found) folders.push_back(std::move(path));
  return folders;
}

PlannedJob plan_job(const BatchJob& job, const BatchState& state, const PlanOptions& options,
                    Observer& observer, CancelFlag cancel) {
  PlannedJob plan;
  plan.job = job;
  plan.failure = job.failure;
  const auto known = state.jobs.find(job.name);
  const JobRecord before = known == state.jobs.end() ? JobRecord{} : known->second;
  plan.crashed = before.end == JobEnd::running;
  plan.record.fingerprint = fingerprint_of(job);
  plan.record.build = build_text(this_build());
  plan.record.looked_ns = now_ns();
  if (!plan.failure.empty()) return plan;
  const bool unchanged =
      !options.check_all && !options.retry_failed && before.is_finished() && before.has_stamps &&
      before.fingerprint == plan.record.fingerprint && before.build == plan.record.build &&
      are_unchanged(job.scenario, before.stamps, before.looked_ns) && results_are_there(before);
  if (unchanged) {
    plan.record = before;
    plan.folder = before.folder;
    plan.members = before.figures->planned;
    plan.finished = before.figures->finished;
    return plan;
  }
  try {
    plan_loaded(plan, before, options, observer, cancel);
  } catch (const SetupError& problem) {
    plan.failure = at_places_in_list(problem.what(), job);
  }
  plan.record.folder = plan.folder.string();
  return plan;
}

}  // namespace sturz::workflow
