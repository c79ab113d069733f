// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/batch_features.hpp"

#include "engine/core/error.hpp"
#include "io/batch/layer_features.hpp"

#include <algorithm>
#include <utility>

namespace sturz::workflow {
namespace {

/// What a folder may be called.
std::string as_name(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) {
        return !((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                 c == '_' || c == '-' || c == '.');
      },
      '_');
  return text;
}

}  // namespace

std::vector<FeatureJob> feature_jobs(const BatchEntry& entry, const Scenario& scenario) {
  std::vector<std::string> features = entry.features;
  if (entry.each_feature) features = layer_features(scenario);
  if (features.empty()) return {FeatureJob{}};
  std::vector<FeatureJob> jobs;
  for (const std::string& feature : features) {
    std::string name = feature;
    std::erase(name, '"');
    FeatureJob& job = jobs.emplace_back();
    job.suffix = '.';
    job.suffix += as_name(std::move(name));
    job.extra = {{"release.feature", feature, entry.features_at}};
  }
  return jobs;
}

}  // namespace sturz::workflow
