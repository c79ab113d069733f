// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/discrete/pairs.hpp"

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/effects/motion/wrapping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();

Vec3 position(const ParticleSet& p, std::size_t i) { return {p.x[i], p.y[i], p.z[i]}; }

}  // namespace

double GrainPairs::update(const Domain& domain, MovingSet& p, std::span<const double> radius,
                          int threads) {
  if (still_good(p, threads)) return 0;
  wrap_particles(domain, p);
  width_ = skin_;
  for (const double r : radius) width_ = std::max(width_, 2 * r + skin_);
  enter(domain, p);
  sort_into_cells();
  find(p, radius, threads);
  const double dropped = join(p, radius);
  index_grains(p.size());
  listed_at_.resize(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) listed_at_[i] = position(p, i);
  p.order_changed = false;
  any_ = true;
  ++n_lists_;
  return dropped;
}

/// Two grains come nearer by what each moves beside the mean of all, which moves them alike.
bool GrainPairs::still_good(const MovingSet& p, int threads) const {
  if (!any_ || p.order_changed || p.size() != listed_at_.size()) return false;
  Vec3 mean = ordered_reduce(
      p.size(), threads, Vec3(0, 0, 0),
      [&](std::size_t begin, std::size_t end, Vec3& sum) {
        for (std::size_t i = begin; i < end; ++i) sum += position(p, i) - listed_at_[i];
      },
      [](Vec3& total, const Vec3& part) { total += part; });
  if (p.size() > 0) mean /= static_cast<double>(p.size());
  const double most = ordered_reduce(
      p.size(), threads, 0.0,
      [&](std::size_t begin, std::size_t end, double& largest) {
        for (std::size_t i = begin; i < end; ++i) {
          const double moved = (position(p, i) - listed_at_[i] - mean).squaredNorm();
          if (!(moved <= largest)) largest = moved;  // NaN, too
        }
      },
      [](double& total, double part) {
        if (!(part <= total)) total = part;
      });
  return 4 * most <= skin_ * skin_;
}

void GrainPairs::add_images(const Period& period, int axis) {
  if (!period.active) return;
  const std::size_t n = sources_.size();
  for (std::size_t k = 0; k < n; ++k)
    for (const int turn : {-1, 1}) {
      Source image = sources_[k];
      const double at = image.position[axis] + turn * period.length();
      if (at < period.min - width_ || at > period.max + width_) continue;
      Vec3 shift(0, 0, turn * period.rise);
      shift[axis] = turn * period.length();
      image.position += shift;
      image.image += shift;
      sources_.push_back(image);
    }
}

void GrainPairs::enter(const Domain& domain, const MovingSet& p) {
  sources_.clear();
  for (std::uint32_t i = 0; i < p.size(); ++i)
    sources_.push_back({position(p, i), Vec3(0, 0, 0), i});
  add_images(domain.x, 0);
  add_images(domain.y, 1);
  constexpr double inf = std::numeric_limits<double>::infinity();
  double east = -inf, north = -inf;
  west_ = south_ = inf;
  for (const Source& s : sources_) {
    west_ = std::min(west_, s.position.x()), east = std::max(east, s.position.x());
    south_ = std::min(south_, s.position.y()), north = std::max(north, s.position.y());
  }
  // A few grains far away must not cost a table of empty cells.
  double cell = width_;
  const auto count = [&](double extent) { return std::max(0.0, std::floor(extent / cell)) + 1; };
  while (count(east - west_) * count(north - south_) > 8.0 * sources_.size() + 4096) cell *= 2;
  width_ = cell;
  n_cols_ = static_cast<std::uint32_t>(count(east - west_));
  n_rows_ = static_cast<std::uint32_t>(count(north - south_));
}

/// A position that is nowhere (NaN) falls into the first cell: the run ends for it anyway.
std::uint32_t GrainPairs::cell_of(const Vec3& at) const {
  const auto along = [&](double distance, std::uint32_t n) {
    const double k = distance > 0 ? distance / width_ : 0;
    return std::min(n - 1, static_cast<std::uint32_t>(k));
  };
  return along(at.y() - south_, n_rows_) * n_cols_ + along(at.x() - west_, n_cols_);
}

void GrainPairs::sort_into_cells() {
  cell_.resize(sources_.size());
  cell_begin_.assign(std::size_t{n_cols_} * n_rows_ + 1, 0);
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    cell_[k] = cell_of(sources_[k].position);
    ++cell_begin_[cell_[k] + 1];
  }
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  sorted_.resize(sources_.size());
  fill_.assign(cell_begin_.begin(), cell_begin_.end() - 1);
  for (std::size_t k = 0; k < sources_.size(); ++k) sorted_[fill_[cell_[k]]++] = sources_[k];
}

void GrainPairs::find_near(std::size_t i, std::span<const double> radius,
                           std::vector<Found>& out) const {
  const Vec3 at = sources_[i].position;  // a grain's own entry stands at its index
  const std::uint32_t cell = cell_[i], row = cell / n_cols_, col = cell % n_cols_;
  const std::uint32_t first = col > 0 ? col - 1 : 0, last = std::min(col + 1, n_cols_ - 1);
  const std::size_t start = out.size();
  for (std::uint32_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, n_rows_ - 1); ++r) {
    const std::uint32_t end = cell_begin_[std::size_t{r} * n_cols_ + last + 1];
    for (std::uint32_t k = cell_begin_[std::size_t{r} * n_cols_ + first]; k < end; ++k) {
      const Source& s = sorted_[k];
      if (s.grain <= i) continue;  // found from the other side; no grain meets its own image
      const double near = radius[i] + radius[s.grain] + skin_;
      if (std::abs(s.position.z() - at.z()) >= near) continue;
      if ((s.position - at).squaredNorm() < near * near) out.push_back({s.grain, s.image});
    }
  }
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(start), out.end(),
            [](const Found& a, const Found& b) { return a.b < b.b; });
}

void GrainPairs::find(const MovingSet& p, std::span<const double> radius, int threads) {
  n_found_.resize(p.size());
  found_.resize((p.size() + block - 1) / block);
  parallel_ranges(p.size(), block, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Found>& found = found_[begin / block];
    found.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t before = found.size();
      find_near(i, radius, found);
      n_found_[i] = static_cast<std::uint32_t>(found.size() - before);
    }
  });
}

/// Makes pairs of what was found, with the memory of those that were listed before. What overlaps
/// and was not listed came from no approach (the grains were set down so): it carries nothing.
double GrainPairs::join(const MovingSet& p, std::span<const double> radius) {
  old_.swap(pairs_);
  pairs_.clear();
  begin_.assign(p.size() + 1, 0);
  std::size_t next = 0;  // in the block's findings
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (i % block == 0) next = 0;
    for (std::uint32_t n = 0; n < n_found_[i]; ++n) {
      const Found& f = found_[i / block][next++];
      GrainPair& pair = pairs_.emplace_back();
      pair.a = static_cast<std::uint32_t>(i), pair.b = f.b, pair.image = f.image;
      const double distance = (position(p, i) - position(p, f.b) - f.image).norm();
      pair.memory.unloaded = std::max(0.0, radius[i] + radius[f.b] - distance);
    }
    begin_[i + 1] = static_cast<std::uint32_t>(pairs_.size());
  }
  new_of_id_.assign(p.n_created(), gone);
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    expect(i == 0 || p.id[i] > p.id[i - 1], "grains are stored in the order of their ids");
    new_of_id_[p.id[i]] = i;
  }
  double dropped = 0;
  for (const GrainPair& old : old_) {
    const std::uint32_t a = new_of_id_[id_[old.a]], b = new_of_id_[id_[old.b]];
    bool kept = false;
    if (a != gone && b != gone)
      for (std::uint32_t k = begin_[a]; !kept && k < begin_[a + 1]; ++k)
        if (pairs_[k].b == b) pairs_[k].memory = old.memory, kept = true;
    if (!kept) dropped += old.memory.stored;
  }
  id_.assign(p.id.begin(), p.id.end());
  return dropped;
}

/// Which pairs each grain belongs to, in their order.
void GrainPairs::index_grains(std::size_t n) {
  begin_.assign(n + 1, 0);
  for (const GrainPair& pair : pairs_) ++begin_[pair.a + 1], ++begin_[pair.b + 1];
  for (std::size_t i = 1; i <= n; ++i) begin_[i] += begin_[i - 1];
  of_grain_.resize(2 * pairs_.size());
  fill_.assign(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t k = 0; k < pairs_.size(); ++k) {
    of_grain_[fill_[pairs_[k].a]++] = k << 1;
    of_grain_[fill_[pairs_[k].b]++] = k << 1 | 1;
  }
}

std::size_t GrainPairs::bytes() const {
  std::size_t total = (pairs_.capacity() + old_.capacity()) * sizeof(GrainPair) +
                      (sources_.capacity() + sorted_.capacity()) * sizeof(Source) +
                      listed_at_.capacity() * sizeof(Vec3);
  for (const auto* v :
       {&cell_begin_, &cell_, &n_found_, &new_of_id_, &begin_, &of_grain_, &fill_, &id_})
    total += v->capacity() * sizeof(std::uint32_t);
  for (const auto& found : found_) total += found.capacity() * sizeof(Found);
  return total;
}

}  // namespace sturz
