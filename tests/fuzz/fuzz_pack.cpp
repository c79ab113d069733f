// SPDX-License-Identifier: Apache-2.0
// A pack of members: any bytes; a record whose parts were changed and sealed anew, as no damage but
// only malice makes them; and maps whose runs lie anywhere. Members, or BadRecord.
#include "io/files/io_error.hpp"
#include "io/members/packs/crc32c.hpp"
#include "io/members/packs/pack_file.hpp"
#include "tests/fuzz/memory_file.hpp"

#include <fuzzer/FuzzedDataProvider.h>

#include <cstdlib>
#include <numeric>
#include <span>
#include <vector>

namespace {

using sturz::ByteWriter;

sturz::MemberResult original(bool with_gauges) {
  sturz::MemberResult m;
  m.member = 3;
  m.outcome = sturz::Outcome::settled;
  m.grid = {40, 50, 5e5, 4.6e6, 2.5, ""};
  m.window = {4, 5, 35, 21};
  for (int l = 0; l < sturz::n_peak_layers; ++l) {
    const auto layer = static_cast<sturz::PeakLayer>(l);
    if (!sturz::is_kept(layer, m.censoring, m.scalars)) continue;
    m.layer(layer).assign(m.window.n_cells(), sturz::info(layer).untouched);
    for (std::size_t i = 0; i < m.window.n_cells(); i += 1 + i % 7) m.layer(layer)[i] = 1.5F;
  }
  m.history.rows.resize(3);
  m.effect_seconds = m.pass_seconds = {{"a", 1}, {"b", 2}};
  if (!with_gauges) return m;
  m.gauges.time_s = {0, 1};
  m.gauges.points.resize(1);
  m.gauges.points[0].thickness_m = m.gauges.points[0].speed_m_s = {1, 2};
  m.gauges.points[0].momentum_flux_n_m = {1, 2};
  m.gauges.lines.resize(1);
  m.gauges.lines[0].volume_m3 = m.gauges.lines[0].discharge_m3_s = {1, 2};
  return m;
}

void check(const sturz::MemberResult& m) {
  for (const auto& layer : m.layers)
    if (!layer.empty() && layer.size() != m.window.n_cells()) std::abort();
  if (m.window.n_cells() > 0 && (!m.grid.contains(m.window.row0, m.window.col0) ||
                                 !m.grid.contains(m.window.end_row() - 1, m.window.end_col() - 1)))
    std::abort();
}

/// As a store goes through a pack.
void read_all(std::span<const std::uint8_t> bytes) {
  const sturz::fuzz::MemoryFile memory(bytes.data(), bytes.size());
  const sturz::PackFile file(memory.path());
  std::uint64_t told = 0;
  sturz::PackVisitor visitor;
  visitor.record = [&](const sturz::RecordHead& head, std::uint64_t at) {
    if (at != told) std::abort();  // every byte is told once, in order
    told = at + head.total;
    std::vector<std::byte> all(head.total);
    file.read(at, all);
    try {
      check(sturz::Record(head, all).result());
    } catch (const sturz::BadRecord&) {
    }
  };
  visitor.damage = [&](std::optional<std::int64_t>, std::uint64_t at, std::uint64_t n) {
    if (at != told || n == 0) std::abort();
    told = at + n;
  };
  const std::uint64_t end = look_through(file, visitor);
  if (told != bytes.size() || end > told) std::abort();
}

std::vector<std::uint8_t> plain(std::span<const std::byte> bytes) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return {first, first + bytes.size()};
}

/// Some bytes of a part changed, cut or added.
ByteWriter changed(const ByteWriter& part, FuzzedDataProvider& from) {
  std::vector<std::byte> bytes(part.bytes().begin(), part.bytes().end());
  for (int n = from.ConsumeIntegralInRange(0, 6); n > 0 && !bytes.empty(); --n) {
    const auto at = from.ConsumeIntegralInRange<std::size_t>(0, bytes.size() - 1);
    if (from.ConsumeIntegralInRange(0, 9) == 0)
      bytes.resize(at);
    else
      bytes[at] = static_cast<std::byte>(from.ConsumeIntegral<std::uint8_t>());
  }
  ByteWriter out;
  out.values(std::span<const std::byte>(bytes));
  return out;
}

void changed_record(FuzzedDataProvider& from) {
  const sturz::MemberResult m = original(from.ConsumeBool());
  sturz::RecordParts parts;
  write_facts(parts.facts, m, {"a", "b", "c"});
  write_series(parts.series, m);
  write_maps(parts.directory, parts.maps, m);
  for (ByteWriter* part : {&parts.facts, &parts.series, &parts.directory, &parts.maps})
    if (from.ConsumeBool()) *part = changed(*part, from);
  read_all(plain(sturz::sealed_record(from.ConsumeBool() ? 3 : 4, std::move(parts))));
}

/// Runs anywhere, with sums that fit.
void any_runs(FuzzedDataProvider& from) {
  const sturz::MemberResult m = original(false);
  sturz::RecordParts parts;
  write_facts(parts.facts, m, {"a", "b", "c"});
  write_series(parts.series, m);
  constexpr std::uint32_t n_layers = 6;
  parts.directory.put(std::uint32_t{1});
  parts.directory.put(n_layers);
  for (std::uint32_t l = 0; l < n_layers; ++l) parts.directory.put(l);
  for (int band = 0; band < 3; ++band) {
    ByteWriter runs;
    std::uint32_t touched = 0;
    const auto n_runs = from.ConsumeIntegralInRange<std::uint32_t>(0, 4);
    for (std::uint32_t r = 0; r < n_runs; ++r) {
      const auto n = from.ConsumeBool() ? from.ConsumeIntegralInRange<std::uint32_t>(0, 22)
                                        : from.ConsumeIntegral<std::uint32_t>();
      runs.put(from.ConsumeIntegralInRange<std::uint32_t>(0, 40));
      runs.put(from.ConsumeBool() ? from.ConsumeIntegralInRange<std::uint32_t>(0, 22)
                                  : from.ConsumeIntegral<std::uint32_t>());
      runs.put(n);
      touched += n < 1000 ? n : 0;
    }
    if (from.ConsumeIntegralInRange(0, 9) == 0) touched += from.ConsumeIntegral<std::uint8_t>();
    parts.directory.put(n_runs);
    parts.directory.put(touched);
    parts.directory.put(sturz::crc32c(runs.bytes()));
    parts.maps.values(runs.bytes());
    const std::vector<float> values(touched, 2.5F);
    for (std::uint32_t l = 0; l < n_layers; ++l) {
      parts.directory.put(sturz::crc32c(std::as_bytes(std::span(values))));
      parts.maps.values(std::span<const float>(values));
    }
  }
  read_all(plain(sturz::sealed_record(3, std::move(parts))));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider from(data, size);
  switch (from.ConsumeIntegralInRange(0, 2)) {
    case 0: {  // two records and whatever else, some of it changed
      static const auto record = plain(sturz::encode_record(original(true), {"a", "b", "c"}));
      std::vector<std::uint8_t> bytes = record;
      const auto extra = from.ConsumeBytes<std::uint8_t>(from.ConsumeIntegralInRange(0, 80));
      bytes.insert(bytes.end(), extra.begin(), extra.end());
      bytes.insert(bytes.end(), record.begin(), record.end());
      for (int n = from.ConsumeIntegralInRange(0, 8); n > 0 && !bytes.empty(); --n) {
        const auto at = from.ConsumeIntegralInRange<std::size_t>(0, bytes.size() - 1);
        const int kind = from.ConsumeIntegralInRange(0, 9);
        if (kind == 0)
          bytes.resize(at);
        else if (kind == 1)
          bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
        else
          bytes[at] = from.ConsumeIntegral<std::uint8_t>();
      }
      read_all(bytes);
      return 0;
    }
    case 1:
      changed_record(from);
      return 0;
    default:
      any_runs(from);
      return 0;
  }
}
