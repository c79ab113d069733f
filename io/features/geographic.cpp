// SPDX-License-Identifier: Apache-2.0
#include "io/features/geographic.hpp"

#include "engine/core/error.hpp"
#include "io/files/io_error.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cstring>

namespace sturz {
namespace {

constexpr int points_per_edge = 8;

OGRSpatialReference degrees() {
  OGRSpatialReference system;
  system.SetWellKnownGeogCS("WGS84");
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return system;
}

}  // namespace

class Geographic::Parts {
 public:
  explicit Parts(const std::string& crs_wkt) {
    const GdalScope scope;
    const OGRSpatialReference from = crs_from_wkt(crs_wkt);
    if (!from.IsProjected() && !from.IsGeographic()) return;
    std::string warning;  // that the datum is taken for WGS 84, where it has no name
    try {
      transform_ = transform_between(from, degrees(), "the maps", &warning);
      known_ = true;
    } catch (const SetupError&) {
      // The Moon, Mars, or a datum whose shift is not known: maps are right without degrees.
    }
  }
  bool known() const { return known_; }
  void transform(std::vector<double>& x, std::vector<double>& y) const {
    if (transform_ == nullptr) return;  // degrees already
    const GdalScope scope;
    if (!transform_->Transform(static_cast<int>(x.size()), x.data(), y.data()))
      throw IoError(fmt::format("the map cannot be placed in degrees ({}).", gdal_reason()));
  }

 private:
  TransformPtr transform_;
  bool known_ = false;
};

Geographic::Geographic(const std::string& crs_wkt) : parts_(std::make_unique<Parts>(crs_wkt)) {}
Geographic::~Geographic() = default;
bool Geographic::is_known() const { return parts_->known(); }
void Geographic::transform(std::vector<double>& x, std::vector<double>& y) const {
  parts_->transform(x, y);
}

std::vector<Vec2> geographic_outline(const Grid& grid) {
  const Geographic place(grid.crs_wkt);
  if (!place.is_known()) return {};
  const Vec2 corners[] = {{grid.west_m, grid.south_m()},
                          {grid.east_m(), grid.south_m()},
                          {grid.east_m(), grid.north_m},
                          {grid.west_m, grid.north_m}};
  std::vector<double> x, y;
  for (int edge = 0; edge < 4; ++edge)
    for (int i = 0; i < points_per_edge; ++i) {
      const double t = static_cast<double>(i) / points_per_edge;
      const Vec2 at = (1 - t) * corners[edge] + t * corners[(edge + 1) % 4];
      x.push_back(at.x()), y.push_back(at.y());
    }
  try {
    place.transform(x, y);
  } catch (const IoError&) {
    return {};  // the projection has no degrees for some of it
  }
  std::vector<Vec2> ring;
  for (std::size_t i = 0; i < x.size(); ++i) ring.emplace_back(x[i], y[i]);
  ring.push_back(ring.front());
  return ring;
}

std::optional<int> epsg_code(const std::string& crs_wkt) {
  const GdalScope scope;
  const OGRSpatialReference system = crs_from_wkt(crs_wkt);
  const char* authority = system.GetAuthorityName(nullptr);
  const char* code = system.GetAuthorityCode(nullptr);
  if (authority == nullptr || code == nullptr || std::string(authority) != "EPSG") return {};
  int number = 0;
  const char* end = code + std::strlen(code);
  const auto read = std::from_chars(code, end, number);
  if (read.ec != std::errc() || read.ptr != end) return {};
  return number;
}

}  // namespace sturz
