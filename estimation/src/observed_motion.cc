#include "observed_motion.h"

namespace dpe {

ObservedMotion::ObservedMotion(const Scene& scene, int object,
                               const Observations& observations, int num_frames)
    : cloth_(scene.objects[object]),
      is_explicit_(scene.integration_method == IntegrationMethod::kExplicitEuler),
      h_(scene.delta),
      positions_(observations.positions[object].leftCols(num_frames)) {
  positions_.col(0) = cloth_.positions;
  for (int v = 0; v < cloth_.num_vertices(); ++v) {
    if (!cloth_.is_fixed[v]) continue;
    positions_.middleRows<3>(3 * v).colwise() = cloth_.positions.segment<3>(3 * v);
  }
  for (const PrescribedPath& path : cloth_.prescribed_paths) {
    for (int f = 0; f < num_frames; ++f) {
      positions_.col(f).segment<3>(3 * path.vertex) = path.At(f);
    }
  }
  num_steps_ = num_frames - (is_explicit_ ? 2 : 1);
  // The first step's equation has the unknown initial velocity in it.
  if (cloth_.estimate_initial_velocity && !is_explicit_) first_step_ = 1;
}

Eigen::VectorXd ObservedMotion::Difference(int n) const {
  return (positions_.col(n + 1) - positions_.col(n)) / h_;
}

void ObservedMotion::GetStep(int n, Eigen::VectorXd* x0, Eigen::VectorXd* v0,
                             Eigen::VectorXd* x1, Eigen::VectorXd* v1) const {
  *x0 = positions_.col(n);
  *x1 = positions_.col(n + 1);
  const Eigen::VectorXd over_step = Difference(n);
  if (is_explicit_) {
    *v0 = over_step;
    *v1 = Difference(n + 1);
  } else {
    *v0 = n == 0 ? cloth_.velocities : Difference(n - 1);
    *v1 = over_step;
  }
  for (int v = 0; v < cloth_.num_vertices(); ++v) {
    if (!cloth_.is_fixed[v]) continue;
    v0->segment<3>(3 * v) = over_step.segment<3>(3 * v);
    v1->segment<3>(3 * v) = over_step.segment<3>(3 * v);
  }
}

Eigen::VectorXd ObservedMotion::InitialVelocity() const {
  if (is_explicit_) return Difference(0);
  // Differences are the velocities of frames 1 and 2.
  return 2.0 * Difference(0) - Difference(1);
}

}  // namespace dpe
