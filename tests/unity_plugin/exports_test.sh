#!/usr/bin/env bash
# The shared library shows the functions that the headers declare, and nothing else.
#
#   exports_test.sh NM LIBRARY HEADER_FOLDER
set -euo pipefail
exported="$("$1" -D --defined-only "$2" | awk '{print $NF}' | sed 's/@.*//' | sort -u)"
declared="$(cat "$3"/*.h | tr '\n' ' ' |
            grep -oE 'DPE_API [^;(]+' | grep -oE 'dpe_[a-z_]+$' | sort -u)"
if [[ -z "$declared" ]]; then
  echo "no declaration was found in $3" >&2
  exit 1
fi
if [[ "$exported" != "$declared" ]]; then
  echo "exported (>) and declared (<) differ:" >&2
  diff <(echo "$declared") <(echo "$exported") >&2
  exit 1
fi
echo "$(wc -l <<< "$exported") functions"
