// SPDX-License-Identifier: Apache-2.0
#include "engine/neighbors/cross_pairs.hpp"

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace sturz {
namespace {

constexpr int bits = 21;  // of each index in a cell's number
constexpr std::int32_t last_index = (1 << bits) - 3;
constexpr double frame_units = 1 << 29;  // along the longest side, so that differences fit

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(const std::vector<double>& values) {
    for (const double v : values)  // what is not finite lies nowhere
      if (std::abs(v) < 1e15) low = std::min(low, v), high = std::max(high, v);
  }
};

/// What lies outside the frame falls into its outermost cells: slow, never wrong.
std::uint64_t index_along(std::int32_t units, std::int32_t cell, int offset) {
  const std::int32_t i = units > 0 ? std::min(units / cell, last_index) : 0;
  return static_cast<std::uint64_t>(std::int64_t{i} + 1 + offset);
}

/// A run of sources that may be near.
struct Range {
  std::size_t first = 0, last = 0;
};

}  // namespace

std::size_t PairSide::n_entries() const {
  std::size_t n = 0;
  for (const auto& run : runs_) n += run.end - run.begin;
  return n;
}

std::size_t PairSide::Weighed::bytes() const {
  return runs.capacity() * sizeof(Run) + source.capacity() * sizeof(std::uint32_t) +
         (weight.capacity() + slope.capacity()) * sizeof(float);
}

std::size_t PairSide::bytes() const {
  std::size_t total = keys_.capacity() * sizeof(Key) + images_.capacity() * sizeof(Image) +
                      runs_.capacity() * sizeof(Run) + cell_.capacity() * sizeof(std::uint64_t) +
                      places_.capacity() * sizeof(Place) + blocks_.capacity() * sizeof(Block);
  for (const auto* v : {&index_, &image_row_, &index_of_})
    total += v->capacity() * sizeof(std::uint32_t);
  for (const Mirror& m : mirrors_)
    for (const auto* v : {&m.gap, &m.nx, &m.ny, &m.nz}) total += v->capacity() * sizeof(float);
  for (const Block& b : blocks_) {
    total += b.candidate.capacity() * sizeof(std::uint32_t) + b.weighed.bytes() +
             b.images.capacity() * sizeof(Weighed);
    for (const Weighed& images : b.images) total += images.bytes();
  }
  return total;
}

CrossPairs::CrossPairs(double smoothing_length, double skin, int gradients)
    : h_(smoothing_length), support_(2 * smoothing_length), skin_(skin), gradients_(gradients) {
  expect(h_ > 0 && skin >= 0, "a smoothing length is positive, a skin not negative");
}

std::int32_t CrossPairs::fixed(double distance) const {
  const double units = distance / unit_;
  if (!(units > -frame_units)) return static_cast<std::int32_t>(-frame_units);
  return static_cast<std::int32_t>(std::floor(std::min(units, 2 * frame_units) + 0.5));
}

std::int32_t CrossPairs::cell_units() const {
  return static_cast<std::int32_t>(std::ceil((support_ + skin_) / unit_)) + 1;
}

std::uint64_t CrossPairs::cell_of(std::int32_t x, std::int32_t y, std::int32_t z, int dx, int dy,
                                  int dz) const {
  const std::int32_t cell = cell_units();
  return index_along(z, cell, dz) << (2 * bits) | index_along(y, cell, dy) << bits |
         index_along(x, cell, dx);
}

void CrossPairs::choose_frame(const ParticleSet& a, const ParticleSet& b, const Domain& domain) {
  const double margin = 2 * (support_ + skin_);
  double longest = 0;
  Extent along[3];
  for (const ParticleSet* p : {&a, &b}) along[0].add(p->x), along[1].add(p->y), along[2].add(p->z);
  if (domain.x.active) along[0] = {domain.x.min, domain.x.max};
  if (domain.y.active) along[1] = {domain.y.min, domain.y.max};
  double lift = margin;  // how far images may lie above or below
  for (const Period* p : {&domain.x, &domain.y})
    if (p->active) lift += std::abs(p->rise) * (1 + std::ceil(margin / p->length()));
  for (int k = 0; k < 3; ++k) {
    if (!(along[k].low <= along[k].high)) along[k] = {0, 0};
    const double around = k == 2 ? lift : margin;
    origin_[k] = along[k].low - around;
    longest = std::max(longest, along[k].high - along[k].low + 2 * around);
  }
  unit_ = std::exp2(std::ceil(std::log2(longest / frame_units)));
}

void CrossPairs::enter(PairSide& side, const ParticleSet& p, const Domain& domain) const {
  side.keys_.resize(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    double x = p.x[i], y = p.y[i], z = p.z[i];
    domain.wrap(x, y, z);
    PairSide::Key& key = side.keys_[i];
    key.cell =
        cell_of(fixed(x - origin_[0]), fixed(y - origin_[1]), fixed(z - origin_[2]), 0, 0, 0);
    key.id = p.id[i], key.index = static_cast<std::uint32_t>(i);
    const auto turns = [](const Period& period, double from, double to) {
      const double n = period.active ? std::round((from - to) / period.length()) : 0;
      return std::abs(n) < 1e9 ? static_cast<std::int32_t>(n) : 0;
    };
    key.turn_x = turns(domain.x, p.x[i], x), key.turn_y = turns(domain.y, p.y[i], y);
  }
  std::sort(side.keys_.begin(), side.keys_.end(), [](const auto& a, const auto& b) {
    return std::tie(a.cell, a.id) < std::tie(b.cell, b.id);
  });
  side.index_.resize(p.size());
  for (std::size_t r = 0; r < p.size(); ++r) side.index_[r] = side.keys_[r].index;
  side.n_created_ = p.n_created();
  side.image_row_.clear();
  side.images_.clear();
}

/// Images of rows, and with the second direction images of images.
void CrossPairs::add_images(PairSide& side, const Period& period, bool along_x) const {
  if (!period.active) return;
  const std::int32_t margin = cell_units(), length = fixed(period.length());
  const std::int32_t rise = period.rise < 0 ? -fixed(-period.rise) : fixed(period.rise);
  const std::int32_t low = fixed(period.min - origin_[along_x ? 0 : 1]), high = low + length;
  const auto most = static_cast<std::int32_t>(std::ceil((support_ + skin_) / period.length()));
  const std::size_t n = side.images_.size();
  const auto add = [&](const PairSide::Image& base) {
    const std::int32_t at =
        along_x ? side.places_[base.row].x + base.dx : side.places_[base.row].y + base.dy;
    for (std::int32_t turn = -most; turn <= most; ++turn) {
      const std::int32_t there = at + turn * length;
      if (turn == 0 || there < low - margin || there > high + margin) continue;
      PairSide::Image image = base;
      (along_x ? image.dx : image.dy) += turn * length;
      image.dz += turn * rise;
      side.images_.push_back(image);
    }
  };
  for (std::uint32_t row = 0; row < side.n_rows(); ++row) add({0, row, 0, 0, 0});
  for (std::size_t k = 0; k < n; ++k) add(side.images_[k]);
}

void CrossPairs::sort_images(PairSide& side) const {
  for (PairSide::Image& image : side.images_)
    image.cell = cell_of(side.places_[image.row].x + image.dx, side.places_[image.row].y + image.dy,
                         side.places_[image.row].z + image.dz, 0, 0, 0);
  std::sort(side.images_.begin(), side.images_.end(), [](const auto& a, const auto& b) {
    return std::tie(a.cell, a.row, a.dx, a.dy) < std::tie(b.cell, b.row, b.dx, b.dy);
  });
  fit(side.image_row_, side.images_.size());
  fit(side.cell_, side.n_rows() + side.images_.size());
  for (std::size_t r = 0; r < side.n_rows(); ++r) side.cell_[r] = side.keys_[r].cell;
  for (std::size_t k = 0; k < side.images_.size(); ++k) {
    side.image_row_[k] = side.images_[k].row;
    side.cell_[side.n_rows() + k] = side.images_[k].cell;
  }
}

void CrossPairs::place(PairSide& side, const ParticleSet& p, const Domain& domain,
                       int threads) const {
  const std::size_t n = side.n_rows();
  fit(side.places_, n + side.images_.size());
  const bool periodic = domain.x.active || domain.y.active;
  parallel_ranges(n, reduction_block, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const std::uint32_t i = side.index_[r];
      double x = p.x[i] - origin_[0], y = p.y[i] - origin_[1], z = p.z[i] - origin_[2];
      if (periodic) {
        const double turn_x = side.keys_[r].turn_x, turn_y = side.keys_[r].turn_y;
        x -= turn_x * domain.x.length(), y -= turn_y * domain.y.length();
        z -= turn_x * domain.x.rise + turn_y * domain.y.rise;
      }
      side.places_[r] = {fixed(x), fixed(y), fixed(z), 0};
    }
  });
  for (std::size_t k = 0; k < side.images_.size(); ++k) {
    const PairSide::Image& image = side.images_[k];
    const PairSide::Place& of = side.places_[image.row];
    side.places_[n + k] = {of.x + image.dx, of.y + image.dy, of.z + image.dz, 0};
  }
}

/// Cells that follow each other along x have neighbouring numbers: nine runs of three cells among
/// the rows, and nine among the images. Rows of one cell share them.
void CrossPairs::list(PairSide& from, const PairSide& to, int threads) const {
  constexpr std::size_t block = PairSide::block;
  const std::size_t n_to = to.n_rows();
  const auto reach = static_cast<float>((support_ + skin_) / unit_), reach2 = reach * reach;
  from.runs_.resize(from.n_rows());
  from.blocks_.resize((from.n_rows() + block - 1) / block);
  parallel_ranges(from.n_rows(), block, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& out = from.blocks_[begin / block].candidate;
    Range ranges[18];
    constexpr std::size_t chunk = 64;
    float distance2[chunk];
    std::size_t n = 0;
    for (std::size_t r = begin; r < end; ++r) {
      const auto [x, y, z, gap] = from.places_[r];
      if (r == begin || from.cell_[r] != from.cell_[r - 1])
        for (int k = 0; k < 9; ++k) {
          const std::uint64_t first = cell_of(x, y, z, -1, k % 3 - 1, k / 3 - 1);
          const std::uint64_t last = cell_of(x, y, z, 1, k % 3 - 1, k / 3 - 1);
          const auto cells = to.cell_.begin();
          for (int images : {0, 1}) {
            const auto a = cells + static_cast<std::ptrdiff_t>(images ? n_to : 0);
            const auto b = images ? to.cell_.end() : cells + static_cast<std::ptrdiff_t>(n_to);
            const auto low = std::lower_bound(a, b, first);
            ranges[k + 9 * images] = {
                static_cast<std::size_t>(low - cells),
                static_cast<std::size_t>(std::upper_bound(low, b, last) - cells)};
          }
        }
      from.runs_[r].begin = static_cast<std::uint32_t>(n);
      for (const Range& range : ranges)
        for (std::size_t s = range.first; s < range.last; s += chunk) {
          const std::size_t m = std::min(chunk, range.last - s);
          for (std::size_t k = 0; k < m; ++k) {
            const PairSide::Place& there = to.places_[s + k];
            const auto dx = static_cast<float>(there.x - x), dy = static_cast<float>(there.y - y);
            const auto dz = static_cast<float>(there.z - z);
            distance2[k] = dx * dx + dy * dy + dz * dz;
          }
          if (out.size() < n + chunk) fit(out, n + 8 * chunk);
          for (std::size_t k = 0; k < m; ++k) {
            out[n] = static_cast<std::uint32_t>(s + k);
            n += distance2[k] < reach2;
          }
        }
      from.runs_[r].end = static_cast<std::uint32_t>(n);
    }
    fit(out, n + 8);
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(n), out.end(), 0u);
  });
}

/// Whether the lists still hold for this set: none came or went. Periodic positions jump when
/// their set is sorted.
bool CrossPairs::current(const PairSide& side, const Set& set, const Domain& domain) const {
  const bool sorted = side.n_sorts_ != set.n_sorts;
  return side.n_rows() == set.particles.size() && side.n_created_ == set.particles.n_created() &&
         !(sorted && (domain.x.active || domain.y.active));
}

void CrossPairs::rebuild(const Set (&sets)[2], const Domain& domain, int threads) {
  choose_frame(sets[0].particles, sets[1].particles, domain);
  for (int k : {0, 1}) {
    PairSide& side = sides_[k];
    enter(side, sets[k].particles, domain);
    place(side, sets[k].particles, domain, threads);
    add_images(side, domain.x, true);
    add_images(side, domain.y, false);
    sort_images(side);
    place(side, sets[k].particles, domain, threads);
  }
  for (int k : {0, 1}) list(sides_[k], sides_[1 - k], threads);
  moved_ = 0;
  stale_ = false;
  ++n_rebuilds_;
}

void CrossPairs::follow_sorting(PairSide& side, const Set& set) const {
  if (side.n_sorts_ == set.n_sorts) return;
  const ParticleSet& p = set.particles;
  side.index_of_.resize(p.n_created());
  for (std::uint32_t i = 0; i < p.size(); ++i) side.index_of_[p.id[i]] = i;
  for (std::size_t r = 0; r < side.n_rows(); ++r) side.index_[r] = side.index_of_[side.keys_[r].id];
}

void CrossPairs::update(const Set& a, const Set& b, const Domain& domain, double ahead, double time,
                        int threads) {
  const Set sets[2] = {a, b};
  moved_ += ahead;
  unweighed_ += ahead;
  std::size_t walls = 0;
  for (const Wall& wall : domain.walls) walls += time < wall.remove_at_s;
  const bool anew = stale_ || !(moved_ < skin_) || !current(sides_[0], a, domain) ||
                    !current(sides_[1], b, domain);
  if (anew)
    rebuild(sets, domain, threads);
  else
    for (int k : {0, 1}) follow_sorting(sides_[k], sets[k]);
  for (int k : {0, 1}) sides_[k].n_sorts_ = sets[k].n_sorts;
  // A particle and an image close in by what both come nearer to the mirror, besides.
  const double kept = weighed_for * h_;
  const auto closed = [&](int k) { return approach(sides_[k], sets[k], domain, time, threads); };
  if (!anew && walls == n_walls_ && unweighed_ < kept &&
      std::hypot(unweighed_, closed(0) + closed(1)) < kept)
    return;
  n_walls_ = walls;
  unweighed_ = 0;
  ++n_weighings_;
  for (int k : {0, 1}) {
    if (!anew) place(sides_[k], sets[k].particles, domain, threads);
    mirror(sides_[k], sets[k], domain, time, threads);
  }
  weigh(sides_[0], sides_[1], gradients_ == 0, threads);
  weigh(sides_[1], sides_[0], gradients_ == 1, threads);
}

}  // namespace sturz
