// SPDX-License-Identifier: Apache-2.0
/// What the steps of reading a scene's files fill in. Included by .cpp files only.
#pragma once

#include "engine/core/error.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "io/site/bed/bed_layers.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// What the steps below fill in.
struct Loading {
  const Scenario& scenario;
  SceneInputs inputs;
  std::string release_label;  ///< for messages about the release
  std::optional<Raster<double>> synthetic_source;
  std::unique_ptr<ElevationRaster> raster;  ///< of terrain.raster
  OpenBedLayers bed_layers;                 ///< of basal.rasters
  std::vector<std::string> problems;        ///< of files that cannot be used

  template <class Read>
  void take_words(Read& read) {
    std::move(read.notes.begin(), read.notes.end(), std::back_inserter(inputs.notes));
    std::move(read.warnings.begin(), read.warnings.end(), std::back_inserter(inputs.warnings));
  }
  void take_identity(InputIdentity& identity) {
    std::error_code error;
    const auto name = std::filesystem::proximate(identity.file, scenario.directory, error);
    const bool inside_file = identity.file.starts_with("/vsi");
    if (!scenario.directory.empty() && !error && !inside_file) identity.file = name.string();
    inputs.identities.push_back(std::move(identity));
  }
  /// Notes, warnings and identity of a file that was read.
  template <class Read>
  void take(Read& read) {
    take_words(read);
    take_identity(read.identity);
  }
  /// Goes on after a problem, so that all files are looked at in one round.
  template <class Call>
  void attempt(Call call) {
    try {
      call();
    } catch (const SetupError& problem) {
      problems.emplace_back(problem.what());
    }
  }
  void refuse_problems() const {
    require(problems.empty(), fmt::format("{}", fmt::join(problems, "\n")));
  }
  void set_release(Raster<double> pattern, ReleasePattern kind) {
    inputs.release = std::make_shared<const Raster<double>>(std::move(pattern));
    inputs.pattern = kind;
    if (kind == ReleasePattern::cover) inputs.release_cover = inputs.release;
  }
  const Grid& grid() const { return inputs.whole; }
};

/// Only checks their files, while no terrain is known.
void load_assets(Loading&, const ReadGround& read);
void load_overlays(Loading&);

// Standing water: its outline; and whether the ground that was read holds it.
void load_pool(Loading&);   ///< checks its file only, while no terrain is known
void check_pool(Loading&);  ///< where its outline was read

// Dams and buildings, on ground that was just read or is not known at all.
void load_structures(Loading&, const ReadGround& read);  ///< their files, and what they do
void stand_structures(Loading&);                         ///< those of all members
void check_structures(Loading&);

// The bed: each attempts what it does, and says what was read.
void load_zones(Loading&);
void check_zones(Loading&);      ///< what can be said of zones when no ground is known
void open_bed_layers(Loading&);  ///< checks them only, while no terrain is known
void load_bed_layers(Loading&);
void load_bed_supply(Loading&);  ///< checks it only, while no ground is known

}  // namespace sturz
