#!/usr/bin/env bash
# Builds and installs dpe from scratch, moves what is installed somewhere else, and
# builds and runs the consumer project with it.
#
#   install_test.sh static|shared
set -euo pipefail
# shellcheck source=packaging.sh
source "$(dirname "${BASH_SOURCE[0]}")/packaging.sh"
kind="$1"

shared=OFF
if [[ "$kind" == shared ]]; then shared=ON; fi
build_dpe "$work/build" -DBUILD_SHARED_LIBS="$shared" \
    -DCMAKE_INSTALL_PREFIX="$work/first" -DDPE_BUILD_VIEWER=OFF -DDPE_BUILD_PYTHON=OFF
quietly cmake --install "$work/build"
rm -rf "$work/build"
mv "$work/first" "$work/prefix"
prefix="$work/prefix"
if grep -rqF -e "$work/first" -e "$work/build" "$prefix/lib/cmake"; then
  fail "the CMake package names the folder it was built or installed in"
fi

for program in simulate fit; do
  build_consumer "$program" "$prefix"
  "$work/consumer_$program/$program" || fail "the consumer's $program"
done

# A version that may be incompatible is refused, and so is a component that is none.
refuses() {  # PATTERN OPTION...
  local pattern="$1"
  shift
  if cmake -S "$here/consumer" -B "$work/refused" -DCMAKE_PREFIX_PATH="$prefix" "$@" \
      > "$work/log" 2>&1; then
    fail "$* was accepted"
  fi
  tr -s ' \n' ' ' < "$work/log" | grep -q "$pattern" || {
    cat "$work/log" >&2
    fail "no message '$pattern'"
  }
  rm -rf "$work/refused"
}
version="$(sed -n 's/^project(dpe VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")"
IFS=. read -r major minor _ <<< "$version"
build_consumer simulate "$prefix" -DWANTED_VERSION="$major.$minor"
refuses 'compatible with requested version' -DWANTED_VERSION="$major.$((minor + 1))"

# The programs run from there, with the libraries beside them.
(cd "$work" && "$prefix/bin/make_scene" --preset side --rows 4 --cols 4 \
    --output "$work/scene.txt" &&
 "$prefix/bin/estimate_cloth" --scene "$work/scene.txt" --settings nG \
    --output_dir "$work/results") > "$work/log" || {
  cat "$work/log" >&2
  fail "the installed programs"
}
[[ -f "$prefix/share/dpe/data/corners.txt" ]] || fail "no data were installed"

if [[ "$kind" == shared ]]; then
  for library in engine estimation; do
    file="$prefix/lib/libdpe_$library.so"
    [[ "$(readlink "$file")" == "libdpe_$library.so.$major.$minor" ]] ||
        fail "$file is not a link to libdpe_$library.so.$major.$minor"
    readelf -d "$file" | grep -q "SONAME.*\[libdpe_$library.so.$major.$minor\]" ||
        fail "the SONAME of $file"
    bash "$here/exports_test.sh" "$file" "$root/$library" "$root/engine" ||
        fail "what $file shows"
  done
fi

# The C interface, with the headers and the library that were installed.
cc -std=c11 -pedantic -Wall -Werror -I"$prefix/include" "$here/c_consumer.c" \
    -o "$work/c_consumer" -L"$prefix/lib" -ldpe_unity -Wl,-rpath,"$prefix/lib" ||
    fail "the C consumer does not compile"
"$work/c_consumer" "$work/scene.txt" || fail "the C consumer"
echo "$kind: installed, moved, found and used"
