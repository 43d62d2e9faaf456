// The simulator: rollouts of a scene as a function of its parameter vector.
#ifndef DPE_ENGINE_SIMULATOR_H_
#define DPE_ENGINE_SIMULATOR_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "dpe/engine/export.h"
#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/engine/timings.h"
#include "dpe/engine/trajectory.h"

namespace dpe {

struct SimulatorOptions {
  // Leave out objects without any estimated parameter (nothing couples objects).
  bool only_estimated_objects = false;

  // Threads for independent objects and for the columns of a Jacobian. Results do not
  // depend on it.
  int num_threads = 1;

  // Polled once per step if set, by rollouts and derivative passes; returning true ends
  // a rollout with kInterrupted, and a pass as if a system could not be solved.
  std::function<bool()> interrupted;

  // What a rollout by Run may keep beyond its trajectory (Simulate keeps nothing):
  // states between frames and factorised matrices of steps, which make derivative
  // passes about twice as fast. What does not fit they make again from the frames, to
  // the same result. The default holds the matrices of 200 steps of a cloth of 48 x 48
  // vertices and leaves half of a small machine's 4 GiB to the caller.
  std::size_t memory_limit_bytes = std::size_t{2} << 30;

  // If set, receives where the time went; must outlive the simulator.
  Timings* timings = nullptr;

  // Implicit methods: Newton stops when the residual has fallen to this fraction of its
  // largest term, or no longer falls; more iterations than the limit are a failure.
  double newton_tolerance = 1e-13;
  int max_newton_iterations = 50;
};

class RolloutTape;
class FactorPool;

// A rollout and what its derivative passes need beyond the trajectory's frames.
class DPE_ENGINE_API Rollout {
 public:
  Rollout();
  Rollout(Rollout&&) noexcept;
  Rollout& operator=(Rollout&&) noexcept;
  ~Rollout();

  const Trajectory& trajectory() const { return trajectory_; }
  const RolloutStatus& status() const { return trajectory_.status; }
  // Bytes that it keeps beyond the trajectory, at most the memory limit.
  std::size_t kept_bytes() const;
  // The parameters it was run with.
  const Eigen::VectorXd& parameters() const { return parameters_; }

 private:
  friend class Simulator;
  friend class Sensitivity;
  Trajectory trajectory_;
  Eigen::VectorXd parameters_;
  std::unique_ptr<RolloutTape> tape_;
};

class ObjectSystem;

class DPE_ENGINE_API Simulator {
 public:
  // @throws SceneError if the scene is not valid (see ValidateScene).
  explicit Simulator(const Scene& scene, const SimulatorOptions& options = {});
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  const Scene& scene() const { return scene_; }
  const SimulatorOptions& options() const { return options_; }
  const ParameterLayout& layout() const { return layout_; }
  bool is_simulated(int object) const { return systems_[object] != nullptr; }

  // Simulates `num_frames` frames (states, the initial one included) with the current
  // parameter values: the scene's own, until Run or StepResidual set others.
  Trajectory Simulate(int num_frames);

  // Simulates with `parameters` (layout order, SI units) in place of the scene's values
  // and records what Sensitivity needs. A failure is in the returned status, never an
  // exception.
  Rollout Run(const Eigen::VectorXd& parameters, int num_frames);

  // The step equation r(x0, v0, x1, v1; p) = 0 of the scene's integration method for
  // given states, and its derivative with respect to the parameters. r is *linear* in
  // mass, stiffness, drag (given damping), in damping (given mass and stiffness) and in
  // wind: inverse dynamics rests on this. Unit: kg m/s.
  //
  // @param object       index into Scene::objects
  // @param h            step length, s
  // @param x0,v0,x1,v1  3N states before and after the step; entries of fixed vertices
  //                     in v0 and v1 are the prescribed velocity over the step
  // @param parameters   p, layout order, SI units
  // @param residual     3N; zero at fixed vertices
  // @param jacobian     dr/dp: (row in 0..3N-1, column in layout order); appended to
  void StepResidual(int object, double h, const Eigen::VectorXd& x0,
                    const Eigen::VectorXd& v0, const Eigen::VectorXd& x1,
                    const Eigen::VectorXd& v1, const Eigen::VectorXd& parameters,
                    Eigen::VectorXd* residual,
                    std::vector<Eigen::Triplet<double>>* jacobian);

 private:
  friend class Sensitivity;
  void SetParameters(const Eigen::VectorXd& parameters);
  Trajectory RollOut(int num_frames, RolloutTape* tape);

  Scene scene_;  // with the current parameter values
  Eigen::VectorXd current_parameters_;
  SimulatorOptions options_;
  ParameterLayout layout_;
  std::vector<std::unique_ptr<ObjectSystem>> systems_;  // null: not simulated
  std::vector<std::shared_ptr<FactorPool>> factor_pools_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_SIMULATOR_H_
