// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/event_scorer.hpp"

#include "ensemble/censoring/scalar_censoring.hpp"
#include "ensemble/scores/thickness_scores.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

using M = MemberScalars;

/// Bands across the path, in cells: one would show the grid's own steps on a path that runs askew.
constexpr double band_cells = 2;
/// Standard deviations that a member counts as late where its front never came.
constexpr double never_sd = 10;

double cell_area(const Grid& g) { return g.cell_m * g.cell_m; }

/// Calls call(row, col) for each covered cell, rows and columns of the maps.
template <class Call>
void for_each_cell(const Raster<std::uint8_t>& cells, const Grid& maps, Call call) {
  const Window at = window_of(cells.grid, maps);
  for (int r = 0; r < at.n_rows; ++r)
    for (int c = 0; c < at.n_cols; ++c)
      if (cells.at(r, c) != 0) call(at.row0 + r, at.col0 + c);
}

/// The error of a quantity, also in shares of it, and the quantity itself.
void compare(const std::string& name, const std::string& unit, const std::string& noun,
             const Measured& observed, double value, Known known, bool relative,
             ScoreSheet& sheet) {
  const double error = value - observed.value;
  const std::string bare = unit == "1" ? name : name.substr(0, name.rfind("_m"));
  sheet.add({unit == "1" ? bare + "_error" : bare + "_error" + name.substr(bare.size()), unit,
             noun + ", simulated less observed", Better::nearer_zero},
            error, known);
  if (relative)
    sheet.add(
        {bare + "_relative_error", "1", "the same over the observed one", Better::nearer_zero},
        error / observed.value, known);
  sheet.compare({name, observed.value, observed.sd, unit}, value, known);
}

/// What is made of a table. \param grows of hits, \param either of what may go up or down
void add_rates(const Contingency& t, const std::string& name, const std::string& noun, Known grows,
               Known either, ScoreSheet& sheet) {
  sheet.add(
      {name + "_iou", "1", "intersection over union of " + noun + ", the CSI: TP / (TP + FP + FN)",
       Better::larger},
      intersection_over_union(t), either);
  sheet.add({name + "_hit_rate", "1", "TP / (TP + FN)", Better::larger}, hit_rate(t), grows);
  sheet.add({name + "_false_alarm_ratio", "1", "FP / (TP + FP)", Better::smaller},
            false_alarm_ratio(t), either);
  sheet.add({name + "_hss", "1",
             "Heidke skill, 2 (TP TN - FP FN) / ((TP + FN)(FN + TN) + (TP + FP)(FP + TN))",
             Better::larger},
            heidke_skill(t), either);
}

}  // namespace

EventScorer::Area::Area(const ObservedArea& area, const Grid& maps, const CellDistances& distances)
    : cells(area.cover, maps),
      outline(sides_of(area.outer), 2 * maps.cell_m),
      sd_m(area.sd_m),
      profile(band_cells * maps.cell_m) {
  const Window at = window_of(area.cover.grid, maps);
  for (int r = 0; r < at.n_rows; ++r)
    for (int c = 0; c < at.n_cols; ++c) {
      const double share = area.cover.at(r, c);
      if (!(share > 0)) continue;
      const double distance = distances.at(at.row0 + r, at.col0 + c);
      profile.add(distance, share * cell_area(maps), 0);
      if (share >= 0.5) profile.reach(distance);
    }
}

EventScorer::EventScorer(std::shared_ptr<const ObservedEvent> event, Grid maps,
                         const Window& touched)
    : event_(std::move(event)),
      maps_(std::move(maps)),
      path_(event_->thalweg, event_->origin),
      distances_(path_, maps_, touched) {
  if (event_->outline) outline_.emplace(*event_->outline, maps_, distances_);
  if (event_->deposit) deposit_.emplace(*event_->deposit, maps_, distances_);
}

std::vector<PeakLayer> EventScorer::layers() const {
  std::vector<PeakLayer> all{PeakLayer::thickness, PeakLayer::arrival, PeakLayer::deposit};
  if (!event_->speeds.empty()) all.push_back(PeakLayer::speed);
  if (event_->thickness && event_->thickness->net_change) all.push_back(PeakLayer::eroded);
  return all;
}

double EventScorer::threshold_m(const MemberView& member) const {
  if (event_->threshold_given || member.columns) return event_->threshold_m;
  return std::max(event_->threshold_m, event_->spacing_m / 10);
}

Raster<std::uint8_t> EventScorer::covered(const MemberView& member, PeakLayer layer) const {
  const Window& w = member.window;
  Raster<std::uint8_t> cells(grid_of(w, maps_), 0);
  const auto limit = static_cast<float>(threshold_m(member));
  for (int r = 0; r < w.n_rows; ++r)
    for (int c = 0; c < w.n_cols; ++c)
      cells.at(r, c) = std::isfinite(member.at(PeakLayer::arrival, w.row0 + r, w.col0 + c)) &&
                       member.at(layer, w.row0 + r, w.col0 + c) > limit;
  return cells;
}

Raster<std::uint8_t> EventScorer::passed(const MemberView& member) const {
  return covered(member, PeakLayer::thickness);
}

Raster<std::uint8_t> EventScorer::at_rest(const MemberView& member) const {
  return covered(member, PeakLayer::deposit);
}

Raster<std::uint8_t> EventScorer::shown_cells(const MemberView& member) const {
  const bool rests = !outline_ && (deposit_ || event_->thickness);
  return rests ? at_rest(member) : passed(member);
}

// What was passed over can only grow, so hits are a lower bound; a share or a distance may go
// either way. What lies at rest may still move away while it moves.
void EventScorer::score_area(const Area& area, const std::string& name, const std::string& noun,
                             const Raster<std::uint8_t>& cells, bool rests,
                             const MemberView& member, ScoreSheet& sheet) const {
  const Contingency t = area.cells.against(cells);
  const Known grows =
      weaker(Known::at_least, rests ? Known::not_at_all : Known::at_least, member.censoring);
  const Known either = weaker(Known::not_at_all, Known::not_at_all, member.censoring);
  sheet.add(
      {name + "_hit_m2", "m2", "area of " + noun + ", simulated and observed (TP)", Better::larger},
      t.hit_m2, grows);
  sheet.add(
      {name + "_false_m2", "m2", "the same, simulated and not observed (FP)", Better::smaller},
      t.false_m2, grows);
  sheet.add(
      {name + "_missed_m2", "m2", "the same, observed and not simulated (FN)", Better::smaller},
      t.missed_m2, either);
  sheet.add({name + "_neither_m2", "m2",
             "neither (TN), of the rectangle around what was observed, widened by half its longer "
             "side",
             Better::larger},
            t.neither_m2, either);
  add_rates(t, name, noun, grows, either, sheet);
  const SegmentIndex own(outer_boundary(cells), 2 * maps_.cell_m);
  const BoundaryDistance d = boundary_distance(own, area.outline, maps_.cell_m / 2, 2 * area.sd_m);
  sheet.add({name + "_distance_m", "m", "mean distance of the two outer boundaries, both ways",
             Better::smaller},
            d.mean_m, either);
  sheet.add(
      {name + "_hausdorff_m", "m", "largest distance of the two outer boundaries", Better::smaller},
      d.hausdorff_m, either);
  sheet.add({name + "_within_2sd", "1",
             "share of both boundaries that lies within two standard deviations of the other",
             Better::larger},
            d.within, either);
  // A member that covers nothing has no boundary: it is farther off than any that has one.
  const bool nothing = t.hit_m2 + t.false_m2 == 0;
  const Window& domain = area.cells.domain();
  sheet.compare({name + "_distance_m", 0, area.sd_m, "m"},
                nothing ? std::hypot(domain.n_rows, domain.n_cols) * maps_.cell_m : d.mean_m,
                nothing && member.censoring == Censoring::none ? Known::at_least : either);
  score_profile(area, name, cells, either, sheet);
}

void EventScorer::score_profile(const Area& area, const std::string& name,
                                const Raster<std::uint8_t>& cells, Known known,
                                ScoreSheet& sheet) const {
  if (!path_.along_thalweg()) return;
  PathProfile own(area.profile.step_m());
  for_each_cell(cells, maps_, [&](int row, int col) {
    const double distance = distances_.at(row, col);
    own.add(distance, cell_area(maps_), 0);
    own.reach(distance);
  });
  sheet.add(
      {name + "_thalweg_runout_error_m", "m",
       "farthest covered cell along the thalweg, simulated less observed", Better::nearer_zero},
      own.runout_m() - area.profile.runout_m(), known);
  sheet.add({name + "_thalweg_width_rmse_m", "m",
             "covered width across the thalweg, root mean square of the differences over bands of "
             "two cells",
             Better::smaller},
            width_rmse_m(own, area.profile), known);
}

void EventScorer::score_thickness(const MemberView& member, ScoreSheet& sheet) const {
  if (!event_->thickness) return;
  const ObservedThickness& observed = *event_->thickness;
  const Window at = window_of(observed.value.grid, maps_);
  std::vector<ThicknessPair> pairs;
  PathProfile mapped(band_cells * maps_.cell_m), own(band_cells * maps_.cell_m);
  Contingency table;
  const double limit = threshold_m(member);
  for (int r = 0; r < at.n_rows; ++r)
    for (int c = 0; c < at.n_cols; ++c) {
      const double value = observed.value.at(r, c);
      if (!std::isfinite(value)) continue;
      const int row = at.row0 + r, col = at.col0 + c;
      double lies = member.at(PeakLayer::deposit, row, col);
      if (observed.net_change) lies -= member.at(PeakLayer::eroded, row, col);
      const double distance = distances_.at(row, col);
      pairs.push_back({value, lies, distance});
      double& area = value > limit ? (lies > limit ? table.hit_m2 : table.missed_m2)
                                   : (lies > limit ? table.false_m2 : table.neither_m2);
      area += cell_area(maps_);
      if (value > limit) mapped.add(distance, cell_area(maps_), value);
      if (lies > limit) own.add(distance, cell_area(maps_), lies);
    }
  const ThicknessScores s = thickness_scores(pairs, limit, 2 * observed.sd_m);
  // What left lies elsewhere, if it lies on measured ground at all.
  const Known known = weaker(Known::not_at_all, Known::not_at_all, member.censoring);
  add_rates(table, "thickness", "what is thicker than the threshold, of the measured cells",
            weaker(Known::at_least, Known::not_at_all, member.censoring), known, sheet);
  const char* what = observed.net_change ? "net change of the ground" : "deposit's thickness";
  sheet.add({"thickness_rmse_m", "m",
             std::string(what) + ", root mean square of the differences where either is above the "
                                 "threshold",
             Better::smaller},
            s.rmse_m, known);
  sheet.add({"thickness_bias_m", "m", "mean of the same differences, simulated less observed",
             Better::nearer_zero},
            s.bias_m, known);
  sheet.add({"thickness_within_2sd", "1", "share of the same cells within two standard deviations",
             Better::larger},
            s.within, known);
  sheet.add({"thickness_volume_ratio", "1", "simulated over observed volume, all measured cells",
             Better::nearer_one},
            s.volume_ratio, known);
  sheet.add({"thickness_band_overlap", "1",
             "volume that lies in the same of ten bands of distance, over the larger volume",
             Better::larger},
            s.band_overlap, known);
  if (path_.along_thalweg())
    sheet.add({"thickness_thalweg_rmse_m", "m",
               "largest thickness across the thalweg, root mean square of the differences over "
               "bands of two cells",
               Better::smaller},
              largest_rmse(own, mapped), known);
  sheet.compare({"thickness_rmse_m", 0, observed.sd_m, "m"}, s.rmse_m, known);
}

void EventScorer::score_lengths(const MemberView& member, const Raster<std::uint8_t>& passed,
                                ScoreSheet& sheet) const {
  const ObservedEvent& e = *event_;
  const auto scalar = [&](const char* name, const char* unit, const char* noun,
                          const std::optional<Measured>& observed, double M::*field,
                          bool relative) {
    if (observed)
      compare(name, unit, noun, *observed, member.scalars.*field,
              known(field, member.scalars, member.censoring), relative, sheet);
  };
  scalar("runout_m", "m", "length from crown to toe", e.runout_m, &M::crown_to_toe_length_m, true);
  scalar("h_over_l", "1", "H/L from crown to toe", e.h_over_l, &M::crown_to_toe_ratio, false);
  scalar("com_travel_m", "m", "travel of the centre of mass", e.com_travel_m, &M::com_travel_m,
         true);
  double area = 0, farthest = nan_d, volume = 0;
  for_each_cell(passed, maps_, [&](int row, int col) {
    area += cell_area(maps_);
    if (e.farthest) farthest = std::fmax(farthest, distances_.at(row, col));
  });
  for (const float v : member.layers[static_cast<std::size_t>(PeakLayer::deposit)])
    volume += v * cell_area(maps_);
  if (e.volume_m3)
    compare("volume_m3", "m3", "volume on the known ground at the end", *e.volume_m3, volume,
            weaker(Known::exactly, Known::not_at_all, member.censoring), true, sheet);
  if (e.area_m2)
    compare("area_m2", "m2", "area passed over", *e.area_m2, area,
            known(&M::reached_area_m2, member.censoring), true, sheet);
  if (e.farthest)
    compare(path_.along_thalweg() ? "farthest_along_m" : "farthest_m", "m",
            path_.along_thalweg() ? "farthest cell passed over, along the thalweg"
                                  : "farthest cell passed over, straight from the source's centre",
            {path_.at(*e.farthest), e.farthest_sd_m}, farthest,
            known(&M::runout_m, member.censoring), false, sheet);
}

double EventScorer::distance_of(const ObservedFront& front) const {
  return front.distance_m ? *front.distance_m : path_.at(front.point);
}

void EventScorer::score_front(const ObservedFront& front, const std::string& name,
                              const MemberView& member, ScoreSheet& sheet) const {
  const Window& w = member.window;
  const double place = distance_of(front);
  double reached = 0, arrival = nan_d;
  for (int row = w.row0; row < w.end_row(); ++row)
    for (int col = w.col0; col < w.end_col(); ++col) {
      const double time = member.at(PeakLayer::arrival, row, col);
      if (!std::isfinite(time)) continue;
      const double distance = distances_.at(row, col);
      if (time <= front.time_s) reached = std::max(reached, distance);
      if (distance >= place) arrival = std::fmin(arrival, time);
    }
  const bool seen_so_far =
      !is_moving(member.censoring) || member.scalars.end_time_s >= front.time_s;
  if (front.sd_m) {
    const Known moving = seen_so_far ? Known::exactly : Known::at_least;
    compare(name + "_m", "m", "place of the front at that time", {place, *front.sd_m}, reached,
            weaker(Known::at_least, moving, member.censoring), false, sheet);
    return;
  }
  // Who never came there would have come after its end at the earliest. Who lies at rest will never
  // come: held against the observation it is as good as excluded, whenever it stopped.
  Known known = Known::exactly;
  double compared = arrival;
  if (std::isnan(arrival)) {
    compared = arrival = member.scalars.end_time_s;
    known = has_left(member.censoring) ? Known::not_at_all : Known::at_least;
    if (member.censoring == Censoring::none)
      compared = std::max(arrival, front.time_s + never_sd * *front.sd_s);
  }
  const std::string seconds = name + "_s";
  sheet.add({name + "_error_s", "s", "time of the front at that place, simulated less observed",
             Better::nearer_zero},
            arrival - front.time_s, known);
  sheet.compare({seconds, front.time_s, *front.sd_s, "s"}, compared, known);
}

void EventScorer::score_fronts(const MemberView& member, ScoreSheet& sheet) const {
  for (std::size_t i = 0; i < event_->fronts.size(); ++i)
    score_front(event_->fronts[i], "front_" + std::to_string(i + 1), member, sheet);
}

void EventScorer::score_speeds(const MemberView& member, ScoreSheet& sheet) const {
  for (std::size_t i = 0; i < event_->speeds.size(); ++i) {
    const ObservedSpeed& speed = event_->speeds[i];
    const double value =
        member.at(PeakLayer::speed, maps_.row_of(speed.point.y()), maps_.col_of(speed.point.x()));
    compare("speed_" + std::to_string(i + 1) + "_m_s", "m s-1", "largest speed at that point",
            speed.speed_m_s, value, known(&M::max_speed_m_s, member.censoring), false, sheet);
  }
}

ScoreSheet EventScorer::score(const MemberView& member) const {
  ScoreSheet own;
  const Raster<std::uint8_t> passed_cells = passed(member);
  if (outline_)
    score_area(*outline_, "outline", "what was passed over", passed_cells, false, member, own);
  if (deposit_) score_area(*deposit_, "deposit", "the deposit", at_rest(member), true, member, own);
  score_thickness(member, own);
  score_lengths(member, passed_cells, own);
  score_fronts(member, own);
  score_speeds(member, own);
  ScoreSheet sheet;  // what sums all up comes first
  const Observation all = misfit(own.observed, own.simulated);
  sheet.add({"misfit", "1",
             "root mean square over the observed quantities of (simulated - observed) / sd",
             Better::smaller},
            all.value, all.known);
  for (std::size_t i = 0; i < own.columns.size(); ++i)
    sheet.add(std::move(own.columns[i]), own.scores[i].value, own.scores[i].known);
  sheet.observed = std::move(own.observed);
  sheet.simulated = std::move(own.simulated);
  return sheet;
}

}  // namespace sturz
