// SPDX-License-Identifier: Apache-2.0
#include "io/members/member_file.hpp"

#include "engine/core/error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/io_error.hpp"
#include "io/files/seal.hpp"
#include "io/members/gauge_netcdf.hpp"
#include "io/members/member_netcdf.hpp"
#include "io/netcdf/grid_netcdf.hpp"
#include "io/netcdf/history_netcdf.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr int format_version = 5;
/// Of members with layers and numbers of grains and of liquid; others are what they were before.
constexpr int materials_version = 6;
/// Few rows to a chunk: the statistics read members in bands of rows.
constexpr int rows_per_chunk = 64, cols_per_chunk = 512;

constexpr const char* passes_attribute = "passes";         // "; "-separated
constexpr const char* seconds_attribute = "pass_seconds";  // in the same order
constexpr const char* effects_attribute = "effects";       // as `describe` names them
constexpr const char* effect_seconds_attribute = "effect_seconds";

int version_of(const MemberScalars& m) {
  return std::isnan(m.solid_runout_m) ? format_version : materials_version;
}

bool has_maps(const MemberResult& m) { return m.window.n_cells() > 0 && !m.layers[0].empty(); }

Grid window_grid(const Grid& g, const Window& w) {
  return {w.n_cols, w.n_rows, g.west_m + w.col0 * g.cell_m, g.north_m - w.row0 * g.cell_m,
          g.cell_m, g.crs_wkt};
}

void write_facts(NetcdfWriter& file, const MemberResult& m) {
  constexpr int global = NetcdfWriter::global;
  file.text(global, "Conventions", "CF-1.10");
  file.text(global, "title", fmt::format("Landslide ensemble member {}", m.member));
  file.text(global, "source", "sturz, landslide ensemble runner");
  file.text(global, "history", "written by sturz");
  file.integer(global, "member_format", version_of(m.scalars));
  file.integer(global, "member", m.member);
  file.text(global, "outcome", std::string(to_string(m.outcome)));
  file.text(global, "censored", std::string(to_string(m.censoring)));
  file.text(global, "reason", m.reason);
  file.text(global, "formulation", m.formulation);
  file.text(global, "binding_limit", m.binding_limit);
  file.text(global, "warnings", m.warnings);
  file.hash(global, "state_hash", m.state_hash);
  write_grid_attributes(file, m.grid);
  const Window window = has_maps(m) ? m.window : Window{};
  file.integer(global, "window_row0", window.row0);
  file.integer(global, "window_col0", window.col0);
  file.integer(global, "window_n_rows", window.n_rows);
  file.integer(global, "window_n_cols", window.n_cols);
}

void write_origin(NetcdfWriter& file, const MemberOrigin& origin) {
  constexpr int global = NetcdfWriter::global;
  file.text(global, "scene_hash", origin.scene_hash);
  file.text(global, "engine_version", origin.engine_version);
  file.text(global, "engine_commit", origin.engine_commit);
}

void write_scalars(NetcdfWriter& file, const MemberScalars& scalars) {
  for (const ScalarInfo& scalar : scalar_table()) {
    if (scalar.sparse && version_of(scalars) != materials_version) continue;
    const int variable = file.variable(scalar.name, NcType::float64, {});
    file.text(variable, "long_name", scalar.long_name);
    file.text(variable, "units", scalar.units);
    file.put(variable, std::span(&(scalars.*scalar.field), 1));
  }
}

void write_seconds(NetcdfWriter& file, const char* names_attribute, const char* numbers_attribute,
                   const NamedSeconds& times) {
  std::string names;
  std::vector<double> seconds;
  for (const auto& [name, spent] : times) {
    names += (names.empty() ? "" : "; ") + name;
    seconds.push_back(spent);
  }
  if (seconds.empty()) return;
  file.text(NetcdfWriter::global, names_attribute, names);
  file.numbers(NetcdfWriter::global, numbers_attribute, seconds);
}

void write_maps(NetcdfWriter& file, const MemberResult& m) {
  const Grid place = window_grid(m.grid, m.window);
  const GridDimensions dimensions = write_grid(file, place);
  const std::vector<std::size_t> chunk{
      static_cast<std::size_t>(std::min(rows_per_chunk, place.n_rows)),
      static_cast<std::size_t>(std::min(cols_per_chunk, place.n_cols))};
  for (int i = 0; i < n_peak_layers; ++i) {
    const auto layer = static_cast<PeakLayer>(i);
    const PeakLayerInfo& about = info(layer);
    if (!is_kept(layer, m.censoring, m.scalars)) continue;
    expect(m.layer(layer).size() == m.window.n_cells(), "a member's maps fill its window");
    const int variable = file.variable(about.name, NcType::float32, {dimensions.y, dimensions.x});
    file.compress(variable, chunk);
    file.fill_value(variable, nan_f);
    file.text(variable, "long_name", about.long_name);
    file.text(variable, "units", about.units);
    link_grid(file, variable, place);
    file.put(variable, m.layer(layer));
  }
}

[[noreturn]] void not_a_member(const NetcdfReader& file, const std::string& what) {
  throw IoError(
      fmt::format("{}: {} (not a finished member, or damaged). The command that wrote "
                  "it computes it again.",
                  file.file().string(), what));
}

std::int64_t need_integer(const NetcdfReader& file, const char* name) {
  const auto value = file.integer("", name);
  if (!value) not_a_member(file, fmt::format("has no attribute {}", name));
  return *value;
}

std::string need_text(const NetcdfReader& file, const char* name) {
  const auto value = file.text("", name);
  if (!value) not_a_member(file, fmt::format("has no attribute {}", name));
  return *value;
}

NamedSeconds read_seconds(const NetcdfReader& file, const char* names_attribute,
                          const char* numbers_attribute) {
  NamedSeconds times;
  std::string names = file.text("", names_attribute).value_or("");
  for (const double seconds : file.numbers("", numbers_attribute)) {
    const std::size_t end = std::min(names.find("; "), names.size());
    times.emplace_back(names.substr(0, end), seconds);
    names.erase(0, end + 2);
  }
  return times;
}

}  // namespace

std::string member_file_name(std::int64_t member) { return fmt::format("{:06d}.nc", member); }

void write_member(const std::filesystem::path& folder, const MemberResult& m,
                  const MemberOrigin& origin) {
  make_folder(folder);
  NetcdfWriter file(folder / member_file_name(m.member));
  write_facts(file, m);
  write_origin(file, origin);
  write_scalars(file, m.scalars);
  write_seconds(file, passes_attribute, seconds_attribute, m.pass_seconds);
  write_seconds(file, effects_attribute, effect_seconds_attribute, m.effect_seconds);
  write_history(file, m.history);
  write_gauges(file, m.gauges);
  if (has_maps(m)) {
    write_maps(file, m);
  } else {
    write_crs(file, m.grid);
  }
  file.commit();
}

MemberSummary read_member_summary(const NetcdfReader& file) {
  const std::int64_t version = need_integer(file, "member_format");
  if (version != format_version && version != materials_version)
    not_a_member(file, "was written by another version of this program");
  MemberSummary m;
  m.member = need_integer(file, "member");
  const std::string outcome = need_text(file, "outcome");
  const auto known = outcome_from(outcome);
  if (!known) not_a_member(file, fmt::format("has the unknown outcome '{}'", outcome));
  m.outcome = *known;
  const std::string censored = need_text(file, "censored");
  const auto censoring = censoring_from(censored);
  if (!censoring) not_a_member(file, fmt::format("is censored by the unknown '{}'", censored));
  m.censoring = *censoring;
  m.reason = need_text(file, "reason");
  m.formulation = need_text(file, "formulation");
  m.binding_limit = need_text(file, "binding_limit");
  m.warnings = need_text(file, "warnings");
  const auto hash = file.hash("", "state_hash");
  if (!hash) not_a_member(file, "has no attribute state_hash");
  m.state_hash = *hash;
  for (const ScalarInfo& scalar : scalar_table()) {
    if (scalar.sparse && version != materials_version) continue;
    const std::vector<double> value = file.doubles(scalar.name);
    if (value.size() != 1) not_a_member(file, fmt::format("{} is not one number", scalar.name));
    m.scalars.*scalar.field = value[0];
  }
  if (version_of(m.scalars) != version)
    not_a_member(file, "was written by another version of this program");
  const auto window = [&](const char* name) {
    const std::int64_t n = need_integer(file, name);
    if (n < 0 || n > std::numeric_limits<int>::max())
      not_a_member(file, fmt::format("has {} = {}", name, n));
    return static_cast<int>(n);
  };
  m.window = {window("window_row0"), window("window_col0"), window("window_n_rows"),
              window("window_n_cols")};
  m.effect_seconds = read_seconds(file, effects_attribute, effect_seconds_attribute);
  return m;
}

MemberOrigin read_member_origin(const NetcdfReader& file) {
  return {need_text(file, "scene_hash"), need_text(file, "engine_version"),
          need_text(file, "engine_commit")};
}

void require_inside(const NetcdfReader& file, const Window& w, const Grid& g) {
  if (w.n_rows <= g.n_rows - w.row0 && w.n_cols <= g.n_cols - w.col0) return;
  not_a_member(file, "has maps that reach beyond its grid");
}

void read_member_rows(const NetcdfReader& file, const Window& window, PeakLayer layer, int first,
                      int n, std::span<float> out) {
  file.floats(info(layer).name, {static_cast<std::size_t>(first), 0},
              {static_cast<std::size_t>(n), static_cast<std::size_t>(window.n_cols)}, out);
}

void read_member_part(const NetcdfReader& file, const Window& window, PeakLayer layer,
                      const Window& part, std::span<float> out) {
  file.floats(info(layer).name,
              {static_cast<std::size_t>(part.row0 - window.row0),
               static_cast<std::size_t>(part.col0 - window.col0)},
              {static_cast<std::size_t>(part.n_rows), static_cast<std::size_t>(part.n_cols)}, out);
}

MemberResult read_member(const std::filesystem::path& path) {
  require_sealed(path);
  const NetcdfReader file(path);
  MemberResult m = result_of(read_member_summary(file));
  m.grid = read_grid_attributes(file);
  require_inside(file, m.window, m.grid);
  m.history = read_history(file);
  m.gauges = read_gauges(file);
  m.pass_seconds = read_seconds(file, passes_attribute, seconds_attribute);
  if (m.window.n_cells() == 0) return m;
  for (int i = 0; i < n_peak_layers; ++i) {
    const auto layer = static_cast<PeakLayer>(i);
    if (!is_kept(layer, m.censoring, m.scalars)) continue;
    auto& values = m.layers[static_cast<std::size_t>(i)];
    file.require_room(static_cast<double>(m.window.n_cells()), info(layer).name);
    values.resize(m.window.n_cells());
    read_member_rows(file, m.window, layer, 0, m.window.n_rows, values);
  }
  return m;
}

}  // namespace sturz
