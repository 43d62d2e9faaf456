#!/usr/bin/env bash
# Installs what is missing, checks the style rules, builds everything with warnings as
# errors and runs the tests.
#
#   tools/test.sh            the tests that every change has to pass
#   tools/test.sh --all      and the long ones
#   tools/test.sh --asan     built with the address and undefined behaviour sanitizers
#   tools/test.sh --tsan     built with the thread sanitizer
#   tools/test.sh --help     this text
#
# The options can be combined; --asan and --tsan replace the Release build. The exit
# code is 0 only if the style rules hold, everything compiles and every test passes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() {
  sed -n '2,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
}

presets=()
selection=(-LE '^long$')
for argument in "$@"; do
  case "$argument" in
    --all) selection=() ;;
    --asan) presets+=(asan) ;;
    --tsan) presets+=(tsan) ;;
    --help | -h) usage; exit 0 ;;
    *) echo "test: unknown option '$argument'" >&2; usage >&2; exit 1 ;;
  esac
done
if [[ ${#presets[@]} == 0 ]]; then
  presets=(release)
fi

# Sums in a fixed order, whatever the number of processors.
export OPENBLAS_NUM_THREADS=1
export UBSAN_OPTIONS="${UBSAN_OPTIONS:-print_stacktrace=1}"
# Programs' own output is compared by tests, so suppressions are used in silence.
export LSAN_OPTIONS="${LSAN_OPTIONS:-print_suppressions=0 suppressions=$PWD/tests/leak_suppressions.txt}"
export TSAN_OPTIONS="${TSAN_OPTIONS:-halt_on_error=1 print_suppressions=0 suppressions=$PWD/tests/race_suppressions.txt}"

# build_and_test PRESET
build_and_test() {
  local folder=build wrapper=()
  if [[ "$1" != release ]]; then folder="build-$1"; fi
  # Kernels with much address space randomisation move programs to where gcc's thread
  # sanitizer does not expect them.
  if [[ "$1" == tsan ]] && setarch "$(uname -m)" -R true 2> /dev/null; then
    wrapper=(setarch "$(uname -m)" -R)
  fi
  ${wrapper[@]+"${wrapper[@]}"} tools/build.sh "$1" -DDPE_BUILD_TESTS=ON \
      -DDPE_WARNINGS_AS_ERRORS=ON &&
    ${wrapper[@]+"${wrapper[@]}"} ctest --test-dir "$folder" --output-on-failure \
        --no-tests=error --no-label-summary \
        --parallel "$(nproc 2> /dev/null || echo 2)" ${selection[@]+"${selection[@]}"}
}

tools/install_dependencies.sh --tests

# All of it runs even if one part fails, so that one run shows everything there is to
# mend.
failed=""
tools/check_style.sh || failed+=" style"
for preset in "${presets[@]}"; do
  build_and_test "$preset" || failed+=" $preset"
done
if [[ -n "$failed" ]]; then
  echo "test: failed:$failed (see above)" >&2
  exit 1
fi
