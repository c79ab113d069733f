// SPDX-License-Identifier: Apache-2.0
/// The stored members of all sources of a region as one source of maps.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/region/region_maps.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/observer.hpp"
#include "io/members/member_store.hpp"
#include "io/netcdf/netcdf_file.hpp"
#include "scenarios/scenario.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sturz::workflow {

/// What is known of one source besides its maps.
struct SourceState {
  RegionSource counts;
  std::string failure;               ///< why it could not be computed; empty: it could
  std::int64_t finished = 0;         ///< members, valid or not
  std::int64_t cut_off = 0;          ///< valid members whose end was not seen
  double release_volume_m3 = nan_d;  ///< of its first valid member
  double compute_s = 0;              ///< of its members [s]
};

/// Reads every member file once against its seal, and keeps of each what maps need: outcome,
/// window, scalars. One file is open at a time, whatever the number of sources; of sources whose
/// members lie in packs, all numbers are kept.
class StoredMembers final : public MemberParts {
 public:
  /// \param members_per_source of the design that all share; folders with another one are refused
  /// \throws SetupError for folders that are damaged or belong to another scene; Cancelled
  StoredMembers(const OutputFolder& region, const std::vector<std::string>& sources,
                std::int64_t members_per_source, const std::string& design_hash, Observer&,
                CancelFlag cancel);

  const std::vector<MemberSummary>& members() const override { return members_; }
  const Grid& grid() const override { return grid_; }
  void read_part(std::size_t index, PeakLayer layer, const Window& part,
                 std::span<float> out) const override;
  void read_touched(std::size_t index, const Window& part, std::span<const PeakLayer> layers,
                    TouchedCells& out) const override;

  const std::vector<SourceState>& sources() const { return sources_; }
  struct Warned {
    std::int64_t sources = 0;
    std::string first;  ///< "source A: its words and numbers"
  };
  /// Warnings of the sources' scenes, by their words: those that differ in numbers alone are one.
  const std::map<std::string, Warned>& warnings() const { return warnings_; }
  /// "source A: 2 of 8 members are missing (3, 4)", one for each of which some are.
  const std::vector<std::string>& missing() const { return missing_; }
  /// Of the members of all sources.
  const std::string& hash() const { return hash_; }
  /// Cells that the first valid member of each source covers at its start.
  /// \param map cells that join `joined` x `joined` of the grid, from `part` on
  Raster<std::uint8_t> release_cells(const Grid& map, const Window& part, int joined,
                                     CancelFlag cancel) const;

  std::vector<RegionSource> region_sources() const;
  const std::vector<std::uint32_t>& source_of_valid() const { return source_of_valid_; }
  const std::vector<std::int64_t>& row_of_valid() const { return row_of_valid_; }

 private:
  void add(const OutputFolder& region, const std::string& source, std::int64_t planned,
           const std::string& design_hash, Observer&, CancelFlag cancel);

  std::vector<MemberSummary> members_;
  std::vector<std::uint32_t> source_of_;  // of each member
  std::vector<std::int64_t> row_of_;
  std::vector<std::filesystem::path> folders_;  // of each source's members
  struct Packed {
    std::shared_ptr<const MemberStore> store;  // of the source; null: members in own files alone
    std::size_t first = 0;                     // its members' first place among all
  };
  std::vector<Packed> packed_;  // of each source
  std::vector<SourceState> sources_;
  std::vector<std::uint32_t> source_of_valid_;
  std::vector<std::int64_t> row_of_valid_;
  std::map<std::string, Warned> warnings_;
  std::vector<std::string> missing_;
  std::string hash_;
  Grid grid_;
  // What follows is guarded by netcdf_mutex().
  mutable std::unique_ptr<NetcdfReader> last_reader_;
  mutable std::size_t last_index_ = 0;
};

}  // namespace sturz::workflow
