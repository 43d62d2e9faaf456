#!/usr/bin/env bash
# Builds the fuzzers with clang, or runs one of them for a minute.
#
#   fuzz_test.sh build
#   fuzz_test.sh run TARGET
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)"
root="$(cd "$here/../.." && pwd -P)"

# clang without libFuzzer's library cannot link a fuzzer.
has_libfuzzer() {
  local folder status=0
  command -v clang++ > /dev/null || return 1
  folder="$(mktemp -d)"
  echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' \
      > "$folder/empty.cc"
  clang++ -fsanitize=fuzzer,address "$folder/empty.cc" -o "$folder/empty" \
      > /dev/null 2>&1 || status=1
  rm -rf "$folder"
  return "$status"
}
if ! has_libfuzzer; then
  echo "skipped: clang with libFuzzer was not found (clang, libclang-rt-dev)"
  exit 77
fi

if [[ "$1" == build ]]; then
  exec "$root/tools/build.sh" fuzz
fi
exec "$here/run.sh" --seconds 60 "$2"
