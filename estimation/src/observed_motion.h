// Positions and velocities of one object before and after every step, from what was
// observed: the states that inverse dynamics puts into the step equations.
#ifndef DPE_ESTIMATION_OBSERVED_MOTION_H_
#define DPE_ESTIMATION_OBSERVED_MOTION_H_

#include <Eigen/Core>

#include "dpe/engine/scene.h"
#include "dpe/estimation/observations.h"

namespace dpe {

class ObservedMotion {
 public:
  // Fixed vertices and the initial state are taken from the scene, the rest from the
  // observations. One frame is one step of length scene.delta.
  ObservedMotion(const Scene& scene, int object, const Observations& observations,
                 int num_frames);

  int first_step() const { return first_step_; }
  int num_steps() const { return num_steps_; }  // equations are first_step ... here - 1

  // 3N states of step n: before it (x0, v0) and after it (x1, v1), m and m/s.
  void GetStep(int n, Eigen::VectorXd* x0, Eigen::VectorXd* v0, Eigen::VectorXd* x1,
               Eigen::VectorXd* v1) const;

  // An estimate of the initial velocity, 3N, m/s: exact for method 0, else extrapolated
  // from the first steps.
  Eigen::VectorXd InitialVelocity() const;

 private:
  Eigen::VectorXd Difference(int n) const;  // (x_{n+1} - x_n) / h

  const ClothObject& cloth_;
  bool is_explicit_;  // method 0: velocities belong to the frame before the step
  double h_;
  Eigen::MatrixXd positions_;  // 3N x F
  int first_step_ = 0;
  int num_steps_ = 0;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_OBSERVED_MOTION_H_
