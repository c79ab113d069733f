// SPDX-License-Identifier: Apache-2.0
/// Cells, groups and runs of columns against brute force over all pairs and images.
#include "engine/neighbors/column_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

namespace sturz {
namespace {

/// Columns with the radius of each.
struct Cloud {
  ParticleSet set;
  std::vector<double> support_radius;

  void add(double x, double y, double r, double z = 0) {
    set.grow(1);
    set.x.back() = x, set.y.back() = y, set.z.back() = z;
    support_radius.push_back(r);
  }
};

Cloud random_cloud(int n, double width, double height, double least, double most,
                   unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  Cloud c;
  for (int k = 0; k < n; ++k) {
    const double x = width * unit(random), y = height * unit(random);
    c.add(x, y, least + (most - least) * unit(random), 5 * unit(random));
  }
  return c;
}

/// A difference of positions as the sweep takes it, which knows no overflow.
double difference(std::int32_t a, std::int32_t b, double unit) {
  return static_cast<std::int32_t>(std::int64_t{a} - b) * unit;
}

/// The records that a group's runs hold, by the column that they are or mirror.
class Found {
 public:
  Found(const ColumnCells& cells, const ColumnGroup& group, std::size_t n_columns)
      : view_(cells.view()), by_source_(n_columns), seen_(cells.size(), 0) {
    for (std::uint32_t r = group.first_run; r < group.last_run; ++r)
      for (std::uint32_t m = view_.runs[r].begin; m < view_.runs[r].end; ++m) {
        EXPECT_EQ(seen_[m]++, 0) << "no pair is met twice";
        by_source_[cells.source(m)].push_back(m);
      }
  }
  /// Where record k sees column j and its images [m].
  std::vector<Vec3> offsets(std::size_t k, std::uint32_t j) const {
    const ColumnRecord& here = view_.records[k];
    std::vector<Vec3> out;
    for (std::uint32_t m : by_source_[j]) {
      const ColumnRecord& there = view_.records[m];
      out.emplace_back(difference(there.x, here.x, view_.unit_m),
                       difference(there.y, here.y, view_.unit_m),
                       difference(there.z, here.z, view_.unit_m));
    }
    return out;
  }
  /// Each position is rounded once [m].
  double tolerance() const { return 2 * view_.unit_m; }

 private:
  ColumnView view_;
  std::vector<std::vector<std::uint32_t>> by_source_;
  std::vector<int> seen_;
};

bool holds(const std::vector<Vec3>& offsets, const Vec3& offset, double tolerance) {
  return std::any_of(offsets.begin(), offsets.end(), [&](const Vec3& o) {
    return (o - offset).cwiseAbs().maxCoeff() <= tolerance;
  });
}

double in_plan(const Vec3& offset) { return std::hypot(offset.x(), offset.y()); }

/// How often a period may lie between a column and a neighbour.
int turns(const Period& p, double support_radius) {
  return p.active ? 1 + static_cast<int>(std::ceil(support_radius / p.length())) : 0;
}

/// Pairs within the smaller support radius of the two, images included; those of them that are
/// missing, and neighbours that are seen where there is no column.
struct PairCount {
  long pairs = 0, missing = 0, phantoms = 0;
};

class BruteForce {
 public:
  BruteForce(const Cloud& c, const Domain& d) : cloud_(c) {
    const double longest = *std::max_element(c.support_radius.begin(), c.support_radius.end());
    for (int a = -turns(d.x, longest); a <= turns(d.x, longest); ++a)
      for (int b = -turns(d.y, longest); b <= turns(d.y, longest); ++b)
        shifts_.emplace_back(a * d.x.length(), b * d.y.length(), a * d.x.rise + b * d.y.rise);
  }
  void count(const Found& found, std::size_t record, std::uint32_t i, PairCount& out) const {
    const ParticleSet& p = cloud_.set;
    for (std::uint32_t j = 0; j < p.size(); ++j) {
      const double within = std::min(cloud_.support_radius[i], cloud_.support_radius[j]);
      const auto seen = found.offsets(record, j);
      std::vector<Vec3> real;
      for (const Vec3& shift : shifts_)
        real.emplace_back(Vec3(p.x[j] - p.x[i], p.y[j] - p.y[i], p.z[j] - p.z[i]) + shift);
      for (const Vec3& offset : real) {
        // On the edge of the support a neighbour weighs nothing.
        if (in_plan(offset) >= within * (1 - 1e-7)) continue;
        ++out.pairs;
        out.missing += !holds(seen, offset, found.tolerance());
      }
      for (const Vec3& offset : seen)
        if (in_plan(offset) < within) out.phantoms += !holds(real, offset, found.tolerance());
    }
  }

 private:
  const Cloud& cloud_;
  std::vector<Vec3> shifts_;
};

void expect_each_column_once(const ColumnCells& cells, std::size_t n) {
  const ColumnView view = cells.view();
  std::vector<int> times(n, 0);
  std::uint32_t next = 0;
  for (std::size_t g = 0; g < cells.n_groups(); ++g) {
    const ColumnGroup& group = view.groups[g];
    ASSERT_EQ(group.begin, next) << "groups follow each other";
    ASSERT_GT(group.end, group.begin);
    ASSERT_LE(group.end - group.begin, static_cast<std::uint32_t>(group_size));
    next = group.end;
    for (std::uint32_t k = group.begin; k < group.end; ++k)
      if (!cells.is_image(k)) ++times[cells.source(k)];
  }
  EXPECT_EQ(next, cells.size());
  EXPECT_EQ(times, std::vector<int>(n, 1));
}

PairCount count_pairs(const Cloud& c, const Domain& domain) {
  ColumnCells cells;
  cells.build(c.set, domain, c.support_radius);
  expect_each_column_once(cells, c.set.size());
  const BruteForce slow(c, domain);
  PairCount out;
  for (std::size_t g = 0; g < cells.n_groups(); ++g) {
    const ColumnGroup& group = cells.view().groups[g];
    const Found found(cells, group, c.set.size());
    for (std::uint32_t k = group.begin; k < group.end; ++k)
      if (!cells.is_image(k)) slow.count(found, k, cells.source(k), out);
  }
  return out;
}

/// Every pair is found; \param least pairs, so that the scene is not an empty one
void expect_all_found(const Cloud& c, long least, const Domain& domain = {}) {
  const PairCount n = count_pairs(c, domain);
  EXPECT_EQ(n.missing, 0) << "of " << n.pairs;
  EXPECT_EQ(n.phantoms, 0) << "beside " << n.pairs;
  EXPECT_GE(n.pairs, least);
}

TEST(ColumnCells, FindEveryPairOfRandomClouds) {
  expect_all_found(random_cloud(500, 60, 40, 4, 4), 5000);
  expect_all_found(random_cloud(500, 300, 200, 4, 4), 600);
  expect_all_found(random_cloud(300, 8, 900, 10, 10), 1000);
}

TEST(ColumnCells, FindEveryPairFarFromTheOrigin) {
  Cloud c = random_cloud(400, 50, 50, 4, 4);
  for (double& x : c.set.x) x += 412345.678;
  for (double& y : c.set.y) y += 5123456.789;
  for (double& z : c.set.z) z += 1234.5;
  expect_all_found(c, 3000);
}

TEST(ColumnCells, FindEveryPairOfMixedSupportRadii) {
  expect_all_found(random_cloud(500, 60, 40, 1, 8), 4000);
  expect_all_found(random_cloud(500, 60, 40, 0.01, 16), 4000);
}

TEST(ColumnCells, FindEveryPairOfADenseClump) {
  Cloud c = random_cloud(300, 0.05, 0.05, 4, 4);
  expect_all_found(c, 300L * 300);
  for (int k = 0; k < 100; ++k) c.add(3, 2, 4);  // on one another
  expect_all_found(c, 400L * 400);
}

TEST(ColumnCells, FindEveryPairOfALine) {
  for (const double slope : {0.0, 1.0, 1e9}) {
    Cloud c;
    for (int k = 0; k < 300; ++k) {
      const double s = 0.7 * k, along = 1 / std::hypot(1, slope);
      c.add(s * along, s * along * slope, 3);
    }
    expect_all_found(c, 300L * 8);
  }
}

TEST(ColumnCells, FindEveryPairOfALattice) {
  // Many distances equal the support radius or a cell's edge.
  Cloud c;
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 20; ++j) c.add(i, j, 4);
  expect_all_found(c, 12000);
}

TEST(ColumnCells, HoldOneColumnAndNone) {
  Cloud one;
  one.add(7, -3, 2);
  expect_all_found(one, 1);  // itself
  ColumnCells cells;
  cells.build(one.set, {}, one.support_radius);
  cells.build(ParticleSet{}, {}, {});
  EXPECT_EQ(cells.size(), 0u);
  EXPECT_EQ(cells.n_groups(), 0u);
}

TEST(ColumnCells, StrayColumnsFarAwayCostNoTableOfEmptyCells) {
  Cloud c = random_cloud(300, 20, 20, 4, 4);
  c.add(-2e5, 3e5, 4, 800);
  c.add(9e5, 1, 4, -100);
  c.add(9e5 + 1, 2, 4, -100);
  // Positions are rounded to a billionth of the extent: well under a support radius.
  expect_all_found(c, 300);
  ColumnCells cells;
  cells.build(c.set, {}, c.support_radius);
  EXPECT_LT(cells.bytes(), 300000u);
}

Period period(double min, double max, double rise = 0) { return {true, min, max, rise}; }

TEST(ColumnCells, FindPeriodicImagesAlongXWithTheirRise) {
  Domain d;
  d.x = period(0, 60, -12.5);
  expect_all_found(random_cloud(500, 60, 40, 2, 6), 4000, d);
}

TEST(ColumnCells, FindPeriodicImagesAlongYWithTheirRise) {
  Domain d;
  d.y = period(0, 40, 7);
  expect_all_found(random_cloud(500, 60, 40, 2, 6), 4000, d);
}

TEST(ColumnCells, FindPeriodicImagesAlongBothAndOverTheCorners) {
  Domain d;
  d.x = period(0, 60, -12.5), d.y = period(0, 40, 7);
  expect_all_found(random_cloud(500, 60, 40, 2, 6), 4000, d);
  // A clump in one corner of a wide box: its images lie far beyond the columns themselves.
  Cloud corner = random_cloud(60, 3, 3, 4, 4);
  for (const double length : {4937.0, 4992.0, 5028.0}) {
    d.x = period(0, length, -1), d.y = period(0, length, 1);
    expect_all_found(corner, 60L * 40, d);
  }
  corner.add(5027, 5027, 4), corner.add(5026, 1, 4), corner.add(2, 5025.5, 4);
  expect_all_found(corner, 60L * 40, d);
}

TEST(ColumnCells, FindTheImagesOfANarrowPeriodAsOftenAsTheyRepeat) {
  Domain d;
  d.y = period(0, 7, 2);
  expect_all_found(random_cloud(100, 60, 7, 8, 8), 1000, d);
  d.y = period(0, 3, 2);
  expect_all_found(random_cloud(40, 60, 3, 8, 8), 1000, d);
}

TEST(ColumnCells, ImagesAreMarked) {
  Domain d;
  d.x = period(0, 60);
  Cloud c = random_cloud(498, 60, 40, 4, 4);
  c.add(0, 20, 4), c.add(59.99, 20, 4);  // from edge to edge: every image has a neighbour
  ColumnCells cells;
  cells.build(c.set, d, c.support_radius);
  std::size_t images = 0, near_edge = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) images += cells.is_image(k);
  for (double x : c.set.x) near_edge += (x < 4) + (x >= 56);
  EXPECT_EQ(images, near_edge);
  EXPECT_EQ(cells.size(), 500 + images);
}

std::vector<std::uint32_t> order_of(const ColumnCells& cells) {
  std::vector<std::uint32_t> order;
  for (std::size_t k = 0; k < cells.size(); ++k) order.push_back(cells.source(k));
  return order;
}

TEST(ColumnCells, AreTheSameAfterAnyHistory) {
  Domain d;
  d.x = period(0, 60, 3);
  const Cloud c = random_cloud(500, 60, 40, 2, 6), other = random_cloud(700, 60, 10, 1, 3, 9);
  ColumnCells fresh, used;
  fresh.build(c.set, d, c.support_radius);
  used.build(other.set, d, other.support_radius);
  used.build(c.set, d, c.support_radius);
  EXPECT_EQ(order_of(fresh), order_of(used));
  EXPECT_EQ(fresh.n_groups(), used.n_groups());
  EXPECT_EQ(fresh.view().unit_m, used.view().unit_m);
}

TEST(ColumnCells, KeepTheStorageOrderWithinACell) {
  // Three positions that columns take turns to stand on: three cells.
  Cloud c;
  for (int k = 0; k < 90; ++k) c.add(10 * (k % 3), 0, 4);
  ColumnCells cells;
  cells.build(c.set, {}, c.support_radius);
  const auto order = order_of(cells);
  for (std::size_t k = 0; k < 90; ++k) EXPECT_EQ(order[k], 3 * (k % 30) + k / 30);
}

}  // namespace
}  // namespace sturz
