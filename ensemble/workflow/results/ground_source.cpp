// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/ground_source.hpp"

#include <algorithm>
#include <utility>

namespace sturz::workflow {
namespace {

constexpr int band_rows = 256;  // the blocks that GeoTIFFs are made of

class GroundSource final : public LayerSource {
 public:
  GroundSource(const Grid& maps, GroundAt ground) : ground_(std::move(ground)) {
    about_.grid = maps;
    about_.layers.push_back(
        {"elevation", {}, "elevation of the ground under the maps", {}, "m", {}, {}, {}, {}});
  }
  const LayerStack& about() const override { return about_; }
  void read(std::size_t /*layer*/, std::size_t /*plane*/, const Window& w,
            std::span<float> out) const override {
    for (int row = 0; row < w.n_rows; ++row)
      read_row(w.row0 + row, w.col0,
               out.subspan(static_cast<std::size_t>(row) * w.n_cols, w.n_cols));
  }

 private:
  void read_row(int row, int col0, std::span<float> out) const {
    const Raster<double>& ground = band_of(row);
    const Grid &maps = about_.grid, &there = ground.grid;
    const int r = there.row_of(maps.y_center(row));
    for (std::size_t i = 0; i < out.size(); ++i) {
      const int c = there.col_of(maps.x_center(col0 + static_cast<int>(i)));
      out[i] = there.contains(r, c) ? static_cast<float>(ground.at(r, c)) : nan_f;
    }
  }

  const Raster<double>& band_of(int row) const {
    const int row0 = row / band_rows * band_rows;
    if (band_ == nullptr || row0 != row0_) {
      const Grid& maps = about_.grid;
      band_.reset();  // before the next is read
      band_ =
          ground_(grid_of({row0, 0, std::min(band_rows, maps.n_rows - row0), maps.n_cols}, maps));
      row0_ = row0;
    }
    return *band_;
  }

  GroundAt ground_;
  LayerStack about_;
  mutable std::shared_ptr<const Raster<double>> band_;
  mutable int row0_ = -1;
};

}  // namespace

std::shared_ptr<const LayerSource> ground_source(const Grid& maps, GroundAt ground) {
  return std::make_shared<GroundSource>(maps, std::move(ground));
}

}  // namespace sturz::workflow
