#!/usr/bin/env bash
# Measures how adaptive quality meets a load that comes and goes: a capture beside a process that takes a core in the
# middle third, and the same at the one quality that the first had in the mean. Writes OUT/adaptive and OUT/fixed.
set -euo pipefail
usage="usage: scripts/adaptive_load.sh SEASCAPE OUT DISPLAY TARGET_HZ WxH [SCENE]
  SEASCAPE  the program, as build/release/seascape
  DISPLAY   window, simulated or headless
  SCENE     default open_sea"
if [[ ${1:-} == --help ]]; then
  echo "$usage"
  exit 0
fi
if (($# < 5 || $# > 6)); then
  echo "$usage" >&2
  exit 2
fi
program=$1 out=$2 display=$3 hz=$4 size=$5 scene=${6:-open_sea}
frames=$((40 * hz))
mkdir -p "$out"
# Frames of a capture are as far apart as they take, so the load comes by the clock.
measure() {
  local folder=$1
  shift
  (
    sleep 12
    timeout 10 bash -c 'while :; do :; done'
  ) &
  local load=$!
  "$program" capture --scene "$scene" --preset low --size "$size" --display "$display" --frames "$frames" --warmup 20 \
    --set adaptive.use=on --set "adaptive.target_hz=$hz" "$@" --out "$folder" | grep "held to"
  kill "$load" 2>/dev/null || true
  wait "$load" 2>/dev/null || true
}
echo "adaptive:"
measure "$out/adaptive" | tee "$out/adaptive.txt"
# Bounds take the next level that is as good or better: a little less comes to the same quality or less.
quality=$(sed -n 's/.*mean quality \([0-9.]*\),.*/\1/p' "$out/adaptive.txt" | awk '{ printf("%.3f", ($1 > 0.04) ? $1 - 0.04 : 0) }')
echo "fixed at $quality:"
measure "$out/fixed" --set "adaptive.floor=$quality" --set "adaptive.ceiling=$quality"
