// Inverse dynamics: parameters from observed positions without simulating.
//
// With every free vertex observed, velocities follow from the positions,
//   v_{n+1} = (x_{n+1} - x_n) / h   (methods 1, 2, 3; v_0 is the scene's),
//   v_n     = (x_{n+1} - x_n) / h   (method 0; the last step has no equation),
// and the step equations r(x_n, v_n, x_{n+1}, v_{n+1}; p) = 0 of all steps, put one
// below the other, are an overdetermined system for p.
//
// What is linear in what: r is linear in (mass, stiffness, drag) for a given damping
// and wind, in damping for given mass and stiffness (the damping coefficients multiply
// both), and in wind for a given drag. So mass, stiffness and drag together are one
// sparse linear least-squares problem; where damping, or wind together with drag, is
// unknown too, the products are taken care of by Gauss-Newton steps from 0.
//
// The gauge: if mass is unknown and no known force acts on an object (its drag is zero
// or unknown and it touches no collider), its equations are homogeneous: scaling mass,
// stiffness and drag together changes nothing. The sum of the masses of its free
// vertices is then kept at a given value.
//
// Exactness: every integration method's step is linear as said, so with one step per
// frame and exact positions the answer is exact but for rounding. With several steps
// per frame a frame is treated as one step, which is an approximation: a start for a
// fit. So it is with noise, which the second differences amplify by 1/h^2.
#ifndef DPE_ESTIMATION_INVERSE_DYNAMICS_H_
#define DPE_ESTIMATION_INVERSE_DYNAMICS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/joint_layout.h"
#include "dpe/estimation/observations.h"

namespace dpe {

struct InverseDynamicsResult {
  bool ok = false;
  std::string message;         // why not
  Eigen::VectorXd parameters;  // layout order, SI units; positive kinds are > 0
  double residual_norm = 0.0;  // of all step equations at the solution, kg m/s
  int iterations = 0;          // linear solves
  // Parameters that the motion does not determine; they take their block's median.
  std::vector<int> undetermined;
  std::vector<std::string> notes;  // gauges fixed, values clamped, ...
};

// Solves for the parameters of simulator->layout().
//
// @param simulator     of a scene whose estimated objects are all observed completely;
//                      its values of estimated parameters are not used
// @param observations  positions, m
// @param num_frames    frames to use, at least 2 (3 for method 0 or unknown initial
//                      velocities)
// @param total_mass    one per object, kg: the sum of the masses of the free vertices,
//                      used only where the gauge needs it
// @throws SceneError if an estimated object is not observed completely
DPE_ESTIMATION_API InverseDynamicsResult
SolveInverseDynamics(Simulator* simulator, const Observations& observations,
                     int num_frames, const std::vector<double>& total_mass);

// One of several motions of the same cloths.
struct InverseDynamicsMotion {
  Simulator* simulator = nullptr;              // of the segment's scene
  const Observations* observations = nullptr;  // complete
  int num_frames = 0;
  int segment = 0;  // of the joint layout
};

// The same for the equations of several motions, one below the other: one system for
// what they share and what each has for itself. Segments of the layout without a motion
// have no equations; what they alone depend on is undetermined.
//
// @param motions     of the layout's segments
// @param joint       the parameters to solve for
// @param total_mass  one per object, kg: of the vertices that are free in any segment
// @throws SceneError as above
DPE_ESTIMATION_API InverseDynamicsResult
SolveInverseDynamics(const std::vector<InverseDynamicsMotion>& motions,
                     const JointLayout& joint, const std::vector<double>& total_mass);

// True if every estimated object of the scene is observed completely.
DPE_ESTIMATION_API bool InverseDynamicsApplies(const Scene& scene,
                                               const Observations& observations);

}  // namespace dpe

#endif  // DPE_ESTIMATION_INVERSE_DYNAMICS_H_
