#!/usr/bin/env bash
# The scripts explain themselves, and refuse options they do not know before they do
# anything.
set -euo pipefail
tools="$(cd "$1" && pwd)"
# shellcheck source=expect.sh
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
cd /

expect "test.sh --help" 0 "test.sh --asan" bash "$tools/test.sh" --help
expect "test.sh, unknown option" 1 "unknown option '--al'" bash "$tools/test.sh" --al
expect "test.sh, usage after it" 1 "test.sh --all" bash "$tools/test.sh" --all nonsense
expect "quickstart.sh --help" 0 "tools/quickstart.sh" bash "$tools/quickstart.sh" --help
expect "quickstart.sh, unknown option" 1 "unknown option '-x'" \
    bash "$tools/quickstart.sh" -x
expect "build.sh without a preset" 1 "PRESET" bash "$tools/build.sh"
expect "build.sh, unknown preset" 1 "nonsense" bash "$tools/build.sh" nonsense
finish
