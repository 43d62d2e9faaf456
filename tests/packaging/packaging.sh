# What the tests of this folder share; sourced. Sets `work`, a folder that is removed at
# the end, and the compiler cache.
# shellcheck shell=bash
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)"
root="$(cd "$here/../.." && pwd -P)"
work="$(mktemp -d)"
work="$(cd "$work" && pwd -P)"
trap 'rm -rf "$work"' EXIT
export OPENBLAS_NUM_THREADS=1
if command -v ccache > /dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache CMAKE_C_COMPILER_LAUNCHER=ccache
fi

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# quietly COMMAND...: shows the output of a command only if it fails.
quietly() {
  "$@" > "$work/log" 2>&1 || { tail -n 60 "$work/log" >&2; fail "$*"; }
}

jobs() {
  local processors
  processors="$(nproc 2> /dev/null || echo 2)"
  echo "${DPE_JOBS:-$processors}"
}

# build_dpe BUILD_FOLDER OPTION...: configures and builds dpe without its tests, with
# the warnings as errors that the compiler cache knows from the ordinary build.
build_dpe() {
  local build="$1"
  shift
  quietly cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release \
      -DDPE_BUILD_TESTS=OFF -DDPE_BUILD_EXAMPLES=OFF -DDPE_WARNINGS_AS_ERRORS=ON \
      -DDPE_FILL_UNITY_PACKAGE=OFF "$@"
  quietly cmake --build "$build" --parallel "$(jobs)"
}

# build_consumer PROGRAM PREFIX [CMAKE_OPTION...]: builds a program of consumer/ with
# what is installed at the prefix; its folder is $work/consumer_PROGRAM.
build_consumer() {
  local program="$1" prefix="$2"
  shift 2
  quietly cmake -S "$here/consumer" -B "$work/consumer_$program" \
      -DCMAKE_BUILD_TYPE=Release -DPROGRAM="$program" -DCMAKE_PREFIX_PATH="$prefix" \
      "$@"
  quietly cmake --build "$work/consumer_$program" --parallel "$(jobs)"
}
