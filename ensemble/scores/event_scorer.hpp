// SPDX-License-Identifier: Apache-2.0
/// Scores members against one observed event. A score is a function of event, grid and member
/// alone, so order, shards and the rest of the ensemble leave no trace.
///
/// Like is compared with like: outline, area, farthest point and fronts with the cells that a
/// member passed over (its arrival map: thicker than the runout limit, and covered by half), those
/// among them thicker than the threshold at their peak; deposit and its thickness with what lies
/// there at the end.
#pragma once

#include "ensemble/scores/boundary_distance.hpp"
#include "ensemble/scores/contingency.hpp"
#include "ensemble/scores/member_view.hpp"
#include "ensemble/scores/path_distance.hpp"
#include "ensemble/scores/path_profile.hpp"
#include "ensemble/scores/score_sheet.hpp"
#include "scenarios/observation/observed_event.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sturz {

class EventScorer {
 public:
  /// \param maps the whole grid of the members' maps
  /// \param touched where members were, say: a place to remember distances for; any will do
  EventScorer(std::shared_ptr<const ObservedEvent> event, Grid maps, const Window& touched);

  /// The layers of a member that are looked at.
  std::vector<PeakLayer> layers() const;
  /// Columns and quantities are the same for every member, whatever it did.
  ScoreSheet score(const MemberView&) const;
  /// What a member is compared with the outline by; with the deposit where no outline was mapped.
  /// On the cells of its window: 1 covered.
  Raster<std::uint8_t> shown_cells(const MemberView&) const;

  const ObservedEvent& event() const { return *event_; }

 private:
  struct Area {  // an observed one
    Area(const ObservedArea& area, const Grid& maps, const CellDistances& distances);
    ObservedCells cells;
    SegmentIndex outline;
    double sd_m = 0;
    PathProfile profile;
  };
  double threshold_m(const MemberView&) const;
  /// Reached cells that are thicker than the threshold in a layer of thicknesses.
  Raster<std::uint8_t> covered(const MemberView&, PeakLayer) const;
  Raster<std::uint8_t> passed(const MemberView&) const;
  Raster<std::uint8_t> at_rest(const MemberView&) const;
  void score_area(const Area&, const std::string& name, const std::string& noun,
                  const Raster<std::uint8_t>& cells, bool rests, const MemberView&,
                  ScoreSheet&) const;
  void score_profile(const Area&, const std::string& name, const Raster<std::uint8_t>& cells, Known,
                     ScoreSheet&) const;
  void score_thickness(const MemberView&, ScoreSheet&) const;
  void score_lengths(const MemberView&, const Raster<std::uint8_t>& passed, ScoreSheet&) const;
  void score_fronts(const MemberView&, ScoreSheet&) const;
  void score_front(const ObservedFront&, const std::string& name, const MemberView&,
                   ScoreSheet&) const;
  void score_speeds(const MemberView&, ScoreSheet&) const;
  double distance_of(const ObservedFront&) const;

  std::shared_ptr<const ObservedEvent> event_;
  Grid maps_;
  PathDistance path_;
  CellDistances distances_;
  std::optional<Area> outline_, deposit_;
};

}  // namespace sturz
