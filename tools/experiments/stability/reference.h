// The motion that the cells of the stability experiment are compared with.
//
// TR-BDF2 (second order, L-stable) with ever shorter steps, 4, 8, 16 ... to the cell's
// one, until halving the step changes the motion by little. What the last halving
// changed is taken as the error of what it led to, although a second-order method
// leaves only a third of it. Where TR-BDF2 does not get there, symplectic Euler tries.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_REFERENCE_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_REFERENCE_H_

#include <Eigen/Core>

#include "dpe/engine/scene.h"

namespace dpe::experiments {

struct Reference {
  bool available = false;
  Eigen::MatrixXd positions;  // 3N x frames, m
  double motion = 0.0;        // m, root mean square of the displacement from the start
  double error = 0.0;         // m, root mean square, estimated as above
  IntegrationMethod method = IntegrationMethod::kTrBdf2;
  int refinement = 0;  // steps of it to one of the cell
  bool converged = false;
};

// Root mean square over frames and free vertices of the difference (m).
double RmsDifference(const ClothObject& object, const Eigen::MatrixXd& a,
                     const Eigen::MatrixXd& b);

// @param tolerance  the error that is small enough, as a fraction of the motion
Reference ComputeReference(const Scene& scene, int num_frames, double tolerance);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_REFERENCE_H_
