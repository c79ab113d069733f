// SPDX-License-Identifier: Apache-2.0
// What a posterior's files say where another ensemble uses them.
#include "engine/core/error.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/calibration/posterior_files.hpp"
#include "ensemble/workflow/calibration/shown_posterior.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/scenario_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

fs::path json_file(const fs::path& folder) { return folder / "posterior.json"; }
fs::path csv_file(const fs::path& folder) { return folder / "posterior.csv"; }

void warn_of_place(const Json& all, const FoundAt& now, std::vector<std::string>& warnings) {
  const std::string effective =
      ": values found by calibration belong to what they were found with, and may mean something "
      "else here.";
  const Json& then = all.at("found_at");
  const auto formulation = then.at("formulation").get<std::string>();
  const auto spacing = then.at("spacing_m").get<double>();
  double least_m3 = then.at("release_volume_m3").get<double>(), most_m3 = least_m3;
  for (const Json& event : all.value("events", Json::array())) {
    least_m3 = std::min(least_m3, event.at("release_volume_m3").get<double>());
    most_m3 = std::max(most_m3, event.at("release_volume_m3").get<double>());
  }
  if (formulation != now.formulation)
    warnings.push_back(fmt::format("the posterior was found in {}, this scene is computed in {}{}",
                                   formulation, now.formulation, effective));
  if (std::abs(spacing - now.spacing_m) > 1e-9 * spacing)
    warnings.push_back(
        fmt::format("the posterior was found at a spacing of {} m, this scene has {} "
                    "m{}",
                    spacing, now.spacing_m, effective));
  if (now.release_volume_m3 < 0.99 * least_m3 || now.release_volume_m3 > 1.01 * most_m3)
    warnings.push_back(fmt::format(
        "the posterior was found with {}, this scene has {:.4g} m3{}",
        most_m3 > least_m3 ? fmt::format("releases of {:.4g} .. {:.4g} m3", least_m3, most_m3)
                           : fmt::format("a release of {:.4g} m3", least_m3),
        now.release_volume_m3, effective));
}

/// Maps of many rows of a posterior that is worth few are bounded as if every row were one more
/// draw.
void warn_of_size(const fs::path& folder, const Json& sample, const FoundAt& now,
                  std::vector<std::string>& warnings) {
  const Json& size = sample.at("effective_size");
  const double worth = size.is_number() ? size.get<double>() : 0;
  if (static_cast<double>(now.members) > worth)
    warnings.push_back(fmt::format(
        "the posterior is worth {:.1f} independent members and {} are asked of it: the bounds of "
        "the maps are those of {} independent draws, and are too narrow. Ask for {} members at "
        "most, or calibrate with more.",
        worth, now.members, now.members, std::max(1.0, std::floor(worth))));
  if (sample.at("method").get<std::string>() != to_string(PosteriorMethod::weights)) return;
  std::vector<std::vector<double>> rows = from_csv(read_text(csv_file(folder))).values;
  if (now.members > 0) rows.resize(std::min(rows.size(), static_cast<std::size_t>(now.members)));
  const std::size_t all = rows.size();
  std::sort(rows.begin(), rows.end());
  const auto different =
      static_cast<std::size_t>(std::unique(rows.begin(), rows.end()) - rows.begin());
  if (different < all)
    warnings.push_back(fmt::format(
        "the posterior weighs members by --method weights: of the first {} of its rows {} are "
        "different, the others are copies and compute the same again.",
        all, different));
}

/// What is in the folder now may not be what was calibrated.
void warn_of_folder(const fs::path& folder, const Json& all, std::vector<std::string>& warnings) {
  const OutputFolder source{folder};
  if (!fs::exists(source.manifest())) return;
  const Manifest manifest = Manifest::read(source.manifest());
  if (manifest.maps_of != all.at("members_hash").get<std::string>())
    warnings.push_back(fmt::format(
        "the members in {} are not those that its posterior was found from. Calibrate again.",
        folder.string()));
  if (fs::exists(source.scenario()) &&
      observation_hash(read_scenario(source.scenario()), manifest.inputs) !=
          all.value("observation_hash", std::string()))
    warnings.push_back(fmt::format(
        "what was observed in {} is not what its posterior was found with. Calibrate again.",
        folder.string()));
}

}  // namespace

std::vector<std::string> posterior_warnings(const fs::path& folder, const FoundAt& now) {
  std::vector<std::string> warnings;
  try {
    const Json all = Json::parse(read_text(json_file(folder)));
    warn_of_place(all, now, warnings);
    warn_of_size(folder, all.at("sample"), now, warnings);
    warn_of_folder(folder, all, warnings);
  } catch (const Json::exception&) {
    throw SetupError(json_file(folder).string() +
                     " is damaged (it does not say where the posterior was found). Calibrate "
                     "again.");
  }
  return warnings;
}

}  // namespace sturz::workflow
