#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# clang-tidy 14 over what changed; every finding is an error. Usage: scripts/tidy.sh [BASE]
#   BASE  commit to compare the working tree with; default: where this branch left origin/main,
#         or the last commit that is a day old (what landed today is looked at together), or HEAD~1
# Needs build/release/compile_commands.json (cmake --preset release). A changed header is looked at
# through a source file that includes it. At most TIDY_MOST files (default 60) are read, those with
# the largest changes first, because one takes eight seconds of a processor.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
database=build/release/compile_commands.json
most=${TIDY_MOST:-60}

default_base() {
  local head base
  head=$(git rev-parse HEAD)
  base=$(git merge-base HEAD origin/main 2>/dev/null)
  [ -n "$base" ] && [ "$base" != "$head" ] && { echo "$base"; return; }
  base=$(git rev-list -1 --before='24 hours ago' HEAD)
  [ -n "$base" ] && { echo "$base"; return; }
  git rev-parse --verify --quiet HEAD~1 || echo "$head"
}

# Changed files, largest change first.
changed() { git diff --numstat --no-renames "$1" -- '*.cpp' '*.hpp' | sort -rn | cut -f3; }

# Source files to read for the names on stdin: sources as they are, headers through their own
# source file or the first one that includes them.
sources() {
  local name
  while read -r name; do
    [ -f "$name" ] || continue
    case $name in
      *.cpp) echo "$name" ;;
      *.hpp)
        if [ -f "${name%.hpp}.cpp" ]; then echo "${name%.hpp}.cpp"
        else git grep -lF "#include \"$name\"" -- '*.cpp' | head -n 1; fi ;;
    esac
  done
}

in_database() {
  local name
  while read -r name; do
    grep -qF "\"file\": \"$PWD/$name\"" "$database" && echo "$name"
  done
}

[ -f "$database" ] || { echo "tidy: no $database. Run: cmake --preset release" >&2; exit 1; }
base=${1:-$(default_base)}
mapfile -t files < <(changed "$base" | sources | awk '!seen[$0]++' | in_database)
echo "tidy: ${#files[@]} source files differ from ${base:0:12}, themselves or a header of theirs"
if [ "${#files[@]}" -gt "$most" ]; then
  echo "tidy: only the $most with the largest changes are read (TIDY_MOST=$most)"
  files=("${files[@]:0:$most}")
fi
[ "${#files[@]}" -eq 0 ] && exit 0

# The commands are those of g++: clang knows not all of its warnings.
found=$(printf '%s\n' "${files[@]}" |
  xargs -P "$(nproc)" -n 1 clang-tidy -p build/release --quiet --warnings-as-errors='*' \
        --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-ignored-optimization-argument 2>&1)
status=$?
printf '%s\n' "$found" | grep -v '^[0-9]* warnings\? generated\.$'
[ $status -eq 0 ] && echo "tidy: clean"
exit $(( status != 0 ))
