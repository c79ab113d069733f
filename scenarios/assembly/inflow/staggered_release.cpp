// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/inflow/staggered_release.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>

namespace sturz {
namespace {

void append(const Release& part, Release& all) {
  const auto add = [](const std::vector<double>& from, std::vector<double>& to) {
    to.insert(to.end(), from.begin(), from.end());
  };
  add(part.x, all.x), add(part.y, all.y), add(part.z, all.z), add(part.mass, all.mass);
  add(part.depth, all.depth), add(part.thickness, all.thickness), add(part.covered, all.covered);
}

Raster<double> times(Raster<double> values, const Raster<double>& share) {
  expect(values.values.size() == share.values.size(), "parts lie on the cells of the pattern");
  for (std::size_t i = 0; i < values.values.size(); ++i) values.values[i] *= share.values[i];
  return values;
}

bool holds_any(const Raster<double>& thickness) {
  return std::any_of(thickness.values.begin(), thickness.values.end(),
                     [](double h) { return h > 0; });
}

}  // namespace

StaggeredRelease staggered_release(const Scenario& s, const SceneInputs& in, const Terrain& bed,
                                   const Raster<double>& thickness,
                                   const ReleaseSettings& settings) {
  StaggeredRelease out;
  if (!s.inflow.empty() && !holds_any(thickness)) return out;
  out.all = release_particles(bed, thickness, settings, in.release_cover.get());
  const double shift = s.release.start_time_s ? s.release.start_time_s->value : 0;
  if (in.release_starts.empty()) {
    if (shift > 0) out.start_s.assign(out.all.x.size(), shift);
  } else {
    Release parts = out.all;  // volume, area and the like are those of the whole
    for (auto* column : {&parts.x, &parts.y, &parts.z, &parts.mass, &parts.depth, &parts.thickness,
                         &parts.covered})
      column->clear();
    for (const ReleaseStart& start : in.release_starts) {
      const Raster<double> own = times(thickness, *start.share);
      if (!holds_any(own)) continue;
      const Raster<double> cover =
          in.release_cover ? times(*in.release_cover, *start.share) : Raster<double>();
      append(release_particles(bed, own, settings, in.release_cover ? &cover : nullptr), parts);
      out.start_s.resize(parts.x.size(), shift + start.start_s);
    }
    out.all = std::move(parts);
  }
  out.n_present =
      out.start_s.empty()
          ? out.all.x.size()
          : static_cast<std::size_t>(std::upper_bound(out.start_s.begin(), out.start_s.end(), 0.0) -
                                     out.start_s.begin());
  return out;
}

std::vector<TimedArrival> later_columns(const StaggeredRelease& r, const Scenario& s,
                                        const Terrain& bed) {
  std::vector<TimedArrival> columns;
  columns.reserve(r.n_later());
  const auto& given = s.release.velocity_m_s;
  for (std::size_t i = r.n_present; i < r.all.x.size(); ++i) {
    TimedArrival c;
    c.time_s = r.start_s[i];
    Arrival& a = c.arrival;
    a.position = Vec3(r.all.x[i], r.all.y[i], r.all.z[i]);
    const CurvedSurface g = bed.curved(r.all.x[i], r.all.y[i]);
    const Vec3 up(-g.east, -g.north, 1), v(given[0], given[1], given[2]);
    a.velocity = v - v.dot(up) / up.squaredNorm() * up;
    a.mass = r.all.mass[i];
    a.thickness = r.all.thickness[i];
    a.covered = r.all.covered[i];
    a.released = true;
    columns.push_back(c);
  }
  return columns;
}

std::string later_text(const std::vector<TimedArrival>& later, const Scenario& s,
                       double bulk_density) {
  double mass = 0;
  for (const TimedArrival& c : later) mass += c.arrival.mass;
  const double first = later.front().time_s, last = later.back().time_s;
  return std::string(s.release.start_time_attribute.empty() ? "`release.start_time_s`: "
                                                            : "`release.start_time_attribute`: ") +
         short_number(mass / bulk_density) + " m3 start " +
         (first == last ? "at " + short_number(first)
                        : "between " + short_number(first) + " and " + short_number(last)) +
         " s";
}

}  // namespace sturz
