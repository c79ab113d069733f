// SPDX-License-Identifier: Apache-2.0
/// Coordinate systems: what a file says, what the user says instead, and which one we work in.
/// Always x east, y north (traditional axis order). Included by .cpp files only.
#pragma once

#include <ogr_spatialref.h>

#include <array>
#include <memory>
#include <string>

namespace sturz {

/// Coordinates beyond this are no place on the earth, be they metres, feet or degrees; what
/// follows the readers turns coordinates into row and column numbers, which hold only so much.
inline constexpr double farthest_coordinate = 1e9;

/// Reads "EPSG:32633", WKT or a PROJ text. \throws SetupError naming `key`
OGRSpatialReference parse_crs(const std::string& text, const std::string& key);

/// Readable name with its code, e.g. "WGS 84 / UTM zone 33N (EPSG:32633)".
std::string crs_name(const OGRSpatialReference& crs);
/// WKT2:2019 on one line.
std::string crs_wkt2(const OGRSpatialReference& crs);
/// The system of a Grid; empty for an empty text.
OGRSpatialReference crs_from_wkt(const std::string& wkt);

/// The UTM zone (or polar stereographic system) of WGS 84 around a place in degrees.
OGRSpatialReference best_metric_crs(double longitude, double latitude);

/// Extent and sampling of a file, in its own units.
struct SourceExtent {
  double min_x = 0, max_x = 0, min_y = 0, max_y = 0;
  double cell = 0;  ///< larger edge of a cell; 0 for vectors
};

/// What the scenario says about a file's system.
struct CrsRequest {
  std::string label;          ///< of the file in messages
  std::string override_key;   ///< e.g. "terrain.crs"; empty: only the file itself can say
  std::string override_text;  ///< its value; empty: not given
  std::string fallback_key;   ///< key that stands in when the file has no system; empty: none
  std::string fallback_text;
};

/// The word for coordinates in metres that lie nowhere on the map.
inline constexpr const char* local_crs = "local";

struct SettledCrs {
  OGRSpatialReference crs;   ///< of the coordinates; empty for `local`
  OGRSpatialReference full;  ///< the same with its vertical part, where it has one

  SettledCrs() = default;  // the library's own default is explicit
};

/// The system that a file's coordinates are in: the user's where given, else the file's own, else
/// the one that stands in. `note` tells of a replaced system, else stays empty.
/// \throws SetupError for a missing, local, geocentric or invalid system, for metres that are
///   tagged as degrees, and for degrees that are called local
SettledCrs settle_crs(const OGRSpatialReference* own, const CrsRequest& request,
                      const SourceExtent& extent, std::string& note);

/// Distances on the map divided by distances on the ground, along x and along y at one place.
struct MapScale {
  double along_x = 1, along_y = 1;
};
/// \param step length of the probe in map units. NaN where the place cannot be transformed
MapScale map_scale(const OGRSpatialReference& crs, double x, double y, double step);

/// True when lengths on this map are metres on the ground within 2 %: a slide can run on it.
/// `reason` says why not.
bool is_working_crs(const OGRSpatialReference& crs, double x, double y, double step,
                    std::string& reason);

using TransformPtr = std::unique_ptr<OGRCoordinateTransformation>;
/// nullptr when both systems are the same or one is empty. A shift between two datums that the
/// library does not know is never passed over: it is some hundred metres.
/// \param warning where one of them names no datum at all and equal datums are assumed, says so;
///   nullptr: such a pair is refused, too
/// \throws SetupError naming both
TransformPtr transform_between(const OGRSpatialReference& from, const OGRSpatialReference& to,
                               const std::string& label, std::string* warning = nullptr);

/// False where only an unknown shift of datums could lead from one to the other.
bool is_shift_known(const OGRSpatialReference& from, const OGRSpatialReference& to);
/// False for "unknown", "not specified" and the like.
bool names_a_datum(const OGRSpatialReference& crs);
/// The UTM zone around a place in degrees, on the datum of `crs` itself.
OGRSpatialReference utm_on_own_datum(const OGRSpatialReference& crs, double longitude,
                                     double latitude);

}  // namespace sturz
