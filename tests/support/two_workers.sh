#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A small ensemble of both formulations on two workers. Usage: two_workers.sh PROGRAM
# Under the thread sanitizer a data race makes the program end with an error.
set -euo pipefail
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for formulation in full_stress depth_averaged; do
  cat >"$folder/$formulation.yaml" <<YAML
title: two at once
terrain:
  synthetic: {plane: {cell_size_m: 4, slope_deg: 30, length_m: 80, width_m: 40}}
release:
  box: {x_m: [-30, -22], y_m: [-4, 4]}
  thickness_m: 6
grains: {density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}
basal:
  friction_coefficient: {uniform: [0.3, 0.7]}
numerics: {spacing_m: 1.5, end_time_s: 1}
ensemble: {design: sobol, members: 4, seed: 1}
hazard: {cell_size_m: 4, thickness_m: [0.5], speed_m_s: [1]}
formulation: $formulation
YAML
  "$program" ensemble "$folder/$formulation.yaml" -o "$folder/$formulation" --workers 2
  [ -s "$folder/$formulation/hazard.nc" ]
done
