// SPDX-License-Identifier: Apache-2.0
/// The finished members of a folder, for readers of many of them in bands of rows.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_parts.hpp"
#include "io/members/member_origin.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
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
/// Maps are read from their files each time, only the rows asked for, and the file of the last
/// member stays open: who wants several layers of a member asks for them in a row. read_part may be
/// called from several threads.
class MemberStore final : public MemberParts {
 public:
  /// A folder that does not exist holds no members.
  /// \throws Cancelled
  explicit MemberStore(std::filesystem::path folder, const MemberFilter& filter = {},
                       CancelFlag cancel = {});

  const std::vector<MemberSummary>& members() const override { return members_; }
  /// \throws SetupError while there is no member with a grid
  const Grid& grid() const override;
  /// \throws IoError when the file was removed or damaged meanwhile
  void read_part(std::size_t index, PeakLayer layer, const Window& part,
                 std::span<float> out) const override;

  /// Of member members()[index]; empty where the scene has none. \throws IoError
  GaugeResult gauges(std::size_t index) const;

  /// One sentence per file that was left out.
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  void add(std::int64_t number, const MemberFilter& filter);
  const NetcdfReader& reader(std::size_t index) const;

  std::filesystem::path folder_;
  std::vector<MemberSummary> members_;
  std::vector<std::string> problems_;
  Grid grid_;

  // What follows is guarded by netcdf_mutex().
  mutable std::unique_ptr<NetcdfReader> last_reader_;
  mutable std::size_t last_index_ = 0;
};

}  // namespace sturz
