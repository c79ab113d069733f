// SPDX-License-Identifier: Apache-2.0
#include "io/members/member_store.hpp"

#include "engine/core/error.hpp"
#include "io/files/io_error.hpp"
#include "io/files/seal.hpp"
#include "io/members/gauge_netcdf.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_netcdf.hpp"
#include "io/netcdf/grid_netcdf.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <mutex>
#include <optional>

namespace sturz {
namespace fs = std::filesystem;
namespace {

/// The member's number if the name is one that member_file_name makes.
std::optional<std::int64_t> number_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (error != std::errc{} || end != stem.data() + stem.size()) return std::nullopt;
  if (file.filename() != member_file_name(number)) return std::nullopt;
  return number;
}

std::vector<std::int64_t> numbers_in(const fs::path& folder) {
  std::vector<std::int64_t> numbers;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (const auto number = number_of(entry.path())) numbers.push_back(*number);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

MemberStore::MemberStore(fs::path folder, const MemberFilter& filter, CancelFlag cancel)
    : folder_(std::move(folder)) {
  for (const std::int64_t number : numbers_in(folder_)) {
    cancel.check();
    if (filter.wanted && !filter.wanted(number)) continue;
    try {
      add(number, filter);
    } catch (const SetupError& error) {
      problems_.emplace_back(error.what());
    }
  }
}

void MemberStore::add(std::int64_t number, const MemberFilter& filter) {
  require_sealed(folder_ / member_file_name(number));
  const NetcdfReader file(folder_ / member_file_name(number));
  MemberSummary summary = read_member_summary(file);
  const Grid grid = read_grid_attributes(file);
  const auto refuse = [&](const std::string& why) {
    throw IoError(fmt::format("{}: {}. The command that wrote it computes it again.",
                              file.file().string(), why));
  };
  if (summary.member != number) refuse(fmt::format("holds member {}", summary.member));
  if (const std::string why =
          filter.refusal ? filter.refusal(summary, read_member_origin(file)) : "";
      !why.empty())
    refuse(why);
  require_inside(file, summary.window, grid);
  if (grid.n_cells() > 0) {
    if (grid_.n_cells() == 0) grid_ = grid;
    if (!grid.same_place(grid_)) refuse("lies on another grid than the members before it");
  }
  members_.push_back(std::move(summary));
}

const Grid& MemberStore::grid() const {
  require(grid_.n_cells() > 0, fmt::format("{}: holds no finished member with maps. Run the "
                                           "ensemble first.",
                                           folder_.string()));
  return grid_;
}

const NetcdfReader& MemberStore::reader(std::size_t index) const {
  if (!last_reader_ || last_index_ != index) {
    last_reader_.reset();
    last_reader_ =
        std::make_unique<NetcdfReader>(folder_ / member_file_name(members_[index].member));
    last_index_ = index;
  }
  return *last_reader_;
}

GaugeResult MemberStore::gauges(std::size_t index) const {
  expect(index < members_.size(), "the member exists");
  const std::lock_guard lock(netcdf_mutex());
  return read_gauges(reader(index));
}

void MemberStore::read_part(std::size_t index, PeakLayer layer, const Window& part,
                            std::span<float> out) const {
  expect(index < members_.size(), "the member exists");
  const Window& w = members_[index].window;
  expect(part.row0 >= w.row0 && end_row(part) <= end_row(w) && part.col0 >= w.col0 &&
             end_col(part) <= end_col(w),
         "the part lies in the member's window");
  expect(out.size() == part.n_cells(), "out holds the part");
  if (part.n_cells() == 0) return;
  if (!is_kept(layer, members_[index].censoring, members_[index].scalars)) {
    std::fill(out.begin(), out.end(), info(layer).untouched);
    return;
  }
  const std::lock_guard lock(netcdf_mutex());  // a writer of maps meanwhile holds it, too
  read_member_part(reader(index), w, layer, part, out);
}

}  // namespace sturz
