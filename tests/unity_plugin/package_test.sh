#!/usr/bin/env bash
# What Unity needs of the package's files, and what no compiler checks: every file and folder
# that Unity sees has a meta file with a GUID of its own, one file holds all imports, and it
# has those that the headers declare.
#
#   package_test.sh UNITY_PLUGIN_FOLDER
set -euo pipefail
package="$1/package"
failures=0

fail() {
  echo "$*" >&2
  failures=$((failures + 1))
}

# Unity does not look into folders whose name ends with ~.
visible="$(cd "$package" && find . -mindepth 1 -not -path '*~*' -not -name '*.meta' |
           sort)"
while IFS= read -r path; do
  case "$path" in
    *.so | *.dylib | *.dll) continue ;;
  esac
  [[ -f "$package/$path.meta" ]] || fail "$path has no meta file"
done <<< "$visible"

# The library's own meta files stay while it is not there.
while IFS= read -r meta; do
  case "$meta" in
    */Plugins/*.so.meta | */Plugins/*.dylib.meta | */Plugins/*.dll.meta) continue ;;
  esac
  [[ -e "${meta%.meta}" ]] || fail "$meta belongs to nothing"
done <<< "$(find "$package" -name '*.meta')"

guids="$(grep -rhE '^guid: ' --include='*.meta' "$package" || true)"
repeated="$(sort <<< "$guids" | uniq -d)"
[[ -z "$repeated" ]] || fail "GUIDs that are used twice: $repeated"
wrong="$(grep -vE '^guid: [0-9a-f]{32}$' <<< "$guids" || true)"
[[ -z "$wrong" ]] || fail "not GUIDs: $wrong"

importing="$(grep -rl DllImport "$package" --include='*.cs')"
[[ "$importing" == "$package/Runtime/DpeNative.cs" ]] ||
  fail "imports are in: $importing"
imported="$(tr '\n' ' ' < "$package/Runtime/DpeNative.cs" |
            grep -oE 'static extern [A-Za-z]+ dpe_[a-z_]+' | grep -oE 'dpe_[a-z_]+$' | sort)"
declared="$(cat "$1"/include/dpe/c/*.h | tr '\n' ' ' |
            grep -oE 'DPE_API [^;(]+' | grep -oE 'dpe_[a-z_]+$' | sort)"
[[ "$imported" == "$declared" ]] ||
  fail "declared (<) and imported (>) differ: $(diff <(echo "$declared") <(echo "$imported"))"

if ((failures > 0)); then exit 1; fi
echo "$(wc -l <<< "$guids") meta files, $(wc -l <<< "$imported") functions"
