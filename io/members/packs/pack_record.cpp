// SPDX-License-Identifier: Apache-2.0
#include "io/members/packs/pack_record.hpp"

#include "io/members/packs/crc32c.hpp"

#include <algorithm>
#include <utility>

namespace sturz {
namespace {

// "STURZmem" and "STURZend" in the order of the bytes; the lowest byte of the version is the last.
constexpr std::uint64_t head_mark = 0x6d656d5a52555453u, tail_mark = 0x646e655a52555453u;
constexpr std::size_t step = 8;  // bytes to which all parts are filled up

std::size_t size_of(const ByteWriter& bytes) { return bytes.bytes().size(); }

void write_head(ByteWriter& to, const RecordHead& head) {
  to.put(head_mark);
  to.put(head.member);
  to.put(head.total);
  to.put(head.maps);
  for (const std::uint32_t n : {head.facts, head.series, head.directory}) to.put(n);
  for (const std::uint32_t sum : head.sums) to.put(sum);
  to.put(std::uint32_t{0});  // kept free
  to.put(crc32c(to.bytes()));
}

std::vector<std::byte> tail_of(const RecordHead& head) {
  ByteWriter to;
  to.put(head.total);
  to.put(head.member);
  to.put(tail_mark);
  to.put(std::uint32_t{0});
  to.put(crc32c(to.bytes()));
  return to.take();
}

void require_sum(std::span<const std::byte> bytes, std::uint32_t sum, const char* what) {
  if (crc32c(bytes) != sum) throw BadRecord(std::string(what) + " does not fit its checksum");
}

}  // namespace

std::vector<std::byte> sealed_record(std::int64_t member, RecordParts parts) {
  auto& [facts, series, directory, maps] = parts;
  RecordHead head;
  for (ByteWriter* part : {&facts, &series, &directory, &maps}) part->pad(step);
  head.member = member;
  head.facts = static_cast<std::uint32_t>(size_of(facts));
  head.series = static_cast<std::uint32_t>(size_of(series));
  head.directory = static_cast<std::uint32_t>(size_of(directory));
  head.maps = size_of(maps);
  head.total = head.maps_at() + head.maps + RecordHead::tail_bytes;
  head.sums = {crc32c(facts.bytes()), crc32c(series.bytes()), crc32c(directory.bytes())};
  ByteWriter all;
  write_head(all, head);
  for (const ByteWriter* part : {&facts, &series, &directory, &maps}) all.values(part->bytes());
  all.values(std::span<const std::byte>(tail_of(head)));
  return all.take();
}

std::vector<std::byte> encode_record(const MemberResult& m, const MemberOrigin& origin) {
  RecordParts parts;
  write_facts(parts.facts, m, origin);
  write_series(parts.series, m);
  if (has_maps(m)) write_maps(parts.directory, parts.maps, m);
  return sealed_record(m.member, std::move(parts));
}

std::optional<RecordHead> head_at(std::span<const std::byte> bytes) {
  if (bytes.size() < RecordHead::n_bytes || bytes[0] != std::byte{'S'}) return std::nullopt;
  ByteReader from(bytes.first(RecordHead::n_bytes));
  if (from.get<std::uint64_t>() != head_mark) return std::nullopt;
  RecordHead head;
  head.member = from.get<std::int64_t>();
  head.total = from.get<std::uint64_t>();
  head.maps = from.get<std::uint64_t>();
  for (std::uint32_t* n : {&head.facts, &head.series, &head.directory})
    *n = from.get<std::uint32_t>();
  for (std::uint32_t& sum : head.sums) sum = from.get<std::uint32_t>();
  from.get<std::uint32_t>();
  const auto sum = from.get<std::uint32_t>();
  if (sum != crc32c(bytes.first(RecordHead::n_bytes - sizeof sum))) return std::nullopt;
  constexpr std::uint64_t most = std::uint64_t{1} << 48;  // so that sums do not run over
  if (head.maps > most || head.total != head.maps_at() + head.maps + RecordHead::tail_bytes ||
      head.total % step != 0)
    return std::nullopt;
  return head;
}

std::optional<RecordTail> tail_at(std::span<const std::byte> bytes) {
  if (bytes.size() < RecordHead::tail_bytes) return std::nullopt;
  bytes = bytes.first(RecordHead::tail_bytes);
  ByteReader from(bytes);
  RecordTail tail;
  tail.total = from.get<std::uint64_t>();
  tail.member = from.get<std::int64_t>();
  if (from.get<std::uint64_t>() != tail_mark) return std::nullopt;
  from.get<std::uint32_t>();
  const auto sum = from.get<std::uint32_t>();
  if (sum != crc32c(bytes.first(bytes.size() - sizeof sum))) return std::nullopt;
  return tail;
}

void series_of(const RecordHead& head, std::span<const std::byte> series, MemberResult& m) {
  require_sum(series, head.sums[1], "its history");
  read_series(series, m);
}

RecordMaps maps_of(const RecordHead& head, std::span<const std::byte> directory,
                   const MemberSummary& member) {
  require_sum(directory, head.sums[2], "its list of maps");
  return {directory, head.maps, member};
}

RecordFacts Record::checked_facts() const {
  const auto facts = part(head_.facts_at(), head_.facts);
  require_sum(facts, head_.sums[0], "the part with its numbers");
  require_sum(part(head_.series_at(), head_.series), head_.sums[1], "its history");
  const auto tail = bytes_.last(RecordHead::tail_bytes);
  const std::vector<std::byte> expected = tail_of(head_);
  if (!std::equal(tail.begin(), tail.end(), expected.begin(), expected.end()))
    throw BadRecord("its end is not as it was written");
  RecordFacts found = read_facts(facts);
  if (found.summary.member != head_.member) throw BadRecord("it has two numbers");
  maps_of(head_, part(head_.directory_at(), head_.directory), found.summary)
      .check(part(head_.maps_at(), head_.maps));
  return found;
}

MemberResult Record::result() const {
  RecordFacts facts = checked_facts();
  MemberResult m = result_of(facts.summary);
  m.grid = std::move(facts.grid);
  read_series(part(head_.series_at(), head_.series), m);
  if (m.window.n_cells() == 0) return m;
  // A window of so many cells is not made of so few bytes: memory is not taken on a header's word.
  if (static_cast<double>(m.window.n_cells()) > 1032.0 * static_cast<double>(head_.total))
    throw BadRecord("its window is larger than its maps can fill");
  const RecordMaps maps =
      maps_of(head_, part(head_.directory_at(), head_.directory), facts.summary);
  const auto bytes = part(head_.maps_at(), head_.maps);
  const auto copy = [&](std::uint64_t at, std::span<std::byte> out) {
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), out.size(), out.begin());
  };
  TouchedCells cells;
  for (int i = 0; i < n_peak_layers; ++i) {
    const auto layer = static_cast<PeakLayer>(i);
    if (!is_kept(layer, m.censoring, m.scalars)) continue;
    maps.read(copy, m.window, {&layer, 1}, cells);
    m.layer(layer).assign(m.window.n_cells(), info(layer).untouched);
    const float* value = cells.values[0].data();
    for (const TouchedCells::Run& run : cells.runs) {
      const auto first = static_cast<std::size_t>(run.row - m.window.row0) *
                             static_cast<std::size_t>(m.window.n_cols) +
                         static_cast<std::size_t>(run.col - m.window.col0);
      std::copy_n(value, run.n, m.layer(layer).begin() + static_cast<std::ptrdiff_t>(first));
      value += run.n;
    }
  }
  return m;
}

}  // namespace sturz
