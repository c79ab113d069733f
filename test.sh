#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what the tests need, builds everything, runs all tests labelled unit, physics, style or hard.
# The last line is always "N passed, N failed"; the exit code is zero only when nothing failed.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. scripts/packages.sh

give_up() { echo "$1" >&2; echo "0 passed, 1 failed"; exit 1; }

install_packages "${build_packages[@]}" "${test_packages[@]}" || give_up "Packages are missing."
install_node

cmake --preset release -DSTURZ_TESTS=ON >/dev/null || give_up "cmake could not configure."
cmake --build build/release || give_up "The build failed."

export OMP_WAIT_POLICY=passive OPENBLAS_NUM_THREADS=1
results=build/release/test-results
rm -rf "$results" && mkdir -p "$results"
jobs=$(nproc)
# Tests that time something carry RUN_SERIAL, so ctest gives them the machine.
for label in style unit physics hard; do
  echo "--- $label"
  ctest --test-dir build/release -L "^${label}\$" -j "$jobs" --no-tests=error \
        --output-on-failure --output-junit "test-results/$label.xml" |
    grep -vE '^ *Start |\.\.\. +Passed |^Test project|^Internal ctest'
done

python3 scripts/count_tests.py "$results"/style.xml "$results"/unit.xml "$results"/physics.xml "$results"/hard.xml
