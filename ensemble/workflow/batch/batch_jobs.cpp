// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/batch_jobs.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/batch/batch_features.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "io/files/plain_text.hpp"
#include "io/scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

/// Collects what is wrong, each line once: many jobs may name one scenario.
class Problems {
 public:
  void add(const std::string& lines) {
    std::istringstream in(lines);
    for (std::string line; std::getline(in, line);)
      if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
  }
  void check() const { require(lines_.empty(), fmt::format("{}", fmt::join(lines_, "\n"))); }

 private:
  std::vector<std::string> lines_;
};

std::vector<std::string> overrides_of(const std::vector<BatchValue>& set) {
  std::vector<std::string> texts;
  for (const BatchValue& value : set) texts.push_back(value.key + "=" + value.value);
  return texts;
}

/// Reads the scenario; what is wrong with it goes to the problems.
bool read_into(BatchJob& job, const BatchEntry& entry, Problems& problems) {
  try {
    job.scenario = read_scenario(job.scene.file, job.scene.overrides);
    return true;
  } catch (const ScenarioError& problem) {
    problems.add(at_places_in_list(problem.what(), job));
  } catch (const SetupError& problem) {
    problems.add(fmt::format("{}: {}.scenario = {} ({}).", entry.scenario_at.text(), entry.path,
                             entry.scenario, problem.what()));
  }
  return false;
}

class Expansion {
 public:
  Expansion(const fs::path& list, BatchJobs& jobs, SpeedCache cache,
            const std::vector<std::string>& problems_of_list)
      : near_(list.parent_path()), jobs_(jobs), cache_(std::move(cache)) {
    for (const std::string& problem : problems_of_list) problems_.add(problem);
  }

  void add(const BatchEntry& entry, bool wanted) {
    BatchJob job = job_of(entry);
    job.wanted = wanted;
    // The entry without a feature, so that its layer can be asked.
    if (entry.each_feature || entry.features.empty())
      if (!read_into(job, entry, problems_)) return;
    std::vector<FeatureJob> features;
    try {
      features = feature_jobs(entry, job.scenario);
    } catch (const SetupError& problem) {
      job.failure = problem.what();
      return keep(entry, std::move(job));
    }
    for (FeatureJob& feature : features) {
      BatchJob one = job;
      one.name += feature.suffix;
      one.base += feature.suffix;
      if (!feature.extra.empty()) {
        one.set.insert(one.set.end(), feature.extra.begin(), feature.extra.end());
        one.scene.overrides = overrides_of(one.set);
        if (!read_into(one, entry, problems_)) continue;
      }
      keep(entry, std::move(one));
    }
  }
  void check() const { problems_.check(); }

 private:
  BatchJob job_of(const BatchEntry& entry) const {
    BatchJob job;
    job.name = entry.name;
    job.single_run = entry.single_run;
    job.set = entry.set;
    if (entry.members > 0)
      job.set.push_back({"ensemble.members", std::to_string(entry.members), entry.at});
    job.scene = {(near_ / entry.scenario).lexically_normal().string(), overrides_of(job.set),
                 cache_};
    job.base = entry.folder.empty() ? jobs_.root / entry.name
                                    : fs::absolute(near_ / entry.folder).lexically_normal();
    if (!job.base.has_filename()) job.base = job.base.parent_path();
    return job;
  }

  void keep(const BatchEntry& entry, BatchJob job) {
    const auto [first, is_new] = bases_.emplace(job.base.string(), entry.path);
    if (is_new) {
      jobs_.list.push_back(std::move(job));
      return;
    }
    problems_.add(
        fmt::format("{}: {} (its results would be called {} as those of {}). Choose "
                    "another name or folder.",
                    entry.at.text(), entry.path, job.base.string(), first->second));
  }

  fs::path near_;
  BatchJobs& jobs_;
  SpeedCache cache_;
  Problems problems_;
  std::map<std::string, std::string> bases_;
};

bool is_wanted(const BatchEntry& entry, const std::vector<std::string>& only) {
  return only.empty() || std::find(only.begin(), only.end(), entry.name) != only.end();
}

}  // namespace

std::string at_places_in_list(const std::string& lines, const BatchJob& job) {
  std::string placed;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    for (const BatchValue& value : job.set) {
      const std::string source = "--set " + one_line(value.key, 80) + ": ";
      if (!line.starts_with(source)) continue;
      line = value.at.text() + ": " + line.substr(source.size());
      break;
    }
    placed += (placed.empty() ? "" : "\n") + line;
  }
  return placed;
}

BatchJobs read_batch_jobs(const fs::path& list, const SpeedCache& cache,
                          const std::vector<std::string>& only, const fs::path& results) {
  BatchJobs jobs;
  std::vector<std::string> problems;
  jobs.spec = read_batch(list, problems);
  const fs::path near = fs::absolute(list).parent_path();  // a timer calls from anywhere
  jobs.root =
      jobs.spec.results.empty() ? near / default_folder(list.string()) : near / jobs.spec.results;
  if (!results.empty()) jobs.root = fs::absolute(results);
  jobs.root = jobs.root.lexically_normal();
  if (!jobs.root.has_filename()) jobs.root = jobs.root.parent_path();
  if (!jobs.spec.stop_file.empty()) jobs.stop_file = near / jobs.spec.stop_file;
  for (const std::string& name : only)
    if (std::none_of(jobs.spec.jobs.begin(), jobs.spec.jobs.end(),
                     [&](const BatchEntry& entry) { return entry.name == name; }))
      problems.push_back(fmt::format("--only {} (the list has no job of that name).", name));
  Expansion expansion(list, jobs, cache, problems);
  for (const BatchEntry& entry : jobs.spec.jobs) expansion.add(entry, is_wanted(entry, only));
  expansion.check();
  return jobs;
}

}  // namespace sturz::workflow
