// SPDX-License-Identifier: Apache-2.0
/// The features of any polygon layer that OGR reads, valid and in the terrain's coordinate system.
/// Included by .cpp files only.
#pragma once

#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/ogr_polygons.hpp"
#include "io/site/polygon_request.hpp"
#include "scenarios/input_identity.hpp"

#include <ogrsf_frmts.h>

#include <functional>
#include <string>
#include <vector>

namespace sturz {

/// A layer open for reading.
struct PolygonLayer {
  std::string label;  ///< for messages: "release.polygon = source.gpkg"
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  InputIdentity identity;  ///< complete after read_features()
  OpenDataset dataset;
  OGRLayer* layer = nullptr;
};

/// One feature: all its polygons in the terrain's system.
struct PolygonFeature {
  std::string name;  ///< "feature 3"
  PolygonsPtr polygons;
  double thickness_m = 1;
  double start_s = 0;
};

/// "layer 'a' is used ..." goes to the notes. \throws SetupError naming key and file: missing file
///   or layer
PolygonLayer open_polygon_layer(const PolygonRequest& request);

/// All features, in file order. What was reprojected, mended or taken as it is goes to the notes.
/// \param read_fields called for each feature to fill in what its fields say
/// \throws SetupError naming key and file: no coordinate system; empty layer or polygon; points or
///   lines
std::vector<PolygonFeature> read_features(
    PolygonLayer& layer, const PolygonRequest& request, const Grid& terrain,
    const std::function<void(OGRFeature&, PolygonFeature&)>& read_fields = {});

/// What moves the layer's coordinates to the terrain's system; nullptr where they stay as they are.
/// Completes the identity's shape with the system. \throws SetupError
TransformPtr terrain_transform(PolygonLayer& layer, const PolygonRequest& request,
                               const Grid& terrain);

/// "polygon x 1 to 2, y 1 to 2; terrain x 0 to 5, y 0 to 5"
std::string places_text(const OGREnvelope& polygon, const Grid& terrain);

}  // namespace sturz
