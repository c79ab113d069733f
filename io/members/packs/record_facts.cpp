// SPDX-License-Identifier: Apache-2.0
#include "io/members/packs/record_facts.hpp"

#include "engine/core/hash.hpp"

#include <cmath>
#include <string_view>
#include <utility>

namespace sturz {
namespace {

/// Changes whenever the meaning of the bytes does, for what the names below do not show.
constexpr std::uint64_t facts_version = 1;

/// Of the names of all numbers, in order: another program may know other ones.
std::uint64_t table_hash() {
  static const std::uint64_t hash = [] {
    Hash64 names;
    const auto add = [&](std::string_view name) {
      names.add(std::span(name.data(), name.size())).add(std::uint8_t{0});
    };
    names.add(facts_version);
    for (const ScalarInfo& scalar : scalar_table()) add(scalar.name);
    for (const HistoryColumn& column : history_table()) add(column.name);
    for (int i = 0; i < n_peak_layers; ++i) add(info(static_cast<PeakLayer>(i)).name);
    return names.value();
  }();
  return hash;
}

void write_seconds(ByteWriter& to, const NamedSeconds& times) {
  to.put(static_cast<std::uint32_t>(times.size()));
  for (const auto& [name, seconds] : times) {
    to.text(name);
    to.put(seconds);
  }
}

NamedSeconds read_seconds(ByteReader& from) {
  NamedSeconds times;
  for (auto n = from.get<std::uint32_t>(); n > 0; --n) {
    std::string name = from.text();
    times.emplace_back(std::move(name), from.get<double>());
  }
  return times;
}

void write_grid(ByteWriter& to, const Grid& g) {
  to.put(static_cast<std::int32_t>(g.n_cols));
  to.put(static_cast<std::int32_t>(g.n_rows));
  to.put(g.west_m);
  to.put(g.north_m);
  to.put(g.cell_m);
  to.text(g.crs_wkt);
}

Grid read_grid(ByteReader& from) {
  Grid g;
  g.n_cols = from.get<std::int32_t>();
  g.n_rows = from.get<std::int32_t>();
  g.west_m = from.get<double>();
  g.north_m = from.get<double>();
  g.cell_m = from.get<double>();
  g.crs_wkt = from.text();
  if (g.n_cols < 0 || g.n_rows < 0 || !(g.cell_m > 0)) throw BadRecord("it has a senseless grid");
  return g;
}

void write_window(ByteWriter& to, const Window& w) {
  for (const int n : {w.row0, w.col0, w.n_rows, w.n_cols}) to.put(static_cast<std::int32_t>(n));
}

Window read_window(ByteReader& from, const Grid& g) {
  Window w;
  for (int* n : {&w.row0, &w.col0, &w.n_rows, &w.n_cols}) {
    *n = from.get<std::int32_t>();
    if (*n < 0) throw BadRecord("it has a senseless window");
  }
  if (w.n_rows > g.n_rows - w.row0 || w.n_cols > g.n_cols - w.col0)
    throw BadRecord("it has maps that reach beyond its grid");
  return w;
}

void write_peak(ByteWriter& to, const GaugePeak& peak) {
  to.put(peak.value);
  to.put(peak.time_s);
}

GaugePeak read_peak(ByteReader& from) {
  const auto value = from.get<double>();
  return {value, from.get<double>()};
}

void write_gauges(ByteWriter& to, const GaugeResult& gauges) {
  to.put(static_cast<std::uint32_t>(gauges.points.size()));
  to.put(static_cast<std::uint32_t>(gauges.lines.size()));
  if (gauges.empty()) return;
  to.put(gauges.interval_s);
  to.list(gauges.time_s);
  for (const PointSeries& p : gauges.points) {
    to.text(p.name);
    for (const double v : {p.at.x(), p.at.y(), p.arrival_s}) to.put(v);
    for (const auto* peak : {&p.thickness, &p.speed, &p.momentum_flux}) write_peak(to, *peak);
    for (const auto* series : {&p.thickness_m, &p.speed_m_s, &p.momentum_flux_n_m})
      to.list(*series);
  }
  for (const LineSeries& l : gauges.lines) {
    to.text(l.name);
    to.put(l.arrival_s);
    to.put(l.total_m3);
    write_peak(to, l.discharge);
    to.list(l.volume_m3);
    to.list(l.discharge_m3_s);
  }
}

PointSeries read_point(ByteReader& from) {
  PointSeries p;
  p.name = from.text();
  const auto x = from.get<double>();
  p.at = Vec2(x, from.get<double>());
  p.arrival_s = from.get<double>();
  for (auto* peak : {&p.thickness, &p.speed, &p.momentum_flux}) *peak = read_peak(from);
  for (auto* series : {&p.thickness_m, &p.speed_m_s, &p.momentum_flux_n_m})
    *series = from.list<float>();
  return p;
}

LineSeries read_line(ByteReader& from) {
  LineSeries l;
  l.name = from.text();
  l.arrival_s = from.get<double>();
  l.total_m3 = from.get<double>();
  l.discharge = read_peak(from);
  l.volume_m3 = from.list<double>();
  l.discharge_m3_s = from.list<double>();
  return l;
}

GaugeResult read_gauges(ByteReader& from) {
  GaugeResult gauges;
  const auto n_points = from.get<std::uint32_t>(), n_lines = from.get<std::uint32_t>();
  if (n_points == 0 && n_lines == 0) return gauges;
  gauges.interval_s = from.get<double>();
  gauges.time_s = from.list<double>();
  const std::size_t n = gauges.time_s.size();
  for (std::uint32_t k = 0; k < n_points; ++k) {
    gauges.points.push_back(read_point(from));
    const PointSeries& p = gauges.points.back();
    if (p.thickness_m.size() != n || p.speed_m_s.size() != n || p.momentum_flux_n_m.size() != n)
      throw BadRecord("a gauge has another number of instants than the clock");
  }
  for (std::uint32_t k = 0; k < n_lines; ++k) {
    gauges.lines.push_back(read_line(from));
    const LineSeries& l = gauges.lines.back();
    if (l.volume_m3.size() != n || l.discharge_m3_s.size() != n)
      throw BadRecord("a gauge has another number of instants than the clock");
  }
  return gauges;
}

/// Columns that the scene has, one after the other, as a member's own file holds them.
void write_history(ByteWriter& to, const MemberHistory& history) {
  to.put(static_cast<std::uint32_t>(history.rows.size()));
  if (history.rows.empty()) return;
  for (const bool flag : {history.has_states, history.has_temperature, history.has_mixture})
    to.put(static_cast<std::uint8_t>(flag));
  for (const HistoryColumn& column : history_table())
    if (history.has(column.part))
      for (const HistoryRow& row : history.rows) to.put(row.*column.field);
}

MemberHistory read_history(ByteReader& from) {
  MemberHistory history;
  const auto n = from.get<std::uint32_t>();
  if (n == 0) return history;
  for (bool* flag : {&history.has_states, &history.has_temperature, &history.has_mixture})
    *flag = from.get<std::uint8_t>() != 0;
  if (n > from.left() / sizeof(float)) throw BadRecord("its history is longer than its record");
  history.rows.resize(n);
  for (const HistoryColumn& column : history_table())
    if (history.has(column.part))
      for (HistoryRow& row : history.rows) row.*column.field = from.get<float>();
  return history;
}

}  // namespace

bool has_maps(const MemberResult& m) { return m.window.n_cells() > 0 && !m.layers[0].empty(); }

void write_facts(ByteWriter& to, const MemberResult& m, const MemberOrigin& origin) {
  to.put(table_hash());
  to.put(static_cast<std::int64_t>(m.member));
  for (const std::string_view word : {to_string(m.outcome), to_string(m.censoring)}) to.text(word);
  for (const std::string* text : {&m.reason, &m.formulation, &m.binding_limit, &m.warnings})
    to.text(*text);
  to.put(m.state_hash);
  for (const ScalarInfo& scalar : scalar_table()) to.put(m.scalars.*scalar.field);
  write_grid(to, m.grid);
  write_window(to, has_maps(m) ? m.window : Window{});
  write_seconds(to, m.effect_seconds);
  for (const std::string* text :
       {&origin.scene_hash, &origin.engine_version, &origin.engine_commit})
    to.text(*text);
}

RecordFacts read_facts(std::span<const std::byte> bytes) {
  ByteReader from(bytes);
  if (from.get<std::uint64_t>() != table_hash())
    throw BadRecord("it was written by another version of this program");
  RecordFacts facts;
  MemberSummary& m = facts.summary;
  m.member = from.get<std::int64_t>();
  if (m.member < 0) throw BadRecord("it has a negative number");
  const auto outcome = outcome_from(from.text());
  const auto censoring = censoring_from(from.text());
  if (!outcome || !censoring) throw BadRecord("its end is not known to this program");
  m.outcome = *outcome;
  m.censoring = *censoring;
  for (std::string* text : {&m.reason, &m.formulation, &m.binding_limit, &m.warnings})
    *text = from.text();
  m.state_hash = from.get<std::uint64_t>();
  for (const ScalarInfo& scalar : scalar_table()) m.scalars.*scalar.field = from.get<double>();
  facts.grid = read_grid(from);
  m.window = read_window(from, facts.grid);
  m.effect_seconds = read_seconds(from);
  for (std::string* text :
       {&facts.origin.scene_hash, &facts.origin.engine_version, &facts.origin.engine_commit})
    *text = from.text();
  return facts;
}

void write_series(ByteWriter& to, const MemberResult& m) {
  write_history(to, m.history);
  write_gauges(to, m.gauges);
  write_seconds(to, m.pass_seconds);
}

void read_series(std::span<const std::byte> bytes, MemberResult& m) {
  ByteReader from(bytes);
  m.history = read_history(from);
  m.gauges = read_gauges(from);
  m.pass_seconds = read_seconds(from);
}

}  // namespace sturz
