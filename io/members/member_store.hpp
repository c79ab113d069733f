// SPDX-License-Identifier: Apache-2.0
/// The finished members of a folder, for readers of many of them in bands of rows.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "io/members/member_origin.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace sturz {

/// Which members a store is asked for; empty functions: all.
struct MemberFilter {
  /// Files of other numbers are not even opened.
  std::function<bool(std::int64_t member)> wanted;
  /// Says why a member does not belong to the others; empty: it does.
  std::function<std::string(const MemberSummary&, const MemberOrigin&)> refusal;
};

/// Lists members/NNNNNN.nc in ascending order. Unfinished files (*.part) do not count. A damaged
/// file, one that is refused, or one on another grid than the first, is named in problems() and
/// treated as absent, so that a resumed run computes it again. Every file is read once as plain
/// bytes, against its seal (io/files/seal.hpp), before netCDF sees it.
///
/// Maps are kept decompressed, whole windows, until `memory_bound` is reached; what comes later is
/// read from its file each time, only the rows asked for. (Nothing is dropped: statistics pass over
/// all members again and again, where dropping the oldest would never hit.)
/// read_rows may be called from several threads.
class MemberStore final : public MemberSource {
 public:
  static constexpr std::size_t default_memory_bound = std::size_t{512} << 20;

  /// A folder that does not exist holds no members.
  explicit MemberStore(std::filesystem::path folder, const MemberFilter& filter = {},
                       std::size_t memory_bound = default_memory_bound);

  const std::vector<MemberSummary>& members() const override { return members_; }
  /// \throws SetupError while there is no member with a grid
  const Grid& grid() const override;
  /// \throws IoError when the file was removed or damaged meanwhile
  void read_rows(std::size_t index, PeakLayer layer, int row0, int n_rows,
                 std::span<float> out) const override;

  /// One sentence per file that was left out.
  const std::vector<std::string>& problems() const { return problems_; }
  /// Bytes of maps in memory now.
  std::size_t memory_in_use() const;

 private:
  using Map = std::shared_ptr<const std::vector<float>>;

  void add(std::int64_t number, const MemberFilter& filter);
  Map cached_or_loaded(std::size_t index, PeakLayer layer) const;
  const NetcdfReader& reader(std::size_t index) const;

  std::filesystem::path folder_;
  std::size_t memory_bound_;
  std::vector<MemberSummary> members_;
  std::vector<std::string> problems_;
  Grid grid_;

  mutable std::mutex mutex_;  ///< guards all below
  mutable std::unordered_map<std::size_t, Map> maps_;
  mutable std::size_t bytes_ = 0;
  mutable std::unique_ptr<NetcdfReader> last_reader_;
  mutable std::size_t last_index_ = 0;
};

}  // namespace sturz
