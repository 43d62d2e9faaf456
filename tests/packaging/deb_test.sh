#!/usr/bin/env bash
# The Debian packages: built, inspected, installed into a clean root, and used there.
#
# The root is made by debootstrap from the mirror that apt uses, as root. Where that
# cannot be had (not root, no debootstrap, no network), the packages are unpacked into a
# folder instead and run there with this machine's libraries, which shows less: it says so.
# Without dpkg-shlibdeps there is nothing to test.
set -euo pipefail
# shellcheck source=packaging.sh
source "$(dirname "${BASH_SOURCE[0]}")/packaging.sh"
# What a root may have mounted is not removed with it.
trap 'rm -rf --one-file-system "$work"' EXIT
if ! command -v dpkg-shlibdeps > /dev/null || ! command -v cpack > /dev/null; then
  echo "skipped: dpkg-shlibdeps (dpkg-dev) or cpack was not found"
  exit 77
fi

build_dpe "$work/build" -DBUILD_SHARED_LIBS=ON -DCMAKE_INSTALL_PREFIX=/usr
(cd "$work/build" && quietly cpack -G DEB -B "$work/packages")
version="$(sed -n 's/^project(dpe VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")"
architecture="$(dpkg --print-architecture)"
package() { echo "$work/packages/$1_${version}_$architecture.deb"; }
for name in dpe dpe-viewer libdpe-dev python3-dpe; do
  [[ -f "$(package $name)" ]] || fail "no package $name in $(ls "$work/packages")"
done
rm -rf "$work/build"

# depends PACKAGE NAME...: each is among what the package depends on.
depends() {
  local name field dependencies
  field="$(dpkg-deb -f "$(package "$1")" Depends)"
  dependencies="$(sed -E 's/^ *//; s/[ (].*//' <<< "${field//[,|]/$'\n'}")"
  shift
  for name in "$@"; do
    grep -qxE -- "$name" <<< "$dependencies" || fail "no dependency on $name in: $field"
  done
}
contains() {  # PACKAGE PATTERN...
  local files pattern
  files="$(dpkg-deb -c "$(package "$1")" | awk '{print $6, $8}')"
  shift
  for pattern in "$@"; do
    grep -qE -- "$pattern" <<< "$files" || fail "no $pattern in: $files"
  done
}
# Debian's CMake target of Ceres is its static library.
depends dpe libc6 'libgflags2.*' 'libgoogle-glog0.*' libcholmod3 libspqr2 \
    'libopenblas0.*|libblas3|libblas.so.3' 'libstdc\+\+6'
depends dpe-viewer dpe libvulkan1 'libglfw3.*'
depends libdpe-dev dpe libceres-dev libeigen3-dev
depends python3-dpe dpe python3-numpy
contains dpe '^./usr/bin/estimate_cloth' '^./usr/lib/.*/libdpe_engine.so.[0-9.]+' \
    '^./usr/share/dpe/data/corners.txt'
contains libdpe-dev '^./usr/include/dpe/engine/scene.h' '^./usr/include/dpe/dpe_c.h' \
    '^./usr/lib/.*/cmake/dpe/dpeConfig.cmake' '/libdpe_engine.so libdpe_engine.so.'
contains python3-dpe '^./usr/lib/python3.*/dpe/_core.*.so'
contains dpe-viewer '^./usr/bin/dpe_viewer'

# The mirror that apt uses; empty if none is named.
mirror() {
  sed -nE 's#^URIs: *(http[^ ]*/(debian|ubuntu))/?( .*)?$#\1#p' /etc/apt/sources.list.d/*.sources \
      2> /dev/null | head -n 1
  sed -nE 's/^deb +(\[[^]]*\] +)?(http[^ ]*)\/? .* main.*/\2/p' /etc/apt/sources.list \
      2> /dev/null | head -n 1
}

make_root() {
  local mirror suite
  [[ "$(id -u)" == 0 ]] && command -v debootstrap > /dev/null || return 1
  mirror="$(mirror | head -n 1)"
  suite="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")"
  [[ -n "$mirror" && -n "$suite" ]] || return 1
  echo "A clean root of $suite from $mirror ..."
  debootstrap --variant=minbase "$suite" "$work/root" "$mirror" > "$work/log" 2>&1 ||
      return 1
  chroot "$work/root" apt-get update > "$work/log" 2>&1
}

# The programs, in the root or in the folder of unpacked packages (`in_root COMMAND...`).
use_packages() {
  local output
  output="$(in_root estimate_cloth --scene /usr/share/dpe/data/corners.txt \
      --output_dir /tmp/results 2>&1)" || fail "estimate_cloth: $output"
  grep -q '^converged' <<< "$output" || fail "estimate_cloth: $output"
  in_root cat /tmp/results/report.json | grep -q '"success": true' ||
      fail "the report of estimate_cloth"
  in_root dpe_viewer /usr/share/dpe/data/corners.txt --offscreen --first_frame 20 \
      --size 320x200 --png /tmp/frame.png > "$work/log" 2>&1 || {
    cat "$work/log" >&2
    fail dpe_viewer
  }
  # A picture of a cloth; an empty one of this size has less than 1 kB.
  (($(in_root cat /tmp/frame.png | wc -c) > 4000)) || fail "the picture is empty"
  in_root python3 -c 'import dpe
motion = dpe.simulate(dpe.Scene.load("/usr/share/dpe/data/side.txt"), 5)
assert motion.positions.shape == (5, 144, 3), motion.positions.shape' ||
      fail "the Python module"
}

if make_root; then
  mkdir "$work/root/packages"
  cp "$work"/packages/*.deb "$work/root/packages"
  in_root() { chroot "$work/root" env OPENBLAS_NUM_THREADS=1 "$@"; }
  # The viewer draws with Mesa's software driver, which it recommends.
  # shellcheck disable=SC2016
  quietly in_root env DEBIAN_FRONTEND=noninteractive sh -c \
      'apt-get install -y -q --no-install-recommends /packages/dpe_*.deb \
           /packages/dpe-viewer_*.deb /packages/python3-dpe_*.deb mesa-vulkan-drivers'
  if in_root sh -c 'ls /usr/include/eigen3 /usr/bin/g++' > /dev/null 2>&1; then
    fail "the root is not clean: it has what dpe is built with"
  fi
  use_packages
  echo "installed and used in a clean root"
else
  for name in dpe dpe-viewer python3-dpe; do dpkg-deb -x "$(package $name)" "$work/tree"; done
  libraries="$(dirname "$(find "$work/tree" -name 'libdpe_engine.so.*' | head -n 1)")"
  modules="$(dirname "$(dirname "$(find "$work/tree" -name '_core*.so')")")"
  # Names below /usr and /tmp mean the folder.
  in_root() {
    local word command=()
    for word in "$@"; do
      word="${word//\/usr\/share\/dpe/$work\/tree\/usr\/share\/dpe}"
      command+=("${word//\/tmp\//$work\/tree\/tmp\/}")
    done
    PATH="$work/tree/usr/bin:$PATH" LD_LIBRARY_PATH="$libraries" PYTHONPATH="$modules" \
        "${command[@]}"
  }
  mkdir -p "$work/tree/tmp"
  use_packages
  echo "NOT in a clean root (that takes root, debootstrap and a mirror): unpacked and used" \
       "with this machine's libraries"
fi
