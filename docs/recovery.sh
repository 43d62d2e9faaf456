#!/usr/bin/env bash
# Prints the tables of docs/recovery.md. Takes about two minutes.
#
#   docs/recovery.sh [BUILD_FOLDER]      (default: build)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program="${1:-build}/bin/estimate_cloth"
results="$(mktemp -d)"
trap 'rm -rf "$results"' EXIT
export OPENBLAS_NUM_THREADS=1

# row SCENE SETTINGS OPTION...: runs one estimation and prints its row.
row() {
  local scene="$1" settings="$2"
  shift 2
  "$program" --scene "data/$scene.txt" --settings "$settings" --output_dir "$results" \
    "$@" > /dev/null
  python3 - "$results/report.json" "$*" << 'PYTHON'
import json, sys
r = json.load(open(sys.argv[1]))
number = lambda x, f: "–" if x is None else format(x, f)
validation = (r["validation"] or {}).get("rms_position_error_m")
print("|", " | ".join([
    r["scene"].split("/")[-1].removesuffix(".txt"), r["settings"], str(r["frames"]),
    sys.argv[2] or "default", r["solver"], str(r["iterations"]),
    number(r["rms_position_error_m"], ".3g"), number(validation, ".2g"),
    number(r["parameter_deviation_percent"], ".2g"), number(r["wall_time_s"], ".2f")]),
    "|")
PYTHON
}

header() {
  echo "| scene | settings | frames | options | solver | iterations | RMS (m) |" \
    "RMS over 500 frames (m) | deviation (%) | time (s) |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
}

header
for scene in side corners flag flag_no_wind; do
  for settings in Ln nL LL; do row $scene $settings --validate_frames 500; done
done
echo
header
for scene in side corners flag; do
  for settings in Gn nG; do
    for init in inverse_dynamics uniform:1 uniform:0.0001; do
      row $scene $settings --init $init
    done
  done
done
echo
header
row corners Ln --solver lbfgs --init scene --init_perturbation 0.2 --seed 1
