#!/usr/bin/env bash
# Runs the fuzzers, one after another, from their corpus.
#
#   tests/fuzz/run.sh [--seconds N] [--build FOLDER] [--jobs N] [--keep] [TARGET...]
#
#   --seconds N      for each target; default 60
#   --build FOLDER   where they were built; default build-fuzz
#   --jobs N         so many targets at once; default 1
#   --keep           afterwards, add to the corpus what reaches more code than it does,
#                    at most 8 inputs of 512 bytes for each target
#   TARGET           scene, csv, ...; default: all of them
#
# Prints a line per target: executions, executions per second, edges covered. What is
# found is left in FOLDER/findings/TARGET. Exit code 0: nothing was found.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)"
root="$(cd "$here/../.." && pwd -P)"
seconds=60
build="$root/build-fuzz"
keep=0
jobs=1
targets=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    --seconds) seconds="${2:?--seconds needs a number}"; shift ;;
    --build) build="$(cd "${2:?--build needs a folder}" && pwd -P)"; shift ;;
    --jobs) jobs="${2:?--jobs needs a number}"; shift ;;
    --keep) keep=1 ;;
    --help | -h) sed -n '2,16s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    -*) echo "run: unknown option '$1'" >&2; exit 1 ;;
    *) targets+=("$1") ;;
  esac
  shift
done
if [[ ! "$seconds" =~ ^[1-9][0-9]*$ || ! "$jobs" =~ ^[1-9][0-9]*$ ]]; then
  echo "run: --seconds and --jobs need a whole number above 0" >&2
  exit 1
fi
if [[ ${#targets[@]} == 0 ]]; then
  for folder in "$here"/corpus/*/; do targets+=("$(basename "$folder")"); done
fi
export OPENBLAS_NUM_THREADS=1
export UBSAN_OPTIONS="print_stacktrace=1"

# The last number of LABEL in a log.
figure() { sed -nE "s/.*$1 *([0-9]+).*/\1/p" "$2" | tail -n 1; }

fuzz() {
  local target="$1" findings="$build/findings/$1" found="$build/corpus/$1" status=0
  local program="$build/bin/${1}_fuzzer" log="$build/findings/$1.log" limit=4096
  if [[ ! -x "$program" ]]; then
    echo "$target: no $program; cmake --preset fuzz && cmake --build --preset fuzz" >&2
    return 1
  fi
  mkdir -p "$findings" "$found"
  rm -f "$findings"/*
  # New inputs go to the first folder, the build's; the seeds are only read.
  "$program" -max_total_time="$seconds" -max_len="$limit" -timeout=60 \
      -rss_limit_mb=1024 -malloc_limit_mb=1024 -print_final_stats=1 \
      -artifact_prefix="$findings/" "$found" "$here/corpus/$target" \
      > "$log" 2>&1 || status=$?
  echo "$target: $(figure 'number_of_executed_units:' "$log") executions," \
      "$(figure 'average_exec_per_sec:' "$log") per second," \
      "$(figure 'cov:' "$log") edges covered"
  if [[ "$status" != 0 ]]; then
    grep -aE 'ERROR|SUMMARY|runtime error|libFuzzer: |terminate called|what\(\)' "$log" \
        | head -n 8 >&2
    echo "$target: FOUND, see $log and $findings" >&2
    return 1
  fi
  if [[ "$keep" == 1 ]]; then merge "$target"; fi
}

# Adds what the corpus lacks; large inputs and many of them stay out of the tree.
merge() {
  local target="$1" minimal="$build/corpus/$1.minimal" size file count=0
  rm -rf "$minimal"
  # Beside the seeds, inputs that reach something new. Of those that are small enough the
  # larger ones: they are more like files.
  cp -r "$here/corpus/$target" "$minimal"
  "$build/bin/${target}_fuzzer" -merge=1 -max_len=512 "$minimal" "$build/corpus/$target" \
      > "$build/findings/$target.merge" 2>&1
  while read -r size file; do
    if ((count >= 8)); then break; fi
    if ((size > 512)) || [[ -e "$here/corpus/$target/$(basename "$file")" ]]; then continue; fi
    cp "$file" "$here/corpus/$target/"
    count=$((count + 1))
  done <<< "$(find "$minimal" -type f -printf '%s %p\n' | sort -rn)"
  rm -rf "$minimal"
}

failed=0
running=0
for target in "${targets[@]}"; do
  if ((running >= jobs)); then
    wait -n || failed=1
    running=$((running - 1))
  fi
  fuzz "$target" &
  running=$((running + 1))
done
while ((running > 0)); do
  wait -n || failed=1
  running=$((running - 1))
done
exit "$failed"
