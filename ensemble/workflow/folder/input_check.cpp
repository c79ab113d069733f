// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/input_check.hpp"

#include "io/gdal/gdal_raster.hpp"
#include "io/site/terrain_request.hpp"

#include <utility>

namespace sturz::workflow {

std::vector<InputIdentity> of_members(std::vector<InputIdentity> inputs) {
  std::erase_if(inputs, [](const InputIdentity& i) {
    return i.role == "hazard.observed_polygon" || i.role.starts_with("observation.") ||
           i.role.starts_with("assets.");
  });
  return inputs;
}

std::vector<std::string> changed_inputs(const Scenario& scenario, std::vector<InputIdentity> now,
                                        const std::vector<InputIdentity>& before) {
  const RasterRequest terrain = terrain_request(scenario);
  for (InputIdentity& is : now) {
    if (is.role != terrain.key || terrain.path.empty()) continue;  // others are read whole
    const std::vector<std::string> unread = parts_to_read(is, before);
    if (!unread.empty()) is.parts.merge(ElevationRaster(terrain).hashes_of(unread));
  }
  return input_differences(of_members(before), of_members(std::move(now)));
}

std::string as_lines(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "\n  " + sentence;
  return text;
}

}  // namespace sturz::workflow
