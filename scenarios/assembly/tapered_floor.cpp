// SPDX-License-Identifier: Apache-2.0
// A floor of constant curvature under a release, per connected part.
#include "engine/core/error.hpp"
#include "scenarios/assembly/release_pattern.hpp"
#include "scenarios/assembly/slope.hpp"

#include <Eigen/Sparse>

#include <algorithm>
#include <array>
#include <cmath>

namespace sturz {
namespace {

constexpr Eigen::Index most_tapered_cells = 2000000;  // seconds and a gigabyte
using Matrix = Eigen::SparseMatrix<double>;

struct Step {
  int row, col;
  Vec2 direction;  ///< on the map
};
const std::array<Step, 4> steps{
    {{0, 1, {1, 0}}, {0, -1, {-1, 0}}, {-1, 0, {0, 1}}, {1, 0, {0, -1}}}};

/// Cells that hang together over their edges.
struct Part {
  std::vector<std::size_t> cells;
};

std::vector<Part> parts_of(const Raster<double>& pattern) {
  const Grid& g = pattern.grid;
  std::vector<Part> parts;
  std::vector<char> seen(pattern.values.size(), 0);
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first] || !(pattern.values[first] > 0)) continue;
    std::vector<std::size_t>& cells = parts.emplace_back().cells;
    cells.push_back(first);
    seen[first] = 1;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const int row = static_cast<int>(cells[i] / g.n_cols),
                col = static_cast<int>(cells[i] % g.n_cols);
      for (const Step& step : steps) {
        if (!g.contains(row + step.row, col + step.col)) continue;
        const std::size_t next = g.index(row + step.row, col + step.col);
        if (seen[next] || !(pattern.values[next] > 0)) continue;
        seen[next] = 1;
        cells.push_back(next);
      }
    }
    std::sort(cells.begin(), cells.end());
  }
  return parts;
}

/// Unit vector down the mean slope under a part; zero on level ground.
Vec2 fall_line(const Part& part, const Raster<double>& pattern, const Raster<double>& ground) {
  Vec2 down(0, 0);
  const Grid& g = pattern.grid;
  const PlaceOnGrid at(g, ground.grid);
  for (const std::size_t k : part.cells)
    down -= pattern.values[k] * gradient_at(ground, at.row + static_cast<int>(k / g.n_cols),
                                            at.col + static_cast<int>(k % g.n_cols));
  const double length = down.norm();
  return length > 1e-9 ? Vec2(down / length) : Vec2(0, 0);
}

void taper(const Part& part, const Raster<double>& ground, Raster<double>& pattern) {
  const Grid& g = pattern.grid;
  const Vec2 down = fall_line(part, pattern, ground);
  const auto n = static_cast<Eigen::Index>(part.cells.size());
  require(n <= most_tapered_cells, "release.floor = tapered (" + std::to_string(n) +
                                       " cells hang together, more than 2000000). Use a larger "
                                       "terrain.cell_size_m.");
  const auto place = [&](std::size_t cell) -> Eigen::Index {
    const auto found = std::lower_bound(part.cells.begin(), part.cells.end(), cell);
    return found != part.cells.end() && *found == cell ? found - part.cells.begin() : -1;
  };
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd source(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t cell = part.cells[static_cast<std::size_t>(i)];
    const int row = static_cast<int>(cell / g.n_cols), col = static_cast<int>(cell % g.n_cols);
    source[i] = pattern.values[cell];
    double diagonal = 0;
    for (const Step& step : steps) {
      const int r = row + step.row, c = col + step.col;
      const Eigen::Index j = g.contains(r, c) ? place(g.index(r, c)) : -1;
      if (j >= 0) {
        diagonal += 1;
        entries.emplace_back(i, j, -1);
      } else if (step.direction.dot(down) > -0.5) {
        diagonal += 2;  // the edge lies half a cell away
      }
    }
    entries.emplace_back(i, i, diagonal);
  }
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Matrix> solver(matrix);
  const Eigen::VectorXd height = solver.solve(source);
  require(solver.info() == Eigen::Success && height.minCoeff() > 0,
          "release.floor = tapered (no floor could be found under the release). Use uniform.");
  const double scale = source.sum() / height.sum();
  for (Eigen::Index i = 0; i < n; ++i)
    pattern.values[part.cells[static_cast<std::size_t>(i)]] = scale * height[i];
}

}  // namespace

Raster<double> tapered(const Raster<double>& pattern, const Raster<double>& ground) {
  Raster<double> out = pattern;
  for (double& h : out.values)
    if (!(h > 0)) h = 0;
  for (const Part& part : parts_of(pattern)) taper(part, ground, out);
  return out;
}

}  // namespace sturz
