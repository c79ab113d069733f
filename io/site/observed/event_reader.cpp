// SPDX-License-Identifier: Apache-2.0
#include "io/site/observed/event_reader.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/site/observed/observed_files.hpp"
#include "io/site/stand_in_crs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace sturz {
namespace {

/// What the steps below share.
struct Reading {
  const Scenario& scenario;
  const ObservationSpec& spec;
  const Grid& maps;
  EventRead read;
  std::vector<std::string> problems;

  template <class Call>
  void attempt(Call call) {
    try {
      call();
    } catch (const SetupError& problem) {
      problems.emplace_back(problem.what());
    }
  }
  void take(FileRead& file) {
    std::move(file.notes.begin(), file.notes.end(), std::back_inserter(read.notes));
    std::move(file.warnings.begin(), file.warnings.end(), std::back_inserter(read.warnings));
    read.identities.push_back(std::move(file.identity));
  }
  bool has_maps() const { return maps.n_cols > 0; }
  PolygonRequest layer(const char* key, const std::string& path, const std::string& name,
                       const char* layer_key, const char* what) const {
    PolygonRequest request;
    request.path = path;
    request.layer = name;
    request.key = key;
    request.layer_key = layer_key;
    request.directory = scenario.directory;
    request.crs = spec.crs;
    request.crs_key = "observation.crs";
    request.what = what;
    request.without_terrain = !has_maps();
    stand_in_with_terrain(request, scenario.terrain);
    return request;
  }
};

void read_areas(Reading& r) {
  const auto area = [&r](const PolygonRequest& request, double sd_m,
                         std::optional<ObservedArea>& into) {
    if (request.path.empty()) return;
    r.attempt([&] {
      AreaRead read = read_observed_area(request, r.maps);
      r.take(read);
      if (r.read.rings.empty()) r.read.rings = std::move(read.rings);
      read.area.sd_m = sd_m;
      into = std::move(read.area);
    });
  };
  const ObservationSpec& o = r.spec;
  area(r.layer("observation.outline", o.outline, o.outline_layer, "observation.outline_layer",
               "observed outline"),
       o.outline_sd_m.value_or(0), r.read.event.outline);
  area(r.layer("observation.deposit", o.deposit, o.deposit_layer, "observation.deposit_layer",
               "observed deposit"),
       o.deposit_sd_m.value_or(0), r.read.event.deposit);
}

struct MaskedSource {
  std::size_t cells = 0;
  double sum_m = 0;  ///< of their values
};

/// An elevation difference tells where the source lay how much was lost, not what lies there.
MaskedSource mask_source(Raster<double>& value, const Grid& maps, const Raster<double>& release) {
  const Window at = window_of(value.grid, maps);
  MaskedSource masked;
  const Grid& g = release.grid;
  for (int row = 0; row < g.n_rows; ++row)
    for (int col = 0; col < g.n_cols; ++col) {
      if (!(release.at(row, col) > 0)) continue;
      const double edge = 1e-6 * maps.cell_m, x = g.x_center(col), y = g.y_center(row);
      const double half = g.cell_m / 2 - edge;
      for (int r = maps.row_of(y + half); r <= maps.row_of(y - half); ++r)
        for (int c = maps.col_of(x - half); c <= maps.col_of(x + half); ++c) {
          if (!at.contains(r, c)) continue;
          double& v = value.at(r - at.row0, c - at.col0);
          if (std::isfinite(v)) ++masked.cells, masked.sum_m += v;
          v = nan_d;
        }
    }
  return masked;
}

/// Members would be praised for leaving nothing.
void require_deposit(const ObservedThickness& thickness, double threshold_m,
                     const std::string& label) {
  for (const double v : thickness.value.values)
    if (std::abs(v) > threshold_m) return;
  throw SetupError(fmt::format(
      "{}: no cell that is compared holds more than {:g} m (observation.threshold_m). Check "
      "observation.thickness_sign, or lower the threshold.",
      label, threshold_m));
}

void read_thickness(Reading& r, const Raster<double>* release) {
  const ObservationSpec& o = r.spec;
  if (o.deposit_thickness.empty()) return;
  RasterRequest request;
  request.path = o.deposit_thickness;
  request.key = "observation.deposit_thickness";
  request.directory = r.scenario.directory;
  request.crs = o.crs;
  request.crs_key = "observation.crs";
  stand_in_with_terrain(request, r.scenario.terrain);
  ThicknessValuesRead read = read_observed_thickness(request, o.thickness_sign, r.maps);
  ObservedThickness thickness{std::move(read.value), o.thickness_sign != ThicknessSign::thickness,
                              o.thickness_sd_m.value_or(0)};
  const std::string label = request.key + " = " + request.path;
  if (thickness.net_change && r.has_maps()) {
    const MaskedSource source =
        release ? mask_source(thickness.value, r.maps, *release) : MaskedSource{};
    if (source.sum_m > 0)
      read.warnings.push_back(
          fmt::format("{}: where mass was released the ground rises, by {:.2g} m on the mean. Is "
                      "observation.thickness_sign the other way round?",
                      label, source.sum_m / static_cast<double>(source.cells)));
    std::size_t fell = 0;
    for (double& v : thickness.value.values)
      if (o.mask_erosion && v < 0) v = nan_d, ++fell;
    read.notes.push_back(
        fmt::format("{}: net change, not compared in {} cells of the source{}", label, source.cells,
                    o.mask_erosion ? fmt::format(" and {} where the ground fell", fell) : ""));
  }
  if (r.has_maps()) require_deposit(thickness, r.read.event.threshold_m, label);
  r.take(read);
  r.read.event.thickness = std::move(thickness);
}

std::optional<Measured> measured(const std::optional<MeasuredSpec>& spec) {
  if (!spec) return std::nullopt;
  return Measured{spec->value.value_or(0), spec->sd.value_or(0)};
}

std::optional<double> number_in(const NumberRecord& record, const char* name) {
  const auto found = record.find(name);
  return found == record.end() ? std::nullopt : std::optional(found->second.front());
}

/// \pre the record has a point
Vec2 point_in(const NumberRecord& record) {
  const std::vector<double>& xy = record.at("point_m");
  return {xy.at(0), xy.at(1)};
}

void take_numbers(const Scenario& scenario, ObservedEvent& event) {
  const ObservationSpec& o = *scenario.observation;
  event.runout_m = measured(o.runout_m);
  event.h_over_l = measured(o.h_over_l);
  event.com_travel_m = measured(o.com_travel_m);
  event.volume_m3 = measured(o.volume_m3);
  event.area_m2 = measured(o.area_m2);
  for (const NumberRecord& record : o.fronts) {
    ObservedFront front;
    front.time_s = number_in(record, "time_s").value_or(0);
    front.distance_m = number_in(record, "distance_m");
    if (!front.distance_m) front.point = point_in(record);
    front.sd_m = number_in(record, "sd_m");
    front.sd_s = number_in(record, "sd_s");
    event.fronts.push_back(front);
  }
  for (const NumberRecord& record : o.speeds)
    event.speeds.push_back(
        {point_in(record),
         {number_in(record, "speed_m_s").value_or(0), number_in(record, "sd_m_s").value_or(0)}});
  if (o.farthest_point_m) event.farthest = Vec2((*o.farthest_point_m)[0], (*o.farthest_point_m)[1]);
  event.farthest_sd_m = o.farthest_point_sd_m.value_or(0);
  event.threshold_given = o.threshold_m.has_value();
  event.threshold_m = o.threshold_m.value_or(event.threshold_m);
  event.spacing_m = scenario.numerics.spacing_m;
}

void read_corners(Reading& r) {
  const ObservationSpec& o = r.spec;
  if (!o.thalweg.empty())
    r.attempt([&] {
      CornersRead read =
          read_observed_line(r.layer("observation.thalweg", o.thalweg, "", "", "thalweg"), r.maps);
      r.take(read);
      r.read.event.thalweg = std::move(read.corners);
    });
  if (!o.farthest_point.empty())
    r.attempt([&] {
      CornersRead read = read_observed_point(
          r.layer("observation.farthest_point", o.farthest_point, "", "", "farthest point"),
          r.maps);
      r.take(read);
      r.read.event.farthest = read.corners.front();
    });
}

/// Nothing where mass only enters later.
std::optional<Vec2> centre_of(const Raster<double>& release) {
  Vec2 sum = Vec2::Zero();
  double weight = 0;
  const Grid& g = release.grid;
  for (int row = 0; row < g.n_rows; ++row)
    for (int col = 0; col < g.n_cols; ++col) {
      const double v = std::max(0.0, release.at(row, col));
      sum += v * Vec2(g.x_center(col) - g.west_m, g.y_center(row) - g.north_m);
      weight += v;
    }
  if (!(weight > 0)) return std::nullopt;
  return Vec2(Vec2(g.west_m, g.north_m) + sum / weight);
}

/// Straight distances count from the source's centre. \return it is known
bool take_origin(Reading& r, const Raster<double>* release) {
  if (release == nullptr) return false;
  ObservedEvent& event = r.read.event;
  const std::optional<Vec2> centre = centre_of(*release);
  if (centre) event.origin = *centre;
  const bool distances = event.farthest || !event.fronts.empty();
  if (!centre && distances && event.thalweg.empty() && r.spec.thalweg.empty())
    r.problems.emplace_back(
        "observation: farthest_point and fronts are distances down the path, and the scene has no "
        "release that they could count from. Add observation.thalweg.");
  return centre.has_value();
}

/// A point of the scene that no member can reach was mostly written in another system.
void require_on_maps(Reading& r) {
  const auto check = [&r](const Vec2& p, const std::string& what) {
    const Grid& g = r.maps;
    if (g.contains(g.row_of(p.y()), g.col_of(p.x()))) return;
    r.problems.push_back(fmt::format(
        "{} = [{:.10g}, {:.10g}]: lies beyond the terrain (x {:.10g} to {:.10g}, y {:.10g} to "
        "{:.10g}). Give coordinates in the terrain's system.",
        what, p.x(), p.y(), g.west_m, g.east_m(), g.south_m(), g.north_m));
  };
  const ObservedEvent& event = r.read.event;
  if (event.farthest) check(*event.farthest, "observation.farthest_point");
  for (std::size_t i = 0; i < event.fronts.size(); ++i)
    if (!event.fronts[i].distance_m)
      check(event.fronts[i].point, fmt::format("observation.fronts[{}].point_m", i));
  for (std::size_t i = 0; i < event.speeds.size(); ++i)
    check(event.speeds[i].point, fmt::format("observation.speeds[{}].point_m", i));
}

/// No member can be longer or wider than its terrain: such a number was mostly written in another
/// unit, or the terrain is too small to show the event.
void require_within_terrain(Reading& r) {
  const Grid& g = r.maps;
  const double diagonal = std::hypot(g.n_cols, g.n_rows) * g.cell_m;
  const auto check = [&r](const std::string& key, double value, double most, const char* unit,
                          const char* than) {
    if (!(value > most)) return;
    r.problems.push_back(fmt::format(
        "{} = {:g} {}: {}, {:.4g} {} (no member could come that far). Check the unit, or use a "
        "larger terrain.",
        key, value, unit, than, most, unit));
  };
  const ObservedEvent& e = r.read.event;
  const char* longer = "is longer than the terrain is across";
  if (e.runout_m) check("observation.runout_m.value", e.runout_m->value, diagonal, "m", longer);
  if (e.com_travel_m)
    check("observation.com_travel_m.value", e.com_travel_m->value, diagonal, "m", longer);
  if (e.area_m2)
    check("observation.area_m2.value", e.area_m2->value,
          static_cast<double>(g.n_cols) * g.n_rows * g.cell_m * g.cell_m, "m2",
          "is more than the terrain's area");
  double along = 0;  // a thalweg may wind
  for (std::size_t i = 1; i < e.thalweg.size(); ++i)
    along += (e.thalweg[i] - e.thalweg[i - 1]).norm();
  for (std::size_t i = 0; i < e.fronts.size(); ++i)
    if (e.fronts[i].distance_m)
      check(fmt::format("observation.fronts[{}].distance_m", i), *e.fronts[i].distance_m,
            std::max(along, diagonal), "m",
            along > diagonal ? "is longer than the thalweg" : longer);
}

/// Possible, and of little use.
void doubt_deviations(EventRead& read) {
  const auto check = [&read](const char* key, const std::optional<Measured>& m) {
    if (m && m->sd > m->value)
      read.warnings.push_back(fmt::format(
          "observation.{}: its standard deviation of {:g} is larger than its value of {:g}, so it "
          "says next to nothing. Are both in the same unit?",
          key, m->sd, m->value));
  };
  const ObservedEvent& e = read.event;
  check("runout_m", e.runout_m), check("h_over_l", e.h_over_l);
  check("com_travel_m", e.com_travel_m), check("volume_m3", e.volume_m3);
  check("area_m2", e.area_m2);
}

/// A deposit lies where something passed: two layers that say otherwise are of different events,
/// or in different places.
void compare_areas(EventRead& read) {
  const auto& outline = read.event.outline;
  const auto& deposit = read.event.deposit;
  if (!outline || !deposit) return;
  const Grid& o = outline->cover.grid;
  const Grid& d = deposit->cover.grid;
  double all = 0, beyond = 0;
  for (int row = 0; row < d.n_rows; ++row)
    for (int col = 0; col < d.n_cols; ++col) {
      const int r = o.row_of(d.y_center(row)), c = o.col_of(d.x_center(col));
      const double passed = o.contains(r, c) ? outline->cover.at(r, c) : 0;
      all += deposit->cover.at(row, col);
      beyond += std::max(0.0, deposit->cover.at(row, col) - passed);
    }
  if (beyond > 0.05 * all)
    read.warnings.push_back(fmt::format(
        "observation.deposit: {:.0f} % of it lie outside observation.outline, which should hold "
        "all that was passed over; do both show the same event, in the right coordinate system?",
        100 * beyond / all));
}

/// What was passed over holds the source.
void doubt_place(EventRead& read, const Raster<double>& release) {
  if (!read.event.outline) return;
  const Raster<double>& cover = read.event.outline->cover;
  const Grid& g = release.grid;
  for (int row = 0; row < g.n_rows; ++row)
    for (int col = 0; col < g.n_cols; ++col) {
      if (!(release.at(row, col) > 0)) continue;
      const int r = cover.grid.row_of(g.y_center(row)), c = cover.grid.col_of(g.x_center(col));
      if (cover.grid.contains(r, c) && cover.at(r, c) > 0) return;
    }
  read.warnings.emplace_back(
      "observation.outline: does not touch the release, and should hold all that was passed over; "
      "does it show this event, in the right coordinate system?");
}

/// Distances count from the line's start.
void doubt_direction(EventRead& read) {
  const ObservedEvent& e = read.event;
  if (e.thalweg.empty()) return;
  if ((e.thalweg.front() - e.origin).norm() > (e.thalweg.back() - e.origin).norm())
    read.warnings.emplace_back(
        "observation.thalweg: its start lies farther from the source than its end (distances count "
        "from the start). Turn the line round if it was drawn upwards.");
}

void note_threshold(const ObservedEvent& event, EventRead& read) {
  const bool areas = event.outline || event.deposit || event.thickness || event.area_m2;
  if (!areas || event.threshold_given) return;
  read.notes.push_back(
      fmt::format("observation.threshold_m: {:g} m (not given), at least a tenth of the spacing in "
                  "full_stress: members count as covering cells that are thicker",
                  event.threshold_m));
}

}  // namespace

EventRead read_observed_event(const Scenario& scenario, const Grid& maps,
                              const Raster<double>* release) {
  const GdalScope scope;
  Reading r{scenario, *scenario.observation, maps, {}, {}};
  take_numbers(scenario, r.read.event);
  read_areas(r);
  r.attempt([&] { read_thickness(r, release); });
  read_corners(r);
  const bool has_source = take_origin(r, release);
  if (r.has_maps()) require_on_maps(r);
  if (r.has_maps()) require_within_terrain(r);
  require(r.problems.empty(), fmt::format("{}", fmt::join(r.problems, "\n")));
  if (r.has_maps()) compare_areas(r.read);
  if (r.has_maps() && has_source) doubt_place(r.read, *release);
  if (has_source) doubt_direction(r.read);
  doubt_deviations(r.read);
  note_threshold(r.read.event, r.read);
  return std::move(r.read);
}

}  // namespace sturz
