// SPDX-License-Identifier: Apache-2.0
#include "io/members/member_store.hpp"

#include "engine/core/error.hpp"
#include "io/files/io_error.hpp"
#include "io/files/seal.hpp"
#include "io/members/gauge_netcdf.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_netcdf.hpp"
#include "io/members/member_numbers.hpp"
#include "io/netcdf/grid_netcdf.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace sturz {
namespace fs = std::filesystem;
namespace {

constexpr const char* again = "The command that wrote it computes it again.";

/// Whether some member belongs to both shards: m = k - 1 modulo n has a solution in common.
bool may_share(const PackName& a, const PackName& b) {
  return (a.k - b.k) % std::gcd(a.n, b.n) == 0;
}

/// Puts members and places into the order of their numbers, of each the first.
template <class Place>
void sort_and_thin(std::vector<MemberSummary>& members, std::vector<Place>& places) {
  std::vector<std::size_t> order(members.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const MemberSummary &x = members[a], &y = members[b];
    if (x.member != y.member) return x.member < y.member;
    if (is_valid(x.outcome) != is_valid(y.outcome)) return is_valid(x.outcome);
    if (places[a].pack != places[b].pack) return places[a].pack < places[b].pack;
    return places[a].offset > places[b].offset;
  });
  order.erase(std::unique(order.begin(), order.end(),
                          [&](std::size_t a, std::size_t b) {
                            return members[a].member == members[b].member;
                          }),
              order.end());
  if (order.size() == members.size() && std::is_sorted(order.begin(), order.end())) return;
  std::vector<MemberSummary> sorted_members;
  std::vector<Place> sorted_places;
  sorted_members.reserve(order.size());
  sorted_places.reserve(order.size());
  for (const std::size_t i : order) {
    sorted_members.push_back(std::move(members[i]));
    sorted_places.push_back(places[i]);
  }
  members = std::move(sorted_members);
  places = std::move(sorted_places);
}

}  // namespace

/// Fills a store.
class MemberStore::Listing {
 public:
  Listing(MemberStore& to, const MemberFilter& filter, CancelFlag cancel)
      : to_(to), filter_(filter), cancel_(cancel) {}

  void add_files() {
    for (const std::int64_t number : member_files_in(to_.folder_)) {
      cancel_.check();
      if (filter_.wanted && !filter_.wanted(number)) continue;
      try {
        add_file(number);
      } catch (const SetupError& error) {
        problems_.emplace_back(number, error.what());
      }
    }
  }

  void add_packs() {
    const auto& paths = to_.packs_->paths();
    for (std::size_t p = 0; p < paths.size(); ++p) {
      if (!may_share(*pack_named(paths[p]), filter_.shard)) continue;
      try {
        add_pack(p);
      } catch (const IoError& error) {
        problems_.emplace_back(std::nullopt, error.what());
      }
    }
  }

  /// What is wrong with one copy of a member is no problem where another is sound.
  void finish() {
    sort_and_thin(to_.members_, to_.places_);
    const auto is_there = [&](std::int64_t number) {
      const auto at = std::lower_bound(
          to_.members_.begin(), to_.members_.end(), number,
          [](const MemberSummary& m, std::int64_t wanted) { return m.member < wanted; });
      return at != to_.members_.end() && at->member == number;
    };
    std::set<std::int64_t> told;
    for (auto& [number, text] : problems_)
      if (!number || (!is_there(*number) && told.insert(*number).second))
        to_.problems_.push_back(std::move(text));
  }

 private:
  void add_file(std::int64_t number) {
    const fs::path path = to_.folder_ / member_file_name(number);
    require_sealed(path);
    const NetcdfReader file(path);
    RecordFacts facts;
    facts.summary = read_member_summary(file);
    facts.grid = read_grid_attributes(file);
    facts.origin = read_member_origin(file);
    if (facts.summary.member != number)
      refuse(path.string(), fmt::format("holds member {}", facts.summary.member));
    require_inside(file, facts.summary.window, facts.grid);
    add(std::move(facts), {}, path.string());
  }

  void add_pack(std::size_t pack) {
    const auto file = to_.packs_->get(pack);
    PackVisitor visitor;
    std::vector<std::byte> bytes;
    visitor.record = [&](const RecordHead& head, std::uint64_t offset) {
      cancel_.check();
      if (filter_.wanted && !filter_.wanted(head.member)) return;
      bytes.resize(head.total);
      file->read(offset, bytes);
      const std::string name = file->record_name(head.member, offset);
      try {
        add(Record(head, bytes).checked_facts(), {static_cast<std::int32_t>(pack), offset}, name);
      } catch (const BadRecord& error) {
        problems_.emplace_back(head.member, fmt::format("{}: {}. {}", name, error.what(), again));
      } catch (const SetupError& error) {
        problems_.emplace_back(head.member, error.what());
      }
    };
    visitor.damage = [&](std::optional<std::int64_t> member, std::uint64_t at, std::uint64_t n) {
      if (member && filter_.wanted && !filter_.wanted(*member)) return;
      problems_.emplace_back(
          member,
          fmt::format("{}: {} bytes are damaged, cut short, or were never finished. {}",
                      member ? file->record_name(*member, at)
                             : fmt::format("{}, a member at byte {}", file->path().string(), at),
                      n, again));
    };
    look_through(*file, visitor);
  }

  [[noreturn]] static void refuse(const std::string& name, const std::string& why) {
    throw IoError(fmt::format("{}: {}. {}", name, why, again));
  }

  void add(RecordFacts facts, Place place, const std::string& name) {
    const std::string why = filter_.refusal ? filter_.refusal(facts.summary, facts.origin) : "";
    if (!why.empty()) refuse(name, why);
    if (facts.grid.n_cells() > 0) {
      if (to_.grid_.n_cells() == 0) to_.grid_ = facts.grid;
      if (!facts.grid.same_place(to_.grid_))
        refuse(name, "lies on another grid than the members before it");
    }
    to_.members_.push_back(std::move(facts.summary));
    to_.places_.push_back(place);
  }

  MemberStore& to_;
  const MemberFilter& filter_;
  CancelFlag cancel_;
  std::vector<std::pair<std::optional<std::int64_t>, std::string>> problems_;
};

/// A record whose head and directory of maps have been read.
class MemberStore::OpenRecord {
 public:
  OpenRecord(std::shared_ptr<const PackFile> file, const Place& place, const MemberSummary& member,
             std::size_t index)
      : index_(index), file_(std::move(file)), offset_(place.offset), number_(member.member) {
    std::array<std::byte, RecordHead::n_bytes> bytes{};
    file_->read(offset_, bytes);
    const auto head = head_at(bytes);
    if (!head || head->member != number_) changed("its head is not as it was");
    head_ = *head;
    std::vector<std::byte> directory(head_.directory);
    file_->read(offset_ + head_.directory_at(), directory);
    guarded([&] { maps_ = maps_of(head_, directory, member); });
  }

  std::size_t index() const { return index_; }

  void read(const Window& part, std::span<const PeakLayer> layers, TouchedCells& out) const {
    guarded([&] {
      maps_.read(
          [&](std::uint64_t at, std::span<std::byte> bytes) {
            file_->read(offset_ + head_.maps_at() + at, bytes);
          },
          part, layers, out);
    });
  }
  bool is_exact_for(std::span<const PeakLayer> layers) const { return maps_.is_exact_for(layers); }

  MemberResult result(MemberOrigin& origin) const {
    std::vector<std::byte> bytes(head_.total);
    file_->read(offset_, bytes);
    MemberResult result;
    guarded([&] {
      const Record record(head_, bytes);
      origin = record.checked_facts().origin;
      result = record.result();
    });
    return result;
  }
  MemberResult series() const {
    std::vector<std::byte> bytes(head_.series);
    file_->read(offset_ + head_.series_at(), bytes);
    MemberResult result;
    guarded([&] { series_of(head_, bytes, result); });
    return result;
  }

 private:
  [[noreturn]] void changed(const std::string& why) const {
    throw IoError(fmt::format("{}: {} (the file was damaged or changed meanwhile). {}",
                              file_->record_name(number_, offset_), why, again));
  }
  template <class Work>
  void guarded(Work work) const {
    try {
      work();
    } catch (const BadRecord& error) {
      changed(error.what());
    }
  }

  std::size_t index_;
  std::shared_ptr<const PackFile> file_;
  std::uint64_t offset_;
  std::int64_t number_;
  RecordHead head_;
  RecordMaps maps_;
};

MemberStore::MemberStore(fs::path folder, const MemberFilter& filter, CancelFlag cancel)
    : folder_(std::move(folder)),
      packs_(std::make_unique<OpenPacks>(packs_in(folder_))),
      record_lock_(std::make_unique<std::mutex>()) {
  Listing listing(*this, filter, cancel);
  listing.add_files();
  listing.add_packs();
  listing.finish();
}

const Grid& MemberStore::grid() const {
  require(grid_.n_cells() > 0, fmt::format("{}: holds no finished member with maps. Run the "
                                           "ensemble first.",
                                           folder_.string()));
  return grid_;
}

fs::path MemberStore::own_file(std::size_t index) const {
  return folder_ / member_file_name(members_[index].member);
}

fs::path MemberStore::file_of(std::size_t index) const {
  const std::int32_t pack = places_.at(index).pack;
  return pack < 0 ? own_file(index) : packs_->paths()[static_cast<std::size_t>(pack)];
}

const NetcdfReader& MemberStore::reader(std::size_t index) const {
  if (!last_reader_ || last_index_ != index) {
    last_reader_.reset();
    last_reader_ = std::make_unique<NetcdfReader>(own_file(index));
    last_index_ = index;
  }
  return *last_reader_;
}

std::shared_ptr<const MemberStore::OpenRecord> MemberStore::record(std::size_t index) const {
  {
    const std::lock_guard guard(*record_lock_);
    if (last_record_ && last_record_->index() == index) return last_record_;
  }
  const Place& place = places_[index];
  auto opened = std::make_shared<const OpenRecord>(
      packs_->get(static_cast<std::size_t>(place.pack)), place, members_[index], index);
  const std::lock_guard guard(*record_lock_);
  last_record_ = opened;
  return opened;
}

GaugeResult MemberStore::gauges(std::size_t index) const {
  expect(index < members_.size(), "the member exists");
  if (places_[index].pack >= 0) return record(index)->series().gauges;
  const std::lock_guard lock(netcdf_mutex());
  return read_gauges(reader(index));
}

MemberResult MemberStore::result(std::size_t index, MemberOrigin& origin) const {
  expect(index < members_.size(), "the member exists");
  if (places_[index].pack >= 0) return record(index)->result(origin);
  const std::lock_guard lock(netcdf_mutex());
  origin = read_member_origin(reader(index));
  return read_member(own_file(index));
}

void MemberStore::read_part(std::size_t index, PeakLayer layer, const Window& part,
                            std::span<float> out) const {
  expect(index < members_.size(), "the member exists");
  const Window& w = members_[index].window;
  expect(w.contains(part), "the part lies in the member's window");
  expect(out.size() == part.n_cells(), "out holds the part");
  if (part.n_cells() == 0) return;
  const bool packed = places_[index].pack >= 0;
  const bool kept = is_kept(layer, members_[index].censoring, members_[index].scalars);
  if (!kept || packed) std::fill(out.begin(), out.end(), info(layer).untouched);
  if (!kept) return;
  if (!packed) {
    const std::lock_guard lock(netcdf_mutex());  // a writer of maps meanwhile holds it, too
    read_member_part(reader(index), w, layer, part, out);
    return;
  }
  thread_local TouchedCells cells;
  record(index)->read(part, {&layer, 1}, cells);
  const float* values = cells.values[0].data();
  for (const TouchedCells::Run& run : cells.runs) {
    const auto first =
        static_cast<std::size_t>(run.row - part.row0) * static_cast<std::size_t>(part.n_cols) +
        static_cast<std::size_t>(run.col - part.col0);
    std::copy_n(values, run.n, out.begin() + static_cast<std::ptrdiff_t>(first));
    values += run.n;
  }
}

void MemberStore::read_touched(std::size_t index, const Window& part,
                               std::span<const PeakLayer> layers, TouchedCells& out) const {
  expect(index < members_.size() && members_[index].window.contains(part),
         "the part lies in the member's window");
  if (places_[index].pack >= 0) {
    const auto opened = record(index);
    if (opened->is_exact_for(layers)) return opened->read(part, layers, out);
  }
  MemberParts::read_touched(index, part, layers, out);
}

}  // namespace sturz
