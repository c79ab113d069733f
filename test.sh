#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what the tests need, builds everything and runs what a change must pass:
#   release     warnings are errors; all tests labelled style, unit, cluster, physics or hard
#   clang-tidy  over the files that changed (scripts/tidy.sh)
#   asan        the unit tests of engine, scenarios, io, designs and hazard maps under
#               AddressSanitizer and UBSan (clang, -O1)
#   fuzz        each fuzz target from the same seed for some twenty seconds' worth of inputs: the same
#               inputs every time, so that a change fails for what it changed
#   tsan        the executor's and the runner's tests, and an ensemble on two workers, under the
#               thread sanitizer (clang, -O1, one OpenMP thread: libomp is not instrumented)
# All of them run, in about 40 minutes from scratch on two quiet cores; name fewer while you work:
# STURZ_STAGES="release asan" ./test.sh. Long fuzzing is scripts/nightly.sh.
# The last line is always "N passed, N failed"; the exit code is zero only when nothing failed.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. scripts/packages.sh

give_up() { echo "$1" >&2; echo "0 passed, 1 failed"; exit 1; }
wanted() { case " ${STURZ_STAGES:-release tidy asan fuzz tsan} " in *" $1 "*) ;; *) return 1 ;; esac; }

install_packages "${build_packages[@]}" "${test_packages[@]}" || give_up "Packages are missing."
install_node

export OMP_WAIT_POLICY=passive OPENBLAS_NUM_THREADS=1
results=$PWD/build/test-results
rm -rf "$results" && mkdir -p "$results"
jobs=$(nproc)

expected=()  # names of the result files that must be there in the end

# build PRESET TARGET...: configures and builds, or ends everything.
build() {
  local preset=$1 werror=OFF
  shift
  [ "$preset" = release ] && werror=ON
  cmake --preset "$preset" -DSTURZ_TESTS=ON -DSTURZ_WERROR="$werror" >/dev/null ||
    give_up "cmake could not configure $preset."
  cmake --build "build/$preset" --target "$@" || give_up "The build of $preset failed."
}

# tests PRESET NAME CTEST-OPTIONS...: results go to NAME.xml.
tests() {
  local preset=$1 name=$2
  shift 2
  expected+=("$results/$name.xml")
  echo "--- $name"
  ctest --test-dir "build/$preset" -j "$jobs" --no-tests=error --output-on-failure \
        --output-junit "$results/$name.xml" "$@" |
    grep -vE '^ *Start |\.\.\. +Passed |^Test project|^Internal ctest'
}

# record NAME COMMAND...: one more test, for what ctest does not run.
record() {
  local name=$1 status=run begin=$SECONDS
  shift
  expected+=("$results/$name.xml")
  echo "--- $name"
  "$@" || status=fail
  echo "    $name: $((SECONDS - begin)) s"
  printf '<testsuite><testcase name="%s" status="%s"/></testsuite>\n' "$name" "$status" \
    >"$results/$name.xml"
}

stage_release() {
  build release all
  # Tests that time something carry RUN_SERIAL, so ctest gives them the machine.
  for label in style unit cluster physics hard; do tests release "$label" -L "^${label}\$"; done
}

stage_tidy() { record tidy scripts/tidy.sh; }

# Whole ensembles, browser pages and counted allocations take minutes there, or mean nothing.
asan_tests=(engine_tests scenarios_test io_foreign_bytes_test io_input_test io_output_test
            scenario_file_test ensemble_design_test ensemble_hazard_test ensemble_scores_test)

stage_asan() {
  build asan "${asan_tests[@]}"
  local binary
  for binary in "${asan_tests[@]}"; do
    record "asan-$binary" quietly "$(find build/asan/tests -name "$binary" -type f -perm -u+x)" --gtest_brief=1
  done
}

declare -A fuzz_runs=([scenario]=12000 [design]=100000 [hydrograph]=100000 [polygons]=6000 [rasters]=4000 [netcdf]=800
                      [manifest]=60000 [risk]=60000 [pack]=60000)

stage_fuzz() {
  build asan fuzz
  local target
  for target in "${!fuzz_runs[@]}"; do
    record "fuzz-$target" quietly tests/fuzz/run.sh "$target" -seed=1 -runs="${fuzz_runs[$target]}"
  done
}

stage_tsan() {
  build tsan ensemble_runner_test sturz
  OMP_NUM_THREADS=1 TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp" \
    tests tsan tsan -R 'EveryExecutor|EveryRunner|^tsan\.'
}

# quietly COMMAND...: its output only when it fails.
quietly() {
  local text
  text=$("$@" 2>&1) && { printf '%s\n' "$text" | tail -n 1; return 0; }
  printf '%s\n' "$text" | tail -n 60
  return 1
}

for stage in release tidy asan fuzz tsan; do
  wanted "$stage" || continue
  begin=$SECONDS
  "stage_$stage"
  echo "=== $stage took $((SECONDS - begin)) s"
done

python3 scripts/count_tests.py "${expected[@]}"
