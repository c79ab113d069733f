// SPDX-License-Identifier: Apache-2.0
/// Terrains written as formulas, some with a source of their own.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/scenario.hpp"

#include <optional>
#include <vector>

namespace sturz {

/// Limits of cell_size_m, the number that every shape needs.
inline constexpr double min_synthetic_cell_m = 1e-3, max_synthetic_cell_m = 1e4;

/// The ground before a slide starts to move, and the mass that lies on it.
struct SyntheticScene {
  Raster<double> bed;                       ///< elevation of the surface that carries the mass [m]
  std::optional<Raster<double>> thickness;  ///< vertical release thickness [m], own source only
};

/// One number that a shape understands.
struct ShapeParameter {
  const char* name;  ///< e.g. "slope_deg"
  double default_value;
  double min, max;
  const char* help;
};
/// Names of all shapes.
std::vector<std::string> synthetic_shapes();
/// True for a shape whose scene has a release thickness of its own; false for an unknown shape.
bool brings_source(const std::string& shape);
/// Parameters of one shape; throws SetupError on an unknown shape.
std::vector<ShapeParameter> shape_parameters(const std::string& shape);

/// Builds the terrain. Throws SetupError on an unknown shape or parameter.
SyntheticScene make_synthetic(const SyntheticTerrain&);

}  // namespace sturz
