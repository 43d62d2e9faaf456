#!/usr/bin/env bash
# A shared library shows what the public headers of its folder mark with DPE_..._API,
# all of it, and nothing else: no class of src/, no template of the standard library.
#
#   exports_test.sh LIBRARY FOLDER_WITH_include [ANOTHER_ONE...]
#
# The other folders are those of libraries it uses: inline classes of theirs may be shown.
set -euo pipefail
library="$1"
headers="$(cat "$2"/include/dpe/*/*.h | sed 's|//.*||; s|^#.*||' | tr -s '\n ' ' ')"

others="$(shift 2; for folder in "$@"; do cat "$folder"/include/dpe/*/*.h; done |
          sed 's|//.*||; s|^#.*||' | tr -s '\n ' ' ')"
# Marked classes, and marked functions by their last name.
classes="$(grep -oE '(class|struct) DPE_[A-Z]+_API [A-Za-z]+' <<< "$headers $others" |
           awk '{print $3}' | sort -u)"
functions="$(grep -oE 'DPE_[A-Z]+_API [^;{(]*\(' <<< "$headers" |
             sed -E 's/ *\($//; s/.*[^A-Za-z0-9_]([A-Za-z0-9_]+|operator<<)$/\1/' | sort -u)"
[[ -n "$classes" && -n "$functions" ]] || { echo "no mark in the headers of $2" >&2; exit 1; }

# nm's names without their arguments: "dpe::Rollout::kept_bytes".
shown="$(nm -D --defined-only --demangle "$library" | cut -d' ' -f3- |
         sed -E 's/^(vtable|typeinfo|typeinfo name) for //; s/^non-virtual thunk to //;
                 s/\[abi:[a-z0-9]+\]//g; s/\(.*//' | sort -u)"
wrong=0
while IFS= read -r name; do
  owner="$(sed -E 's/^dpe::([A-Za-z0-9_]+).*/\1/' <<< "$name")"
  last="${name##*::}"
  if [[ "$name" != dpe::* ]] ||
      ! grep -qxF -e "$owner" <<< "$classes" && ! grep -qxF -e "$last" <<< "$functions"; then
    echo "shown, but not marked in a public header: $name" >&2
    wrong=$((wrong + 1))
  fi
done <<< "$shown"
while IFS= read -r name; do
  if ! grep -qE "(^|::)$name\$" <<< "$shown"; then
    echo "marked in a public header, but not shown: $name" >&2
    wrong=$((wrong + 1))
  fi
done <<< "$functions"
if ((wrong > 0)); then exit 1; fi
echo "$(basename "$library"): $(wc -l <<< "$shown") names shown"
