// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/release_pattern.hpp"

#include "engine/core/error.hpp"
#include "engine/core/sum.hpp"
#include "scenarios/assembly/slope.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace sturz {
namespace {

double volume_of(const Raster<double>& thickness) {
  Sum sum;
  for (const double h : thickness.values)
    if (h > 0) sum.add(h);
  return sum.value() * thickness.grid.cell_m * thickness.grid.cell_m;
}

/// What a pattern holds if its numbers count normal to the slope.
struct NormalReading {
  double vertical_m3 = 0, normal_m3 = 0;
  double steepest = 0;     ///< rise over run
  double steep_share = 0;  ///< of the vertical volume, on cells over 60 degrees
};

/// \param visit called with each cell that holds mass, and 1 / cos(slope) there
template <class Visit>
NormalReading read_as_normal(const Raster<double>& pattern, const Raster<double>& ground,
                             Visit visit) {
  NormalReading out;
  const Grid& g = pattern.grid;
  const PlaceOnGrid at(g, ground.grid);
  Sum vertical, normal, steep;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      const std::size_t cell = g.index(r, c);
      const double h = pattern.values[cell];
      if (!(h > 0)) continue;
      const double slope = gradient_at(ground, at.row + r, at.col + c).norm();
      const double stretch = std::sqrt(1 + slope * slope);
      vertical.add(h);
      normal.add(h * stretch);
      if (slope > std::numbers::sqrt3) steep.add(h);
      out.steepest = std::max(out.steepest, slope);
      visit(cell, stretch);
    }
  const double area = g.cell_m * g.cell_m;
  out.vertical_m3 = area * vertical.value();
  out.normal_m3 = area * normal.value();
  if (out.vertical_m3 > 0) out.steep_share = steep.value() / vertical.value();
  return out;
}

/// Whole cubic metres, or three digits of less than a hundred.
std::string volume_text(double m3) {
  return (m3 < 100 ? short_number(m3) : number_text(std::round(m3))) + " m3";
}

/// Both volumes where the scene fixes one of them; else the factor between them.
std::string readings_text(const ReleaseSpec& r, ReleasePattern kind, const NormalReading& reading) {
  const std::string factor = short_number(reading.normal_m3 / reading.vertical_m3);
  if (r.volume_m3)
    return "release.volume_m3 sets the volume; thicknesses normal to the slope alone would hold " +
           factor + " times that of vertical ones";
  double thickness = 1;
  if (kind == ReleasePattern::cover && r.thickness_m) {
    if (!r.thickness_m->is_fixed())
      return "normal to the slope, thicknesses hold " + factor +
             " times the volume of vertical ones";
    thickness = r.thickness_m->value;
  }
  return volume_text(thickness * reading.vertical_m3) + " with vertical thicknesses, " +
         volume_text(thickness * reading.normal_m3) + " with thicknesses normal to the slope";
}

void note_readings(const ReleaseSpec& r, const NormalReading& reading, SceneInputs& in) {
  std::string text = "release.thickness: " + std::string(to_string(r.thickness)) + "; " +
                     readings_text(r, in.pattern, reading);
  if (r.thickness == ThicknessDirection::normal && reading.steep_share > 0.01)
    text += "; " + short_number(100 * reading.steep_share) +
            " % of it lies on cells steeper than 60 degrees (up to " +
            short_number(std::atan(reading.steepest) * 180 / std::numbers::pi) +
            "), where the vertical thickness is more than twice the normal one: look at the map";
  in.notes.push_back(text);
}

/// The synthetic shapes bring thicknesses that are no measurements.
bool is_measured(const ReleaseSpec& r) {
  return !r.polygon.empty() || !r.thickness_raster.empty() || r.box || r.paraboloid || r.cylinder;
}

double greatest(const Raster<double>& thickness) {
  return *std::max_element(thickness.values.begin(), thickness.values.end());
}

void taper_floor(SceneInputs& in) {
  auto floor = std::make_shared<const Raster<double>>(tapered(*in.release, *in.elevation));
  const double share = volume_of(*floor) / volume_of(*in.release);
  in.notes.push_back("release.floor: tapered; greatest thickness " +
                     short_number(greatest(*floor) / greatest(*in.release)) +
                     " times that of the uniform floor, volume " +
                     number_text(std::round(1e8 * share) / 1e6) + " % of it");
  in.release = std::move(floor);
}

}  // namespace

void shape_release(const Scenario& s, SceneInputs& in) {
  const ReleaseSpec& r = s.release;
  const bool normal = r.thickness == ThicknessDirection::normal;
  std::shared_ptr<Raster<double>> stretched;
  if (normal) stretched = std::make_shared<Raster<double>>(*in.release);
  const NormalReading reading =
      read_as_normal(*in.release, *in.elevation, [&](std::size_t cell, double stretch) {
        if (normal) stretched->values[cell] *= stretch;
      });
  if (!(reading.vertical_m3 > 0)) return;  // refused where it is filled
  in.normal_over_vertical = reading.normal_m3 / reading.vertical_m3;
  if (normal || (is_measured(r) && in.normal_over_vertical > 1.01)) note_readings(r, reading, in);
  if (normal) {
    in.release = stretched;
    in.source_volume_m3 *= in.normal_over_vertical;
  }
  if (r.floor == ReleaseFloor::tapered) taper_floor(in);
}

Raster<double> release_thickness(const ReleaseSpec& spec, const SceneInputs& in) {
  Raster<double> thickness = *in.release;
  double scale = 1;
  if (in.pattern == ReleasePattern::cover && spec.thickness_m) scale = spec.thickness_m->value;
  if (spec.volume_m3) {
    double sum = 0;
    for (double h : thickness.values)
      if (h > 0) sum += h;
    const double volume = sum * thickness.grid.cell_m * thickness.grid.cell_m;
    require(volume > 0, "release: the source covers no cell. Check that it lies on the terrain.");
    scale = spec.volume_m3->value / volume;
  }
  for (double& h : thickness.values) h = h > 0 ? h * scale : 0;
  return thickness;
}

}  // namespace sturz
