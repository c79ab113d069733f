// SPDX-License-Identifier: Apache-2.0
/// What a scenario file chooses by a word: each set of choices once, with the words of the file.
#pragma once

#include "engine/core/words.hpp"
#include "engine/laws/friction_cone.hpp"

namespace sturz {

/// How a member is computed; `automatic` decides between the first two that follow by the layers
/// that resolve its flow.
enum class Formulation { automatic, full_stress, depth_averaged, discrete };
constexpr auto words_of(Formulation) {
  using enum Formulation;
  return std::array{Word{automatic, "auto"}, Word{full_stress, "full_stress"},
                    Word{depth_averaged, "depth_averaged"}, Word{discrete, "discrete"}};
}

/// What the edge of the known ground does to the mass: lets it out or holds it.
enum class TerrainEdge { outflow, wall };
constexpr auto words_of(TerrainEdge) {
  using enum TerrainEdge;
  return std::array{Word{outflow, "outflow"}, Word{wall, "wall"}};
}

/// What an analytic wall does to the liquid beside it: nothing along it, or drag as glass does.
enum class WallLiquid { slips, sticks };
constexpr auto words_of(WallLiquid) {
  using enum WallLiquid;
  return std::array{Word{slips, "slips"}, Word{sticks, "sticks"}};
}

/// What the terrain shows where the mass lies: the bed under it, or the surface before failure.
enum class ReleaseSurface { bed, pre_failure };
constexpr auto words_of(ReleaseSurface) {
  using enum ReleaseSurface;
  return std::array{Word{bed, "bed"}, Word{pre_failure, "pre_failure"}};
}

/// How a thickness of the release was measured: straight down, or at right angles to the slope.
enum class ThicknessDirection { vertical, normal };
constexpr auto words_of(ThicknessDirection) {
  using enum ThicknessDirection;
  return std::array{Word{vertical, "vertical"}, Word{normal, "normal"}};
}

/// Floor of a release that is dug out of the terrain: at even depth, or rising to its lower edge.
enum class ReleaseFloor { uniform, tapered };
constexpr auto words_of(ReleaseFloor) {
  using enum ReleaseFloor;
  return std::array{Word{uniform, "uniform"}, Word{tapered, "tapered"}};
}

/// What a raster of an observed deposit holds: thicknesses, or differences of two elevation models.
enum class ThicknessSign { thickness, rise_positive, fall_positive };
constexpr auto words_of(ThicknessSign) {
  using enum ThicknessSign;
  return std::array{Word{thickness, "thickness"}, Word{rise_positive, "rise_positive"},
                    Word{fall_positive, "fall_positive"}};
}

/// Lateral earth pressure of columns; `automatic` is `active` for piles and isotropic for sheets.
enum class LateralPressure { automatic, isotropic, active, active_passive };
constexpr auto words_of(LateralPressure) {
  using enum LateralPressure;
  return std::array{Word{automatic, "auto"}, Word{isotropic, "isotropic"}, Word{active, "active"},
                    Word{active_passive, "active_passive"}};
}

constexpr bool asks_for_internal_friction(LateralPressure p) {
  return p == LateralPressure::active || p == LateralPressure::active_passive;
}

/// Where an internal friction angle holds: in shear along a plane, or in plane strain.
constexpr auto words_of(FrictionCone) {
  using enum FrictionCone;
  return std::array{Word{simple_shear, "simple_shear"}, Word{plane_strain, "plane_strain"}};
}

/// Pore pressure that a mixture starts with: that of still water, or all of the weight.
enum class InitialPressure { hydrostatic, liquefied };
constexpr auto words_of(InitialPressure) {
  using enum InitialPressure;
  return std::array{Word{hydrostatic, "hydrostatic"}, Word{liquefied, "liquefied"}};
}

/// Pore pressure inside a column: a parabola, or computed at nodes from the bed up.
enum class PressureProfile { parabola, resolved };
constexpr auto words_of(PressureProfile) {
  using enum PressureProfile;
  return std::array{Word{parabola, "parabola"}, Word{resolved, "resolved"}};
}

/// Where excess pore pressure drains to: the free surface, or the bed as well.
enum class Drainage { top, both };
constexpr auto words_of(Drainage) {
  using enum Drainage;
  return std::array{Word{top, "top"}, Word{both, "both"}};
}

/// Velocities of a mixture: grains and water together, or each its own.
enum class MixturePhases { one, two };
constexpr auto words_of(MixturePhases) {
  using enum MixturePhases;
  return std::array{Word{one, "one"}, Word{two, "two"}};
}

/// What drag between grains and liquid follows from.
enum class PhaseDragLaw { permeability, settling };
constexpr auto words_of(PhaseDragLaw) {
  using enum PhaseDragLaw;
  return std::array{Word{permeability, "permeability"}, Word{settling, "settling"}};
}

/// One continuous stress law from dense to dilute, or the paper's switch between laws.
enum class StressMode { unified, paper_switch };
constexpr auto words_of(StressMode) {
  using enum StressMode;
  return std::array{Word{unified, "unified"}, Word{paper_switch, "paper_switch"}};
}

/// What isolated particles do when they meet.
enum class IsolatedContactLaw { none, hertz_mindlin };
constexpr auto words_of(IsolatedContactLaw) {
  using enum IsolatedContactLaw;
  return std::array{Word{none, "none"}, Word{hertz_mindlin, "hertz_mindlin"}};
}

/// How fast the flow takes its bed along.
enum class ErosionLaw { exponential, shear_stress, momentum_jump };
constexpr auto words_of(ErosionLaw) {
  using enum ErosionLaw;
  return std::array{Word{exponential, "exponential"}, Word{shear_stress, "shear_stress"},
                    Word{momentum_jump, "momentum_jump"}};
}

/// How much bed there is to take: a depth, or as much as the flow can.
enum class ErosionSupply { limited, unlimited };
constexpr auto words_of(ErosionSupply) {
  using enum ErosionSupply;
  return std::array{Word{limited, "limited"}, Word{unlimited, "unlimited"}};
}

/// How the uncertain values of an ensemble are drawn; `table` brings its own.
enum class Design { monte_carlo, latin_hypercube, sobol, table, morris, saltelli };
constexpr auto words_of(Design) {
  using enum Design;
  return std::array{Word{monte_carlo, "monte_carlo"},
                    Word{latin_hypercube, "latin_hypercube"},
                    Word{sobol, "sobol"},
                    Word{table, "table"},
                    Word{morris, "morris"},
                    Word{saltelli, "saltelli"}};
}

}  // namespace sturz
