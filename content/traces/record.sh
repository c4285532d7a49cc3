#!/bin/bash
# Records scenes.csv: the GPU time of each frame of ten shipped scenes along their camera paths, over its median.
# Usage: content/traces/record.sh build/bench/seascape [SCENE...]. Each path is run three times and the least time of a
# frame is taken: a software driver's times include what other programs took from it.
set -eu
program=$1; shift
scenes=${*:-open_sea storm harbour lagoon regatta rivers still_life waterline flotsam aquarium}
here=$(dirname -- "$(readlink -f -- "$0")")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
for scene in $scenes; do
  "$program" capture --scene "$scene" --preset low --size 200x136 --views 1 --display headless --fps 45 --warmup 10 --frames 300 --repeat 3 \
    --out "$work/$scene" > "$work/$scene.log" 2>&1 || { cat "$work/$scene.log"; exit 1; }
  column=$(head -1 "$work/$scene/capture.csv" | tr , '\n' | grep -nx gpu_ms | cut -d: -f1)
  frame=$(head -1 "$work/$scene/capture.csv" | tr , '\n' | grep -nx frame | cut -d: -f1)
  tail -n +2 "$work/$scene/capture.csv" | awk -F, -v c="$column" -v f="$frame" '
    !($f in least) {order[++n] = $f; least[$f] = $c}
    $c + 0 < least[$f] + 0 {least[$f] = $c}
    END {for (i = 1; i <= n; ++i) print least[order[i]]}' > "$work/$scene.ms"
  median=$(sort -g "$work/$scene.ms" | awk '{v[NR] = $1} END {print v[int((NR + 1) / 2)]}')
  { echo "$scene"; awk -v m="$median" '{printf "%.4f\n", $1 / m}' "$work/$scene.ms"; } > "$work/$scene.column"
  columns="${columns:-} $work/$scene.column"
done
paste -d, $columns > "$here/scenes.csv"
