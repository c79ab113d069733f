# SPDX-License-Identifier: Apache-2.0
# A build that shows how far it is instead of the compiler's words; sourced by quickstart.sh.

# Core-seconds of a first build without the tests, measured with gcc 12 and an empty ccache.
build_core_seconds=600

# build_forecast: minutes on this machine, as "4 to 7 minutes".
build_forecast() {
  local seconds=$((build_core_seconds / $(nproc)))
  local low=$((seconds * 4 / 5 / 60)) high=$((seconds * 6 / 5 / 60 + 1))
  [ "$low" -ge 1 ] && echo "$low to $high minutes" || echo "a minute or two"
}

clock() { printf '%d:%02d' $(($1 / 60)) $(($1 % 60)); }

# build_step FILE: "37 %" from the last "[12/345]" of ninja's log, nothing before the first.
build_step() {
  tail -c 4000 "$1" 2>/dev/null | tr '\r' '\n' |
    sed -n 's|^\[\([0-9]*\)/\([0-9]*\)\].*|\1 \2|p' |
    awk 'END { if ($2 > 0) printf "%d %%", 100 * $1 / $2 }'
}

# build_quietly LOG COMMAND...: runs the command with its words in LOG. On a terminal one line says
# how far it is; elsewhere a new line every half minute. When it fails, the end of the log is shown.
build_quietly() {
  local log=$1 begin=$SECONDS told=$SECONDS step pid code=0 erase=''
  shift
  : >"$log"
  # In a process group of its own, so that an interrupted script takes all compilers with it.
  set -m
  NINJA_STATUS='[%f/%t] ' "$@" >"$log" 2>&1 </dev/null &
  pid=$!
  set +m
  trap 'kill -TERM -- "-$pid" 2>/dev/null' INT TERM
  while kill -0 "$pid" 2>/dev/null; do
    step=$(build_step "$log")
    if [ -t 1 ]; then
      printf '\r\033[KBuilding: %s (%s)' "${step:-starting}" "$(clock $((SECONDS - begin)))"
      erase='\r\033[K'
    elif [ $((SECONDS - told)) -ge "${build_tell_every:-30}" ]; then
      told=$SECONDS
      echo "Building: ${step:-starting} ($(clock $((SECONDS - begin))))"
    fi
    sleep 1
  done
  wait "$pid" || code=$?
  trap - INT TERM
  printf '%b' "$erase"
  if [ "$code" -ne 0 ]; then
    tail -n 30 "$log" >&2
    echo "The build failed; the lines above are the end of $log." >&2
    return "$code"
  fi
  echo "Built in $(clock $((SECONDS - begin))); the compiler's words are in $log."
}
