// SPDX-License-Identifier: Apache-2.0
#include "io/members/member_stack.hpp"

#include "engine/core/error.hpp"
#include "io/features/geographic.hpp"
#include "io/netcdf/grid_netcdf.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace sturz {
namespace {

constexpr int band_rows = 128;
constexpr std::size_t chunk_edge = band_rows;

/// Indices in the store.
std::vector<std::size_t> valid_members(const MemberStore& store, PeakLayer layer) {
  std::vector<std::size_t> valid;
  const auto& members = store.members();
  for (std::size_t i = 0; i < members.size(); ++i)
    if (is_valid(members[i].outcome)) valid.push_back(i);
  require(!valid.empty(), "no member is valid (nothing can be stacked).");
  // What is kept only where it occurs is 0 in the others.
  require(std::any_of(valid.begin(), valid.end(),
                      [&](std::size_t i) {
                        return is_kept(layer, members[i].censoring, members[i].scalars);
                      }),
          fmt::format("no member has a map of {} (the scene does not call for it).",
                      info(layer).long_name));
  return valid;
}

class Stack {
 public:
  Stack(const std::filesystem::path& target, const MemberStore& store, const MemberStack& of)
      : store_(store),
        of_(of),
        valid_(valid_members(store, of.layer)),
        file_(target, NetcdfMedium::disk) {
    Window all;
    for (const std::size_t i : valid_) all = joined(all, store.members()[i].window);
    require(all.n_cells() > 0, "no member touched a cell (nothing can be stacked).");
    window_ = all;
    grid_ = grid_of(window_, store.grid());
  }

  StackWritten write(CancelFlag cancel) {
    write_attributes();
    member_ = file_.dimension("member", valid_.size());
    place_ = write_grid(file_, grid_);
    write_events();
    const bool has_place = write_degrees();
    const int intensity = define_intensity(has_place);
    for (std::size_t k = 0; k < valid_.size(); ++k) put_member(intensity, k, cancel);
    cancel.check();
    file_.commit();
    return {static_cast<std::int64_t>(valid_.size()), grid_, has_place};
  }

 private:
  void write_attributes() {
    file_.text(NetcdfWriter::global, "Conventions", "CF-1.10");
    for (const auto& [name, value] : of_.attributes) file_.text(NetcdfWriter::global, name, value);
    write_grid_attributes(file_, grid_);
  }

  template <class Number>
  void put_events(const char* name, NcType type, const char* long_name, const char* units,
                  const std::vector<Number>& values, const char* standard_name = "") {
    const int variable = file_.variable(name, type, {member_});
    if (*standard_name != '\0') file_.text(variable, "standard_name", standard_name);
    file_.text(variable, "long_name", long_name);
    file_.text(variable, "units", units);
    file_.put(variable, values);
  }

  void write_events() {
    std::vector<std::int32_t> numbers, events;
    for (const std::size_t i : valid_) {
      const auto number = static_cast<std::int32_t>(store_.members()[i].member);
      numbers.push_back(number);
      events.push_back(number + 1);
    }
    const std::vector<double> frequencies(valid_.size(),
                                          of_.frequency / static_cast<double>(valid_.size()));
    put_events("member", NcType::int32, "number of the member", "1", numbers, "realization");
    put_events("time", NcType::int32,
               "number of the event from 1 on, in place of a date: members have none", "1", events);
    put_events("event_id", NcType::int32, "number of the event, from 1 on", "1", events);
    put_events("frequency", NcType::float64,
               "of the event: that of the release over the number of valid members", "year-1",
               frequencies);
  }

  /// \return false where the map lies nowhere on the earth
  bool write_degrees() {
    const Geographic geographic(grid_.crs_wkt);
    if (!geographic.is_known()) return false;
    const auto define = [&](const char* name, const char* units) {
      const int variable = file_.variable(name, NcType::float64, {place_.y, place_.x});
      file_.compress(variable, {chunk(grid_.n_rows), chunk(grid_.n_cols)});
      file_.text(variable, "standard_name", name);
      file_.text(variable, "long_name", fmt::format("{} of the cell centre, WGS 84", name));
      file_.text(variable, "units", units);
      return variable;
    };
    const int latitude = define("latitude", "degrees_north"),
              longitude = define("longitude", "degrees_east");
    for (int row0 = 0; row0 < grid_.n_rows; row0 += band_rows) {
      const int n_rows = std::min(band_rows, grid_.n_rows - row0);
      std::vector<double> x, y;
      for (int row = row0; row < row0 + n_rows; ++row)
        for (int col = 0; col < grid_.n_cols; ++col)
          x.push_back(grid_.x_center(col)), y.push_back(grid_.y_center(row));
      geographic.transform(x, y);
      const std::vector<std::size_t> start{static_cast<std::size_t>(row0), 0},
          count{static_cast<std::size_t>(n_rows), static_cast<std::size_t>(grid_.n_cols)};
      file_.put(latitude, start, count, std::span<const double>(y));
      file_.put(longitude, start, count, std::span<const double>(x));
    }
    return true;
  }

  static std::size_t chunk(int length) {
    return std::min(chunk_edge, static_cast<std::size_t>(length));
  }

  int define_intensity(bool has_place) {
    const PeakLayerInfo& about = info(of_.layer);
    const int variable =
        file_.variable("intensity", NcType::float32, {member_, place_.y, place_.x});
    file_.compress(variable, {1, chunk(grid_.n_rows), chunk(grid_.n_cols)});
    file_.fill_value(variable, nan_f);
    file_.text(variable, "long_name", about.long_name);
    file_.text(variable, "units", of_.units);
    file_.text(variable, "comment",
               std::isnan(about.untouched) ? "missing where a member did not come"
                                           : "0 where a member did not come");
    file_.text(variable, "sturz_layer", about.name);
    file_.text(variable, "coordinates", has_place ? "time latitude longitude" : "time");
    link_grid(file_, variable, grid_);
    return variable;
  }

  void put_member(int intensity, std::size_t k, CancelFlag cancel) {
    for (int row = 0; row < grid_.n_rows; row += band_rows) {
      cancel.check();
      const Window part{window_.row0 + row, window_.col0, std::min(band_rows, grid_.n_rows - row),
                        grid_.n_cols};
      read(valid_[k], part);
      file_.put(intensity, {k, static_cast<std::size_t>(row), 0},
                {1, static_cast<std::size_t>(part.n_rows), static_cast<std::size_t>(part.n_cols)},
                std::span<const float>(values_));
    }
  }

  /// values_ of a part of the common grid: those of the member where it was.
  void read(std::size_t member, const Window& part) {
    values_.assign(part.n_cells(), info(of_.layer).untouched);
    const MemberSummary& about = store_.members()[member];
    const Window there = overlap(part, about.window);
    if (there.n_cells() == 0 || !is_kept(of_.layer, about.censoring, about.scalars)) return;
    own_.resize(there.n_cells());
    store_.read_part(member, of_.layer, there, own_);
    const float* from = own_.data();
    for (int row = 0; row < there.n_rows; ++row, from += there.n_cols) {
      const std::size_t to = static_cast<std::size_t>(there.row0 + row - part.row0) * part.n_cols +
                             (there.col0 - part.col0);
      std::transform(from, from + there.n_cols, values_.begin() + static_cast<std::ptrdiff_t>(to),
                     [&](float v) { return v * of_.per_si; });
    }
  }

  const MemberStore& store_;
  const MemberStack& of_;
  std::vector<std::size_t> valid_;
  NetcdfWriter file_;
  Window window_;
  Grid grid_;
  int member_ = -1;
  GridDimensions place_;
  std::vector<float> values_, own_;
};

}  // namespace

StackWritten write_member_stack(const std::filesystem::path& file, const MemberStore& store,
                                const MemberStack& stack, CancelFlag cancel) {
  return Stack(file, store, stack).write(cancel);
}

}  // namespace sturz
