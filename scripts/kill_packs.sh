#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# kill_packs.sh PROGRAM [INSTANTS] [SEED]: kills an ensemble in packs with SIGKILL at random instants of its
# life (members, appending, maps), then its merge, resumes it each time, and compares the hash and the
# bytes of the maps with those of an ensemble that was left alone. The last line says how many of the
# resumed folders had the same bits; the exit code is zero when all had.
set -uo pipefail
program=$(realpath "$1")
instants=${2:-40}
RANDOM=${3:-1}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 2
export XDG_CACHE_HOME=$folder/cache OMP_WAIT_POLICY=passive
cat >scene.yaml <<'YAML'
title: packs under fire
terrain:
  synthetic: {plane: {cell_size_m: 2, slope_deg: 30, length_m: 120, width_m: 50}}
release:
  box: {x_m: [-50, -40], y_m: [-5, 5]}
  thickness_m: 3
grains: {density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}
basal:
  friction_coefficient: {uniform: [0.3, 0.7]}
  pore_pressure_ratio: {uniform: [0.0, 0.3]}
numerics: {spacing_m: 1, end_time_s: 1.5}
ensemble: {design: sobol, members: 32, seed: 1}
hazard: {cell_size_m: 2, thickness_m: [0.5, 1], speed_m_s: [1]}
formulation: depth_averaged
YAML
run() { "$program" ensemble scene.yaml -o "$1" --packs --workers 2 >/dev/null 2>"$1.err"; }
hash_of() { sed -n 's/.*"hazard_hash": *"\([0-9a-f]*\)".*/\1/p' "$1/manifest.json"; }
# What the netCDF file holds without what names the moment: all variables.
values_of() { ncdump -p 9,17 "$1/hazard.nc" | sed '1,/^data:/d' | sha256sum; }

begin=$(date +%s%N)
run whole || { cat whole.err; exit 2; }
life_ms=$((($(date +%s%N) - begin) / 1000000))
begin=$(date +%s%N)
"$program" merge whole >/dev/null 2>&1 || exit 2
merge_ms=$((($(date +%s%N) - begin) / 1000000))
expected=$(hash_of whole)
expected_values=$(values_of whole)
echo "left alone: $expected, $life_ms ms; its merge: $merge_ms ms"

same=0 killed=0 recomputed=0
for ((i = 1; i <= instants; ++i)); do
  ((i % 4 == 1)) && rm -rf out  # from the start, and thrice where the last one had come to
  if ((i % 4 == 0)); then
    run out  # whole again: its merge is killed
    "$program" merge out >/dev/null 2>&1 &
    ms=$((RANDOM * merge_ms / 32768))
  else
    "$program" ensemble scene.yaml -o out --packs --workers 2 >/dev/null 2>&1 &
    ms=$((RANDOM * life_ms / 32768))
  fi
  sleep "$(printf '%d.%03d' $((ms / 1000)) $((ms % 1000)))"
  kill -9 $! 2>/dev/null && killed=$((killed + 1))
  wait $! 2>/dev/null
  before=$("$program" members out --json 2>/dev/null | sed -n 's/.*"members": *\([0-9]*\).*/\1/p')
  cp -r out resumed 2>/dev/null  # it may have been killed before it made a folder
  run resumed || { echo "instant $i: resume failed"; cat resumed.err; }
  recomputed=$((recomputed + 32 - ${before:-0}))
  if [ "$(hash_of resumed)" = "$expected" ] && [ "$(values_of resumed)" = "$expected_values" ]; then
    same=$((same + 1))
  else
    echo "instant $i ($ms ms): other maps"
  fi
  rm -rf resumed
done
echo "$same of $instants instants gave the same bits; $killed processes were killed, $recomputed members computed after them"
[ "$same" -eq "$instants" ]
