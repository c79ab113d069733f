// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/inflow/source_geometry.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz {
namespace {

/// Rise over run below which the ground says no direction.
constexpr double level_slope = 1e-3;
/// Of the golden ratio, and of its twin in two dimensions: sequences whose members keep off each
/// other whatever part of them one takes (Roberts 2018).
constexpr double golden = 0.6180339887498949, plastic_x = 0.7548776662466927,
                 plastic_y = 0.5698402909980532;

double fraction(double v) { return v - std::floor(v); }

Vec2 slope_at(const Terrain& bed, const Vec2& at, const std::string& label) {
  require(bed.inside(at.x(), at.y()), label + ": enters where the ground is not known (x " +
                                          number_text(at.x()) + ", y " + number_text(at.y()) +
                                          "). Move it or fill the terrain there.");
  const CurvedSurface g = bed.curved(at.x(), at.y());
  return {g.east, g.north};
}

}  // namespace

SourceGeometry::SourceGeometry(const InflowSource& source, const Terrain& bed,
                               std::optional<double> direction_deg) {
  std::optional<Vec2> way;
  if (direction_deg) {
    const double angle = *direction_deg * std::numbers::pi / 180;
    way = Vec2(std::sin(angle), std::cos(angle));
  }
  if (source.rings.empty())
    take_lines(source, bed, way);
  else
    take_rings(source, bed, way);
}

/// Each part of a line flows to the side on which the ground falls along it as a whole.
void SourceGeometry::take_lines(const InflowSource& source, const Terrain& bed,
                                std::optional<Vec2> way) {
  double rise = 0;
  for (const auto& corners : source.lines) {
    double fall = 0, length = 0;  // to the left of it
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const Vec2 along = corners[i + 1] - corners[i];
      const Vec2 slope = slope_at(bed, 0.5 * (corners[i] + corners[i + 1]), source.label);
      fall -= slope.dot(Vec2(-along.y(), along.x()));
      length += along.norm();
    }
    require(way || std::abs(fall) > level_slope * length,
            source.label +
                ": the ground below its line is level (which way does it flow?). Give "
                "direction_deg.");
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const Vec2 along = corners[i + 1] - corners[i];
      if (!(along.norm() > 0)) continue;
      const Vec2 across = Vec2(-along.y(), along.x()).normalized();
      Stretch s{corners[i], corners[i + 1], way ? *way : Vec2(fall > 0 ? across : Vec2(-across)),
                0};
      const double width = along.norm() * std::abs(across.dot(s.way));
      rise += width * slope_at(bed, 0.5 * (corners[i] + corners[i + 1]), source.label).dot(s.way);
      s.until = width_ += width;
      stretches_.push_back(s);
    }
  }
  require(width_ > 0, source.label +
                          ": direction_deg points along its line (no width is left to enter "
                          "across). Turn one of them.");
  level_ = 1 / std::hypot(1.0, rise / width_);
}

void SourceGeometry::take_rings(const InflowSource& source, const Terrain& bed,
                                std::optional<Vec2> way) {
  rings_ = source.rings;
  Vec2 high(-1e300, -1e300);
  low_ = {1e300, 1e300};
  for (const auto& ring : rings_)
    for (const Vec2& p : ring) low_ = low_.cwiseMin(p), high = high.cwiseMax(p);
  size_ = high - low_;
  Vec2 slope(0, 0);
  constexpr std::size_t samples = 64;
  for (std::size_t k = 0; k < samples; ++k)
    slope += slope_at(bed, place_in_polygon(k, 0).at, source.label) / samples;
  next_ = tried_ = 0;
  require(way || slope.norm() > level_slope,
          source.label +
              ": the ground below its polygon is level (which way does it flow?). Give "
              "direction_deg.");
  way_ = way ? *way : Vec2(-slope.normalized());
  double least = 1e300, most = -1e300;
  for (const auto& ring : rings_)
    for (const Vec2& p : ring) {
      const double across = p.dot(Vec2(-way_.y(), way_.x()));
      least = std::min(least, across), most = std::max(most, across);
    }
  width_ = most - least;
  level_ = 1 / std::hypot(1.0, slope.dot(way_));
}

bool SourceGeometry::inside(const Vec2& p) const {
  bool in = false;
  for (const auto& ring : rings_)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Vec2 &a = ring[i], &b = ring[j];
      if ((a.y() > p.y()) != (b.y() > p.y()) &&
          p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
        in = !in;
    }
  return in;
}

/// The sequence goes on in the rectangle around it; what falls beside it is passed over.
SourceGeometry::Place SourceGeometry::place_in_polygon(std::size_t k, double offset) {
  expect(k == next_, "columns of a polygon are placed one after the other");
  ++next_;
  for (constexpr std::size_t most = 100000; tried_ < most * next_;) {
    ++tried_;
    const auto n = static_cast<double>(tried_);
    const Vec2 p = low_ + Vec2(fraction(offset + n * plastic_x) * size_.x(),
                               fraction(offset + n * plastic_y) * size_.y());
    if (inside(p)) return {p, way_};
  }
  throw SetupError(
      "inflow: its polygon covers next to nothing of the rectangle around it. Draw it "
      "wider.");
}

SourceGeometry::Place SourceGeometry::place(std::size_t k, double offset) {
  if (!rings_.empty()) return place_in_polygon(k, offset);
  const double across = fraction(offset + static_cast<double>(k) * golden) * width_;
  auto s = std::find_if(stretches_.begin(), stretches_.end(),
                        [&](const Stretch& each) { return across < each.until; });
  if (s == stretches_.end()) --s;
  const double from = s == stretches_.begin() ? 0 : std::prev(s)->until;
  const double share = s->until > from ? (across - from) / (s->until - from) : 0;
  return {s->from + share * (s->to - s->from), s->way};
}

}  // namespace sturz
