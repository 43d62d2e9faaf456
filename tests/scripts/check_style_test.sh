#!/usr/bin/env bash
# A small project that obeys every rule must pass tools/check_style.sh; each of the
# broken variants below must be refused with a message that names file and rule.
set -euo pipefail
tools="$(cd "$1" && pwd)"
# shellcheck source=expect.sh
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
root="$scratch/project"

# put FILE [LINE...]: writes a file of the small project.
put() {
  local file="$root/$1"
  shift
  mkdir -p "$(dirname "$file")"
  printf '%s\n' "$@" > "$file"
}

# lines N TEXT: N times the same line.
lines() {
  local i
  for ((i = 0; i < $1; ++i)); do echo "$2"; done
}

clean_project() {
  rm -rf "$root"
  mkdir -p "$root"
  cp "$tools/../.clang-format" "$root"
  local folder
  for folder in . engine engine/src/forces estimation estimation/examples \
                estimation/src/linear tools viewer tests tests/engine tests/estimation; do
    put "$folder/README.md" "What lives here."
  done
  put engine/include/dpe/engine/scene.h "int Scene();"
  put engine/src/forces/spring.h '#include <ceres/jet.h>' "int Spring();"
  put engine/src/forces/spring.cc '#include "forces/spring.h"' "" \
      '#include "dpe/engine/scene.h"' "// not std::cout, nor printf(\"\")" \
      'int Spring() { return Scene() + snprintf(nullptr, 0, ""); }'
  put engine/src/scene_io.cc '#include <nlohmann/json.hpp>' "int Scene() { return 0; }"
  put estimation/src/fit.cc '#include <ceres/ceres.h>' "" \
      '#include "dpe/engine/scene.h"' '#include "linear/qr.h"' \
      "int Fit() { return Scene(); }"
  put estimation/src/linear/qr.h "int Qr();"
  put estimation/examples/fit.cc '#include <ceres/ceres.h>' "" '#include <cstdio>' "" \
      'int main() { std::printf("1"); }'
  put tools/fit_cloth.cc '#include <gflags/gflags.h>' "" '#include <iostream>' \
      "int main() { std::cout << 1; }"
  put viewer/main.cc '#include <gflags/gflags.h>' "" "int main() { std::cerr << 1; }"
  put viewer/window.cc '#include <GLFW/glfw3.h>' '#include <vulkan/vulkan.h>'
  put tests/engine/spring_test.cc '#include "forces/spring.h"' "" \
      '#include <nlohmann/json.hpp>'
}

# refused NAME PATTERN: the project as it stands must be refused; starts afresh.
refused() {
  expect "$1" 1 "$2" bash "$tools/check_style.sh" --root "$root"
  clean_project
}

clean_project
expect "a clean project passes" 0 "no violation" \
    bash "$tools/check_style.sh" --root "$root"
expect "an unknown option is refused" 1 "check_style.sh" \
    bash "$tools/check_style.sh" --frobnicate

rm "$root/engine/src/forces/README.md"
refused "a folder without README" "^engine/src/forces: has no README.md"

if [[ "$(clang-format --version 2> /dev/null)" == *"version 14."* ]]; then
  put engine/src/untidy.cc "int   Untidy( ){return 1 ;}"
  refused "bad format" "^engine/src/untidy.cc: not formatted"
  put .clang-format "NoSuchOption: 1"
  refused "a broken .clang-format" "clang-format.* failed"
fi

# Sizes. The clean project has eight short files.
# shellcheck disable=SC2046
put engine/src/long.cc $(lines 401 "//")
refused "a very long file" "95th percentile of files is 401 lines"
for i in 1 2 3 4 5 6 7 8 9 10 11; do
  # shellcheck disable=SC2046
  put "engine/src/middling$i.cc" $(lines 126 "//")
done
refused "files too long as a rule" "the median file is 126 lines"
# shellcheck disable=SC2046
put engine/src/long_function.cc "int Long(int a," "         int b) {" \
    $(lines 60 ";") "}"
refused "a long function" "95th percentile of functions is 63 lines"
# shellcheck disable=SC2046
put tests/engine/long_test.cc $(lines 500 "//")
expect "the size of tests is free" 0 "" bash "$tools/check_style.sh" --root "$root"
clean_project

# Dependencies.
put engine/src/optimise.cc '#include <ceres/problem.h>'
refused "Ceres in the engine" "^engine/src/optimise.cc:1: Ceres belongs to estimation"
put engine/include/dpe/engine/jet.h '#include <ceres/jet.h>'
refused "ceres/jet.h in a public header" "engine/jet.h:1: Ceres belongs to estimation"
put tools/fit.cc '#  include "ceres/ceres.h"'
refused "Ceres in a program" "^tools/fit.cc:1: Ceres"
put estimation/src/window.cc "" '#include <GLFW/glfw3.h>'
refused "GLFW outside viewer" "^estimation/src/window.cc:2: Vulkan and GLFW"
put engine/src/device.cc '#include <vulkan/vulkan.h>'
refused "Vulkan outside viewer" "^engine/src/device.cc:1: Vulkan and GLFW"
put engine/src/scene.cc '#include <nlohmann/json.hpp>'
refused "JSON outside *_io files" "^engine/src/scene.cc:1: JSON belongs"
put estimation/src/flags.cc '#include <gflags/gflags.h>'
refused "flags in a library" "^estimation/src/flags.cc:1: flags belong to tools"
put viewer/options.cc '#include <gflags/gflags.h>'
refused "flags in the viewer but for its program" "^viewer/options.cc:1: flags belong"
put viewer/say.cc "void Say() { std::cerr << 1; }"
refused "std::cerr in the viewer but for its program" "^viewer/say.cc:1: only the programs"
put engine/src/say.cc "void Say() { std::cout << 1; }"
refused "std::cout in a library" "^engine/src/say.cc:1: only the programs"
put engine/src/say.cc 'void Say() { std::printf("1"); }'
refused "printf in a library" "^engine/src/say.cc:1: only the programs"
put estimation/src/say.cc 'void Say() { fprintf(stderr, "1"); }'
refused "stderr in a library" "^estimation/src/say.cc:1: only the programs"
put engine/src/up.cc '#include "dpe/estimation/fit.h"'
refused "the engine includes estimation" "^engine/src/up.cc:1: the engine includes"
put estimation/src/up.cc '#include "dpe/viewer/window.h"'
refused "estimation includes the viewer" "^estimation/src/up.cc:1: estimation includes"
put estimation/src/peek.cc '#include "forces/spring.h"'
refused "another room's private header" "peek.cc:1: private header of engine"
put tools/peek.cc '#include "forces/spring.h"'
refused "a program includes a private header" "peek.cc:1: private header of engine"
put tests/engine/peek_test.cc '#include "linear/qr.h"'
refused "a test includes another room's private header" "private header of estimation"
put tests/benchmarks/README.md "What lives here."
put tests/benchmarks/floor.cc '#include "forces/spring.h"'
expect "a benchmark may include the engine's private headers" 0 "" \
    bash "$tools/check_style.sh" --root "$root"
put tests/benchmarks/floor.cc '#include "linear/qr.h"'
refused "a benchmark includes another's" "private header of estimation: linear/qr.h"
put estimation/src/path.cc '#include "../../engine/src/forces/spring.h"'
refused "include by path" "^estimation/src/path.cc:1: include by path"
put engine/include/dpe/engine/leak.h '#include "forces/spring.h"'
refused "a public header includes a private one" "leak.h:1: a public header includes"

# In a git repository: what git ignores is not looked at, new files are.
if command -v git > /dev/null; then
  git -C "$root" init -q
  echo "/build*/" > "$root/.gitignore"
  put build/generated.cc "void Say() { std::cout << 1; }"
  expect "ignored files are not looked at" 0 "" \
      bash "$tools/check_style.sh" --root "$root"
  put viewer/options.cc '#include <gflags/gflags.h>'
refused "flags in the viewer but for its program" "^viewer/options.cc:1: flags belong"
put viewer/say.cc "void Say() { std::cerr << 1; }"
refused "std::cerr in the viewer but for its program" "^viewer/say.cc:1: only the programs"
put engine/src/say.cc "void Say() { std::cout << 1; }"
  refused "new files are looked at" "^engine/src/say.cc:1"
fi
finish
