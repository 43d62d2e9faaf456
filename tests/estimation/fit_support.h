// What the tests of whole fits share.
#ifndef DPE_TESTS_ESTIMATION_FIT_SUPPORT_H_
#define DPE_TESTS_ESTIMATION_FIT_SUPPORT_H_

#include <algorithm>
#include <string>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/observations.h"

namespace dpe::test {

inline SimulatorOptions OnlyEstimatedObjects() {
  SimulatorOptions options;
  options.only_estimated_objects = true;
  return options;
}

// The motion that the scene's own parameters make.
inline Observations OwnMotion(const Scene& scene, int num_frames) {
  return ObserveAll(Simulator(scene, OnlyEstimatedObjects()).Simulate(num_frames));
}

// RMS of the summary's scene, simulated afresh.
inline double RmsOfScene(const Scene& scene, const Observations& target,
                         int num_frames) {
  return RmsPositionError(Simulator(scene, OnlyEstimatedObjects()).Simulate(num_frames),
                          target, num_frames);
}

// The scene with everything that is estimated overwritten by `value`.
inline Scene WithEstimatesOverwritten(Scene scene, double value) {
  const ParameterLayout layout(scene);
  layout.Insert(Eigen::VectorXd::Constant(layout.size(), value), &scene);
  return scene;
}

inline bool HasNote(const EstimatorSummary& summary, const std::string& part) {
  return std::any_of(
      summary.notes.begin(), summary.notes.end(),
      [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

}  // namespace dpe::test

#endif  // DPE_TESTS_ESTIMATION_FIT_SUPPORT_H_
