// SPDX-License-Identifier: Apache-2.0
/// Pairs across two particle sets with their smoothing weights, listed from both sides, for sums
/// that are taken several times a step.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/core/vec.hpp"
#include "engine/particles/particle_set.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sturz {

/// New size of a vector that grows and shrinks by little: it asks for memory with some to spare.
template <class Value>
void fit(std::vector<Value>& values, std::size_t size) {
  if (size > values.capacity()) values.reserve(size + size / 4);
  values.resize(size);
}

/// The particles of one set in an order of their own, by cell and then by id, so that sums over
/// them have the same bits whatever the storage order; and, per particle, its neighbours in the
/// other set. A neighbour is a source: a row of the other side, or a periodic image of one.
class PairSide {
 public:
  std::size_t n_rows() const { return index_.size(); }
  /// Storage index of a row's particle, up to date after CrossPairs::update.
  std::uint32_t index(std::size_t row) const { return index_[row]; }
  /// Rows and the images behind them: how many values a sum over neighbours reads.
  std::size_t n_sources() const { return places_.size(); }
  /// Values of the rows are there; gives the images theirs.
  template <class Value>
  void copy_images(std::vector<Value>& values) const {
    for (std::size_t k = 0; k < image_row_.size(); ++k)
      values[n_rows() + k] = values[image_row_[k]];
  }
  /// A row's pairs within the support, in a fixed order.
  struct Pairs {
    const std::uint32_t* source;
    const float* weight;  ///< W > 0 [1/m^3] of the smoothing kernel
    const float* slope;   ///< C t^3 [1/m^5], whose gradient at the row is slope (x_source - x_row)
    std::size_t n;
  };
  /// A pair has the same weight from both sides, to the last bit. Slopes on the side that wants
  /// gradients only.
  Pairs pairs(std::size_t row) const { return blocks_[row / block].weighed.pairs(row % block); }
  /// Where a source lies, in the frame of CrossPairs::unit [units].
  Vec3 place(std::size_t source) const {
    const Place& p = places_[source];
    return {1.0 * p.x, 1.0 * p.y, 1.0 * p.z};
  }
  /// Ground and walls that may complete supports.
  std::size_t n_mirrors() const { return mirrors_.size(); }
  /// Whether sources have images in mirror m near a row; its normal and the distance to it [units].
  bool near(std::size_t row, std::size_t m) const { return mirrors_[m].gap[row] < far_; }
  Vec3 normal(std::size_t row, std::size_t m) const {
    const Mirror& p = mirrors_[m];
    return {p.nx[row], p.ny[row], p.nz[row]};
  }
  float gap(std::size_t source, std::size_t m) const { return mirrors_[m].gap[source]; }
  /// The images of a row's pairs in mirror m, for rows near it. The weights of `pairs` hold them
  /// already, its slopes do not.
  Pairs image_pairs(std::size_t row, std::size_t m) const {
    return blocks_[row / block].images[m].pairs(row % block);
  }
  std::size_t n_entries() const;
  std::size_t bytes() const;

 private:
  friend class CrossPairs;
  static constexpr std::size_t block = 256;  ///< rows whose entries are kept together

  struct Run {
    std::uint32_t begin = 0, end = 0;  ///< entries of a row in its block
  };
  /// Pairs of a block's rows, no more than what has a weight.
  struct Weighed {
    std::vector<Run> runs;  ///< [rows of the block]; empty: none has any
    std::vector<std::uint32_t> source;
    std::vector<float> weight;  ///< W [1/m^3]
    std::vector<float> slope;   ///< C t^3 [1/m^5], only where gradients are wanted

    Pairs pairs(std::size_t row) const {
      if (runs.empty()) return {nullptr, nullptr, nullptr, 0};
      const Run run = runs[row];
      return {source.data() + run.begin, weight.data() + run.begin,
              slope.empty() ? nullptr : slope.data() + run.begin, std::size_t{run.end} - run.begin};
    }
    void make_room(std::size_t rows, std::size_t entries, bool gradients);
    std::size_t bytes() const;
  };
  struct Block {
    /// Those within the support and the skin; eight more than there are: whole lanes are read.
    std::vector<std::uint32_t> candidate;
    Weighed weighed;
    std::vector<Weighed> images;  ///< [mirror]
  };
  /// A plane near which sources have images: the ground under each particle, or a wall.
  struct Mirror {
    std::vector<float> gap;         ///< [sources] distance in position units, at most 2h
    std::vector<float> nx, ny, nz;  ///< [rows] normal
  };
  /// Of a source, in position units.
  struct alignas(16) Place {
    std::int32_t x = 0, y = 0, z = 0;
    float gap = 0;  ///< to the first mirror: it is loaded with the others
  };
  struct Key {
    std::uint64_t cell = 0;
    std::uint32_t id = 0, index = 0;
    std::int32_t turn_x = 0, turn_y = 0;  ///< periods that wrapping takes off
  };
  struct Image {
    std::uint64_t cell = 0;
    std::uint32_t row = 0;
    std::int32_t dx = 0, dy = 0, dz = 0;  ///< in position units
  };

  std::vector<Key> keys_;      ///< [rows] of the last rebuild
  std::vector<Image> images_;  ///< of the last rebuild
  std::vector<std::uint32_t> index_, image_row_;
  std::vector<std::uint64_t> cell_;  ///< [sources] of the last rebuild
  std::vector<Place> places_;        ///< [sources]
  std::vector<Mirror> mirrors_;
  float far_ = 0;          ///< 2h in position units
  std::vector<Run> runs_;  ///< [rows] of candidates
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> index_of_;  ///< by id
  std::size_t n_created_ = 0, n_sorts_ = 0;
};

/// Which particles of two sets are near each other: lists with a skin, made anew when particles
/// have moved by more than it relative to each other, or came or went. A set that was only sorted
/// keeps its lists.
class CrossPairs {
 public:
  /// \param smoothing_length h of the smoothing kernel [m], support 2h; \param skin [m]
  /// \param gradients  which side wants them
  CrossPairs(double smoothing_length, double skin, int gradients);

  /// The ground under each particle, [particles] each; null: none.
  struct Ground {
    /// Along the normal; 2h or more: no image, as where the ground is not known [m].
    const float* distance = nullptr;
    const float *nx = nullptr, *ny = nullptr, *nz = nullptr;
  };
  /// A set and how often it was sorted (MovingSet::n_sorts).
  struct Set {
    const ParticleSet& particles;
    std::size_t n_sorts;
    Ground ground = {};
  };
  /// Brings lists, and weights that moved on by more than `weighed_for`, up to date. \param ahead
  /// longest way that two particles of the sets may have gone relative to each other since the last
  /// call [m] \param time  walls count until they are removed [s]
  ///
  /// A support that ground or a wall cuts is completed by the images of the sources: what lies at
  /// its foot is as full of grains as what lies above it.
  void update(const Set& a, const Set& b, const Domain&, double ahead, double time, int threads);

  const PairSide& side(int k) const { return sides_[k]; }
  /// Of PairSide::place [m].
  double unit() const { return unit_; }
  std::size_t n_rebuilds() const { return n_rebuilds_; }
  /// How often weights were made.
  std::size_t n_weighings() const { return n_weighings_; }
  std::size_t bytes() const { return sides_[0].bytes() + sides_[1].bytes(); }

 private:
  void follow_sorting(PairSide&, const Set&) const;
  bool current(const PairSide&, const Set&, const Domain&) const;
  void rebuild(const Set (&)[2], const Domain&, int threads);
  void choose_frame(const ParticleSet&, const ParticleSet&, const Domain&);
  void enter(PairSide&, const ParticleSet&, const Domain&) const;
  void add_images(PairSide&, const Period&, bool along_x) const;
  void sort_images(PairSide&) const;
  void place(PairSide&, const ParticleSet&, const Domain&, int threads) const;
  class Weigher;
  float gap_units(double distance) const;
  void mirror(PairSide& side, const Set& set, const Domain& domain, double time, int threads) const;
  double approach(const PairSide& side, const Set& set, const Domain& domain, double time,
                  int threads) const;
  void list(PairSide& from, const PairSide& to, int threads) const;
  void weigh(PairSide& from, const PairSide& to, bool gradients, int threads) const;
  std::uint64_t cell_of(std::int32_t x, std::int32_t y, std::int32_t z, int dx, int dy,
                        int dz) const;
  std::int32_t fixed(double distance) const;
  std::int32_t cell_units() const;

  double h_, support_, skin_;
  int gradients_;
  /// In smoothing lengths: as long as nothing moved further, weights stay. They are the same from
  /// both sides all the while, so that what is exchanged is exact.
  static constexpr double weighed_for = 0.02;
  double moved_ = 0, unweighed_ = 0;
  std::size_t n_walls_ = 0;
  bool stale_ = true;
  std::size_t n_rebuilds_ = 0, n_weighings_ = 0;
  double origin_[3] = {0, 0, 0};  ///< of the position units [m]
  double unit_ = 1;               ///< [m]
  PairSide sides_[2];
};

}  // namespace sturz
