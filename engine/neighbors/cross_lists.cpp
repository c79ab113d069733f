// SPDX-License-Identifier: Apache-2.0
#include "engine/neighbors/cross_lists.hpp"

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace sturz {
namespace {

constexpr int bits = 21;  // of each index in a cell's number
constexpr double last_index = (1 << bits) - 3;

/// A position far away falls into the last cell, one nowhere (NaN) into the first: slow, never
/// wrong.
std::uint64_t index_along(double distance, double cell, int offset) {
  const double i = distance > 0 ? std::min(distance / cell, last_index) : 0;
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(i) + 1 + offset);
}

double least(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity();
  for (double v : values) low = std::min(low, v);
  return low;
}

}  // namespace

CrossLists::CrossLists(double support, double skin) : support_(support), skin_(skin) {
  expect(support > 0 && skin >= 0, "a support is positive, a skin not negative");
}

std::uint64_t CrossLists::cell_of(double x, double y, double z, int dx, int dy, int dz) const {
  const double cell = support_ + skin_;
  return index_along(z - origin_[2], cell, dz) << (2 * bits) |
         index_along(y - origin_[1], cell, dy) << bits | index_along(x - origin_[0], cell, dx);
}

void CrossLists::add_images(const ParticleSet& to, const Period& period, bool along_x) {
  if (!period.active) return;
  const double margin = support_ + skin_, length = period.length();
  const int most = static_cast<int>(std::ceil(margin / length));  // a box may be short
  const std::size_t n = sources_.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Source s = sources_[k];
    const double at = along_x ? to.x[s.index] + s.dx : to.y[s.index] + s.dy;
    for (int turn = -most; turn <= most; ++turn) {
      const double there = at + turn * length;
      if (turn == 0 || there < period.min - margin || there > period.max + margin) continue;
      Source image = s;
      (along_x ? image.dx : image.dy) += turn * length;
      image.dz += turn * period.rise;
      sources_.push_back(image);
    }
  }
}

void CrossLists::enter(const ParticleSet& to, const Domain& domain) {
  sources_.clear();
  for (std::uint32_t j = 0; j < to.size(); ++j) sources_.push_back({0, j, to.id[j], 0, 0, 0});
  add_images(to, domain.x, true);
  add_images(to, domain.y, false);
  const double margin = 2 * (support_ + skin_);
  origin_[0] = least(to.x) - (domain.x.active ? margin + domain.x.length() : 0) - margin;
  origin_[1] = least(to.y) - (domain.y.active ? margin + domain.y.length() : 0) - margin;
  double lift = 0;  // how far images may lie below
  for (const Period* p : {&domain.x, &domain.y})
    if (p->active) lift += std::abs(p->rise) * std::ceil(margin / p->length());
  origin_[2] = least(to.z) - lift - margin;
  for (Source& s : sources_)
    s.cell = cell_of(to.x[s.index] + s.dx, to.y[s.index] + s.dy, to.z[s.index] + s.dz, 0, 0, 0);
  std::sort(sources_.begin(), sources_.end(), [](const Source& a, const Source& b) {
    return std::tie(a.cell, a.id, a.dx, a.dy) < std::tie(b.cell, b.id, b.dx, b.dy);
  });
}

/// Cells that follow each other along x have neighbouring numbers: nine runs of three cells.
void CrossLists::list(const ParticleSet& from, const ParticleSet& to, std::size_t i,
                      std::vector<std::uint32_t>& out) const {
  const double search_radius = support_ + skin_;
  const auto by_cell = [](const Source& s, std::uint64_t cell) { return s.cell < cell; };
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy) {
      const std::uint64_t first = cell_of(from.x[i], from.y[i], from.z[i], -1, dy, dz);
      const std::uint64_t last = cell_of(from.x[i], from.y[i], from.z[i], 1, dy, dz);
      auto s = std::lower_bound(sources_.begin(), sources_.end(), first, by_cell);
      for (; s != sources_.end() && s->cell <= last; ++s) {
        const Vec3 r(from.x[i] - to.x[s->index] - s->dx, from.y[i] - to.y[s->index] - s->dy,
                     from.z[i] - to.z[s->index] - s->dz);
        if (r.squaredNorm() < search_radius * search_radius)
          out.push_back(static_cast<std::uint32_t>(s - sources_.begin()));
      }
    }
}

void CrossLists::rebuild(const ParticleSet& from, const ParticleSet& to, const Domain& domain,
                         int threads) {
  enter(to, domain);
  runs_.resize(from.size());
  entries_.resize((from.size() + block - 1) / block);
  parallel_ranges(from.size(), block, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& entries = entries_[begin / block];
    entries.clear();
    for (std::size_t i = begin; i < end; ++i) {
      runs_[i].begin = static_cast<std::uint32_t>(entries.size());
      list(from, to, i, entries);
      runs_[i].end = static_cast<std::uint32_t>(entries.size());
    }
  });
  stale_ = false;
  moved_ = 0;
  ++n_rebuilds_;
}

std::size_t CrossLists::n_entries() const {
  std::size_t n = 0;
  for (const auto& entries : entries_) n += entries.size();
  return n;
}

std::size_t CrossLists::bytes() const {
  std::size_t total = sources_.capacity() * sizeof(Source) + runs_.capacity() * sizeof(Run);
  for (const auto& entries : entries_) total += entries.capacity() * sizeof(std::uint32_t);
  return total;
}

}  // namespace sturz
