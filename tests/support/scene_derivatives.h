// All derivatives of one rollout, for tests that run the same one in different ways.
#ifndef DPE_TESTS_SUPPORT_SCENE_DERIVATIVES_H_
#define DPE_TESTS_SUPPORT_SCENE_DERIVATIVES_H_

#include <cstddef>
#include <vector>

#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"

namespace dpe::test {

struct SceneDerivatives {
  std::vector<Eigen::MatrixXd> positions, velocities;  // the trajectory
  Eigen::VectorXd gradient;             // of a random functional of all states
  std::vector<Eigen::MatrixXd> dx, dv;  // along a random direction
  RowMajorMatrix tangent, adjoint;      // Jacobians of random rows
  std::size_t kept_bytes = 0;
};

// Rows of every object, frame and several blocks, positions and velocities.
std::vector<StateDerivative> RandomRows(const Scene& scene, int num_frames,
                                        int* num_rows);

// Runs the scene with its own parameters; a failure is a failure of the test.
SceneDerivatives ComputeDerivatives(const Scene& scene, const SimulatorOptions& options,
                                    int num_frames);

// The largest difference of the four derivatives, each relative to its norm; 0 only if
// they are equal bit by bit. Trajectories must be equal; otherwise infinity.
double Distance(const SceneDerivatives& a, const SceneDerivatives& b);

}  // namespace dpe::test

#endif  // DPE_TESTS_SUPPORT_SCENE_DERIVATIVES_H_
