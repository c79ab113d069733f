// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf/cf_grid_mapping.hpp"

#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <cstring>

namespace sturz {
namespace {

/// How one projection of GDAL is called in CF, and its parameters: CF name, GDAL name.
struct Projection {
  const char* gdal;
  const char* cf;
  std::vector<std::array<const char*, 2>> parameters;
};

const std::vector<Projection>& projections() {
  static const std::vector<Projection> table{
      {SRS_PT_TRANSVERSE_MERCATOR,
       "transverse_mercator",
       {{"scale_factor_at_central_meridian", SRS_PP_SCALE_FACTOR},
        {"longitude_of_central_meridian", SRS_PP_CENTRAL_MERIDIAN},
        {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_ORIGIN}}},
      {SRS_PT_LAMBERT_CONFORMAL_CONIC_2SP,
       "lambert_conformal_conic",
       {{"longitude_of_central_meridian", SRS_PP_CENTRAL_MERIDIAN},
        {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_ORIGIN}}},
      {SRS_PT_ALBERS_CONIC_EQUAL_AREA,
       "albers_conical_equal_area",
       {{"longitude_of_central_meridian", SRS_PP_LONGITUDE_OF_CENTER},
        {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_CENTER}}},
      {SRS_PT_LAMBERT_AZIMUTHAL_EQUAL_AREA,
       "lambert_azimuthal_equal_area",
       {{"longitude_of_projection_origin", SRS_PP_LONGITUDE_OF_CENTER},
        {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_CENTER}}},
      {SRS_PT_AZIMUTHAL_EQUIDISTANT,
       "azimuthal_equidistant",
       {{"longitude_of_projection_origin", SRS_PP_LONGITUDE_OF_CENTER},
        {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_CENTER}}},
      {SRS_PT_OBLIQUE_STEREOGRAPHIC,
       "stereographic",
       {{"longitude_of_projection_origin", SRS_PP_CENTRAL_MERIDIAN},
        {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_ORIGIN},
        {"scale_factor_at_projection_origin", SRS_PP_SCALE_FACTOR}}},
      {SRS_PT_HOTINE_OBLIQUE_MERCATOR_AZIMUTH_CENTER,
       "oblique_mercator",
       {{"azimuth_of_central_line", SRS_PP_AZIMUTH},
        {"longitude_of_projection_origin", SRS_PP_LONGITUDE_OF_CENTER},
        {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_CENTER},
        {"scale_factor_at_projection_origin", SRS_PP_SCALE_FACTOR}}},
  };
  return table;
}

/// The latitude of a polar system is its pole (with a scale factor) or its true-scale parallel.
void add_polar_stereographic(const OGRSpatialReference& crs, GridMapping& mapping) {
  const double latitude = crs.GetNormProjParm(SRS_PP_LATITUDE_OF_ORIGIN, 90);
  mapping.texts.emplace_back("grid_mapping_name", "polar_stereographic");
  mapping.numbers.push_back(
      {"straight_vertical_longitude_from_pole", {crs.GetNormProjParm(SRS_PP_CENTRAL_MERIDIAN)}});
  mapping.numbers.push_back({"latitude_of_projection_origin", {latitude > 0 ? 90.0 : -90.0}});
  if (std::abs(std::abs(latitude) - 90) < 1e-9)
    mapping.numbers.push_back(
        {"scale_factor_at_projection_origin", {crs.GetNormProjParm(SRS_PP_SCALE_FACTOR, 1)}});
  else
    mapping.numbers.push_back({"standard_parallel", {latitude}});
}

void add_projection(const OGRSpatialReference& crs, GridMapping& mapping) {
  const char* name = crs.GetAttrValue("PROJECTION");
  if (name == nullptr) return;
  if (std::strcmp(name, SRS_PT_POLAR_STEREOGRAPHIC) == 0) {
    add_polar_stereographic(crs, mapping);
  } else {
    const Projection* known = nullptr;
    for (const auto& p : projections())
      if (std::strcmp(p.gdal, name) == 0) known = &p;
    if (known == nullptr) return;
    mapping.texts.emplace_back("grid_mapping_name", known->cf);
    for (const auto& [cf, gdal] : known->parameters)
      mapping.numbers.push_back({cf, {crs.GetNormProjParm(gdal, 0)}});
    if (crs.FindProjParm(SRS_PP_STANDARD_PARALLEL_2) >= 0)
      mapping.numbers.push_back({"standard_parallel",
                                 {crs.GetNormProjParm(SRS_PP_STANDARD_PARALLEL_1),
                                  crs.GetNormProjParm(SRS_PP_STANDARD_PARALLEL_2)}});
  }
  mapping.numbers.push_back({"false_easting", {crs.GetProjParm(SRS_PP_FALSE_EASTING)}});
  mapping.numbers.push_back({"false_northing", {crs.GetProjParm(SRS_PP_FALSE_NORTHING)}});
}

void add_name(const OGRSpatialReference& crs, const char* node, const char* attribute,
              GridMapping& mapping) {
  if (const char* value = crs.GetAttrValue(node)) mapping.texts.emplace_back(attribute, value);
}

}  // namespace

GridMapping cf_grid_mapping(const OGRSpatialReference& crs) {
  GridMapping mapping;
  add_projection(crs, mapping);
  mapping.numbers.push_back({"semi_major_axis", {crs.GetSemiMajor()}});
  mapping.numbers.push_back({"inverse_flattening", {crs.GetInvFlattening()}});
  mapping.numbers.push_back({"longitude_of_prime_meridian", {crs.GetPrimeMeridian()}});
  add_name(crs, "PROJCS", "projected_crs_name", mapping);
  add_name(crs, "GEOGCS", "geographic_crs_name", mapping);
  add_name(crs, "DATUM", "horizontal_datum_name", mapping);
  add_name(crs, "SPHEROID", "reference_ellipsoid_name", mapping);
  add_name(crs, "PRIMEM", "prime_meridian_name", mapping);
  mapping.texts.emplace_back("crs_wkt", crs_wkt2(crs));
  return mapping;
}

}  // namespace sturz
