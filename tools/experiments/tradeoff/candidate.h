// What a trade-off experiment varies: a scene by name, and the settings with which it
// is simulated.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_CANDIDATE_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_CANDIDATE_H_

#include <string>
#include <vector>

#include "dpe/engine/quality.h"
#include "dpe/engine/scene.h"
#include "dpe/engine/simulator.h"
#include "experiments/record.h"

namespace dpe::experiments::tradeoff {

struct Candidate {
  std::string scene = "side";
  int resolution = 12;  // vertices per side of the cloth
  int frames = 101;     // the initial state included
  StepSettings settings{IntegrationMethod::kTrBdf2, 1, "cholesky", 1e-5, 1e-13};
  int max_newton_iterations = SimulatorOptions().max_newton_iterations;
};

// Keys: scene, resolution, frames, integrator, steps, solver, tolerance,
// newton_tolerance, newton_iterations; those that are missing are as above.
// @throws SceneError naming a value that is not accepted
Candidate CandidateFromRecord(const Record& record);
void SetCandidate(const Candidate& candidate, Record* record);

// "tr_bdf2 x2 cg 1e-05 newton 1e-06": settings as a table shows them; what does not
// matter to a method is left out.
std::string SettingsText(const StepSettings& settings);

// The legacy scene of that name (data/NAME.txt for 12 vertices per side, see
// make_scene), with frames of 20 ms and the candidate's settings. Of its springs those
// of equal stiffness are a group: mode R can represent the truth.
//
// @param uniform  all springs have the mean stiffness, so that mode G can, too
Scene CandidateScene(const Candidate& candidate, bool uniform = false);

SimulatorOptions CandidateOptions(const Candidate& candidate);

// Whether Newton's method, or a linear solver, has a part in the method's step.
bool UsesNewton(IntegrationMethod method);
bool UsesLinearSolver(IntegrationMethod method);

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_CANDIDATE_H_
