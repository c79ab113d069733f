#!/usr/bin/env bash
# UNTESTED. Shards as tasks of HyperQueue, which keeps workers within large jobs of a cluster's scheduler.
#   hq server start &; hq alloc add slurm --time-limit 1h     (or hq worker start)
set -euo pipefail
: "${SCENE:?a scenario file}" "${OUT:?a folder}" "${SHARDS:=16}"

hq submit --wait --cpus 1 --array "1-$SHARDS" --max-fails "$SHARDS" -- sturz ensemble "$SCENE" -o "$OUT" --workers 1 --shard "auto/$SHARDS"
sturz merge "$OUT"  # names the shards that are missing, if any
