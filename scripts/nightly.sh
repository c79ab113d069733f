#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What is too slow for every change: each fuzz target for ten minutes or a million runs, whichever
# ends first, on what earlier nights learned. Usage: scripts/nightly.sh [SECONDS_PER_TARGET]
# A finding lies in build/asan/tests/fuzz/TARGET-*; the exit code is the number of targets that
# found something.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/packages.sh
seconds=${1:-600}

install_packages "${build_packages[@]}" "${test_packages[@]}" || exit 1
cmake --preset asan >/dev/null && cmake --build build/asan --target fuzz || exit 1

broken=0
for target in $(tests/fuzz/run.sh --list); do
  log=build/asan/tests/fuzz/$target.log
  if tests/fuzz/run.sh "$target" -runs=1000000 -max_total_time="$seconds" >"$log" 2>&1; then
    echo "$target: $(grep -E '^Done ' "$log")"
  else
    broken=$((broken + 1))
    echo "$target: FINDING, see $log"
    tail -n 40 "$log"
  fi
done
exit "$broken"
