// SPDX-License-Identifier: Apache-2.0
#include "tests/reports/made_up_results.hpp"

#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/release_footprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz::testing {
namespace {

constexpr const char* utm_33 =
    "PROJCRS[\"WGS 84 / UTM zone 33N\",BASEGEOGCRS[\"WGS 84\"],ID[\"EPSG\",32633]]";
constexpr double west_m = 412000, south_m = 4651000;

/// Where the gully lies: northing of its bottom, relative to the middle, at `s` = 0..1 eastward.
double gully(double s) { return 0.13 * std::sin(7 * s + 0.6) + 0.05 * std::sin(19 * s); }

/// Smooth noise in 0..1 of unit wavelength: random values at whole numbers, eased in between.
double noise(double x, double y) {
  const auto corner = [](double i, double j) {
    const double v = std::sin(i * 127.1 + j * 311.7) * 43758.5453;
    return v - std::floor(v);
  };
  const double i = std::floor(x), j = std::floor(y);
  const auto ease = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const double u = ease(x - i), w = ease(y - j);
  return (1 - w) * ((1 - u) * corner(i, j) + u * corner(i + 1, j)) +
         w * ((1 - u) * corner(i, j + 1) + u * corner(i + 1, j + 1));
}

/// Sharp crests and round valleys: folded noise of five halving wavelengths.
double ridges(double x, double y) {
  double sum = 0, weight = 0.5, carried = 1;
  for (int k = 0; k < 6; ++k) {
    const double fold = 1 - std::abs(2 * noise(x, y) - 1);
    sum += weight * carried * fold * fold;
    carried = std::min(1.0, 1.6 * fold);
    weight *= 0.5;
    const double turned = 1.6 * x - 1.2 * y;
    y = 1.2 * x + 1.6 * y + 11.3;
    x = turned + 4.7;
  }
  return sum;
}

/// A slope that flattens into a fan, cut by the gully and roughened by ridges beside it.
Raster<double> make_ground(const MadeUpScene& scene) {
  Raster<double> ground(Grid{.n_cols = scene.n_cols,
                             .n_rows = scene.n_rows,
                             .west_m = west_m,
                             .north_m = south_m + scene.n_rows * scene.cell_m,
                             .cell_m = scene.cell_m,
                             .crs_wkt = utm_33});
  const double length = scene.n_cols * scene.cell_m, width = scene.n_rows * scene.cell_m;
  for (int row = 0; row < scene.n_rows; ++row)
    for (int col = 0; col < scene.n_cols; ++col) {
      const double s = (col + 0.5) / scene.n_cols, t = 0.5 - (row + 0.5) / scene.n_rows;
      const double off = t - gully(s) * length / width / 1.5;
      const double steep = std::exp(-2.6 * s);
      const double valley = 0.5 * steep * length * off * off / (0.10 + std::abs(off));
      const double beside = std::min(1.0, 5 * std::abs(off)) * (0.12 + 0.88 * steep);
      const double crests = ridges(5.2 * s + 3, 5.2 * t * width / length + 8);
      ground.at(row, col) = 640 + 0.34 * length * steep + valley + 0.30 * length * beside * crests;
    }
  for (int row = 0; row < std::max(1, scene.n_rows / 12); ++row)  // a corner beyond the survey
    for (int col = 0; col < scene.n_cols / 9; ++col) ground.at(row, col) = nan_d;
  return ground;
}

DesignTable make_design(int n) {
  DesignTable design{.keys = {"basal.friction_coefficient", "basal.pore_pressure_ratio",
                              "grains.solid_fraction", "grains.cohesion_pa"},
                     .units = {"1", "1", "1", "Pa"},
                     .design = Design::latin_hypercube,
                     .seed = 1,
                     .unit_cube = {},
                     .values = {}};
  for (int k = 0; k < n; ++k) {
    const auto u = [&](double step) { return std::fmod(0.5 + step * (k + 1), 1.0); };
    design.values.push_back({0.15 + 0.25 * u(0.6180339887), 0.5 * u(0.7548776662),
                             0.5 + 0.2 * u(0.5698402910), 2000 * u(0.8191725134)});
  }
  return design;
}

/// Half of each; where grains came no more, liquid alone.
void put_phases(MemberResult& m, std::size_t cell, bool with_grains, double h, double v,
                double along) {
  const auto put = [&](PeakLayer p, double value) { m.layer(p)[cell] = static_cast<float>(value); };
  put(PeakLayer::liquid, with_grains ? 0.5 * h : h);
  put(PeakLayer::liquid_speed, v);
  put(PeakLayer::liquid_energy, 0.25 * 1200 * h * v * v);
  put(PeakLayer::liquid_pressure, (with_grains ? 500 : 1200) * v * v);
  put(PeakLayer::liquid_arrival, 4 + 70 * along);
  put(PeakLayer::liquid_fraction, with_grains ? 0.5 : 1);
  if (!with_grains) return;
  put(PeakLayer::solid, 0.5 * h);
  put(PeakLayer::solid_speed, 0.9 * v);
  put(PeakLayer::solid_energy, 0.25 * 1500 * h * v * v);
  put(PeakLayer::solid_pressure, 1000 * v * v);
  put(PeakLayer::solid_arrival, 6 + 75 * along);
}

/// One member: a tongue that follows the gully, thick behind its front, fast where it is steep.
MemberResult make_member(std::int64_t number, const MadeUpScene& scene, const Grid& grid,
                         const std::vector<double>& x) {
  MemberResult m;
  m.member = number;
  m.grid = grid;
  m.window = {0, 0, grid.n_rows, grid.n_cols};
  for (int k = 0; k < n_peak_layers; ++k)
    if (const auto layer = static_cast<PeakLayer>(k); scene.phases || !is_of_materials(layer))
      m.layers[k].assign(grid.n_cells(), info(layer).untouched);
  const double effective = x[0] * (1 - x[1]);
  const double whole = std::clamp(0.30 + 0.55 * std::exp(-(effective - 0.07) / 0.12), 0.25, 0.93);
  const bool gone = whole > scene.edge;
  const double runout = std::min(whole, scene.edge);
  const double side = 0.6 * (x[2] - 0.6), length = grid.n_cols * grid.cell_m;
  const double aspect = length / (grid.n_rows * grid.cell_m);
  MemberScalars& sc = m.scalars;
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      const double s = (col + 0.5) / grid.n_cols, t = 0.5 - (row + 0.5) / grid.n_rows;
      const double along = (s - 0.08) / (whole - 0.08);
      if (along <= 0 || along >= 1 || s >= scene.edge) continue;
      const double fan = std::max(0.0, s - 0.62);
      const double centre = gully(s) * aspect / 1.5 + fan * side;
      const double half = (0.035 + 0.02 * std::sin(9 * s + 30 * x[2]) * 0.5 + 0.22 * fan) *
                          std::pow(1 - along, 0.28);
      const double across = (t - centre) / (half * std::min(1.0, std::sqrt(20 * along)));
      if (std::abs(across) >= 1) continue;
      const double profile = std::pow(1 - across * across, 0.6);
      const double h = (9 * std::exp(-3.5 * s) + 1.2) * profile * std::pow(1 - along, 0.2);
      const double v = 38 * std::sqrt(along * (1 - along)) * std::sqrt(profile);
      if (h < 0.05) continue;
      const std::size_t cell = grid.index(row, col);
      const auto put = [&](PeakLayer p, double value) {
        m.layer(p)[cell] = static_cast<float>(value);
      };
      put(PeakLayer::thickness, h);
      put(PeakLayer::speed, v);
      put(PeakLayer::energy, 0.5 * 1500 * h * v * v);
      put(PeakLayer::pressure, 1500 * v * v);
      put(PeakLayer::arrival, along < 0.06 ? 0 : 4 + 70 * along);
      if (gone && (col + 1.5) / grid.n_cols >= scene.edge) put(PeakLayer::left, 800 * h);
      put(PeakLayer::deposit, 0.4 * h * along);
      if (scene.phases) put_phases(m, cell, along < 0.85, h, v, along);
      sc.reached_area_m2 += grid.cell_m * grid.cell_m;
      sc.max_thickness_m = std::max(sc.max_thickness_m, h);
      sc.max_speed_m_s = std::max(sc.max_speed_m_s, v);
      sc.max_energy_j_m2 = std::max(sc.max_energy_j_m2, 0.5 * 1500 * h * v * v);
      sc.max_pressure_pa = std::max(sc.max_pressure_pa, 1500 * v * v);
    }
  sc.runout_m = (runout - 0.08) * length;
  sc.front_travel_m = sc.runout_m;
  sc.crown_to_toe_length_m = sc.runout_m + 0.03 * length;
  sc.crown_to_toe_drop_m = 0.3 * sc.crown_to_toe_length_m;
  sc.crown_to_toe_ratio = 0.3;
  sc.com_travel_m = 0.6 * sc.runout_m;
  sc.lost_fraction = gone ? whole - scene.edge : 0;
  if (scene.phases) {
    sc.solid_runout_m = (0.85 * runout - 0.08) * length, sc.liquid_runout_m = sc.runout_m;
    sc.solid_reached_area_m2 = 0.8 * sc.reached_area_m2;
    sc.liquid_reached_area_m2 = sc.reached_area_m2;
    sc.max_solid_thickness_m = 0.5 * sc.max_thickness_m;
    sc.max_liquid_thickness_m = 0.5 * sc.max_thickness_m;
    sc.max_solid_speed_m_s = 0.9 * sc.max_speed_m_s, sc.max_liquid_speed_m_s = sc.max_speed_m_s;
    sc.max_solid_energy_j_m2 = 0.5 * sc.max_energy_j_m2;
    sc.max_liquid_energy_j_m2 = 0.4 * sc.max_energy_j_m2;
    sc.max_solid_pressure_pa = 0.6 * sc.max_pressure_pa;
    sc.max_liquid_pressure_pa = 0.4 * sc.max_pressure_pa;
    sc.solid_lost_fraction = sc.solid_lost_mass_kg = sc.liquid_lost_mass_kg = 0;
    sc.liquid_lost_fraction = 2 * sc.lost_fraction;
  }
  sc.release_layers = 2.7;
  sc.parted_fraction = 0.01 + 0.1 * x[1];
  sc.end_time_s = 74 + 20 * x[2];
  sc.n_particles = 2841;
  sc.n_steps = 18000 + 40 * static_cast<double>(number);
  sc.wall_s = 11 + 6 * runout;
  sc.cpu_s = 1.8 * sc.wall_s;
  m.warnings = fmt::format(
      "the release is {:.1f} particles thick (fewer than 3: stresses across the flow are not "
      "resolved). Use a finer spacing_m",
      sc.release_layers);
  m.outcome = Outcome::settled;
  if (runout > 0.9) m.outcome = Outcome::out_of_time;
  if (gone) m.outcome = Outcome::left_terrain;
  m.censoring = censoring_of(gone, m.outcome == Outcome::out_of_time);
  if (scene.n_failed > 0 && number % (scene.n_members / scene.n_failed) == 11) {
    m.outcome = Outcome::diverged;
    m.reason =
        "speed of particle 1204 is not a number at t = 12.4 s; the time step was bound by "
        "<terrain contact>";
  }
  return m;
}

/// A mass that speeds up, loosens, comes to rest and packs again within a minute.
MemberHistory make_history() {
  MemberHistory h;
  h.has_states = h.has_temperature = true;
  for (int k = 0; k <= 120; ++k) {
    const float s = static_cast<float>(k) / 120, bell = 4 * s * (1 - s);
    HistoryRow row;
    row.time_s = 60 * s;
    row.front_travel_m = 900 * s * s * (3 - 2 * s);
    row.com_travel_m = 0.7F * row.front_travel_m;
    row.tail_travel_m = 0.4F * row.front_travel_m;
    row.max_speed_m_s = 28 * bell;
    row.front_speed_m_s = 24 * bell;
    row.mean_speed_m_s = 17 * bell;
    row.tail_speed_m_s = 6 * bell;
    row.transition = 0.06F * bell;
    row.dilute = 0.10F * bell * bell;
    row.ultradilute = 0.02F * bell * bell * bell;
    row.dense = 1 - row.transition - row.dilute - row.ultradilute;
    row.max_granular_temperature_m2_s2 = 12 * bell;
    h.rows.push_back(row);
  }
  return h;
}

class MadeUpSource : public MemberParts {
 public:
  MadeUpSource(const MadeUpScene& scene, Grid grid, const DesignTable& design)
      : grid_(std::move(grid)) {
    for (int k = 0; k < scene.n_members; ++k) {
      results_.push_back(make_member(k, scene, grid_, design.values[static_cast<std::size_t>(k)]));
      const MemberResult& r = results_.back();
      summaries_.push_back({r.member, r.outcome, r.censoring, r.reason, r.formulation, "sound",
                            r.warnings, r.state_hash, r.scalars, r.window, r.effect_seconds});
    }
  }
  const std::vector<MemberSummary>& members() const override { return summaries_; }
  const Grid& grid() const override { return grid_; }
  void read_part(std::size_t index, PeakLayer layer, const Window& part,
                 std::span<float> out) const override {
    const auto& values = results_[index].layer(layer);
    std::fill(out.begin(), out.end(), info(layer).untouched);
    if (values.empty()) return;
    for (int row = 0; row < part.n_rows; ++row)
      std::copy_n(
          values.begin() + static_cast<std::ptrdiff_t>(grid_.index(part.row0 + row, part.col0)),
          part.n_cols, out.begin() + static_cast<std::ptrdiff_t>(row) * part.n_cols);
  }
  const std::vector<MemberResult>& results() const { return results_; }

 private:
  Grid grid_;
  std::vector<MemberResult> results_;
  std::vector<MemberSummary> summaries_;
};

LayerStack peaks_of(const MemberResult& m) {
  LayerStack stack{.grid = m.grid, .layers = {}, .attributes = {}};
  for (int k = 0; k < n_peak_layers; ++k) {
    const auto peak = static_cast<PeakLayer>(k);  // no bed is taken along
    if (peak == PeakLayer::eroded || (is_of_materials(peak) && m.layer(peak).empty())) continue;
    const PeakLayerInfo& about = info(static_cast<PeakLayer>(k));
    Layer layer;
    layer.name = about.name;
    layer.meaning = {quantity_of(static_cast<PeakLayer>(k)), Statistic::peak};
    layer.long_name = about.long_name, layer.units = about.units;
    layer.values = m.layers[k];
    stack.layers.push_back(std::move(layer));
  }
  return stack;
}

}  // namespace

MadeUpResults make_up_results(const MadeUpScene& scene) {
  MadeUpResults r;
  r.elevation = make_ground(scene);
  r.design = make_design(scene.n_members);
  auto source = std::make_unique<MadeUpSource>(scene, r.elevation.grid, r.design);
  if (!source->results().empty()) r.peaks = peaks_of(source->results().front());
  HazardContext context;
  context.spacing_m = 7;
  r.history = make_history();
  r.hazard = make_hazard_map(*source, HazardSpec{}, context);
  r.release = release_footprint(*source);
  r.source = std::move(source);
  return r;
}

ReportInput MadeUpResults::ensemble_input() const {
  ReportInput in;
  in.title = "Gully above the made-up village";
  in.scenario_yaml =
      "title: Gully above the made-up village\nterrain: {raster: ground.tif}\n"
      "basal:\n  friction_coefficient: {uniform: [0.15, 0.4]}\n"
      "numerics: {spacing_m: 7, end_time_s: 120}   # </script><b>not markup</b>\n";
  in.manifest = {{"program", "sturz 0.1.0 (9f31c02)"},
                 {"compiler", "GNU 12.2.0, -O3"},
                 {"started", "2026-05-04 09:12 UTC"},
                 {"command", "sturz ensemble scenario.yaml -n 32"},
                 {"design", "latin_hypercube, 32 members, seed 1"},
                 {"checksum of ground.tif", "sha256 4be1d9a2c07f55e0918f3c2ab6d47e10fe33"}};
  in.elevation = &elevation;
  in.hazard = &hazard;
  in.members = source->members();
  in.samples = sampled_values(design, in.members);
  in.convergence = probability_convergence(*source);
  in.warnings = {
      "Thickness thresholds 0.1, 0.5, 1 and 2 m lie below half the particle spacing "
      "(3.5 m): they are not resolved. Use a finer spacing_m to map them."};
  in.notes = {"ground.tif: 2 % of the cells are nodata; the flow may leave there.",
              "release: polygon area x thickness 1 200 000 m3, initialised 1 199 874 m3."};
  in.description = {"full_stress  2 841 particles of 7 m, about 18 000 steps",
                    "gravity         on   always", "grain_stress    on   the scene has grains",
                    "fluid           off  no fluid block"};
  in.timings = {{"grain stress", 361},       {"bed", 74},
                {"kinetic theory", 31},      {"motion", 12},
                {"bookkeeping", 5.2},        {"gravity", 1.9},
                {"isolated particles", 0.4}, {"states of the grains", 0.3}};
  in.elapsed_s = 251;
  in.max_censored_fraction = 0.05;
  in.release = &release;
  in.resolved_thickness_m = 3.5;
  return in;
}

ReportInput MadeUpResults::single_input() const {
  ReportInput in = ensemble_input();
  in.hazard = nullptr;
  in.peaks = &peaks;
  in.history = &history;
  in.members.resize(1);
  in.pass_timings = {{"pair sweep", 325},
                     {"ground and wall support", 74},
                     {"pair sweep, dispersed groups", 31},
                     {"others", 56}};
  if (!in.members.empty()) {
    MemberScalars& m = in.members.front().scalars;
    m.parted_fraction = 0.083, m.transition_fraction = 0.041, m.dilute_fraction = 0.054;
    m.ultradilute_fraction = 0.0092, m.max_granular_temperature_m2_s2 = 12;
    m.granular_ratio = 0.0153;
  }
  in.samples.rows.resize(1);
  in.convergence.clear();
  return in;
}

}  // namespace sturz::testing
