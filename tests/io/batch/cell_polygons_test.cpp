// SPDX-License-Identifier: Apache-2.0
#include "io/features/cell_polygons.hpp"

#include <gtest/gtest.h>
#include <ogr_geometry.h>

#include <memory>

namespace sturz {
namespace {

std::unique_ptr<OGRGeometry> geometry_of(const std::string& wkb) {
  OGRGeometry* made = nullptr;
  EXPECT_EQ(OGRGeometryFactory::createFromWkb(wkb.data(), nullptr, &made, wkb.size()), OGRERR_NONE);
  return std::unique_ptr<OGRGeometry>(made);
}

Raster<std::uint8_t> cells() {
  Grid grid;
  grid.n_cols = 5;
  grid.n_rows = 4;
  grid.cell_m = 2;
  grid.west_m = 100;
  grid.north_m = 50;
  return Raster<std::uint8_t>(grid);
}

TEST(CellPolygons, HoldExactlyTheCellsWithHoles) {
  Raster<std::uint8_t> ring = cells();
  for (int row = 0; row < 3; ++row)
    for (int col = 1; col < 4; ++col) ring.at(row, col) = row == 1 && col == 2 ? 0 : 7;
  const auto geometry = geometry_of(cells_as_polygons(ring));
  ASSERT_NE(geometry, nullptr);
  ASSERT_EQ(wkbFlatten(geometry->getGeometryType()), wkbMultiPolygon);
  EXPECT_TRUE(geometry->IsValid());
  const OGRMultiPolygon* all = geometry->toMultiPolygon();
  EXPECT_DOUBLE_EQ(all->get_Area(), 8 * 4);
  ASSERT_EQ(all->getNumGeometries(), 1);
  EXPECT_EQ(all->getGeometryRef(0)->getNumInteriorRings(), 1);
  OGREnvelope box;
  all->getEnvelope(&box);
  EXPECT_EQ(box.MinX, 102);
  EXPECT_EQ(box.MaxX, 108);
  EXPECT_EQ(box.MinY, 44);
  EXPECT_EQ(box.MaxY, 50);
}

TEST(CellPolygons, CellsThatTouchAtACornerAreValidPolygons) {
  Raster<std::uint8_t> two = cells();
  two.at(0, 0) = two.at(1, 1) = 1;
  const auto geometry = geometry_of(cells_as_polygons(two));
  ASSERT_NE(geometry, nullptr);
  EXPECT_TRUE(geometry->IsValid());
  EXPECT_EQ(geometry->toMultiPolygon()->getNumGeometries(), 2);
}

TEST(CellPolygons, NothingIsNothing) { EXPECT_EQ(cells_as_polygons(cells()), ""); }

}  // namespace
}  // namespace sturz
