// SPDX-License-Identifier: Apache-2.0
#include "engine/particles/grain_packing.hpp"

#include "engine/core/error.hpp"
#include "engine/core/random.hpp"
#include "engine/core/sum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

namespace sturz {
namespace {

/// A free place on the lattice.
struct Place {
  double level = 0;  ///< above the lowest, over the local thickness
  std::int32_t row = 0, col = 0, layer = 0;
  Vec3 at{0, 0, 0};
  double depth = 0, thickness = 0;  ///< [m]

  auto order() const { return std::tie(row, col, layer); }
};

/// Thickness of the cell below; 0 off the raster.
double thickness_at(const Raster<double>& t, double x, double y) {
  const int row = t.grid.row_of(y), col = t.grid.col_of(x);
  if (!t.grid.contains(row, col)) return 0;
  const double h = t.at(row, col);
  return h > 0 ? h : 0;
}

/// Hexagonal close packing opened to `fill`: nearest distance a, rows a sqrt(3)/2, layers
/// a sqrt(2/3).
class Lattice {
 public:
  Lattice(const GrainPacking& packing, const Raster<double>& thickness) : raster_(thickness) {
    const double d3 = std::pow(packing.diameter_m, 3) * std::numbers::pi / 6;
    fill_ = std::min(packing.solid_fraction, densest_fill);
    a_ = std::cbrt(std::numbers::sqrt2 * d3 / fill_);
    swelling_ = packing.solid_fraction / fill_;
    radius_ = 0.5 * packing.diameter_m;
    const RandomWords w = random_words(packing.seed, {0xffffffffU, 0xffffffffU, 0xffffffffU,
                                                      static_cast<std::uint32_t>(packing.member)});
    phase_ = {a_ * unit_from(w[0]), a_ * unit_from(w[1]), a_ * unit_from(w[2])};
    // Where the release lies: the lattice need not cover the whole raster.
    const Grid& g = thickness.grid;
    int row0 = g.n_rows, row1 = -1, col0 = g.n_cols, col1 = -1;
    for (int r = 0; r < g.n_rows; ++r)
      for (int c = 0; c < g.n_cols; ++c)
        if (thickness.at(r, c) > 0)
          row0 = std::min(row0, r), row1 = std::max(row1, r), col0 = std::min(col0, c),
          col1 = std::max(col1, c);
    west_ = g.west_m + col0 * g.cell_m, east_ = g.west_m + (col1 + 1) * g.cell_m;
    south_ = g.north_m - (row1 + 1) * g.cell_m, north_ = g.north_m - row0 * g.cell_m;
  }
  double spacing() const { return a_; }

  /// All places up to `level` times the local thickness.
  std::vector<Place> places(const Terrain& bed, double level) const {
    std::vector<Place> out;
    const double row_m = a_ * std::numbers::sqrt3 / 2;
    const auto n_rows = static_cast<std::int32_t>((north_ - south_) / row_m) + 3;
    const auto n_cols = static_cast<std::int32_t>((east_ - west_) / a_) + 3;
    for (std::int32_t row = -2; row < n_rows; ++row)
      for (std::int32_t col = -2; col < n_cols; ++col)
        for (const int odd : {0, 1}) {  // layers of one kind stand above each other
          const double x = west_ + phase_.x() + a_ * (col + 0.5 * ((row + odd) & 1));
          const double y = south_ + phase_.y() + row_m * (row + odd / 3.0);
          stand(bed, level, row, col, odd, x, y, out);
        }
    return out;
  }

 private:
  void stand(const Terrain& bed, double level, std::int32_t row, std::int32_t col, int odd,
             double x, double y, std::vector<Place>& out) const {
    const double h = thickness_at(raster_, x, y);
    if (!(h > 0) || !bed.inside(x, y)) return;
    const SurfacePoint s = bed.surface(x, y);
    const double lowest = s.z + radius_ / s.normal.z(), swollen = swelling_ * h;
    const double layer_m = a_ * std::sqrt(2.0 / 3);
    auto layer = static_cast<std::int32_t>(std::ceil((lowest - phase_.z()) / layer_m));
    if (((layer & 1) != 0) != (odd == 1)) ++layer;
    for (;; layer += 2) {
      const Vec3 at(x, y, phase_.z() + layer * layer_m);
      const double above = at.z() - lowest;
      if (above > level * swollen) return;
      if (bed.distance(at, radius_).distance < radius_) continue;
      out.push_back(
          {above / swollen, row, col, layer, at, std::max(0.0, s.z + swollen - at.z()), h});
    }
  }

  const Raster<double>& raster_;
  double fill_ = 1, a_ = 1, swelling_ = 1, radius_ = 0.5;
  Vec3 phase_{0, 0, 0};
  double west_ = 0, east_ = 0, south_ = 0, north_ = 0;
};

/// The n lowest places, in the order of the lattice.
std::vector<Place> lowest_places(const Terrain& bed, const Lattice& lattice, std::size_t n) {
  std::vector<Place> all;
  for (double level = 1.5; level < 50 && all.size() < n; level *= 2)
    all = lattice.places(bed, level);
  require(all.size() >= n, "release: its " + std::to_string(n) +
                               " grains find no place (it is thinner than a grain). Use a smaller "
                               "grains.discrete.diameter_m.");
  const auto lower = [](const Place& p, const Place& q) {
    return p.level != q.level ? p.level < q.level : p.order() < q.order();
  };
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n - 1), all.end(), lower);
  all.resize(n);
  std::sort(all.begin(), all.end(),
            [](const Place& p, const Place& q) { return p.order() < q.order(); });
  return all;
}

}  // namespace

double grains_in(double volume_m3, const GrainPacking& p) {
  return volume_m3 * p.solid_fraction * 6 / (std::numbers::pi * std::pow(p.diameter_m, 3));
}

void pack_grains(const Terrain& bed, const Raster<double>& thickness, const GrainPacking& packing,
                 Release& out) {
  const double number = grains_in(out.volume_m3, packing);
  require(number < 2e9,
          "release: more than 2e9 grains (particles are numbered with 32 bits). Use a larger "
          "grains.discrete.diameter_m.");
  require(number >= 0.5,
          "release: less than half a grain (nothing would move). Use a smaller "
          "grains.discrete.diameter_m.");
  const auto n = static_cast<std::size_t>(std::max(1.0, std::round(number)));
  const Lattice lattice(packing, thickness);
  const std::vector<Place> places = lowest_places(bed, lattice, n);
  for (auto* column : {&out.x, &out.y, &out.z, &out.mass, &out.depth, &out.thickness, &out.covered})
    column->clear();
  const auto member = static_cast<std::uint64_t>(packing.member);
  const double amplitude = packing.jitter * lattice.spacing();
  Sum sum;
  for (const Place& p : places) {
    const RandomWords w = random_words(
        packing.seed,
        {static_cast<std::uint32_t>(p.col), static_cast<std::uint32_t>(p.row),
         static_cast<std::uint32_t>(p.layer) ^ static_cast<std::uint32_t>(member >> 32 << 16),
         static_cast<std::uint32_t>(member)});
    const auto jitter = [&](std::uint32_t word) { return amplitude * (2 * unit_from(word) - 1); };
    out.x.push_back(p.at.x() + jitter(w[0]));
    out.y.push_back(p.at.y() + jitter(w[1]));
    out.z.push_back(p.at.z() + jitter(w[2]));
    const double size = 1 + packing.size_spread * (2 * unit_from(w[3]) - 1);
    out.mass.push_back(size * size * size);
    sum.add(out.mass.back());
    out.depth.push_back(p.depth);
    out.thickness.push_back(p.thickness);
    out.covered.push_back(1);
  }
  const double each = packing.density_kg_m3 * packing.solid_fraction * out.volume_m3 / sum.value();
  for (double& m : out.mass) m *= each;
  out.dropped_fraction = 0;
}

}  // namespace sturz
