#!/usr/bin/env bash
# Installs the packages that dpe is built on, as far as they are missing.
#
#   tools/install_dependencies.sh            what the programs need
#   tools/install_dependencies.sh --tests    and what the tests need
#
# Debian and Ubuntu (apt-get), Fedora (dnf), macOS (Homebrew). On any other system it
# prints what is needed and goes on: the packages may be there under other names.
# DPE_SKIP_INSTALL=1 makes it do nothing.
set -euo pipefail

usage() {
  sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
}

fail() {
  echo "install_dependencies: $*" >&2
  exit 1
}

# A list per part of the project: libraries and programs, viewer, Python module,
# run_experiments' plots; then the same for what only tests need (Slurm and munge for
# campaigns on a cluster, Mono for the Unity package; Doxygen for the API reference, clang
# with libFuzzer, and what makes Debian packages and a clean root to try them in).
apt_packages="g++ cmake make git pkg-config ccache libceres-dev libsuitesparse-dev
  libeigen3-dev libgoogle-glog-dev libgflags-dev nlohmann-json3-dev
  libopenblas-pthread-dev libtinyobjloader-dev
  libvulkan-dev mesa-vulkan-drivers glslang-tools libglfw3-dev libimgui-dev libglm-dev
  libstb-dev
  python3-dev python3-numpy pybind11-dev
  gnuplot-nox"
apt_test_packages="libgtest-dev libgmock-dev libbenchmark-dev clang-format valgrind
  vulkan-validationlayers xvfb xauth xdotool ffmpeg
  python3-pytest python3-scipy python3-matplotlib python3-pip python3-setuptools
  python3-wheel
  slurmctld slurmd slurm-client munge
  mono-mcs mono-runtime
  doxygen clang llvm libclang-rt-dev binutils file dpkg-dev fakeroot debootstrap"
dnf_packages="gcc-c++ cmake make git pkgconf-pkg-config ccache ceres-solver-devel
  suitesparse-devel eigen3-devel glog-devel gflags-devel json-devel openblas-devel
  tinyobjloader-devel
  vulkan-loader-devel vulkan-headers mesa-vulkan-drivers glslang glfw-devel glm-devel
  stb-devel
  python3-devel python3-numpy pybind11-devel
  gnuplot"
dnf_test_packages="gtest-devel gmock-devel google-benchmark-devel clang-tools-extra
  valgrind
  vulkan-validation-layers xorg-x11-server-Xvfb xorg-x11-xauth xdotool ffmpeg-free
  python3-pytest python3-scipy python3-matplotlib python3-pip python3-setuptools
  python3-wheel
  slurm-slurmctld slurm-slurmd slurm munge
  mono-core
  doxygen clang compiler-rt"
brew_packages="cmake git pkg-config ccache ceres-solver suite-sparse eigen glog gflags
  nlohmann-json openblas tinyobjloader
  vulkan-loader vulkan-headers molten-vk glslang glfw glm
  numpy pybind11
  gnuplot"
brew_test_packages="googletest google-benchmark clang-format
  vulkan-validationlayers ffmpeg
  scipy
  mono
  doxygen llvm"

# as_root COMMAND...: directly where we are root, through sudo otherwise.
as_root() {
  if [[ "$(id -u)" == 0 ]]; then
    "$@"
  elif command -v sudo > /dev/null; then
    sudo "$@"
  else
    fail "not root and there is no sudo; run as root: $*"
  fi
}

# DPkg::Lock::Timeout makes apt-get wait for another package manager to finish, but only
# where it locks the package database; `update` locks the lists and fails at once.
apt_update() {
  local log waited=0
  log="$(mktemp)"
  until as_root env LC_ALL=C apt-get update < /dev/null > "$log" 2>&1; do
    if ((waited >= 600)) || ! grep -qi 'could not get lock' "$log"; then
      cat "$log" >&2
      echo "install_dependencies: the package lists could not be renewed;" \
           "trying with those that are there" >&2
      break
    fi
    ((waited > 0)) || echo "Waiting for another package manager to finish ..."
    sleep 5
    waited=$((waited + 5))
  done
  rm -f "$log"
}

apt_is_installed() {
  [[ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2> /dev/null)" == installed ]]
}

install_with_apt() {
  local package missing="" unknown="" left=""
  for package in "$@"; do
    apt_is_installed "$package" || missing+=" $package"
  done
  if [[ -z "$missing" ]]; then
    return
  fi
  echo "Installing:$missing"
  apt_update
  for package in $missing; do
    apt-cache show "$package" > /dev/null 2>&1 || unknown+=" $package"
  done
  if [[ -n "$unknown" ]]; then
    fail "apt knows no package of this name:$unknown (see the README for what is needed" \
         "and which systems have it)"
  fi
  # shellcheck disable=SC2086  # a list of names
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q \
      --no-install-recommends -o DPkg::Lock::Timeout=600 $missing < /dev/null || true
  for package in $missing; do
    apt_is_installed "$package" || left+=" $package"
  done
  if [[ -n "$left" ]]; then
    fail "could not be installed:$left (the reason is in apt-get's output above)"
  fi
}

install_with_dnf() {
  local package missing=""
  for package in "$@"; do
    rpm -q --quiet "$package" || missing+=" $package"
  done
  if [[ -n "$missing" ]]; then
    echo "Installing:$missing"
    # shellcheck disable=SC2086  # a list of names
    as_root dnf install -y $missing || fail "dnf could not install all of:$missing"
  fi
}

install_with_brew() {
  local package missing=""
  for package in "$@"; do
    brew list --formula "$package" > /dev/null 2>&1 || missing+=" $package"
  done
  if [[ -n "$missing" ]]; then
    echo "Installing:$missing"
    # shellcheck disable=SC2086  # a list of names
    brew install $missing || fail "brew could not install all of:$missing"
  fi
}

with_tests=0
for argument in "$@"; do
  case "$argument" in
    --tests) with_tests=1 ;;
    --help | -h) usage; exit 0 ;;
    *) echo "install_dependencies: unknown option '$argument'" >&2; usage >&2; exit 1 ;;
  esac
done
if [[ "${DPE_SKIP_INSTALL:-0}" == 1 ]]; then
  exit 0
fi
if [[ "$with_tests" == 1 ]]; then
  apt_packages+=" $apt_test_packages"
  dnf_packages+=" $dnf_test_packages"
  brew_packages+=" $brew_test_packages"
fi

# shellcheck disable=SC2086  # the lists are meant to be split
if command -v apt-get > /dev/null && command -v dpkg-query > /dev/null; then
  install_with_apt $apt_packages
elif command -v dnf > /dev/null; then
  install_with_dnf $dnf_packages
elif command -v brew > /dev/null; then
  install_with_brew $brew_packages
else
  echo "No package manager known to this script was found. dpe needs (Debian's names):"
  # shellcheck disable=SC2086
  printf '  %s\n' $apt_packages
fi
