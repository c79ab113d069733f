#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes one reader of foreign bytes. Usage: tests/fuzz/run.sh TARGET [libFuzzer options]
#   TARGET   NAME of a fuzz_NAME.cpp here; `--list` names them all
#   options  e.g. -runs=1000 or -max_total_time=60; one million runs when neither is given
# Build first:  cmake --preset asan && cmake --build build/asan --target fuzz
# Seeds, what libFuzzer learned and findings lie in build/asan/tests/fuzz (or $STURZ_FUZZ_DIR).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
target=${1:?TARGET, or --list}
shift
if [ "$target" = --list ]; then
  for file in "$here"/fuzz_*.cpp; do basename "$file" .cpp | sed s/^fuzz_//; done
  exit
fi
work=${STURZ_FUZZ_DIR:-$root/build/asan/tests/fuzz}
/usr/bin/python3 "$here/make_corpus.py" "$target" "$root" "$work"

leaks=1
options=(-max_len=4096 -timeout=60 -rss_limit_mb=2048 "-artifact_prefix=$work/$target-")
[ -f "$here/$target.dict" ] && options+=("-dict=$here/$target.dict")
case $target in
  # GDAL and HDF5 keep tables for the whole run, which look like leaks; a GeoPackage has 20 kB at least.
  polygons) options+=(-max_len=24576) leaks=0 ;;
  rasters) leaks=0 ;;
  netcdf) options+=(-max_len=256) leaks=0 ;;
esac
options+=("-detect_leaks=$leaks")
case " $* " in *" -runs="* | *" -max_total_time="*) ;; *) options+=(-runs=1000000) ;; esac
# Short stacks of allocations make GDAL's many small ones twice as fast.
memory=allocator_may_return_null=1:max_allocation_size_mb=1024:malloc_context_size=4
export ASAN_OPTIONS="$memory:quarantine_size_mb=16:detect_leaks=$leaks:${ASAN_OPTIONS:-}"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1:${UBSAN_OPTIONS:-}"
exec "$work/fuzz_$target" "${options[@]}" "$@" "$work/corpus_$target"
