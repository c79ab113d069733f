// SPDX-License-Identifier: Apache-2.0
#include "io/members/member_store.hpp"

#include "engine/core/error.hpp"
#include "io/files/io_error.hpp"
#include "io/files/seal.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_netcdf.hpp"
#include "io/netcdf/grid_netcdf.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
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

std::size_t key_of(std::size_t index, PeakLayer layer) {
  return index * n_peak_layers + static_cast<std::size_t>(layer);
}

}  // namespace

MemberStore::MemberStore(fs::path folder, const MemberFilter& filter, std::size_t memory_bound)
    : folder_(std::move(folder)), memory_bound_(memory_bound) {
  for (const std::int64_t number : numbers_in(folder_)) {
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

std::size_t MemberStore::memory_in_use() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
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

MemberStore::Map MemberStore::cached_or_loaded(std::size_t index, PeakLayer layer) const {
  const auto known = maps_.find(key_of(index, layer));
  if (known != maps_.end()) return known->second;
  const Window& window = members_[index].window;
  const std::size_t bytes = window.n_cells() * sizeof(float);
  if (bytes_ + bytes > memory_bound_) return nullptr;
  auto values = std::make_shared<std::vector<float>>(window.n_cells());
  read_member_rows(reader(index), window, layer, 0, window.n_rows, *values);
  bytes_ += bytes;
  return maps_[key_of(index, layer)] = std::move(values);
}

void MemberStore::read_rows(std::size_t index, PeakLayer layer, int row0, int n_rows,
                            std::span<float> out) const {
  const Grid& whole = grid();
  expect(index < members_.size(), "the member exists");
  expect(row0 >= 0 && n_rows >= 0 && row0 + n_rows <= whole.n_rows, "the rows lie on the grid");
  expect(out.size() == static_cast<std::size_t>(n_rows) * whole.n_cols, "out holds the rows");
  std::fill(out.begin(), out.end(), info(layer).untouched);
  const Window& w = members_[index].window;
  const int first = std::max(row0, w.row0), end = std::min(row0 + n_rows, w.row0 + w.n_rows);
  if (first >= end || w.n_cols == 0 || !is_kept(layer, members_[index].censoring)) return;
  const auto width = static_cast<std::size_t>(w.n_cols);
  std::vector<float> rows;  // only when memory is full
  Map map;
  {
    const std::lock_guard lock(mutex_);
    map = cached_or_loaded(index, layer);
    if (!map) {
      rows.resize(static_cast<std::size_t>(end - first) * width);
      read_member_rows(reader(index), w, layer, first - w.row0, end - first, rows);
    }
  }
  const float* from =
      map ? map->data() + static_cast<std::size_t>(first - w.row0) * width : rows.data();
  for (int row = first; row < end; ++row, from += width)
    std::copy(from, from + width,
              out.begin() + static_cast<std::ptrdiff_t>(row - row0) * whole.n_cols + w.col0);
}

}  // namespace sturz
