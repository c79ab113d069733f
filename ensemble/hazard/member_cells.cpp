// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/member_cells.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/touched_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

std::vector<std::size_t> valid_in_order(const std::vector<MemberSummary>& members) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (is_valid(members[i].outcome)) indices.push_back(i);
  const auto number = [&](std::size_t i) { return members[i].member; };
  std::sort(indices.begin(), indices.end(),
            [&](std::size_t a, std::size_t b) { return number(a) < number(b); });
  for (std::size_t i = 1; i < indices.size(); ++i)
    require(number(indices[i]) != number(indices[i - 1]),
            fmt::format("member {} occurs twice (two shards computed it?). Keep one of its files.",
                        number(indices[i])));
  return indices;
}

Window hull(const Window& a, const Window& b) {
  if (a.n_cells() == 0) return b;
  if (b.n_cells() == 0) return a;
  Window both;
  both.row0 = std::min(a.row0, b.row0);
  both.col0 = std::min(a.col0, b.col0);
  both.n_rows = std::max(end_row(a), end_row(b)) - both.row0;
  both.n_cols = std::max(end_col(a), end_col(b)) - both.col0;
  return both;
}

/// Peaks are never negative and never undefined; an arrival time, and what needs a flow, may be.
void check_values(std::span<const float> values, PeakLayer layer, std::int64_t member) {
  const bool may_be_nan = std::isnan(info(layer).untouched);
  bool good = true;
  for (const float v : values) good &= may_be_nan ? !(v < 0) : v >= 0;
  require(good, fmt::format("member {}: {} holds a value that is negative{} (it cannot be). Delete "
                            "the member's file and compute it again.",
                            member, info(layer).name, may_be_nan ? "" : " or undefined"));
}

/// One member's values in the rows of a pass, read in bands that a block is high.
class MemberReader {
 public:
  MemberReader(const MemberParts& source, const std::vector<PeakLayer>& layers)
      : source_(source), layers_(layers) {}

  void collect(std::size_t index, std::uint32_t place, TouchedRecords& records) {
    const MemberSummary& member = source_.members()[index];
    const Window mine = overlap(member.window, records.cells_ahead());
    for (int row = 0; row < mine.n_rows; row += MemberCells::block_edge) {
      const Window band{mine.row0 + row, mine.col0,
                        std::min(MemberCells::block_edge, mine.n_rows - row), mine.n_cols};
      source_.read_touched(index, band, layers_, cells_);
      for (std::size_t l = 0; l < layers_.size(); ++l)
        check_values(cells_.values[l], layers_[l], member.member);
      records.add(place, cells_);
    }
  }

 private:
  const MemberParts& source_;
  const std::vector<PeakLayer>& layers_;
  TouchedCells cells_;
};

}  // namespace

MemberCells::MemberCells(const MemberParts& source)
    : source_(source), indices_(valid_in_order(source.members())) {
  for (const std::size_t i : indices_) touched_ = hull(touched_, source.members()[i].window);
}

void MemberCells::visit(const Window& extent, const std::vector<PeakLayer>& layers,
                        std::size_t memory_bytes, CancelFlag cancel,
                        const std::function<void(const CellRows&)>& visitor) const {
  std::vector<Window> windows;
  windows.reserve(indices_.size());
  for (const std::size_t i : indices_) windows.push_back(source_.members()[i].window);
  TouchedRecords records(extent, layers, memory_bytes, windows);
  MemberReader reader(source_, layers);
  while (records.next_pass()) {
    for (std::size_t m = 0; m < indices_.size(); ++m) {
      cancel.check();
      reader.collect(indices_[m], static_cast<std::uint32_t>(m), records);
    }
    records.hand_out([&](const CellRows& rows) {
      cancel.check();
      visitor(rows);
    });
  }
}

}  // namespace sturz
