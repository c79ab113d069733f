// SPDX-License-Identifier: Apache-2.0
#include "io/members/packs/record_maps.hpp"

#include "io/members/packs/crc32c.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace sturz {
namespace {

constexpr int band_rows = RecordMaps::band_rows;

/// A run of touched cells, counted within the member's window.
struct StoredRun {
  std::uint32_t row = 0, col = 0, n = 0;
};

std::vector<PeakLayer> kept_layers(Censoring censoring, const MemberScalars& scalars) {
  std::vector<PeakLayer> kept;
  for (int i = 0; i < n_peak_layers; ++i)
    if (const auto layer = static_cast<PeakLayer>(i); is_kept(layer, censoring, scalars))
      kept.push_back(layer);
  return kept;
}

bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool same_value(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Finds the touched cells of some rows.
struct BandScan {
  const MemberResult& member;
  const std::vector<PeakLayer>& kept;
  std::vector<StoredRun> runs = {};
  std::uint32_t n_touched = 0;
  bool exact = true;  ///< no cell differs in bits alone

  bool touched(std::size_t i) {
    bool bits = false, value = false;
    for (const PeakLayer layer : kept) {
      const float v = member.layer(layer)[i], untouched = info(layer).untouched;
      bits |= !same_bits(v, untouched);
      value |= !same_value(v, untouched);
    }
    exact &= bits == value;
    return bits;
  }
  void add(int row) {
    const auto n_cols = static_cast<std::uint32_t>(member.window.n_cols);
    for (std::uint32_t col = 0; col < n_cols; ++col) {
      if (!touched(static_cast<std::size_t>(row) * n_cols + col)) continue;
      const bool goes_on = !runs.empty() && runs.back().row == static_cast<std::uint32_t>(row) &&
                           runs.back().col + runs.back().n == col;
      if (goes_on)
        ++runs.back().n;
      else
        runs.push_back({static_cast<std::uint32_t>(row), col, 1});
      ++n_touched;
    }
  }
};

std::uint32_t sum_since(const ByteWriter& bytes, std::size_t begin) {
  return crc32c(bytes.bytes().subspan(begin));
}

/// What a byte range holds, copied out: it need not lie at an even address.
template <class T>
void copy_out(std::span<const std::byte> from, std::size_t first, std::size_t n, T* to) {
  if (n > 0) std::memcpy(to, from.data() + first * sizeof(T), n * sizeof(T));
}

void require_sum(std::span<const std::byte> bytes, std::uint32_t sum) {
  if (crc32c(bytes) != sum) throw BadRecord("its maps do not fit their checksum");
}

/// The part of a run that lies in the columns and rows of `part`, all counted in the grid.
TouchedCells::Run clipped(const StoredRun& run, const Window& window, const Window& part,
                          std::size_t& skipped) {
  const int row = window.row0 + static_cast<int>(run.row);
  const int col = window.col0 + static_cast<int>(run.col);
  const int first = std::max(col, part.col0);
  const int end = std::min(col + static_cast<int>(run.n), part.end_col());
  skipped = static_cast<std::size_t>(std::max(first - col, 0));
  if (row < part.row0 || row >= part.end_row() || end <= first) return {};
  return {row, first, end - first};
}

}  // namespace

void write_maps(ByteWriter& directory, ByteWriter& maps, const MemberResult& m) {
  const std::vector<PeakLayer> kept = kept_layers(m.censoring, m.scalars);
  ByteWriter bands;
  bool exact = true;
  for (int first = 0; first < m.window.n_rows; first += band_rows) {
    BandScan scan{m, kept};
    for (int row = first; row < std::min(first + band_rows, m.window.n_rows); ++row) scan.add(row);
    exact &= scan.exact;
    bands.put(static_cast<std::uint32_t>(scan.runs.size()));
    bands.put(scan.n_touched);
    std::size_t begin = maps.size();
    maps.values(std::span<const StoredRun>(scan.runs));
    bands.put(sum_since(maps, begin));
    for (const PeakLayer layer : kept) {
      begin = maps.size();
      for (const StoredRun& run : scan.runs)
        maps.values(std::span(m.layer(layer))
                        .subspan(static_cast<std::size_t>(run.row) *
                                         static_cast<std::size_t>(m.window.n_cols) +
                                     run.col,
                                 run.n));
      bands.put(sum_since(maps, begin));
    }
  }
  directory.put(static_cast<std::uint32_t>(exact));
  directory.put(static_cast<std::uint32_t>(kept.size()));
  for (const PeakLayer layer : kept) directory.put(static_cast<std::uint32_t>(layer));
  directory.values(bands.bytes());
}

RecordMaps::RecordMaps(std::span<const std::byte> directory, std::uint64_t n_bytes,
                       const MemberSummary& member)
    : window_(member.window),
      n_bytes_(n_bytes),
      kept_(kept_layers(member.censoring, member.scalars)) {
  ByteReader from(directory);
  const bool fits_window = window_.n_cells() > 0 || directory.empty();
  if (!fits_window) throw BadRecord("it has maps but no window");
  if (window_.n_cells() == 0) return;
  exact_ = from.get<std::uint32_t>() != 0;
  bool same = from.get<std::uint32_t>() == kept_.size();
  for (std::size_t i = 0; same && i < kept_.size(); ++i)
    same = from.get<std::uint32_t>() == static_cast<std::uint32_t>(kept_[i]);
  if (!same) throw BadRecord("it has other maps than its numbers say");
  const auto n_bands = static_cast<std::size_t>((window_.n_rows - 1) / band_rows) + 1;
  const std::size_t bytes_each = sizeof(std::uint32_t) * (3 + kept_.size());
  if (from.left() / bytes_each < n_bands) throw BadRecord("its list of maps ends too early");
  bands_.resize(n_bands);
  std::uint64_t offset = 0;
  for (Band& band : bands_) {
    band.offset = offset;
    for (auto* number : {&band.n_runs, &band.n_touched, &band.runs_sum})
      *number = from.get<std::uint32_t>();
    for (std::size_t l = 0; l < kept_.size(); ++l) band.layer_sums[l] = from.get<std::uint32_t>();
    offset += bytes(band);
    if (offset > n_bytes_) throw BadRecord("its maps are shorter than its list of them says");
  }
}

std::uint64_t RecordMaps::runs_bytes(const Band& band) const {
  return sizeof(StoredRun) * std::uint64_t{band.n_runs};
}
std::uint64_t RecordMaps::layer_bytes(const Band& band) const {
  return sizeof(float) * std::uint64_t{band.n_touched};
}
std::uint64_t RecordMaps::bytes(const Band& band) const {
  return runs_bytes(band) + kept_.size() * layer_bytes(band);
}

std::size_t RecordMaps::place_of(PeakLayer layer) const {
  return static_cast<std::size_t>(std::find(kept_.begin(), kept_.end(), layer) - kept_.begin());
}

void RecordMaps::check(std::span<const std::byte> maps) const {
  std::uint64_t end = 0;
  for (const Band& band : bands_) {
    std::uint64_t at = band.offset;
    require_sum(maps.subspan(at, runs_bytes(band)), band.runs_sum);
    at += runs_bytes(band);
    for (std::size_t l = 0; l < kept_.size(); ++l, at += layer_bytes(band))
      require_sum(maps.subspan(at, layer_bytes(band)), band.layer_sums[l]);
    end = at;
  }
  const auto rest = maps.subspan(end);  // filled up to eight bytes
  if (rest.size() >= sizeof(std::uint64_t) ||
      std::any_of(rest.begin(), rest.end(), [](std::byte b) { return b != std::byte{0}; }))
    throw BadRecord("something stands behind its maps");
}

bool RecordMaps::is_exact_for(std::span<const PeakLayer> layers) const {
  const auto asked = [&](PeakLayer l) {
    return std::find(layers.begin(), layers.end(), l) != layers.end();
  };
  return exact_ && std::all_of(kept_.begin(), kept_.end(), asked);
}

void RecordMaps::take(std::size_t number, std::span<const std::byte> all, const Window& part,
                      std::span<const PeakLayer> layers, TouchedCells& out) const {
  const Band& band = bands_[number];
  const auto runs = all.first(runs_bytes(band));
  require_sum(runs, band.runs_sum);
  const std::uint32_t first_row = static_cast<std::uint32_t>(number) * band_rows;
  std::uint64_t seen = 0, before = 0;  // before: end of the last run, as a cell of the window
  const auto n_cols = static_cast<std::uint64_t>(window_.n_cols);
  struct Piece {
    std::size_t first, n;
  };
  thread_local std::vector<Piece> pieces;
  pieces.clear();
  for (std::uint32_t r = 0; r < band.n_runs; ++r) {
    StoredRun run;
    copy_out(runs, r, 1, &run);
    const std::uint64_t cell = run.row * n_cols + run.col;
    const bool sound = run.n > 0 && run.row >= first_row && run.row < first_row + band_rows &&
                       run.row < static_cast<std::uint32_t>(window_.n_rows) && run.col < n_cols &&
                       run.n <= n_cols - run.col && cell >= before &&
                       run.n <= band.n_touched - seen;
    if (!sound) throw BadRecord("its maps lie where they cannot");
    before = cell + run.n;
    std::size_t skipped = 0;
    const TouchedCells::Run mine = clipped(run, window_, part, skipped);
    if (mine.n > 0) {
      out.runs.push_back(mine);
      pieces.push_back({seen + skipped, static_cast<std::size_t>(mine.n)});
      out.n_cells += static_cast<std::size_t>(mine.n);
    }
    seen += run.n;
  }
  if (seen != band.n_touched) throw BadRecord("its maps have another number of cells");
  for (std::size_t l = 0; l < layers.size(); ++l) {
    std::vector<float>& to = out.values[l];
    std::size_t at = to.size();
    to.resize(out.n_cells, info(layers[l]).untouched);
    const std::size_t place = place_of(layers[l]);
    if (place == kept_.size()) continue;
    const auto values =
        all.subspan(runs_bytes(band) + place * layer_bytes(band), layer_bytes(band));
    require_sum(values, band.layer_sums[place]);
    for (const Piece& piece : pieces) {
      std::memcpy(&to[at], values.data() + piece.first * sizeof(float), piece.n * sizeof(float));
      at += piece.n;
    }
  }
}

void RecordMaps::read(const Read& read, const Window& part, std::span<const PeakLayer> layers,
                      TouchedCells& out) const {
  out.reset(layers.size());
  if (part.n_cells() == 0 || bands_.empty()) return;
  const auto first = static_cast<std::size_t>((part.row0 - window_.row0) / band_rows);
  const auto end = static_cast<std::size_t>((part.end_row() - 1 - window_.row0) / band_rows) + 1;
  thread_local std::vector<std::byte> bytes_read;  // this is called a million times
  if (2 * layers.size() > kept_.size()) {          // nearly all of it: in one stroke
    const std::uint64_t from = bands_[first].offset;
    bytes_read.resize(bands_[end - 1].offset + bytes(bands_[end - 1]) - from);
    read(from, bytes_read);
    for (std::size_t b = first; b < end; ++b)
      take(b, std::span(bytes_read).subspan(bands_[b].offset - from, bytes(bands_[b])), part,
           layers, out);
    return;
  }
  for (std::size_t b = first; b < end; ++b) {  // runs and the layers asked for
    const Band& band = bands_[b];
    bytes_read.resize(bytes(band));
    const auto fetch = [&](std::uint64_t at, std::uint64_t n) {
      read(band.offset + at, std::span(bytes_read).subspan(at, n));
    };
    fetch(0, runs_bytes(band));
    for (const PeakLayer layer : layers)
      if (const std::size_t place = place_of(layer); place < kept_.size())
        fetch(runs_bytes(band) + place * layer_bytes(band), layer_bytes(band));
    take(b, bytes_read, part, layers, out);
  }
}

}  // namespace sturz
