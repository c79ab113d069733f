// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/structured_cube.hpp"

#include "ensemble/sampling/random_words.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <algorithm>
#include <numeric>

namespace sturz {
namespace {

using Cube = std::vector<std::vector<double>>;

/// Fisher and Yates, with bits that belong to this trajectory.
std::vector<std::size_t> order_of(std::size_t n_dims, std::uint64_t seed, std::uint32_t set) {
  std::vector<std::size_t> order(n_dims);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = n_dims; k-- > 1;) {
    const auto word =
        random_word(seed, Stream::trajectory, static_cast<std::uint32_t>(n_dims + k), set);
    std::swap(order[k], order[word % (k + 1)]);
  }
  return order;
}

}  // namespace

Cube morris_cube(std::size_t n, std::size_t n_dims, std::uint64_t seed) {
  Cube cube;
  for (std::uint32_t set = 0; cube.size() < n; ++set) {
    std::vector<double> row(n_dims);
    for (std::size_t d = 0; d < n_dims; ++d) {  // one of the eight levels
      const auto word = random_word(seed, Stream::trajectory, static_cast<std::uint32_t>(d), set);
      row[d] = (static_cast<double>(word % 8) + 0.5) / 8;
    }
    cube.push_back(row);
    for (const std::size_t d : order_of(n_dims, seed, set)) {
      row[d] += row[d] < 0.5 ? morris_step : -morris_step;
      cube.push_back(row);
    }
  }
  cube.resize(n);
  return cube;
}

Cube saltelli_cube(std::size_t n, std::size_t n_dims, std::uint64_t seed) {
  const std::size_t set = n_dims + 2;
  Cube cube;
  for (const std::vector<double>& pair :
       draw_unit_cube(Design::sobol, (n + set - 1) / set, 2 * n_dims, seed)) {
    const auto middle = pair.begin() + static_cast<std::ptrdiff_t>(n_dims);
    const std::vector<double> a(pair.begin(), middle), b(middle, pair.end());
    cube.push_back(a);
    cube.push_back(b);
    for (std::size_t k = 0; k < n_dims; ++k) {
      cube.push_back(a);
      cube.back()[k] = b[k];
    }
  }
  cube.resize(n);
  return cube;
}

}  // namespace sturz
