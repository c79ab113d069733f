// SPDX-License-Identifier: Apache-2.0
/// Dams and buildings on the ground that columns feel: averaged to their spacing and rounded over
/// two cells, which would take the crest off a dam and the walls off a house.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/ground_structures.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz {

struct SceneInputs;

/// Surface that columns feel of a raster at (x, y): the biquadratic spline over its nodes, which
/// Terrain::curved evaluates. NaN beside the raster's edge.
double rounded(const Raster<double>& nodes, double x, double y);

/// Raises the dams on averaged ground so that the rounded surface reaches their crest everywhere
/// along their lines, and cells that buildings cover for the greater part to their mean roof;
/// the others get the mean of what stands beside the buildings.
/// \param fine the held part of the working grid with all that stands on it
/// \param averaged means of factor x factor cells of it; factor 1: the same
void stand_on_columns_ground(const Scenario& numbers, const SceneInputs&, int factor,
                             const Raster<double>& fine, Raster<double>& averaged);

/// How much lower than its crest the ground that columns feel is somewhere along a dam, as a share
/// of its height there: the most of all dams, and which one it is.
struct CrestLack {
  double share = 0;
  std::string name;
};
CrestLack crest_lack(const Scenario& numbers, const SceneInputs&, int factor);

/// Buildings of the layer that keep no cell on averaged ground, of those on held cells.
int lost_buildings(const SceneInputs&, int factor);

}  // namespace sturz
