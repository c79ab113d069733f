// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/planes/plane_dataset.hpp"

#include "io/gdal/crs.hpp"

#include <algorithm>
#include <vector>

namespace sturz {
namespace {

constexpr int block_edge = 256;

}  // namespace

class PlaneBand final : public GDALRasterBand {
 public:
  PlaneBand(PlaneDataset& owner, const LayerSource& source, std::size_t layer, std::size_t plane)
      : owner_(owner), source_(source), layer_(layer), plane_(plane) {
    poDS = &owner;
    nBand = 1;
    eAccess = GA_ReadOnly;
    eDataType = GDT_Float32;
    nRasterXSize = owner.grid_.n_cols;
    nRasterYSize = owner.grid_.n_rows;
    nBlockXSize = std::min(block_edge, nRasterXSize);
    nBlockYSize = std::min(block_edge, nRasterYSize);
  }

  double GetNoDataValue(int* is_set) override {
    if (is_set != nullptr) *is_set = TRUE;
    return nan_d;
  }
  const char* GetUnitType() override { return source_.about().layers[layer_].units.c_str(); }

 protected:
  CPLErr IReadBlock(int block_col, int block_row, void* image) override {
    try {
      read(block_col, block_row, image);
      return CE_None;
    } catch (...) {
      owner_.thrown_ = std::current_exception();
      CPLError(CE_Failure, CPLE_FileIO, "a block of the map cannot be read");
      return CE_Failure;
    }
  }

 private:
  /// Blocks at the eastern and southern edge reach beyond the map; GDAL ignores that part.
  void read(int block_col, int block_row, void* image) {
    Window w{block_row * nBlockYSize, block_col * nBlockXSize, 0, 0};
    w.n_rows = std::min(nBlockYSize, nRasterYSize - w.row0);
    w.n_cols = std::min(nBlockXSize, nRasterXSize - w.col0);
    values_.resize(w.n_cells());
    source_.read(layer_, plane_, w, values_);
    for (int row = 0; row < w.n_rows; ++row) {
      const float* from = values_.data() + static_cast<std::size_t>(row) * w.n_cols;
      std::copy_n(from, w.n_cols,
                  static_cast<float*>(image) + static_cast<std::size_t>(row) * nBlockXSize);
    }
  }

  PlaneDataset& owner_;
  const LayerSource& source_;
  std::size_t layer_, plane_;
  std::vector<float> values_;
};

PlaneDataset::PlaneDataset(const LayerSource& source, std::size_t layer, std::size_t plane)
    : grid_(source.about().grid) {
  nRasterXSize = grid_.n_cols;
  nRasterYSize = grid_.n_rows;
  eAccess = GA_ReadOnly;
  if (!grid_.crs_wkt.empty())
    crs_ = std::make_unique<OGRSpatialReference>(crs_from_wkt(grid_.crs_wkt));
  SetBand(1, new PlaneBand(*this, source, layer, plane));  // NOLINT: GDAL's base class owns it
}

PlaneDataset::~PlaneDataset() = default;

CPLErr PlaneDataset::GetGeoTransform(double* affine) {
  const auto numbers = affine_of(grid_);
  std::copy(numbers.begin(), numbers.end(), affine);
  return CE_None;
}

const OGRSpatialReference* PlaneDataset::GetSpatialRef() const { return crs_.get(); }

void PlaneDataset::rethrow() const {
  if (thrown_) std::rethrow_exception(thrown_);
}

}  // namespace sturz
