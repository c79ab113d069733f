// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/crs.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/gdal_handles.hpp"

#include <cpl_conv.h>
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <vector>

namespace sturz {
namespace {

constexpr double largest_scale_error = 0.02;
constexpr double largest_degree_cell = 0.1;  // 11 km: no terrain of a slide, but 0.1 m is one

std::string with_options(const OGRSpatialReference& crs, const char* format) {
  const char* options[] = {format, "MULTILINE=NO", nullptr};
  char* text = nullptr;
  crs.exportToWkt(&text, options);
  std::string wkt = text == nullptr ? "" : text;
  CPLFree(text);
  return wkt;
}

/// Where the user can name the system.
std::string place_for(const CrsRequest& request) {
  return request.override_key.empty() ? "EPSG:xxxxx to the file (ogr2ogr -a_srs)"
                                      : "`" + request.override_key + ": EPSG:xxxxx`";
}

/// The other way out, where there is one: a scene without a place on the map.
std::string or_local(const CrsRequest& request) {
  return request.override_key == "terrain.crs"
             ? ", or `terrain.crs: local` if they are metres that lie nowhere on the map"
             : "";
}

void refuse_unusable(const OGRSpatialReference& crs, const CrsRequest& request) {
  if (crs.IsProjected() || crs.IsGeographic()) return;
  throw SetupError(fmt::format(
      "{}: its coordinate system '{}' is {} (no map can place it). Add {}, the projected "
      "system of the coordinates{}.",
      request.label, crs_name(crs),
      crs.IsLocal() ? "a local one" : (crs.IsGeocentric() ? "geocentric" : "of no usable kind"),
      place_for(request), crs.IsLocal() ? or_local(request) : ""));
}

void refuse_metres_as_degrees(const OGRSpatialReference& crs, const CrsRequest& request,
                              const SourceExtent& e) {
  if (!crs.IsGeographic()) return;
  const char* source = request.override_text.empty() ? "tagged as" : "said to be in";
  const std::string advice =
      fmt::format("These look like metres: give {}, the projected system of the coordinates.",
                  place_for(request));
  if (e.min_x < -180 || e.max_x > 360 || e.min_y < -90 || e.max_y > 90)
    throw SetupError(fmt::format(
        "{}: {} {} (degrees), but its coordinates are x {:.10g} to {:.10g}, y {:.10g} to {:.10g}, "
        "outside +-180/90. {}",
        request.label, source, crs_name(crs), e.min_x, e.max_x, e.min_y, e.max_y, advice));
  if (e.cell > largest_degree_cell)
    throw SetupError(
        fmt::format("{}: {} {} (degrees), but its cells are {:.6g} degrees wide, {:.0f} km. {}",
                    request.label, source, crs_name(crs), e.cell, e.cell * 111, advice));
}

}  // namespace

OGRSpatialReference parse_crs(const std::string& text, const std::string& key) {
  const GdalScope scope;
  OGRSpatialReference crs;
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  // A scenario must not make the program fetch or read other files through this text.
  const char* limits[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  if (crs.SetFromUserInput(text.c_str(), limits) != OGRERR_NONE)
    throw SetupError(fmt::format("{} = {}: not a coordinate system ({}). Write it like EPSG:32633.",
                                 key, text, gdal_reason("unknown text")));
  return crs;
}

std::string crs_name(const OGRSpatialReference& crs) {
  const char* name = crs.GetName();
  const char* authority = crs.GetAuthorityName(nullptr);
  const char* code = crs.GetAuthorityCode(nullptr);
  std::string text = name == nullptr ? "unnamed" : name;
  if (authority != nullptr && code != nullptr) text += fmt::format(" ({}:{})", authority, code);
  return text;
}

std::string crs_wkt2(const OGRSpatialReference& crs) {
  return crs.IsEmpty() ? "" : with_options(crs, "FORMAT=WKT2_2019");
}

OGRSpatialReference crs_from_wkt(const std::string& wkt) {
  if (!wkt.empty()) return parse_crs(wkt, "coordinate system of the grid");
  OGRSpatialReference none;
  none.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return none;
}

namespace {

int utm_zone(double longitude) {
  const double wrapped = longitude - 360 * std::floor((longitude + 180) / 360);
  return std::clamp(static_cast<int>(std::floor((wrapped + 180) / 6)) + 1, 1, 60);
}

}  // namespace

OGRSpatialReference best_metric_crs(double longitude, double latitude) {
  const bool north = latitude >= 0;
  int code = (north ? 32600 : 32700) + utm_zone(longitude);
  if (latitude > 84) code = 32661;
  if (latitude < -80) code = 32761;
  return parse_crs(fmt::format("EPSG:{}", code), "working coordinate system");
}

namespace {

void check_local(const OGRSpatialReference* own, const CrsRequest& request, std::string& note) {
  if (own == nullptr || own->IsEmpty()) return;
  const char* unit = nullptr;
  require(own->IsGeographic() || std::abs(own->GetLinearUnits(&unit) - 1) < 1e-9,
          fmt::format("{}: {} = local, but the unit of its own system {} is {} (local coordinates "
                      "are metres). Convert it, or leave the key out.",
                      request.label, request.override_key, crs_name(*own),
                      unit == nullptr ? "another one" : unit));
  if (own->IsLocal()) return;
  require(!own->IsGeographic() && !own->IsGeocentric(),
          fmt::format("{}: {} = local, but its own system {} counts in degrees (local coordinates "
                      "are metres). Reproject it, or leave the key out.",
                      request.label, request.override_key, crs_name(*own)));
  note = fmt::format("{}: its own system {} is left aside, because {} = local", request.label,
                     crs_name(*own), request.override_key);
}

OGRSpatialReference chosen_crs(const OGRSpatialReference* own, const CrsRequest& request,
                               std::string& note) {
  const bool has_own = own != nullptr && !own->IsEmpty();
  if (!request.override_text.empty()) {
    OGRSpatialReference crs = parse_crs(request.override_text, request.override_key);
    if (has_own && !own->IsSame(&crs))
      note = fmt::format("{}: its own system {} replaced by {} = {}", request.label, crs_name(*own),
                         request.override_key, crs_name(crs));
    return crs;
  }
  if (has_own) return *own;
  if (!request.fallback_text.empty()) {
    OGRSpatialReference crs = parse_crs(request.fallback_text, request.fallback_key);
    note = fmt::format("{}: has no coordinate system; taken to be in {} = {}", request.label,
                       request.fallback_key, crs_name(crs));
    return crs;
  }
  throw SetupError(
      fmt::format("{}: has no coordinate system (so the result could not be put on a map). Add "
                  "{}, the system of its coordinates{}.",
                  request.label, place_for(request), or_local(request)));
}

}  // namespace

SettledCrs settle_crs(const OGRSpatialReference* own, const CrsRequest& request,
                      const SourceExtent& extent, std::string& note) {
  SettledCrs settled;
  if (request.override_text == local_crs) {
    check_local(own, request, note);
    return settled;
  }
  settled.full = chosen_crs(own, request, note);
  settled.crs = settled.full;
  settled.crs.StripVertical();
  settled.crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  refuse_unusable(settled.crs, request);
  refuse_metres_as_degrees(settled.crs, request, extent);
  return settled;
}

MapScale map_scale(const OGRSpatialReference& crs, double x, double y, double step) {
  OGRSpatialReference degrees;
  degrees.CopyGeogCSFrom(&crs);
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const TransformPtr transform(OGRCreateCoordinateTransformation(&crs, &degrees));
  std::array<double, 3> xs{x, x + step, x}, ys{y, y, y + step};
  if (!transform || !transform->Transform(3, xs.data(), ys.data())) return {NAN, NAN};
  // Radii of curvature of the ellipsoid, along the meridian and across it.
  const double to_rad = std::numbers::pi / 180, a = crs.GetSemiMajor();
  const double flattening = crs.GetInvFlattening() == 0 ? 0 : 1 / crs.GetInvFlattening();
  const double e2 = flattening * (2 - flattening), s = std::sin(ys[0] * to_rad);
  const double across = a / std::sqrt(1 - e2 * s * s);
  const double along = across * (1 - e2) / (1 - e2 * s * s);
  const auto ground = [&](int i) {
    return std::hypot((ys[i] - ys[0]) * to_rad * along,
                      (xs[i] - xs[0]) * to_rad * across * std::cos(ys[0] * to_rad));
  };
  return {step / ground(1), step / ground(2)};
}

bool is_working_crs(const OGRSpatialReference& crs, double x, double y, double step,
                    std::string& reason) {
  if (crs.IsGeographic()) {
    reason = "its coordinates are degrees";
    return false;
  }
  const char* unit = nullptr;
  const double metres = crs.GetLinearUnits(&unit);
  if (std::abs(metres - 1) > 1e-9) {
    reason = fmt::format("its unit is {}", unit == nullptr ? "not the metre" : unit);
    return false;
  }
  const MapScale scale = map_scale(crs, x, y, step);
  const double worst =
      std::abs(scale.along_x - 1) > std::abs(scale.along_y - 1) ? scale.along_x : scale.along_y;
  // NaN: the place lies outside what the projection can invert; that too is no map to run on.
  if (!(std::abs(worst - 1) <= largest_scale_error)) {
    reason = fmt::format("lengths on this map are {:+.1f} % off the ground's", (worst - 1) * 100);
    return false;
  }
  return true;
}

bool names_a_datum(const OGRSpatialReference& crs) {
  const char* datum = crs.GetAttrValue("DATUM");
  std::string name = datum == nullptr ? "" : datum;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return c == '_' ? ' ' : std::tolower(c); });
  return !name.empty() && name.find("unknown") == std::string::npos &&
         name.find("not specified") == std::string::npos &&
         name.find("unnamed") == std::string::npos;
}

bool is_shift_known(const OGRSpatialReference& from, const OGRSpatialReference& to) {
  OGRCoordinateTransformationOptions strict;
  strict.SetBallparkAllowed(false);
  const TransformPtr known(OGRCreateCoordinateTransformation(&from, &to, strict));
  return known != nullptr;
}

OGRSpatialReference utm_on_own_datum(const OGRSpatialReference& crs, double longitude,
                                     double latitude) {
  OGRSpatialReference utm;
  utm.CopyGeogCSFrom(&crs);
  utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  utm.SetUTM(utm_zone(longitude), latitude >= 0 ? 1 : 0);
  return utm;
}

TransformPtr transform_between(const OGRSpatialReference& from, const OGRSpatialReference& to,
                               const std::string& label, std::string* warning) {
  if (from.IsEmpty() || to.IsEmpty() || from.IsSame(&to)) return nullptr;
  const bool known = is_shift_known(from, to);
  const bool both_named = names_a_datum(from) && names_a_datum(to);
  if (!known && (both_named || warning == nullptr))
    throw SetupError(fmt::format(
        "{}: cannot be moved from {} to {}: the shift between their datums is not known (places "
        "would be unsure by some 100 m). Transform it first with the parameters of your survey "
        "office, or name the system that its coordinates are really in.",
        label, crs_name(from), crs_name(to)));
  TransformPtr transform(OGRCreateCoordinateTransformation(&from, &to));
  if (!transform)
    throw SetupError(fmt::format("{}: cannot be moved from {} to {} ({}). Reproject it first.",
                                 label, crs_name(from), crs_name(to), gdal_reason()));
  if (!known)
    *warning = fmt::format(
        "{}: one of {} and {} names no datum; both are taken to have the same. If they have not, "
        "places are off by up to some 100 m",
        label, crs_name(from), crs_name(to));
  return transform;
}

}  // namespace sturz
