#!/usr/bin/env bash
# Code shown in the guides must be code that is compiled. A line
#   <!-- snippet: FILE NAME -->
# in a guide says that the code block after it is what stands in FILE between the two
# lines "// [NAME]".
set -euo pipefail
root="$(cd "$1/.." && pwd)"
# shellcheck source=expect.sh
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

# check_snippets GUIDE: prints every snippet that differs from its source; 1 if any does,
# or if the guide has none.
check_snippets() {
  local guide="$1" file name status=0 count=0
  while read -r file name; do
    count=$((count + 1))
    awk -v name="$name" '
        $0 ~ "^ *// \\[" name "\\]$" {inside = !inside; next}
        inside' "$root/$file" > "$scratch/source"
    awk -v file="$file" -v name="$name" '
        $0 == "<!-- snippet: " file " " name " -->" {found = 1; next}
        found && /^```/ {if (inside) exit; inside = 1; next}
        inside' "$guide" > "$scratch/shown"
    if [[ ! -s "$scratch/source" ]]; then
      echo "$guide: $file has no lines between two of // [$name]"
      status=1
    elif ! diff "$scratch/shown" "$scratch/source"; then
      echo "$guide: the snippet $name is not what stands in $file"
      status=1
    fi
  done < <(sed -nE 's/^<!-- snippet: ([^ ]+) ([^ ]+) -->$/\1 \2/p' "$guide")
  if ((count == 0)); then
    echo "$guide: no snippets"
    status=1
  fi
  return "$status"
}

guide="$root/docs/custom_residuals.md"
expect "the guide shows what is compiled" 0 "" check_snippets "$guide"
sed 's/residual\[0\] = /residual[0] += /' "$guide" > "$scratch/changed.md"
expect "a changed snippet is refused" 1 "snippet point_to_plane is not" \
    check_snippets "$scratch/changed.md"
sed 's/point_to_plane -->/point_to_line -->/' "$guide" > "$scratch/renamed.md"
expect "a snippet without source is refused" 1 "no lines between" \
    check_snippets "$scratch/renamed.md"
expect "a guide without snippets is refused" 1 "no snippets" \
    check_snippets "$root/docs/README.md"
finish
