// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/batch_features.hpp"

#include "ensemble/workflow/region/region_folder.hpp"
#include "io/site/release/release_features.hpp"
#include "scenarios/schema/value_text.hpp"

#include <utility>

namespace sturz::workflow {

std::vector<FeatureJob> feature_jobs(const BatchEntry& entry, const Scenario& scenario) {
  std::vector<std::string> features = entry.features;
  if (entry.each_feature)
    for (const std::string& name : release_features(scenario))
      features.push_back(quoted_text(name));
  if (features.empty()) return {FeatureJob{}};
  std::vector<FeatureJob> jobs;
  for (const std::string& feature : features) {
    std::string name = feature;
    std::erase(name, '"');
    FeatureJob& job = jobs.emplace_back();
    job.suffix = '.';
    job.suffix += source_file_name(name);
    job.extra = {{"release.each_feature", "false", entry.features_at},
                 {"release.feature", feature, entry.features_at}};
  }
  return jobs;
}

}  // namespace sturz::workflow
