// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/signed_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();

/// Scratch of one line.
struct Line {
  std::vector<double> f, z;
  std::vector<int> v;
  explicit Line(std::size_t n) : f(n), z(n + 1), v(n) {}
};

/// min over q of (p - q)^2 + f(q) for every p: the lower envelope of parabolas. \param out [n]
void envelope(Line& line, int n, double* out, std::size_t stride) {
  int k = -1;
  for (int q = 0; q < n; ++q) {
    if (line.f[q] == far_away) continue;
    double s = -far_away;
    while (k >= 0) {
      const int p = line.v[k];
      s = ((line.f[q] + double(q) * q) - (line.f[p] + double(p) * p)) / (2.0 * (q - p));
      if (s > line.z[k]) break;
      --k;
    }
    line.v[++k] = q;
    line.z[k] = k == 0 ? -far_away : s;
    line.z[k + 1] = far_away;
  }
  if (k < 0) {
    for (int p = 0; p < n; ++p) out[stride * p] = far_away;
    return;
  }
  int at = 0;
  for (int p = 0; p < n; ++p) {
    while (line.z[at + 1] < p) ++at;
    const double d = p - line.v[at];
    out[stride * p] = d * d + line.f[line.v[at]];
  }
}

/// Squared distance to the nearest cell of that kind, in cells.
std::vector<double> squared_to(const Raster<std::uint8_t>& set, bool kind) {
  const int rows = set.grid.n_rows, cols = set.grid.n_cols;
  std::vector<double> squared(set.values.size());
  Line line(static_cast<std::size_t>(std::max(rows, cols)));
  for (int c = 0; c < cols; ++c) {
    for (int r = 0; r < rows; ++r) line.f[r] = (set.at(r, c) != 0) == kind ? 0 : far_away;
    envelope(line, rows, squared.data() + c, static_cast<std::size_t>(cols));
  }
  for (int r = 0; r < rows; ++r) {
    double* const row = squared.data() + static_cast<std::size_t>(r) * cols;
    std::copy_n(row, cols, line.f.begin());
    envelope(line, cols, row, 1);
  }
  return squared;
}

}  // namespace

Raster<float> signed_distance(const Raster<std::uint8_t>& inside) {
  const double cell = inside.grid.cell_m;
  const double most = cell * (inside.grid.n_rows + inside.grid.n_cols);
  const std::vector<double> in = squared_to(inside, true), out = squared_to(inside, false);
  Raster<float> distance(inside.grid);
  for (std::size_t i = 0; i < in.size(); ++i) {
    const bool is_inside = inside.values[i] != 0;
    const double squared = is_inside ? out[i] : in[i];
    const double d = squared == far_away ? most : cell * (std::sqrt(squared) - 0.5);
    distance.values[i] = static_cast<float>(is_inside ? d : -d);
  }
  return distance;
}

}  // namespace sturz
