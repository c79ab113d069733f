// SPDX-License-Identifier: Apache-2.0
/// The maps of a member in a pack: touched cells only, in bands of rows that can be read alone.
///
/// A band holds the runs of touched cells of 16 rows and then, layer by layer, a float32 for each
/// of these cells. A cell is touched where the bits of some layer are not those of an untouched
/// cell, so maps come back bit for bit. Runs and each layer of a band have checksums of their own,
/// kept in the directory: what is read is checked, however little it is.
///
/// Not compressed: shuffle and deflate would save a third of it and cost merges more (ADR 0052).
#pragma once

#include "engine/simulation/member_result.hpp"
#include "engine/simulation/touched_cells.hpp"
#include "io/members/packs/byte_stream.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sturz {

/// Appends the directory and the maps of a result that has some.
void write_maps(ByteWriter& directory, ByteWriter& maps, const MemberResult&);

/// Where the parts of a member's maps lie, and how to read them.
class RecordMaps {
 public:
  static constexpr int band_rows = 16;
  /// Reads bytes of the maps from an offset, as many as fit.
  using Read = std::function<void(std::uint64_t offset, std::span<std::byte>)>;

  RecordMaps() = default;  ///< of a member without maps
  /// \param n_bytes of the maps \throws BadRecord when it does not fit the member
  RecordMaps(std::span<const std::byte> directory, std::uint64_t n_bytes, const MemberSummary&);

  /// Whether all of the maps is as it was written. \throws BadRecord
  void check(std::span<const std::byte> maps) const;

  /// The touched cells of `part`, which lies in the member's window. A layer that the member does
  /// not have is untouched in all of them. \throws BadRecord; what `read` throws
  void read(const Read& read, const Window& part, std::span<const PeakLayer> layers,
            TouchedCells& out) const;
  /// Whether a cell of the runs differs from an untouched one by value in one of these layers.
  bool is_exact_for(std::span<const PeakLayer> layers) const;

 private:
  struct Band {
    std::uint64_t offset = 0;
    std::uint32_t n_runs = 0, n_touched = 0, runs_sum = 0;
    std::array<std::uint32_t, n_peak_layers> layer_sums{};  // by place in kept_
  };
  std::uint64_t runs_bytes(const Band&) const;
  std::uint64_t layer_bytes(const Band&) const;
  std::uint64_t bytes(const Band&) const;
  /// Of a layer among the kept ones; their number when it is not kept.
  std::size_t place_of(PeakLayer) const;
  void take(std::size_t band, std::span<const std::byte> all, const Window& part,
            std::span<const PeakLayer> layers, TouchedCells& out) const;

  Window window_;
  std::uint64_t n_bytes_ = 0;
  bool exact_ = false;
  std::vector<PeakLayer> kept_;
  std::vector<Band> bands_;
};

}  // namespace sturz
