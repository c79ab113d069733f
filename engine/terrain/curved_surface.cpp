// SPDX-License-Identifier: Apache-2.0
#include "engine/terrain/terrain.hpp"

namespace sturz {
namespace {

/// Quadratic B-spline at t = -1/2..1/2 from the middle of three nodes: values and slopes.
struct Weights {
  double value[3], slope[3];
  explicit Weights(double t)
      : value{0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)},
        slope{t - 0.5, -2 * t, t + 0.5} {}
  double sum(const double* n) const { return value[0] * n[0] + value[1] * n[1] + value[2] * n[2]; }
  double rise(const double* n) const { return slope[0] * n[0] + slope[1] * n[1] + slope[2] * n[2]; }
};

double second(const double* n) { return n[0] - 2 * n[1] + n[2]; }

}  // namespace

CurvedSurface Terrain::curved(double x, double y) const {
  const double u = (x - west_node_m_) * per_cell_, v = (north_node_m_ - y) * per_cell_;
  CurvedSurface out;
  if (u >= first_u_ + 0.5 && v >= first_v_ + 0.5 && u < last_node_u_ - 0.5 &&
      v < last_node_v_ - 0.5) {
    const int col = static_cast<int>(u + 0.5), row = static_cast<int>(v + 0.5);
    // A patch carries a margin of nodes of the base raster: three rows and columns that are not
    // wholly inside it touch nothing that it changed.
    const int r = row - 1 - patch_row_, c = col - 1 - patch_col_;
    const bool patched = r >= 0 && c >= 0 && r + 2 < patch_rows_ && c + 2 < patch_cols_;
    const std::ptrdiff_t stride = patched ? patch_cols_ : stride_;
    const double* corner = patched ? &patch_[static_cast<std::size_t>(r) * patch_cols_ + c]
                                   : nodes_ + ((row - 1) * stride_ + col - 1 - corner_);
    const Weights east(u - col), south(v - row);
    double z[3], rise[3], curvature[3];
    for (int k = 0; k < 3; ++k) {
      const double* n = corner + k * stride;
      z[k] = east.sum(n), rise[k] = east.rise(n), curvature[k] = second(n);
    }
    out.z = south.sum(z);
    if (std::isfinite(out.z)) {
      const double per_area = per_cell_ * per_cell_;
      out.east = south.sum(rise) * per_cell_;
      out.north = -south.rise(z) * per_cell_;
      out.curvature_ee = south.sum(curvature) * per_area;
      out.curvature_en = -south.rise(rise) * per_area;
      out.curvature_nn = second(z) * per_area;
      return out;
    }
  } else if (u >= 0.5 && v >= 0.5 && u < n_cols_ - 1.5 && v < n_rows_ - 1.5) {
    needs_more_.raise();
  }
  Block b;
  if (find(x, y, b)) {
    const Slope s = evaluate(b, per_cell_);
    if (std::isfinite(s.z)) {
      out.z = s.z, out.east = s.east, out.north = s.north;
      return out;
    }
  }
  out.z = surface_outside(x, y).z;
  out.known = false;
  return out;
}

}  // namespace sturz
