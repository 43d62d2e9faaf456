#!/usr/bin/env bash
# dpe as a subdirectory of another project (FetchContent): no name clashes, nothing of
# the parent's changes, and its programs are those of the consumer project.
set -euo pipefail
# shellcheck source=packaging.sh
source "$(dirname "${BASH_SOURCE[0]}")/packaging.sh"

# Without a build type, which dpe would choose for itself; the parent looks at what has
# changed. dpe's own warnings are errors, as the compiler cache knows them.
quietly cmake -S "$here/parent" -B "$work/build" -DDPE_SOURCE="$root" \
    -DCONSUMER="$here/consumer" -DDPE_WARNINGS_AS_ERRORS=ON
quietly cmake -DCMAKE_BUILD_TYPE=Release "$work/build"

# Options are cache entries, which a parent and its subdirectories share.
grep -rhoE '^ *option\([A-Za-z0-9_]+' "$root"/CMakeLists.txt "$root"/*/CMakeLists.txt \
    "$root"/cmake | sed 's/.*(//' | sort -u > "$work/options"
if grep -vE '^DPE_' "$work/options"; then fail "options without the prefix DPE_"; fi
[[ "$(wc -l < "$work/options")" -ge 8 ]] || fail "no options were found"
for option in TOOLS TESTS VIEWER PYTHON UNITY_PLUGIN EXAMPLES; do
  grep -q "^DPE_BUILD_$option:BOOL=OFF" "$work/build/CMakeCache.txt" ||
      fail "DPE_BUILD_$option is not off in a subdirectory"
done
grep -q '^DPE_INSTALL:BOOL=OFF' "$work/build/CMakeCache.txt" || fail "DPE_INSTALL is on"

quietly cmake --build "$work/build" --parallel "$(jobs)" --target own_code
grep -q 'unused variable' "$work/log" || {
  cat "$work/log" >&2
  fail "the parent's file did not warn: the test shows nothing"
}
if grep -q 'unused parameter' "$work/log"; then fail "-Wextra has leaked"; fi
quietly cmake --build "$work/build" --parallel "$(jobs)"
for program in simulate fit; do
  "$work/build/$program" || fail "$program in the parent project"
done
cmake --install "$work/build" --prefix "$work/installed" > "$work/log" ||
    fail "installing the parent"
if [[ -e "$work/installed/lib" || -e "$work/installed/include" ]]; then
  fail "dpe was installed with its parent"
fi
echo "as a subdirectory: built and used"
