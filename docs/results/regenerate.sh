#!/usr/bin/env bash
# Runs the experiments again and replaces their pages in this folder.
#
#   docs/results/regenerate.sh [OPTION...] [NAME...]
#     NAME            experiments, as run_experiments --list names them; default: all
#     --build FOLDER  build folder that holds bin/run_experiments (build)
#     --output DIR    where the pages go (this folder)
#     --resume        keep the rows of a run that was interrupted
#     -- FLAG...      more flags for run_experiments (--jobs 1)
#
# One experiment after the other, so that none disturbs the times of another; nothing else
# should run meanwhile. Rows and logs stay in results/regenerate/NAME. Exit code 0: every
# page was written, and every job of it was done.
set -euo pipefail
repository="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"

build="$repository/build"
output="$repository/docs/results"
resume=0
names=()
flags=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    --build | --output)
      if [[ $# == 1 ]]; then
        echo "regenerate: $1 needs a folder" >&2
        exit 1
      fi
      if [[ "$1" == --build ]]; then build="$2"; else output="$2"; fi
      shift 2 ;;
    --resume) resume=1; shift ;;
    --help | -h) sed -n '2,14s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    --) shift; flags=("$@"); break ;;
    -*) echo "regenerate: unknown option '$1'" >&2
        sed -n '2,14s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
        exit 1 ;;
    *) names+=("$1"); shift ;;
  esac
done
if [[ ! -x "$build/bin/run_experiments" ]]; then
  echo "regenerate: $build/bin/run_experiments is not there; build first" \
       "(tools/build.sh release) or give --build" >&2
  exit 1
fi
build="$(cd "$build" && pwd)"
mkdir -p "$output"
output="$(cd "$output" && pwd)"
export OPENBLAS_NUM_THREADS=1
# Scenes of experiments are named from here.
cd "$repository"

known="$("$build/bin/run_experiments" --list |
         sed -n '/^Experiments:/,/^Kinds of jobs:/s/^  \([^ :]*\):.*/\1/p')"
if [[ ${#names[@]} == 0 ]]; then
  # shellcheck disable=SC2206  # names without spaces
  names=($known)
fi
for name in "${names[@]}"; do
  if ! grep -qx -- "$name" <<< "$known"; then
    echo "regenerate: there is no experiment '$name'; there are:" "${known//$'\n'/ }" >&2
    exit 1
  fi
done

# publish NAME FOLDER: the report becomes the folder's README.md.
publish() {
  local page="$output/$1" file
  mkdir -p "$page"
  rm -f "$page"/*.csv "$page"/*.svg
  cp "$2/report.md" "$page/README.md"
  for file in "$2"/*.csv "$2"/*.svg; do
    if [[ -f "$file" ]]; then cp "$file" "$page/"; fi
  done
  echo "Wrote $page"
}

# The table of pages in this folder's README.md, from the first lines of each.
write_index() {
  local index="$output/README.md" page
  if ! grep -q '^<!-- pages:' "$index" 2> /dev/null; then return; fi
  {
    sed '/^<!-- pages:/q' "$index"
    echo
    echo "| page | what |"
    echo "|---|---|"
    for page in "$output"/*/README.md; do
      if [[ ! -f "$page" ]]; then continue; fi
      page="$(basename "$(dirname "$page")")"
      echo "| [$page]($page/README.md) | $(sed -n '1s/^# //p' "$output/$page/README.md") |"
    done
    echo
    sed -n '/^<!-- end of pages/,$p' "$index"
  } > "$index.new"
  mv "$index.new" "$index"
}

incomplete=""
for name in "${names[@]}"; do
  rows="results/regenerate/$name"
  if [[ "$resume" == 0 ]]; then rm -rf "$rows"; fi
  status=0
  "$build/bin/run_experiments" "$name" --output_dir "$rows" \
      ${flags[@]+"${flags[@]}"} || status=$?
  if [[ ! -f "$rows/report.md" ]]; then
    echo "regenerate: $name left no report (exit code $status)" >&2
    incomplete+=" $name"
    continue
  fi
  publish "$name" "$rows"
  if [[ "$status" != 0 ]] || grep -q '^Not done:' "$rows/report.md"; then
    incomplete+=" $name"
  fi
done
write_index
if [[ -n "$incomplete" ]]; then
  echo "regenerate: not every job was done in:$incomplete (the pages say why)" >&2
  exit 1
fi
