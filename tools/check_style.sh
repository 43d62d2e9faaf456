#!/usr/bin/env bash
# Checks the rules of the project that a compiler does not:
#
#   format        clang-format (version 14; another version would differ, and is skipped)
#   size          lines per file: median <= 125, 95th percentile <= 400;
#                 lines per function: 95th percentile <= 60 (tests are not counted)
#   dependencies  which folder may include and use what: tools/check_dependencies.awk
#   folders       every folder has a README.md
#
#   tools/check_style.sh [--root FOLDER]
#
# Prints one line per violation. Exit code 0: none, 1: some.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)"
root="$(cd "$here/.." && pwd -P)"

readonly max_median_file_lines=125
readonly max_p95_file_lines=400
readonly max_p95_function_lines=60
readonly clang_format_version=14

if [[ "${1:-}" == --root && $# == 2 ]]; then
  root="$(cd "$2" && pwd -P)"
elif [[ $# != 0 ]]; then
  sed -n '2,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 1
fi
cd "$root"
violations=0

report() {
  echo "$*"
  violations=$((violations + 1))
}

# The project's files. Without git (an unpacked archive, a checkout that belongs to
# another user) everything but build output and results.
list_files() {
  if [[ "$(git rev-parse --show-toplevel 2> /dev/null)" == "$root" ]]; then
    git ls-files --cached --others --exclude-standard
  else
    find . -type f -not -path './.git/*' -not -path './build*/*' \
        -not -path './results/*' | sed 's|^\./||'
  fi | sort | while IFS= read -r file; do
    if [[ -f "$file" ]]; then echo "$file"; fi
  done
}

# quantile PERCENT: nearest rank of the sorted numbers on standard input.
quantile() {
  sort -n | awk -v percent="$1" '
    {value[NR] = $1}
    END {
      rank = int((percent * NR + 99) / 100)
      print NR ? value[rank < 1 ? 1 : rank] : 0
    }'
}

clang_format_command() {
  local command
  for command in "clang-format-$clang_format_version" clang-format; do
    if "$command" --version 2> /dev/null | grep -q "version $clang_format_version\."; then
      echo "$command"
      return
    fi
  done
}

check_format() {
  local command output unformatted file
  command="$(clang_format_command)"
  if [[ -z "$command" ]]; then
    echo "note: clang-format $clang_format_version was not found; format not checked"
    return
  fi
  # shellcheck disable=SC2086  # names without spaces
  if output="$("$command" --dry-run --Werror $sources 2>&1)"; then return; fi
  unformatted="$(sed -nE 's/^(.*\.(h|cc)):[0-9]+:[0-9]+: error: .*/\1/p' <<< "$output" |
                 sort -u)"
  if [[ -z "$unformatted" ]]; then
    report "$command failed: $(head -1 <<< "$output")"
    return
  fi
  while IFS= read -r file; do
    report "$file: not formatted; run: $command -i $file"
  done <<< "$unformatted"
}

check_limit() {  # WHAT VALUE LIMIT
  if (($2 > $3)); then
    report "size: $1 is $2 lines, at most $3 are allowed"
  fi
}

check_sizes() {
  local counted lines functions
  counted="$(grep -v '^tests/' <<< "$sources" || true)"
  if [[ -z "$counted" ]]; then return; fi
  # shellcheck disable=SC2086  # names without spaces
  lines="$(for file in $counted; do wc -l < "$file"; done)"
  # shellcheck disable=SC2086
  functions="$(awk -f "$here/function_lengths.awk" $counted)"
  local violations_before=$violations
  check_limit "the median file" "$(quantile 50 <<< "$lines")" $max_median_file_lines
  check_limit "the 95th percentile of files" "$(quantile 95 <<< "$lines")" \
      $max_p95_file_lines
  check_limit "the 95th percentile of functions" \
      "$(cut -d' ' -f1 <<< "$functions" | quantile 95)" $max_p95_function_lines
  if ((violations > violations_before)); then
    echo "  longest files:"
    # shellcheck disable=SC2086
    for file in $counted; do echo "$(wc -l < "$file") $file"; done |
        sort -rn | sed -n '1,5s/^/    /p'
    echo "  longest functions:"
    sort -rn <<< "$functions" | sed -n '1,5s/^/    /p'
  fi
}

check_dependencies() {
  local line
  # shellcheck disable=SC2086
  while IFS= read -r line; do
    if [[ -n "$line" ]]; then report "$line"; fi
  done <<< "$(awk -v sources="$sources" -f "$here/check_dependencies.awk" $sources)"
}

# The README of a room speaks for its src/ and its public headers; folders below src/
# have their own. Every file of a fuzzer's corpus is input.
check_readmes() {
  local folder
  while IFS= read -r folder; do
    case "/$folder/" in
      */include/* | */src/ | */fuzz/corpus/* | /.*) continue ;;
    esac
    if [[ ! -f "$folder/README.md" ]]; then
      report "$folder: has no README.md (what lives here, what may be touched)"
    fi
  done <<< "$(sed -n 's|/[^/]*$||p' <<< "$files" | sort -u)"
}

files="$(list_files)"
if grep -q '[[:space:]]' <<< "$(tr '\n' '/' <<< "$files")"; then
  report "file names with spaces: $(grep '[[:space:]]' <<< "$files" | head -3)"
fi
sources="$(grep -E '\.(h|cc)$' <<< "$files" | grep -v '[[:space:]]' || true)"
check_readmes
if [[ -n "$sources" ]]; then
  check_format
  check_sizes
  check_dependencies
fi
if ((violations > 0)); then
  echo "style: $violations violation(s)"
  exit 1
fi
echo "style: $(wc -l <<< "$sources") source files, no violation"
