#!/usr/bin/env bash
# tools/install_dependencies.sh against stand-ins for the package tools, which write down
# how they were called: what is installed stays untouched, what is missing is installed in
# one go, and what cannot be installed is named.
set -euo pipefail
script="$(cd "$1" && pwd)/install_dependencies.sh"
# shellcheck source=expect.sh
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

# stand_in NAME: a program of this name whose body is read from standard input.
stand_in() {
  { echo "#!$BASH"; echo "state='$scratch'"; cat; } > "$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}

mkdir "$scratch/bin"
# $scratch/installed holds one name per line, $scratch/refused what cannot be installed.
stand_in dpkg-query << 'END'
grep -qx -- "${!#}" "$state/installed" && printf installed
END
stand_in apt-cache << 'END'
! grep -qx -- "$2" "$state/unknown"
END
stand_in id << 'END'
cat "$state/user"
END
stand_in sudo << 'END'
echo "sudo $*" >> "$state/calls"
exec "$@"
END
stand_in apt-get << 'END'
echo "apt-get $*" >> "$state/calls"
if [[ "$1" == update ]]; then
  if [[ -s "$state/update_error" ]]; then
    cat "$state/update_error" >&2
    : > "$state/update_error"
    exit 100
  fi
  exit 0
fi
for argument in "$@"; do
  grep -qx -- "$argument" "$state/refused" || echo "$argument" >> "$state/installed"
done
! [[ -s "$state/refused" ]]
END
stand_in sleep << 'END'
true
END

# run [OPTION...]: the script, seeing the stand-ins first.
run() {
  PATH="$scratch/bin:$PATH" DPE_SKIP_INSTALL="${skip:-0}" "$BASH" "$script" "$@"
}

# fresh: nothing installed, nothing refused, user root.
fresh() {
  : > "$scratch/calls"
  : > "$scratch/installed"
  : > "$scratch/unknown"
  : > "$scratch/refused"
  : > "$scratch/update_error"
  echo 0 > "$scratch/user"
}

calls() { cat "$scratch/calls"; }
no_calls() { [[ ! -s "$scratch/calls" ]]; }

fresh
expect "a bare machine" 0 "Installing: g\+\+ cmake" run
expect "everything in one call" 0 "install -y .*g\+\+ .*libceres-dev .*libeigen3-dev" \
    calls
expect "other package managers are waited for" 0 "DPkg::Lock::Timeout=[1-9]" calls
expect "the tests' packages are left out" 1 "" grep -q libgtest-dev "$scratch/calls"
: > "$scratch/calls"
expect "run again" 0 "" run
expect "nothing is missing: apt-get is not called" 0 "" no_calls
expect "the tests need more" 0 "Installing: libgtest-dev libgmock-dev .*valgrind" run --tests
expect "only that is installed" 1 "" grep -q libceres-dev "$scratch/calls"

fresh
echo 1000 > "$scratch/user"
expect "not root" 0 "" run
expect "sudo is used" 0 "^sudo env .*apt-get install" calls

fresh
echo libceres-dev > "$scratch/unknown"
expect "a package that the system does not have" 1 \
    "knows no package of this name: libceres-dev" run
fresh
echo libgflags-dev > "$scratch/refused"
expect "a package that fails to install" 1 \
    "could not be installed: libgflags-dev" run

fresh
echo "E: Could not get lock /var/lib/apt/lists/lock" > "$scratch/update_error"
expect "the lists are locked for a while" 0 "Waiting for another" run
fresh
echo "E: no network" > "$scratch/update_error"
expect "the lists cannot be renewed" 0 "no network" run

fresh
skip=1 expect "installation switched off" 0 "" run
expect "then nothing is called" 0 "" no_calls
expect "unknown option" 1 "unknown option '--frob'" run --frob
expect "help" 0 "install_dependencies.sh --tests" run --help
finish
