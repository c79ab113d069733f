// SPDX-License-Identifier: Apache-2.0
#include "tests/support/made_up_flows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace sturz::test {
namespace {

/// Numbers between 0 and 1 without a pattern, by index.
float noise(std::size_t i) {
  static const auto table = [] {
    std::array<float, 1 << 16> values{};
    std::mt19937 random(20);
    for (float& v : values) v = std::uniform_real_distribution<float>(0, 1)(random);
    return values;
  }();
  return table[i % table.size()];
}

struct Track {
  double row, col, lean, half_width;
  int length;
};

Track track_of(std::int64_t member, int edge) {
  std::mt19937_64 random(static_cast<std::uint64_t>(member));
  random.discard(2);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<>(a, b)(random);
  };
  const double scale = std::min(1.0, edge / 400.0);
  Track t{};
  t.length = static_cast<int>(scale * between(60, 160));
  t.half_width = scale * between(8, 20);
  t.lean = between(-0.3, 0.3);
  const double room = 80 * scale;
  const bool same_place = member % 2 == 0;
  t.row = same_place ? 0.3 * edge : between(1, edge - t.length - 2);
  t.col = same_place ? 0.5 * edge : between(room, edge - room);
  return t;
}

void add_history(MemberResult& m) {
  m.history.rows.resize(120);
  for (std::size_t i = 0; i < m.history.rows.size(); ++i)
    for (const HistoryColumn& column : history_table())
      if (column.part == HistoryPart::motion)
        m.history.rows[i].*column.field = static_cast<float>(i) + noise(i + 31);
}

}  // namespace

MemberResult made_up_flow(std::int64_t member, int edge) {
  const Track t = track_of(member, edge);
  MemberResult m;
  m.member = member;
  m.outcome = Outcome::settled;
  m.formulation = "depth_averaged";
  m.binding_limit = "columns pass each other";
  m.state_hash = 0x9e3779b97f4a7c15u * static_cast<std::uint64_t>(member + 1);
  m.effect_seconds = {{"pressure of columns", 0.1}, {"resistance of the bed", 0.05}};
  m.pass_seconds = {{"column cells", 0.03}, {"column forces", 0.07}, {"peak maps", 0.05}};
  m.grid = {edge, edge, 500000, 4600000, 5, ""};
  const double drift = t.lean * t.length;
  const int west = static_cast<int>(t.col + std::min(drift, 0.0) - t.half_width) - 2;
  const int east = static_cast<int>(t.col + std::max(drift, 0.0) + t.half_width) + 2;
  m.window = {static_cast<int>(t.row), west, t.length, east - west};
  std::array<float*, n_peak_layers> to{};
  for (int l = 0; l < n_peak_layers; ++l) {
    const auto layer = static_cast<PeakLayer>(l);
    if (!is_kept(layer, m.censoring, m.scalars)) continue;
    m.layer(layer).assign(m.window.n_cells(), info(layer).untouched);
    to[static_cast<std::size_t>(l)] = m.layer(layer).data();
  }
  const auto seed = static_cast<std::size_t>(member) * 7919;
  for (int row = 0; row < t.length; ++row) {
    const double middle = t.col + t.lean * row - west;
    const double half = t.half_width - 2 * noise(seed + static_cast<std::size_t>(row));
    const int first = static_cast<int>(middle - half), end = static_cast<int>(middle + half);
    for (int col = first; col < end; ++col) {
      const auto i = static_cast<std::size_t>(row * m.window.n_cols + col);
      const float h = 0.1F + 3 * noise(seed + 3 * i), v = 0.2F + 20 * noise(seed + 5 * i + 1);
      to[0][i] = h, to[1][i] = v, to[2][i] = 0.5F * 1800 * h * v * v;
      to[3][i] = 1800 * v * v, to[4][i] = 0.4F * static_cast<float>(row) + noise(seed + i);
      to[5][i] = row > t.length / 2 ? 0.5F * h : 0;
    }
  }
  add_history(m);
  return m;
}

}  // namespace sturz::test
