// SPDX-License-Identifier: Apache-2.0
/// Stored members of several levels, parted at random into those that an estimate may use and those
/// that it is held against.
#pragma once

#include "engine/core/random.hpp"
#include "ensemble/workflow/multilevel/estimates.hpp"
#include "io/members/member_store.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Members in memory that know where the flow came, and nothing else of their maps.
class CoveredMembers final : public MemberParts {
 public:
  explicit CoveredMembers(Grid grid) : grid_(std::move(grid)) {}
  void add(MemberSummary summary, std::shared_ptr<const std::vector<std::uint8_t>> covered) {
    summaries_.push_back(std::move(summary));
    covered_.push_back(std::move(covered));
  }
  const std::vector<MemberSummary>& members() const override { return summaries_; }
  const Grid& grid() const override { return grid_; }
  void read_part(std::size_t index, PeakLayer, const Window& part,
                 std::span<float> out) const override {
    const Window& whole = summaries_[index].window;
    for (int row = 0; row < part.n_rows; ++row)
      for (int col = 0; col < part.n_cols; ++col) {
        const auto at = static_cast<std::size_t>(row + part.row0 - whole.row0) * whole.n_cols +
                        col + part.col0 - whole.col0;
        out[static_cast<std::size_t>(row) * part.n_cols + col] =
            (*covered_[index])[at] != 0 ? 1.0F : std::nanf("");
      }
  }
  const std::shared_ptr<const std::vector<std::uint8_t>>& covered(std::size_t index) const {
    return covered_[index];
  }

 private:
  Grid grid_;
  std::vector<MemberSummary> summaries_;
  std::vector<std::shared_ptr<const std::vector<std::uint8_t>>> covered_;
};

class StoredLevels {
 public:
  /// Draws of the dearest level that an estimate may use.
  static constexpr std::size_t pool = 64;

  /// Members that failed, or whose end was not seen, are left out.
  void add(const std::string& name, const std::filesystem::path& folder, double spacing_m) {
    const MemberStore store(folder / "members");
    parts_.push_back({name, name, spacing_m});
    levels_.push_back(std::make_unique<CoveredMembers>(store.grid()));
    left_out_.push_back(0);
    for (std::size_t i = 0; i < store.members().size(); ++i) {
      const MemberSummary& m = store.members()[i];
      if (!is_valid(m.outcome) || m.censoring != Censoring::none) {
        ++left_out_.back();
        continue;
      }
      std::vector<std::uint8_t> covered = covered_cells(store, i, {}, m.window).values;
      levels_.back()->add(m, std::make_shared<const std::vector<std::uint8_t>>(std::move(covered)));
    }
  }

  const std::vector<std::unique_ptr<CoveredMembers>>& levels() const { return levels_; }
  const std::vector<std::size_t>& left_out() const { return left_out_; }
  std::vector<double> costs_s() const {
    std::vector<double> costs;
    for (const auto& level : levels_) {
      double sum = 0;
      for (const MemberSummary& m : level->members()) sum += m.scalars.cpu_s;
      costs.push_back(sum / static_cast<double>(level->members().size()));
    }
    return costs;
  }

  /// Two sets of levels that share no draw; members are numbered anew, in random order.
  struct Parted {
    std::vector<std::unique_ptr<CoveredMembers>> owned;
    workflow::LevelMembers taken, others;
  };
  Parted part(std::uint64_t seed) const {
    std::vector<ByNumber> valid;
    for (const auto& level : levels_) valid.push_back(valid_members(*level));
    const std::int64_t last = valid.front().rbegin()->first;
    // [most levels that have it first], random among those of one kind.
    std::vector<std::pair<double, std::int64_t>> dear, beyond;
    for (const auto& [number, member] : valid.back()) {
      std::size_t from = valid.size() - 1;
      while (from > 0 && valid[from - 1].contains(number)) --from;
      const double random = unit_random(seed, static_cast<std::uint64_t>(number));
      if (from == 0) dear.emplace_back(random, number);
      if (from > 0 && number > last)
        beyond.emplace_back(static_cast<double>(from) + random, number);
    }
    std::sort(dear.begin(), dear.end());
    std::sort(beyond.begin(), beyond.end());
    std::vector<std::int64_t> taken, others;
    for (std::size_t k = 0; k < dear.size(); ++k)
      (k < pool ? taken : others).push_back(dear[k].second);
    for (std::size_t k = 0; k < beyond.size(); ++k)
      (k % 2 == 0 ? taken : others).push_back(beyond[k].second);
    Parted parted;
    parted.taken = numbered(taken, valid, parted);
    parted.others = numbered(others, valid, parted);
    for (std::size_t p = 0; p < levels_.size(); ++p)
      parted.others.counts[p] =
          static_cast<std::int64_t>(parted.others.members[p]->members().size());
    return parted;
  }

 private:
  workflow::LevelMembers numbered(const std::vector<std::int64_t>& order,
                                  const std::vector<ByNumber>& valid, Parted& parted) const {
    workflow::LevelMembers all;
    all.parts = parts_;
    all.counts.assign(levels_.size(), 0);
    for (std::size_t p = 0; p < levels_.size(); ++p) {
      auto& level = parted.owned.emplace_back(std::make_unique<CoveredMembers>(levels_[p]->grid()));
      for (const std::int64_t number : order) {
        const auto found = valid[p].find(number);
        // The numbers of a level are those below its count: no gap.
        if (found == valid[p].end()) break;
        MemberSummary m = *found->second;
        const auto at = static_cast<std::size_t>(found->second - levels_[p]->members().data());
        m.member = static_cast<std::int64_t>(level->members().size());
        level->add(std::move(m), levels_[p]->covered(at));
      }
      all.members.push_back(level.get());
    }
    return all;
  }

  std::vector<workflow::LevelPart> parts_;
  std::vector<std::unique_ptr<CoveredMembers>> levels_;
  std::vector<std::size_t> left_out_;
};

}  // namespace sturz
