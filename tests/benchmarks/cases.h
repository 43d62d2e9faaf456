// What is measured: the scenes, grids and integration methods that all benchmarks
// share.
#ifndef DPE_TESTS_BENCHMARKS_CASES_H_
#define DPE_TESTS_BENCHMARKS_CASES_H_

#include <string>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene.h"

namespace dpe::bench {

// The methods to measure; another one is one more line.
constexpr IntegrationMethod kMethods[] = {
    IntegrationMethod::kLinearlyImplicitEuler,
    IntegrationMethod::kImplicitEuler,
    IntegrationMethod::kTrBdf2,
};

// A square grid of `size` x `size` vertices and how much of it to simulate: fewer
// frames of larger cloths, so that a run of everything stays a matter of minutes.
struct GridPlan {
  int size;
  int num_frames;    // the initial state included, as everywhere
  int num_rollouts;  // measured in one repetition
};

constexpr GridPlan kGrids[] = {
    {12, 100, 2}, {24, 51, 1}, {48, 16, 1}, {96, 6, 1}, {192, 3, 1},
};

// The linear solvers that a scene can name: "cholesky" solves to rounding whatever the
// scene's tolerance, "cg" to that tolerance, "auto" is the engine's choice.
constexpr const char* kSolvers[] = {"cholesky", "cg", "auto"};
constexpr double kTolerance = 1e-5;

struct Case {
  ScenePreset preset = ScenePreset::kSide;
  std::string preset_name = "side";
  IntegrationMethod method = IntegrationMethod::kLinearlyImplicitEuler;
  GridPlan plan = kGrids[0];
  std::string solver = "auto";
};

// The preset's cloth of 7 m on the case's grid; every stiffness is to be estimated
// (nL).
Scene MakeScene(const Case& c);

// "<what>/<preset>/<solver>/method:<number>/grid:<size>", which table.py takes apart
// again; with "/slow:1" at its end for cases that take half a minute or more, see
// README.md.
std::string CaseName(const std::string& what, const Case& c);

}  // namespace dpe::bench

#endif  // DPE_TESTS_BENCHMARKS_CASES_H_
