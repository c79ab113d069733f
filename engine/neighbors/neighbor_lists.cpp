// SPDX-License-Identifier: Apache-2.0
#include "engine/neighbors/neighbor_lists.hpp"

#include "engine/core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sturz {
namespace {

std::int32_t to_units(double value, double origin, double unit) {
  return static_cast<std::int32_t>(std::lrint((value - origin) / unit));
}

}  // namespace

NeighborLists::NeighborLists(double support, double skin, TightList tight)
    : support_(support), skin_(skin), tight_(tight) {}

void NeighborLists::rebuild(ParticleSet& set, const Domain& domain, int threads,
                            std::size_t n_listed) {
  n_particles_ = n_listed;
  n_groups_ = (n_particles_ + group_size - 1) / group_size;
  for (std::size_t i = 0; i < n_particles_; ++i) domain.wrap(set.x[i], set.y[i], set.z[i]);
  if (n_particles_ == 0) return rest();
  choose_frame(set, domain);
  sort_particles(set);
  make_images(set, domain);
  // Padding records carry no volume, so a lane that shares their group sees nothing of them.
  records_.assign(padded_size() + images_.size(), NeighborRecord{});
  gather_positions(set, 0, n_particles_);
  for (std::size_t i = n_particles_; i < padded_size(); ++i)
    records_[i] = records_[n_particles_ - 1];
  copy_images();
  sort_records();
  build_lists(threads);
  stale_ = false;
  moved_ = 0;
  ++n_rebuilds_;
}

/// No particle to list.
void NeighborLists::rest() {
  images_.clear();
  records_.clear();
  list_end_.clear();
  block_lists_.clear();
  stale_ = false;
  moved_ = 0;
  ++n_rebuilds_;
}

void NeighborLists::choose_frame(const ParticleSet& set, const Domain& domain) {
  double lo[3] = {1e300, 1e300, 1e300}, hi[3] = {-1e300, -1e300, -1e300};
  for (std::size_t i = 0; i < n_particles_; ++i) {
    const double p[3] = {set.x[i], set.y[i], set.z[i]};
    for (int k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
  }
  double extent = 0;
  for (int k = 0; k < 3; ++k) {
    origin_[k] = 0.5 * (lo[k] + hi[k]);
    extent = std::max(extent, hi[k] - lo[k]);
  }
  // The finest power of two of the support that keeps differences inside 31 bits, images included:
  // an image lies a whole period away, however small the part that the particles fill.
  for (const Period* p : {&domain.x, &domain.y})
    if (p->active) extent += p->length() + std::abs(p->rise);
  int bits = 21;
  while (bits > 10 && (extent + 4 * support_) / support_ * std::ldexp(1.0, bits) > 1.0e9) --bits;
  unit_ = std::ldexp(support_, -bits);

  const double search_radius = support_ + skin_;
  width_ = search_radius;
  west_ = lo[0] - 2 * search_radius;
  south_ = lo[1] - 2 * search_radius;
  auto count = [&](int k) {
    return static_cast<std::uint32_t>((hi[k] - lo[k] + 4 * search_radius) / width_) + 1;
  };
  // A few far particles must not cost a table of empty columns.
  while (double(count(0)) * count(1) > 8.0 * n_particles_ + 4096) width_ *= 2;
  n_cols_ = count(0);
  n_rows_ = count(1);
}

/// Columns are numbered row by row, every second row backwards, so that a group that straddles two
/// columns still holds neighbours.
std::uint32_t NeighborLists::column_of(double x, double y) const {
  const auto col = std::min<std::uint32_t>(
      n_cols_ - 1, static_cast<std::uint32_t>(std::max(0.0, (x - west_) / width_)));
  const auto row = std::min<std::uint32_t>(
      n_rows_ - 1, static_cast<std::uint32_t>(std::max(0.0, (y - south_) / width_)));
  return row * n_cols_ + (row % 2 ? n_cols_ - 1 - col : col);
}

void NeighborLists::sort_particles(ParticleSet& set) {
  keys_.resize(n_particles_);
  order_.resize(set.size());
  for (std::size_t i = 0; i < n_particles_; ++i) {
    const std::int64_t z = to_units(set.z[i], origin_[2], unit_) + (std::int64_t{1} << 31);
    keys_[i] = (std::uint64_t{column_of(set.x[i], set.y[i])} << 32) | std::uint64_t(z);
  }
  std::iota(order_.begin(), order_.end(), 0u);
  const auto end = order_.begin() + static_cast<std::ptrdiff_t>(n_particles_);
  std::sort(order_.begin(), end, [&](std::uint32_t a, std::uint32_t b) {
    return keys_[a] != keys_[b] ? keys_[a] < keys_[b] : set.id[a] < set.id[b];
  });
  set.permute(order_);
}

void NeighborLists::make_images(const ParticleSet& set, const Domain& domain) {
  images_.clear();
  if (!domain.x.active && !domain.y.active && walls_.empty()) return;
  const double search_radius = support_ + skin_;
  auto shifts = [&](const Period& p, double position, double out[3]) {
    int n = 0;
    out[n++] = 0;
    if (!p.active) return n;
    if (position < p.min + search_radius) out[n++] = 1;
    if (position >= p.max - search_radius) out[n++] = -1;
    return n;
  };
  for (std::size_t i = 0; i < n_particles_; ++i) {
    double sx[3], sy[3];
    const int nx = shifts(domain.x, set.x[i], sx), ny = shifts(domain.y, set.y[i], sy);
    for (int a = 0; a < nx; ++a)
      for (int b = 0; b < ny; ++b) {
        const RecordImage image{static_cast<std::uint32_t>(i), sx[a] * domain.x.length(),
                                sy[b] * domain.y.length(),
                                sx[a] * domain.x.rise + sy[b] * domain.y.rise};
        if (!walls_.empty()) mirror(image, {set.x[i], set.y[i], set.z[i]});
        if (sx[a] != 0 || sy[b] != 0) images_.push_back(image);
      }
  }
}

/// Images in every wall beside the source, and in the corners of two that stand upright on
/// each other.
void NeighborLists::mirror(RecordImage image, const Vec3& at) {
  const double search_radius = support_ + skin_;
  const auto beside = [&](const Wall& w) {
    return std::abs((at - w.point).dot(w.normal)) < search_radius;
  };
  for (std::size_t a = 0; a < walls_.size(); ++a) {
    if (!beside(walls_[a])) continue;
    image.mirrors[0] = &walls_[a], image.mirrors[1] = nullptr;
    images_.push_back(image);
    for (std::size_t b = 0; b < a; ++b) {
      if (!beside(walls_[b]) || std::abs(walls_[a].normal.dot(walls_[b].normal)) > 0.01) continue;
      image.mirrors[1] = &walls_[b];
      images_.push_back(image);
    }
  }
}

void NeighborLists::mirror_in(const std::vector<Wall>& walls, double time) {
  std::size_t standing = 0;
  for (const Wall& w : walls) standing += time < w.remove_at_s;
  if (standing == walls_.size()) return;
  walls_.clear();
  for (const Wall& w : walls)
    if (time < w.remove_at_s) walls_.push_back(w);
  invalidate();
}

void NeighborLists::weigh_images(double moment_factor) {
  if (walls_.empty()) return;
  const double enough = 0.25 / moment_factor;
  for (RecordImage& image : images_) {
    image.share = 1;
    for (const Wall* wall : image.mirrors)
      if (wall)
        image.share *=
            static_cast<float>(std::min(1.0, moment_along(image, wall->normal, enough) / enough));
  }
}

/// Sum of t^3 (r.n)^2 over the listed particles and their periodic images, t = 1 - r/2h, no farther
/// than where it is `enough` [m^2]. What a wall mirrors does not count: it is what is weighed.
double NeighborLists::moment_along(const RecordImage& image, const Vec3& normal,
                                   double enough) const {
  const NeighborView lists = view();
  const std::size_t group = image.source / group_size;
  const std::uint32_t* begin = lists.list(group);
  const NeighborRecord& i = records_[image.source];
  const auto nx = static_cast<float>(normal.x()), ny = static_cast<float>(normal.y());
  const auto nz = static_cast<float>(normal.z()), to_s = static_cast<float>(unit_ / support_);
  const auto stop = static_cast<float>(enough / (unit_ * unit_));
  float sum = 0;
  for (const std::uint32_t* j = begin; j != begin + lists.list_size(group) && sum < stop; ++j) {
    if (*j >= padded_size() && images_[*j - padded_size()].mirrors[0]) continue;
    const NeighborRecord& o = records_[*j];
    const auto x = static_cast<float>(o.x - i.x), y = static_cast<float>(o.y - i.y);
    const auto z = static_cast<float>(o.z - i.z);
    const float t = 1 - to_s * std::sqrt(x * x + y * y + z * z);
    if (t <= 0) continue;
    const float along = x * nx + y * ny + z * nz;
    sum += t * t * t * along * along;
  }
  return sum * unit_ * unit_;
}

void NeighborLists::turn(std::size_t image, float& x, float& y, float& z) const {
  for (const Wall* wall : images_[image - padded_size()].mirrors) {
    if (!wall) return;
    const Vec3& n = wall->normal;
    const double twice = 2 * (n.x() * x + n.y() * y + n.z() * z);
    x = static_cast<float>(x - twice * n.x());
    y = static_cast<float>(y - twice * n.y());
    z = static_cast<float>(z - twice * n.z());
  }
}

/// Position, velocity and stress R s R with R = I - 2 n n^T.
void NeighborLists::mirror_record(const Wall& wall, NeighborRecord& r) const {
  const Vec3& n = wall.normal;
  const Vec3 at(origin_[0] + r.x * unit_, origin_[1] + r.y * unit_, origin_[2] + r.z * unit_);
  const double away = 2 * (at - wall.point).dot(n);
  r.x -= to_units(away * n.x(), 0, unit_);
  r.y -= to_units(away * n.y(), 0, unit_);
  r.z -= to_units(away * n.z(), 0, unit_);
  const double twice = 2 * (n.x() * r.vx + n.y() * r.vy + n.z() * r.vz);
  r.vx = static_cast<float>(r.vx - twice * n.x());
  r.vy = static_cast<float>(r.vy - twice * n.y());
  r.vz = static_cast<float>(r.vz - twice * n.z());
  const Vec3 t(r.sxx * n.x() + r.sxy * n.y() + r.szx * n.z(),
               r.sxy * n.x() + r.syy * n.y() + r.syz * n.z(),
               r.szx * n.x() + r.syz * n.y() + r.szz * n.z());
  const double normal = 4 * t.dot(n);
  const auto turned = [&](float s, int a, int b) {
    return static_cast<float>(s - 2 * (n[a] * t[b] + t[a] * n[b]) + normal * n[a] * n[b]);
  };
  r.sxx = turned(r.sxx, 0, 0), r.syy = turned(r.syy, 1, 1), r.szz = turned(r.szz, 2, 2);
  r.sxy = turned(r.sxy, 0, 1), r.syz = turned(r.syz, 1, 2), r.szx = turned(r.szx, 2, 0);
}

void NeighborLists::gather_positions(const ParticleSet& set, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    records_[i].x = to_units(set.x[i], origin_[0], unit_);
    records_[i].y = to_units(set.y[i], origin_[1], unit_);
    records_[i].z = to_units(set.z[i], origin_[2], unit_);
  }
}

void NeighborLists::copy_images() {
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const RecordImage& image = images_[k];
    NeighborRecord& r = records_[padded_size() + k];
    r = records_[image.source];
    for (const Wall* wall : image.mirrors)
      if (wall) mirror_record(*wall, r);
    r.volume *= image.share;
    r.x += to_units(image.dx, 0, unit_);
    r.y += to_units(image.dy, 0, unit_);
    r.z += to_units(image.dz, 0, unit_);
  }
}

void NeighborLists::sort_records() {
  const std::size_t n = n_particles_ + images_.size();
  sorted_.resize(n);
  keys_.resize(n);
  column_begin_.assign(std::size_t{n_cols_} * n_rows_ + 1, 0);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t r = k < n_particles_ ? k : padded_size() + k - n_particles_;
    const NeighborRecord& p = records_[r];
    const auto column = column_of(origin_[0] + p.x * unit_, origin_[1] + p.y * unit_);
    keys_[k] =
        (std::uint64_t{column} << 32) | std::uint64_t(std::int64_t{p.z} + (std::int64_t{1} << 31));
    ++column_begin_[column + 1];
    sorted_[k] = static_cast<std::uint32_t>(k);
  }
  std::partial_sum(column_begin_.begin(), column_begin_.end(), column_begin_.begin());
  // Particles are in order already but for rounding at column borders; images are few.
  std::sort(sorted_.begin(), sorted_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return keys_[a] != keys_[b] ? keys_[a] < keys_[b] : a < b;
  });
  for (auto& s : sorted_)
    if (s >= n_particles_) s += static_cast<std::uint32_t>(padded_size() - n_particles_);
}

std::size_t NeighborLists::collect(std::size_t group, std::vector<std::uint32_t>& candidates,
                                   std::vector<std::uint32_t>& out) const {
  const std::size_t first = group * group_size;
  const int n = static_cast<int>(std::min<std::size_t>(group_size, n_particles_ - first));
  std::int64_t lo[3] = {0, 0, 0}, hi[3] = {0, 0, 0};
  for (int k = 0; k < n; ++k) {
    const NeighborRecord& p = records_[first + k];
    const std::int64_t c[3] = {p.x, p.y, p.z};
    for (int d = 0; d < 3; ++d) {
      lo[d] = k ? std::min(lo[d], c[d]) : c[d];
      hi[d] = k ? std::max(hi[d], c[d]) : c[d];
    }
  }
  const double search_radius = support_ + skin_;
  const auto radius_units = static_cast<std::int64_t>(search_radius / unit_) + 1;
  const double x0 = origin_[0] + lo[0] * unit_ - search_radius,
               x1 = origin_[0] + hi[0] * unit_ + search_radius;
  const double y0 = origin_[1] + lo[1] * unit_ - search_radius,
               y1 = origin_[1] + hi[1] * unit_ + search_radius;
  auto clamp_index = [&](double v, double edge, std::uint32_t count) {
    return std::min<std::int64_t>(count - 1,
                                  std::max<std::int64_t>(0, std::int64_t((v - edge) / width_)));
  };
  candidates.clear();
  for (auto row = clamp_index(y0, south_, n_rows_); row <= clamp_index(y1, south_, n_rows_); ++row)
    for (auto col = clamp_index(x0, west_, n_cols_); col <= clamp_index(x1, west_, n_cols_);
         ++col) {
      const std::size_t column = row * n_cols_ + (row % 2 ? n_cols_ - 1 - col : col);
      auto it = sorted_.begin() + column_begin_[column];
      const auto last = sorted_.begin() + column_begin_[column + 1];
      it = std::lower_bound(it, last, lo[2] - radius_units,
                            [&](std::uint32_t r, std::int64_t z) { return records_[r].z < z; });
      for (; it != last && records_[*it].z <= hi[2] + radius_units; ++it) {
        const NeighborRecord& p = records_[*it];
        if (p.x >= lo[0] - radius_units && p.x <= hi[0] + radius_units &&
            p.y >= lo[1] - radius_units && p.y <= hi[1] + radius_units)
          candidates.push_back(*it);
      }
    }
  const std::size_t start = out.size();
  out.resize(start + candidates.size());
  const std::size_t found = tight_(records_.data(), first, n, candidates.data(), candidates.size(),
                                   static_cast<float>(search_radius / unit_), out.data() + start);
  out.resize(start + found);
  return found;
}

void NeighborLists::build_lists(int threads) {
  const std::size_t n_blocks = (n_groups_ + groups_per_block - 1) / groups_per_block;
  block_lists_.resize(n_blocks);
  blocks_.resize(n_blocks);
  list_end_.resize(n_groups_);
  parallel_ranges(n_groups_, groups_per_block, threads, [&](std::size_t begin, std::size_t end) {
    // Collected in the thread's scratch first: a block's own vector then has the size it needs and
    // a little room, so that later lists fit.
    thread_local std::vector<std::uint32_t> candidates, found;
    found.clear();
    for (std::size_t g = begin; g < end; ++g) {
      collect(g, candidates, found);
      list_end_[g] = static_cast<std::uint32_t>(found.size());
    }
    auto& list = block_lists_[begin / groups_per_block];
    if (list.capacity() < found.size()) list.reserve(found.size() + found.size() / 8);
    list.assign(found.begin(), found.end());
    blocks_[begin / groups_per_block] = list.data();
  });
}

NeighborView NeighborLists::view() const {
  return {records_.data(), n_particles_, blocks_.data(), list_end_.data(), unit_};
}

std::size_t NeighborLists::n_entries() const {
  std::size_t n = 0;
  for (const auto& b : block_lists_) n += b.size();
  return n;
}

std::size_t NeighborLists::bytes() const {
  std::size_t blocks = 0;
  for (const auto& b : block_lists_) blocks += b.capacity() * sizeof(std::uint32_t);
  return blocks + records_.capacity() * sizeof(NeighborRecord) +
         keys_.capacity() * sizeof(std::uint64_t) +
         (order_.capacity() + sorted_.capacity() + column_begin_.capacity() +
          list_end_.capacity()) *
             sizeof(std::uint32_t);
}

}  // namespace sturz
