#!/usr/bin/env bash
# Shards by GNU parallel: on this machine, or on others that see the same folders (--sshlogin).
# What was done before is not done again: shards find their finished members, and parallel its log.
#   SCENE=slope.yaml OUT=out/slope SHARDS=16 ./gnu_parallel.sh
set -euo pipefail
: "${STURZ:=sturz}" "${SCENE:?a scenario file}" "${OUT:?a folder}" "${SHARDS:=16}"

parallel --quote --jobs "${JOBS:-2}" --retries 2 --joblog "$OUT.log" --resume-failed "$STURZ" ensemble "$SCENE" -o "$OUT" --workers 1 --shard "{}/$SHARDS" ::: $(seq "$SHARDS")

"$STURZ" merge "$OUT"
