// SPDX-License-Identifier: Apache-2.0
/// One plane of a map as GDAL reads it, block by block: no more than a few blocks are in memory.
#pragma once

#include "io/gdal/gdal_handles.hpp"
#include "scenarios/layers/layer_stream.hpp"

#include <exception>
#include <memory>

namespace sturz {

class PlaneDataset final : public GDALDataset {
 public:
  /// \param source must outlive it
  PlaneDataset(const LayerSource& source, std::size_t layer, std::size_t plane);
  ~PlaneDataset() override;
  PlaneDataset(const PlaneDataset&) = delete;
  PlaneDataset& operator=(const PlaneDataset&) = delete;

  CPLErr GetGeoTransform(double* affine) override;
  const OGRSpatialReference* GetSpatialRef() const override;
  /// What the source threw while GDAL was reading comes out here: it must not pass through GDAL.
  void rethrow() const;

 private:
  friend class PlaneBand;

  Grid grid_;
  std::unique_ptr<OGRSpatialReference> crs_;
  std::exception_ptr thrown_;
};

}  // namespace sturz
