#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a bare Debian 12 to a hazard map: packages, release build, the shipped Zhangjiawan ensemble.
# Safe to run again: finished work is skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. scripts/packages.sh
. scripts/build_quietly.sh

stage="start"
trap 'code=$?; [ $code -eq 0 ] || echo "quickstart.sh stopped while: $stage (exit code $code)." >&2' EXIT

seconds_since() { echo "$(( SECONDS - $1 )) s"; }

stage="installing packages"
begin=$SECONDS
install_packages "${build_packages[@]}"
install_node
install_time=$(seconds_since "$begin")

stage="building the release preset"
begin=$SECONDS
mkdir -p build
cmake --preset release -DSTURZ_TESTS=OFF >build/configure.log 2>&1 ||
  { tail -n 20 build/configure.log >&2
    echo "cmake could not configure; the whole text is in build/configure.log." >&2; exit 1; }
echo "Building for about $(build_forecast) on $(nproc) cores, less if it was built before."
targets=(sturz)
# Members in Python's process, where its headers are installed.
grep -q '^build sturz_interpreter:' build/release/build.ninja && targets+=(sturz_interpreter)
build_quietly build/build.log cmake --build build/release --target "${targets[@]}"
build_time=$(seconds_since "$begin")

stage="running the shipped ensemble"
begin=$SECONDS
out=out/zhangjiawan
program=build/release/ensemble/app/sturz
"$program" ensemble scenarios/cases/zhangjiawan/scenario.yaml -o "$out"
run_time=$(seconds_since "$begin")

stage="looking for the results"
for file in hazard.nc report.html members.csv; do
  [ -s "$out/$file" ] || { echo "The run ended without $out/$file." >&2; exit 1; }
done
cat <<TEXT

Done. Packages $install_time, build $build_time, ensemble $run_time.

Results are in $PWD/$out
  report.html   look here first: maps over hillshade, members, where the time went (any browser)
  hazard.nc     every map with its CRS (QGIS, xarray, ncview)
  hazard.qgz    the same maps in QGIS, styled; hazard/*.tif for other GIS
  members.csv   one row per member: what was drawn, how it ended, how far it went

Next: a slope of your own. This writes a commented scenario around your elevation raster and the outline
of the mass; then ask what will be computed:
  $program init dtm.tif source.gpkg --thickness 6 -o my_slope
  $program describe my_slope/scenario.yaml
Ten minutes with real ground that is shipped, and how to come by an outline: docs/tutorial.md

To have the command \`sturz\` with manual page and completion (another --prefix needs no sudo):
  sudo cmake --install build/release
TEXT
