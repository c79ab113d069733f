// SPDX-License-Identifier: Apache-2.0
#include "engine/particles/release.hpp"

#include "engine/core/error.hpp"
#include "engine/core/random.hpp"
#include "engine/core/sum.hpp"
#include "engine/particles/release_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace sturz {
namespace {

/// Columns thinner than this many spacings carry no particle of their own.
constexpr double thinnest = 0.2;
/// Or, as depth-averaged columns, than this part of the median thickness.
constexpr double thinnest_column = 0.01;
constexpr std::size_t most_particles = std::size_t{1} << 31;

double volume_median(std::vector<ReleaseColumn> columns) {
  std::sort(columns.begin(), columns.end(),
            [](const auto& a, const auto& b) { return a.thickness_m < b.thickness_m; });
  double half = 0;
  for (const auto& c : columns) half += 0.5 * c.thickness_m;
  double below = 0;
  for (const auto& c : columns)
    if ((below += c.thickness_m) >= half) return c.thickness_m;
  return 0;
}

/// Offsets of a stack's lowest and highest particle above the bed.
///
/// The even stack h/k (1/2, 3/2, ...) would put the lowest particle nearer to the bed than the
/// contact distance dx/2 wherever the layers are thinner than dx or the bed is inclined (vertical
/// dx/2 is dx/2 n_z along the normal): the contact spring would start compressed and throw the
/// mass up. So the lowest starts at contact distance, the highest keeps its position, and the
/// masses, which carry the volume, stay as they are.
struct Stack {
  double first, last;
  Stack(double thickness, std::size_t k, double spacing, double normal_z)
      : first(std::max(0.5 * thickness / k, 0.5 * spacing / normal_z)),
        last(std::max(first, thickness - 0.5 * thickness / k)) {}
  double offset(std::size_t layer, std::size_t k) const {
    return k == 1 ? first : first + (last - first) * layer / (k - 1);
  }
};

class ParticleWriter {
 public:
  ParticleWriter(const Terrain& bed, const ReleaseSettings& s, Release& out)
      : bed_(bed), settings_(s), out_(out) {}

  void deposit(const ReleaseColumn& c) { deposit({c, 0, 0}, c.thickness_m); }
  void deposit(const UpperColumn& upper, double thickness) {
    const ReleaseColumn& c = upper.column;
    const double dx = settings_.spacing_m, base = upper.base_m;
    const double x = (c.lattice_x + 0.5) * dx, y = (c.lattice_y + 0.5) * dx;
    require(bed_.inside(x, y),
            "release: the column at x = " + std::to_string(x) + ", y = " + std::to_string(y) +
                " lies outside the known terrain (nodata or beyond its edge, so there is no bed). "
                "Move the release or use a larger terrain.");
    if (settings_.columns) return place_column(c, x, y);
    const std::size_t k = layers_of(thickness, dx);
    constexpr double no_bed = std::numeric_limits<double>::infinity();
    const Stack stack(thickness, k, dx, base > 0 ? no_bed : bed_.surface(x, y).normal.z());
    const double mass = settings_.bulk_density_kg_m3 * c.thickness_m * dx * dx / k;
    for (std::size_t layer = 0; layer < k; ++layer) {
      const Vec3 p = place(c, upper.first_layer + layer, x, y, base + stack.offset(layer, k));
      out_.x.push_back(p.x());
      out_.y.push_back(p.y());
      out_.z.push_back(p.z());
      out_.mass.push_back(mass);
      out_.depth.push_back(std::max(0.0, bed_.height(p.x(), p.y()) + base + thickness - p.z()));
      out_.thickness.push_back(thickness);
      out_.covered.push_back(c.covered);
    }
  }

 private:
  void place_column(const ReleaseColumn& c, double x, double y) const {
    const Vec3 p = jittered(c, 0, x, y, 0, 0);
    out_.x.push_back(p.x());
    out_.y.push_back(p.y());
    out_.z.push_back(p.z());
    out_.mass.push_back(settings_.bulk_density_kg_m3 * c.thickness_m * settings_.spacing_m *
                        settings_.spacing_m);
    out_.depth.push_back(0.5 * c.thickness_m);
    out_.thickness.push_back(c.thickness_m);
    out_.covered.push_back(c.covered);
  }

  /// A jittered point above the bed, counted by its index on the lattice so that the same particle
  /// gets the same jitter whatever the extent of the release.
  Vec3 place(const ReleaseColumn& c, std::size_t layer, double x, double y, double offset) const {
    Vec3 p = jittered(c, layer, x, y, offset, settings_.jitter * settings_.spacing_m);
    lift_off_bed(p);
    return p;
  }

  /// \param vertical  amplitude of the vertical jitter [m]
  Vec3 jittered(const ReleaseColumn& c, std::size_t layer, double x, double y, double offset,
                double vertical) const {
    const auto member = static_cast<std::uint64_t>(settings_.member);
    const RandomWords w =
        random_words(settings_.seed, {static_cast<std::uint32_t>(c.lattice_x),
                                      static_cast<std::uint32_t>(c.lattice_y),
                                      static_cast<std::uint32_t>(layer ^ (member >> 32 << 16)),
                                      static_cast<std::uint32_t>(member)});
    const double amplitude = settings_.jitter * settings_.spacing_m;
    auto jitter = [&](std::uint32_t word) { return 2 * unit_from(word) - 1; };
    const double dx = amplitude * jitter(w[0]), dy = amplitude * jitter(w[1]);
    if (bed_.inside(x + dx, y + dy)) x += dx, y += dy;
    return {x, y, bed_.height(x, y) + offset + vertical * jitter(w[2])};
  }

  /// Raises a point to the contact distance. On curved ground the distance grows by less than
  /// n_z per metre raised, hence the repetition.
  void lift_off_bed(Vec3& p) const {
    const double contact = 0.5 * settings_.spacing_m;
    for (int i = 0; i < 20; ++i) {
      const SurfaceDistance d = bed_.distance(p, contact);
      if (d.distance >= contact) return;
      p.z() += (contact - d.distance) / std::max(0.1, d.normal.z()) + 1e-12 * contact;
    }
  }

  const Terrain& bed_;
  const ReleaseSettings& settings_;
  Release& out_;
};

void find_crown(const Terrain& bed, const Raster<double>& thickness, const CellExtent& cells,
                Release& out) {
  const Grid& g = thickness.grid;
  out.crown_z_m = -std::numeric_limits<double>::infinity();
  for (int r = cells.row0; r <= cells.row1; ++r)
    for (int c = cells.col0; c <= cells.col1; ++c) {
      const double h = thickness.at(r, c);
      if (!(h >= thinnest_column * out.median_thickness_m)) continue;
      const double x = g.x_center(c), y = g.y_center(r), z = bed.height(x, y) + h;
      if (z > out.crown_z_m) out.crown_x_m = x, out.crown_y_m = y, out.crown_z_m = z;
    }
}

void scale_to(double total, std::vector<double>& mass) {
  Sum sum;
  for (double m : mass) sum.add(m);
  const double factor = total / sum.value();
  for (double& m : mass) m *= factor;
}

}  // namespace

Release release_particles(const Terrain& bed, const Raster<double>& thickness,
                          const ReleaseSettings& s, const Raster<double>* cover) {
  require(s.spacing_m > 0 && std::isfinite(s.spacing_m) && s.bulk_density_kg_m3 > 0,
          "release: spacing and bulk density must be positive (they give a particle its volume). "
          "Check numerics.spacing_m and the grains' density.");
  require(
      s.jitter >= 0 && s.jitter < 0.5,
      "release: the jitter must be in 0..0.5 spacings (more would swap lattice positions). Check "
      "numerics.jitter.");
  const ReleaseColumns columns = release_columns(thickness, s.spacing_m, cover);
  Release out;
  out.volume_m3 = columns.volume_m3;
  out.area_m2 = columns.area_m2;
  out.max_thickness_m = columns.max_thickness_m;
  out.median_thickness_m = volume_median(columns.columns);
  out.layers = out.median_thickness_m / s.spacing_m;
  find_crown(bed, thickness, columns.cells, out);

  const double least =
      s.columns ? thinnest_column * out.median_thickness_m : thinnest * s.spacing_m;
  const auto kept = [&](const ReleaseColumn& c) { return c.thickness_m >= least; };
  std::size_t n = 0;
  Sum dropped, all;
  for (const auto& c : columns.columns) {
    (kept(c) ? all : dropped).add(c.thickness_m);
    if (kept(c)) n += s.columns ? 1 : layers_of(c.thickness_m, s.spacing_m);
  }
  require(n > 0, "release: no column is thicker than " + std::to_string(thinnest * s.spacing_m) +
                     " m (0.2 spacings, so no particle would be made). Choose a smaller "
                     "numerics.spacing_m or check the thickness.");
  require(n < most_particles,
          "release: more than 2e9 particles (particles are numbered with 32 "
          "bits). Choose a larger numerics.spacing_m.");
  out.dropped_fraction = dropped.value() / (dropped.value() + all.value());
  for (auto* column : {&out.x, &out.y, &out.z, &out.mass, &out.depth, &out.thickness, &out.covered})
    column->reserve(n);
  ParticleWriter writer(bed, s, out);
  for (const auto& c : columns.columns)
    if (kept(c)) writer.deposit(c);
  scale_to(s.bulk_density_kg_m3 * out.volume_m3, out.mass);
  return out;
}

std::size_t layers_of(double thickness_m, double spacing_m) {
  return static_cast<std::size_t>(std::max(1.0, std::round(thickness_m / spacing_m)));
}

Release fill_columns(const Terrain& bed, const std::vector<UpperColumn>& columns,
                     const ReleaseSettings& s, double volume_m3) {
  Release out;
  out.volume_m3 = volume_m3;
  ParticleWriter writer(bed, s, out);
  for (const UpperColumn& c : columns) {
    const double thickness = c.column.thickness_m / c.column.covered;
    out.max_thickness_m = std::max(out.max_thickness_m, thickness);
    writer.deposit(c, thickness);
  }
  if (!out.x.empty()) scale_to(s.bulk_density_kg_m3 * volume_m3, out.mass);
  return out;
}

}  // namespace sturz
