// SPDX-License-Identifier: Apache-2.0
#include "io/site/release/named_features.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>

namespace sturz {
namespace {

constexpr std::size_t n_shown = 8;

/// "a, b, c, ... (40 in all)"
std::string some_of(const std::vector<std::string>& names) {
  const std::size_t n = std::min(n_shown, names.size());
  std::string text = comma_separated(
      std::vector<std::string>(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(n)));
  if (n < names.size()) text += fmt::format(", ... ({} in all)", names.size());
  return text.empty() ? "none" : text;
}

}  // namespace

FeatureNames::FeatureNames(const PolygonLayer& layer, const PolygonRequest& request)
    : what_(request.feature_field.empty() ? "FID" : request.feature_field) {
  if (request.feature_field.empty()) return;
  const OGRFeatureDefn& fields = *layer.layer->GetLayerDefn();
  field_ = fields.GetFieldIndex(request.feature_field.c_str());
  if (field_ >= 0) return;
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(fields.GetFieldCount()));
  for (int i = 0; i < fields.GetFieldCount(); ++i)
    names.emplace_back(fields.GetFieldDefn(i)->GetNameRef());
  throw SetupError(fmt::format("release.feature_key = {}: {} has no such field. It has: {}.",
                               request.feature_field, layer.label,
                               names.empty() ? "none" : comma_separated(names)));
}

std::string FeatureNames::of(const OGRFeature& feature) const {
  if (field_ < 0) return fmt::format("{}", feature.GetFID());
  if (feature.IsFieldSetAndNotNull(field_) == 0) return "";
  return feature.GetFieldAsString(field_);
}

std::vector<std::string> feature_names(PolygonLayer& layer, const PolygonRequest& request) {
  const FeatureNames names(layer, request);
  std::vector<std::string> all;
  std::map<std::string, GIntBig> seen;
  layer.layer->ResetReading();
  while (const auto read = OGRFeatureUniquePtr(layer.layer->GetNextFeature())) {
    const std::string name = names.of(*read);
    require(!name.empty(),
            fmt::format("release.feature_key = {}: feature {} of {} has no value there (each needs "
                        "one of its own). Give it one, or use another field.",
                        names.what(), read->GetFID(), layer.label));
    const auto [before, is_new] = seen.emplace(name, read->GetFID());
    require(is_new,
            fmt::format("release.feature_key = {}: features {} and {} of {} are both {} (each "
                        "needs a value of its own). Rename one, unite them, or use another field.",
                        names.what(), before->second, read->GetFID(), layer.label, name));
    all.push_back(name);
  }
  return all;
}

GIntBig wanted_feature(PolygonLayer& layer, const PolygonRequest& request) {
  const FeatureNames names(layer, request);
  std::vector<std::string> others;
  std::optional<GIntBig> found;
  layer.layer->ResetReading();
  while (const auto read = OGRFeatureUniquePtr(layer.layer->GetNextFeature())) {
    std::string name = names.of(*read);
    if (name != request.feature) {
      if (!name.empty()) others.push_back(std::move(name));
      continue;
    }
    require(!found,
            fmt::format("release.feature = {}: features {} and {} of {} both have that value of {} "
                        "(which of them?). Name them apart, unite them, or use another field.",
                        request.feature, *found, read->GetFID(), layer.label, names.what()));
    found = read->GetFID();
  }
  if (found) return *found;
  const std::string near = nearest_name(request.feature, others);
  throw SetupError(
      fmt::format("release.feature = {}: {} has no feature with that {}{}. It has: "
                  "{}.",
                  request.feature, layer.label, names.what(),
                  near.empty() ? "" : fmt::format(" (did you mean {}?)", near), some_of(others)));
}

}  // namespace sturz
