#!/usr/bin/env bash
# Configures and builds one preset of CMakePresets.json.
#
#   tools/build.sh PRESET [CMAKE_OPTION...] [-- TARGET...]
#
# Uses all processors as far as memory allows; DPE_JOBS=N sets the number of jobs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Compiling one file that includes Ceres takes more than 1 GB, with sanitizers nearly 2.
readonly kilobytes_per_job=1800000

processors() {
  nproc 2> /dev/null || sysctl -n hw.ncpu 2> /dev/null || echo 1
}

# Memory that a build may use: what is free, and within what the container may take.
available_kilobytes() {
  local available limit
  available="$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo 2> /dev/null || true)"
  limit="$(cat /sys/fs/cgroup/memory.max 2> /dev/null || true)"
  if [[ "$limit" =~ ^[0-9]+$ ]] && ((limit / 1024 < ${available:-0})); then
    available=$((limit / 1024))
  fi
  echo "${available:-8000000}"
}

jobs_for_this_machine() {
  local jobs by_memory
  jobs="$(processors)"
  by_memory=$(("$(available_kilobytes)" / kilobytes_per_job))
  if ((by_memory < jobs)); then jobs=$by_memory; fi
  if ((jobs < 1)); then jobs=1; fi
  echo "$jobs"
}

if [[ $# == 0 || "$1" == -* ]]; then
  sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 1
fi
configure=(cmake --preset "$1")
build=(cmake --build --preset "$1" --parallel "${DPE_JOBS:-$(jobs_for_this_machine)}")
shift
while [[ $# -gt 0 && "$1" != -- ]]; do
  configure+=("$1")
  shift
done
if [[ $# -gt 1 ]]; then
  shift
  build+=(--target "$@")
fi
"${configure[@]}"
"${build[@]}"
