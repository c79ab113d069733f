// SPDX-License-Identifier: Apache-2.0
/// Features of a polygon layer by name. Included by .cpp files only.
#pragma once

#include "io/site/polygon_layer.hpp"

#include <string>
#include <vector>

namespace sturz {

/// How the features of a layer are called: by the value of a field, or by their FID.
class FeatureNames {
 public:
  /// \param request its `feature_field` says which field; empty: the FID
  /// \throws SetupError naming the fields that there are
  FeatureNames(const PolygonLayer& layer, const PolygonRequest& request);

  /// Empty where the feature has no value.
  std::string of(const OGRFeature&) const;
  /// "name" or "FID", for messages.
  const std::string& what() const { return what_; }

 private:
  int field_ = -1;
  std::string what_;
};

/// Names of all features, in file order; geometries are not looked at.
/// \throws SetupError for a feature without a name and for two of the same name
std::vector<std::string> feature_names(PolygonLayer& layer, const PolygonRequest& request);

/// The FID of the one feature that is asked for.
/// \throws SetupError naming some of those that there are, or that it is there twice
GIntBig wanted_feature(PolygonLayer& layer, const PolygonRequest& request);

}  // namespace sturz
