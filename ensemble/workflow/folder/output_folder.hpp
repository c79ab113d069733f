// SPDX-License-Identifier: Apache-2.0
/// Where the files of one ensemble or run lie, and whether a folder is free for them.
#pragma once

#include <filesystem>
#include <string>

namespace sturz::workflow {

/// Names of everything in a results folder.
struct OutputFolder {
  std::filesystem::path root;

  std::filesystem::path scenario() const { return root / "scenario.yaml"; }
  std::filesystem::path design() const { return root / "design.csv"; }
  std::filesystem::path manifest() const { return root / "manifest.json"; }
  std::filesystem::path lock() const { return root / "lock.json"; }
  std::filesystem::path log() const { return root / "log.txt"; }
  std::filesystem::path members() const { return root / "members"; }
  std::filesystem::path members_csv() const { return root / "members.csv"; }
  std::filesystem::path assets_csv() const { return root / "assets.csv"; }
  std::filesystem::path assets_gpkg() const { return root / "assets.gpkg"; }
  std::filesystem::path gauges_csv() const { return root / "gauges.csv"; }
  std::filesystem::path gauge_series_csv() const { return root / "gauge_series.csv"; }
  std::filesystem::path hazard_nc() const { return root / "hazard.nc"; }
  std::filesystem::path peaks_nc() const { return root / "peaks.nc"; }
  std::filesystem::path frames_nc() const { return root / "frames.nc"; }
  std::filesystem::path tif_folder() const { return root / "hazard"; }
  std::filesystem::path hazard_gpkg() const { return root / "hazard.gpkg"; }
  std::filesystem::path project() const { return root / "hazard.qgz"; }
  /// What a GIS opens of a single run, named after peaks.nc.
  std::filesystem::path peaks_folder() const { return root / "peaks"; }
  std::filesystem::path peaks_gpkg() const { return root / "peaks.gpkg"; }
  std::filesystem::path peaks_project() const { return root / "peaks.qgz"; }
  std::filesystem::path ground_tif() const { return root / "ground.tif"; }
  std::filesystem::path stac_item() const { return root / "stac_item.json"; }
  std::filesystem::path particles() const { return root / "particles"; }
  std::filesystem::path report() const { return root / "report.html"; }
};

/// True when the folder already holds results of that kind; false when it is free to be used.
/// \throws SetupError when it holds something else
bool holds_results(const OutputFolder&, const std::string& kind);

/// Results folder for a scenario file that was given none: out/<its name or its folder's name>.
std::string default_folder(const std::string& scenario_file);

}  // namespace sturz::workflow
