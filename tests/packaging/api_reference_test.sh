#!/usr/bin/env bash
# The API reference is made without a warning, and has what the public headers declare. A
# docstring that is wrong stops it.
set -euo pipefail
# shellcheck source=packaging.sh
source "$(dirname "${BASH_SOURCE[0]}")/packaging.sh"
if ! command -v doxygen > /dev/null; then
  echo "skipped: doxygen was not found"
  exit 77
fi

# Its target needs no build, and nothing of what dpe is built on.
fill() {  # SOURCE_FOLDER: the Doxyfile as CMake fills it in
  local input="$1/docs/api/main_page.md" room
  for room in engine estimation unity_plugin; do input+=" $1/$room/include"; done
  sed -e "s|@PROJECT_SOURCE_DIR@|$1|g" -e "s|@PROJECT_VERSION@|test|" \
      -e "s|@PROJECT_DESCRIPTION@|test|" -e "s|@DPE_API_OUTPUT@|$work/api|g" \
      -e "s|@DPE_API_INPUT@|$input|" "$1/docs/api/Doxyfile.in"
}
mkdir "$work/api"
fill "$root" > "$work/Doxyfile"
if grep -q '@[A-Z_]*@' "$work/Doxyfile"; then fail "a variable of Doxyfile.in is not filled"; fi
doxygen "$work/Doxyfile" > "$work/log" 2>&1 || {
  cat "$work/log" "$work/api/warnings.txt" >&2
  fail "doxygen"
}
for page in structdpe_1_1Scene classdpe_1_1Simulator classdpe_1_1TrajectoryProblem \
    dpe__c_8h structdpe_1_1EstimatorOptions; do
  [[ -s "$work/api/html/$page.html" ]] || fail "no page $page"
done
grep -q 'gives the same field with every compiler' "$work/api/html/namespacedpe.html" ||
    fail "comments are missing"

# It can fail: a parameter that does not exist is noticed.
mkdir "$work/wrong"
cp -r "$root/docs" "$root/engine" "$root/estimation" "$root/unity_plugin" "$work/wrong"
sed -i 's|@param dp |@param dq |; s|// @param num_rows  |// @param rows |;
        s|// @param derivatives  of|// @param matrices  of|' \
    "$work/wrong/engine/include/dpe/engine/sensitivity.h"
cmp -s "$root/engine/include/dpe/engine/sensitivity.h" \
    "$work/wrong/engine/include/dpe/engine/sensitivity.h" && fail "nothing was broken"
fill "$work/wrong" > "$work/Doxyfile"
if doxygen "$work/Doxyfile" > "$work/log" 2>&1; then
  fail "a wrong parameter in a docstring is not noticed"
fi
echo "API reference: no warning"
