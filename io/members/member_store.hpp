// SPDX-License-Identifier: Apache-2.0
/// The finished members of a folder, for readers of many of them in bands of rows.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_parts.hpp"
#include "io/members/member_origin.hpp"
#include "io/members/packs/open_packs.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace sturz {

/// Which members a store is asked for; empty functions: all.
struct MemberFilter {
  /// Files of other numbers are not even opened, records of other numbers in packs not looked at.
  std::function<bool(std::int64_t member)> wanted;
  /// Packs in which no wanted member can be, by the shard that wrote them, are not opened.
  PackName shard = {};
  /// Says why a member does not belong to the others; empty: it does.
  std::function<std::string(const MemberSummary&, const MemberOrigin&)> refusal;
};

/// Lists the members of a folder in ascending order: those in files of their own,
/// members/NNNNNN.nc, and those in packs of any number of shards (packs/pack_file.hpp). Unfinished
/// files (*.part) and unfinished ends of packs do not count. A damaged file or record, one that is
/// refused, or one on another grid than the first, is named in problems() and treated as absent, so
/// that a resumed run computes it again. Everything is read once as plain bytes against its
/// checksum before it is used.
///
/// Of a member that is there more than once, a valid one counts before one that failed (which was
/// tried again), then one in a file of its own, then one in the first pack by its name, and within
/// a pack the last.
///
/// Maps are read each time, only the rows asked for, and the last member stays open: who wants
/// several layers of a member asks for them in a row. Reading may be done from several threads.
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
  void read_touched(std::size_t index, const Window& part, std::span<const PeakLayer> layers,
                    TouchedCells& out) const override;

  /// Of member members()[index]; empty where the scene has none. \throws IoError
  GaugeResult gauges(std::size_t index) const;
  /// All of it, and where it comes from. \throws IoError
  MemberResult result(std::size_t index, MemberOrigin& origin) const;
  /// The file that holds it.
  std::filesystem::path file_of(std::size_t index) const;
  /// Where it begins there: what was written later stands behind. 0 in a file of its own.
  std::uint64_t offset_of(std::size_t index) const { return places_.at(index).offset; }

  /// One sentence per file or record that was left out.
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  struct Place {
    std::int32_t pack = -1;    ///< -1: a file of its own
    std::uint64_t offset = 0;  ///< of its record
  };
  class Listing;
  class OpenRecord;
  const NetcdfReader& reader(std::size_t index) const;
  std::shared_ptr<const OpenRecord> record(std::size_t index) const;
  std::filesystem::path own_file(std::size_t index) const;

  std::filesystem::path folder_;
  std::vector<MemberSummary> members_;
  std::vector<Place> places_;  // of each
  std::vector<std::string> problems_;
  Grid grid_;
  std::unique_ptr<OpenPacks> packs_;

  // What follows is guarded by netcdf_mutex().
  mutable std::unique_ptr<NetcdfReader> last_reader_;
  mutable std::size_t last_index_ = 0;

  mutable std::unique_ptr<std::mutex> record_lock_;  // guards what follows
  mutable std::shared_ptr<const OpenRecord> last_record_;
};

}  // namespace sturz
