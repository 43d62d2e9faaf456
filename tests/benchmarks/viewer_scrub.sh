#!/usr/bin/env bash
# What it costs to drag the time line of a large recording: a recorded motion of N x N
# vertices in a window of 1280x800 under Xvfb, a hand on the time line that goes back and
# forth. Prints pictures and different frames seen per second, and processor time per
# picture. Needs Xvfb and xdotool.
#
#   tests/benchmarks/viewer_scrub.sh [BIN_FOLDER [N [SECONDS]]]      (build/bin 192 10)
set -euo pipefail
bin="$(cd "${1:-build/bin}" && pwd)"
side="${2:-192}"
seconds="${3:-10}"
work="$(mktemp -d)"
pids=()
trap 'kill "${pids[@]}" 2> /dev/null || true; rm -rf "$work"' EXIT
cd "$work"
"$bin/make_scene" --preset side --rows "$side" --cols "$side" --output scene.txt > /dev/null
"$bin/simulate_cloth" --scene scene.txt --frames 40 --output motion.npy > /dev/null

Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3> display 2> /dev/null &
pids+=($!)
until [[ -s display ]]; do sleep 0.1; done
DISPLAY=":$(cat display)"
export DISPLAY
"$bin/dpe_viewer" scene.txt --trajectory motion.npy --paused --state_file=state.jsonl \
    --size=1280x800 > log 2>&1 &
viewer=$!
pids+=("$viewer")
until grep -q at_frame state.jsonl 2> /dev/null; do
  kill -0 "$viewer" 2> /dev/null || { cat log >&2; exit 1; }
  sleep 0.2
done
window="$(xdotool search --name 'dpe_viewer' | tail -n 1)"
place="$(tail -n 1 state.jsonl | sed -nE 's/.*"at_frame":\[([^]]*)\].*/\1/p')"
IFS=, read -r x y <<< "$place"
x="${x%.*}" y="${y%.*}"

ticks() { awk '{print $14 + $15}' "/proc/$viewer/stat"; }
xdotool mousemove --window "$window" "$x" "$y"
sleep 1
xdotool mousedown 1
sleep 1
lines_before="$(wc -l < state.jsonl)"
ticks_before="$(ticks)"
end=$((SECONDS + seconds))
begin="$(date +%s.%N)"
while ((SECONDS < end)); do  # forty positions there and back, sixty a second
  for ((k = -40; k < 40; ++k)); do
    xdotool mousemove --window "$window" $((x + 2 * (k < 0 ? -k : k) - 40)) "$y"
    sleep 0.014
  done
done
took="$(awk -v a="$begin" -v b="$(date +%s.%N)" 'BEGIN {print b - a}')"
ticks_after="$(ticks)"
xdotool mouseup 1
tail -n +"$((lines_before + 1))" state.jsonl > seen.jsonl
pictures="$(wc -l < seen.jsonl)"
changes="$(sed -nE 's/.*"frame":([0-9]+).*/\1/p' seen.jsonl | uniq | wc -l)"
awk -v n="$pictures" -v c="$changes" -v s="$took" -v t=$((ticks_after - ticks_before)) \
    -v hz="$(getconf CLK_TCK)" -v side="$side" 'BEGIN {
  if (n == 0) { print "no picture was drawn"; exit 1 }
  printf "%dx%d vertices: %.1f pictures and %.1f changes of the frame per second, ", \
      side, side, n / s, c / s
  printf "%.1f ms of processor time per picture\n", 1000 * t / hz / n
}'
