// SPDX-License-Identifier: Apache-2.0
/// One member in a pack: head, facts, series, directory of maps, maps, tail; each with its
/// checksum.
///
///   head (64 bytes)  mark, number of the member, length of everything, checksums of three parts
///   facts, series    record_facts.hpp, each filled up to eight bytes
///   directory, maps  record_maps.hpp, alike
///   tail (32 bytes)  number and length once more, mark, checksum
///
/// Records stand one behind the other from the first byte of a file and share nothing: any one of
/// them can be lost without the others. The tail names the member where the head is damaged.
#pragma once

#include "io/members/packs/byte_stream.hpp"
#include "io/members/packs/record_facts.hpp"
#include "io/members/packs/record_maps.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sturz {

struct RecordHead {
  static constexpr std::size_t n_bytes = 64, tail_bytes = 32;

  std::int64_t member = 0;
  std::uint64_t total = 0;  ///< bytes of the record, head and tail included; a multiple of eight
  std::uint64_t maps = 0;   ///< bytes
  std::uint32_t facts = 0, series = 0, directory = 0;  ///< bytes
  std::array<std::uint32_t, 3> sums{};                 ///< of these three

  // Where the parts begin, counted from the head's first byte.
  std::uint64_t facts_at() const { return n_bytes; }
  std::uint64_t series_at() const { return facts_at() + facts; }
  std::uint64_t directory_at() const { return series_at() + series; }
  std::uint64_t maps_at() const { return directory_at() + directory; }
};

/// The four parts of a record, before it has head, tail and sums.
struct RecordParts {
  ByteWriter facts, series, directory, maps;
};
std::vector<std::byte> sealed_record(std::int64_t member, RecordParts parts);

std::vector<std::byte> encode_record(const MemberResult&, const MemberOrigin&);

/// Nothing where no head begins. \param bytes at least RecordHead::n_bytes
std::optional<RecordHead> head_at(std::span<const std::byte> bytes);
/// What the last bytes of a record say of it.
struct RecordTail {
  std::int64_t member = 0;
  std::uint64_t total = 0;
  bool belongs_to(const RecordHead& h) const { return member == h.member && total == h.total; }
};
/// Nothing where no tail begins. \param bytes at least RecordHead::tail_bytes
std::optional<RecordTail> tail_at(std::span<const std::byte> bytes);

/// A whole record that was read. \param bytes head.total of them
class Record {
 public:
  Record(const RecordHead& head, std::span<const std::byte> bytes) : head_(head), bytes_(bytes) {}

  /// Looks at every byte. \throws BadRecord
  RecordFacts checked_facts() const;
  /// Everything, as read_member() gives it. \throws BadRecord
  MemberResult result() const;

 private:
  std::span<const std::byte> part(std::uint64_t at, std::uint64_t n) const {
    return bytes_.subspan(at, n);
  }
  const RecordHead& head_;
  std::span<const std::byte> bytes_;
};

/// History, gauges and seconds of passes from their bytes. \throws BadRecord when damaged
void series_of(const RecordHead&, std::span<const std::byte> series, MemberResult&);
/// The directory of a record's maps from its bytes. \throws BadRecord when it was damaged
RecordMaps maps_of(const RecordHead&, std::span<const std::byte> directory, const MemberSummary&);

}  // namespace sturz
