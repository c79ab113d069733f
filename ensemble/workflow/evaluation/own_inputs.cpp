// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/evaluation/own_inputs.hpp"

#include "scenarios/assembly/reach.hpp"

#include <algorithm>
#include <exception>

namespace sturz::workflow {
namespace {

/// The way out of the search for a reach.
struct NotHeld : std::exception {};

Raster<double> cut_out(const SceneInputs& in, const Window& w) {
  const Window held = in.held();
  if (!held.contains(w)) throw NotHeld();
  Raster<double> part(grid_of(w, in.terrain_grid()));
  for (int r = 0; r < w.n_rows; ++r)
    std::copy_n(&in.elevation->at(w.row0 - held.row0 + r, w.col0 - held.col0), w.n_cols,
                &part.at(r, 0));
  return part;
}

}  // namespace

std::optional<FirstGround> ground_of_member(const Scenario& numbers, const SceneInputs& of_all) {
  if (!of_all.bed_layers.empty() || of_all.structures.any()) return std::nullopt;
  const ReadGround read = [&of_all](const Window& w) { return cut_out(of_all, w); };
  try {
    return first_ground(numbers, of_all, read, "release");
  } catch (const NotHeld&) {
    return std::nullopt;
  }
}

}  // namespace sturz::workflow
