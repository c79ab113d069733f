// SPDX-License-Identifier: Apache-2.0
/// Named scenes built in code: tested, timed and shown from one definition.
///
/// All of them stand on synthetic ground and hold fixed numbers; change what a test varies with
/// the arguments, or on the returned plain data.
#pragma once

#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz {

/// A loose block on an even 30 degree slope that it slides down with constant acceleration.
/// \param friction_coefficient of the bed; \param pore_pressure_ratio r_u of the bed
Scenario block_on_plane(double friction_coefficient = 0.46630765815499858,  // tan 25 deg
                        double pore_pressure_ratio = 0);

/// A granular column of length 1 m and height `aspect` behind a smooth wall at x = 0, one slice of
/// four particles thick with period in y, that collapses over level ground.
/// \param particles_along particles over the column's length
Scenario column_collapse(double aspect = 1, int particles_along = 16);

/// A round column of glass beads, radius 1 m and height `aspect`, that collapses over level ground
/// as rough as their avalanche angle, 27.4 degrees.
/// \param particles_along particles over the radius
Scenario cylinder_collapse(double aspect = 1, int particles_along = 10);

/// A cap-shaped pile on level ground, flatter than its friction angle: it must stay where it is.
Scenario pile(double spacing_m = 1);

/// A box of grains that slides over the edge of a 20 m high, 60 degree cliff.
Scenario cliff(double spacing_m = 1);

/// A sheet of `layers` particles on a 30 degree slope, periodic in x and y, bed tan 25 degrees.
Scenario thin_sheet(int layers = 1);

/// A round mass that falls 100 m on a 30 degree slope and runs out on level ground; bed tan 20
/// degrees. \param azimuth_deg downhill direction, to test that the grid's axes do not matter
Scenario ramp_slide(double azimuth_deg = 90, double spacing_m = 3);

/// The mixture of the debris-flow flume of the U.S. Geological Survey on the ground of ramp_slide:
/// looser than 0.64 it liquefies and runs out, denser it stays on the slope; depth_averaged.
Scenario wet_ramp(double solid_fraction = 0.62, double spacing_m = 3);

/// A smooth straight channel, 20 m wide and 200 m long on an even 20 degree slope, whose bed brakes
/// with Voellmy's mu 0.1 and xi 80 m/s2; without any mass, for an inflow; depth_averaged.
Scenario channel(double spacing_m = 2);

/// V7: a slab 0.1 m thick of glass beads, periodic in x and y, on an even slope with a bed that
/// holds its lowest layer: a tenth rougher than the slope is steep. Starts at rest.
/// \param layers  spacings over the thickness
Scenario bagnold_slab(double slope_deg = 24, int layers = 10);

/// V18: a parabolic cap, 160 m long and 4 m thick, that spreads down a 35 degree slope over a bed
/// of tan 25 degrees; depth_averaged.
Scenario similarity_slide(double spacing_m = 4);

/// The shipped Zhangjiawan case with its median numbers on a coarse ground, for quick runs.
Scenario zhangjiawan_small(double spacing_m = 12);

/// Names for catalogue_scene: the functions above with their default arguments.
std::vector<std::string> catalogue_names();
/// Throws SetupError on an unknown name.
Scenario catalogue_scene(const std::string& name);

}  // namespace sturz
