// Integrates one object from one frame to the next, for rollouts and for the derivative
// passes that take a frame's steps again: from the same checkpoint both come to the
// same states, bit for bit.
#ifndef DPE_ENGINE_FRAME_RUNNER_H_
#define DPE_ENGINE_FRAME_RUNNER_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/simulator.h"
#include "inner_states.h"
#include "integrators/integrator.h"
#include "linear/kept_factor.h"
#include "object_system.h"

namespace dpe {

// Where one frame begins and where its states go; 3N arrays.
struct FrameTarget {
  const double* x0 = nullptr;  // the checkpoint
  const double* v0 = nullptr;
  double* x1 = nullptr;  // after the last step
  double* v1 = nullptr;
  InnerStates* inner = nullptr;  // before that
  int inner_frame = 0;           // its frame there
};

class FrameRunner {
 public:
  FrameRunner(const Scene& scene, const SimulatorOptions& options,
              ObjectSystem* system);

  int num_stages() const { return integrator_->num_stages(); }
  // Whether a frame has states inside.
  bool HasInnerStates() const {
    return scene_.steps_per_frame > 1 || integrator_->num_stages() > 1;
  }

  // Takes the first `num_steps` steps from frame `frame` on.
  //
  // @param kept         where the factorisations of the rollout's first steps go
  // @param failed_step  out: the step within the frame that failed
  StepOutcome Run(int frame, int num_steps, const FrameTarget& target,
                  const std::vector<std::unique_ptr<KeptFactor>>& kept,
                  int* failed_step);

 private:
  StepOutcome Step(int step, const double* x0, const double* v0,
                   const StepResult& result);
  void NameUndefinedForce(const double* x0, const StepResult& result,
                          StepOutcome* outcome) const;

  const Scene& scene_;
  const SimulatorOptions& options_;
  ObjectSystem* system_;
  std::unique_ptr<Integrator> integrator_;
  Eigen::VectorXd v0_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_FRAME_RUNNER_H_
