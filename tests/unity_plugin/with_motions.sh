#!/usr/bin/env bash
# Simulates the scenes of data/ with simulate_cloth and gives them with their motions to a
# program that compares them with what the library computes.
#
#   with_motions.sh SIMULATE_CLOTH DATA_FOLDER PROGRAM [ARGUMENT...]
#
# Calls PROGRAM ARGUMENT... SCENE MOTION SCENE MOTION ...
set -euo pipefail
simulate_cloth="$1"
data="$2"
shift 2
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
pairs=()
for scene in side corners flag flag_no_wind; do
  "$simulate_cloth" --scene="$data/$scene.txt" --output="$scratch/$scene.npy" > /dev/null
  pairs+=("$data/$scene.txt" "$scratch/$scene.npy")
done
TMPDIR="$scratch" "$@" "${pairs[@]}"
