#!/usr/bin/env bash
# From a fresh clone to recovered parameters: installs what is missing, builds the
# programs and recovers the stiffness of every spring of data/corners.txt.
#
#   tools/quickstart.sh
#
# Can be run from any folder and as often as you like.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-}" in
  "") ;;
  --help | -h) sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
  *)
    echo "quickstart: unknown option '$1'" >&2
    sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit 1
    ;;
esac

# True for a build folder that tools/test.sh made: it stays as it is, with its tests and
# its stricter warnings, and so nothing is compiled twice.
build_has_tests() {
  grep -qs '^DPE_BUILD_TESTS:BOOL=ON' build/CMakeCache.txt &&
    grep -qs '^GTest_DIR:PATH=/' build/CMakeCache.txt
}

# The folder of the results written last.
newest_results() {
  local folder newest=""
  for folder in results/corners_*/; do
    if [[ -f "$folder/report.json" ]] &&
       [[ -z "$newest" || "$folder/report.json" -nt "$newest/report.json" ]]; then
      newest="$folder"
    fi
  done
  echo "${newest%/}"
}

tools/install_dependencies.sh
options=()
if ! build_has_tests; then
  # GoogleTest need not be there, and a compiler newer than ours may warn of more.
  options=(-DDPE_BUILD_TESTS=OFF -DDPE_WARNINGS_AS_ERRORS=OFF)
fi
tools/build.sh release ${options[@]+"${options[@]}"} \
    -- make_scene simulate_cloth estimate_cloth

command=(build/bin/estimate_cloth --scene data/corners.txt)
echo
echo "$ ${command[*]}"
status=0
"${command[@]}" || status=$?
results="$(newest_results)"
echo
case "$status" in
  0) echo "Done." ;;
  1) echo "The program refused its input (exit code 1): see its message above." ;;
  2) echo "It stopped before converging (exit code 2): the best result so far was kept." ;;
  3) echo "It failed numerically (exit code 3): see its message above." ;;
  *) echo "It ended with exit code $status." ;;
esac
if [[ -n "$results" ]]; then
  echo "The results are in $PWD/$results"
fi
exit "$status"
