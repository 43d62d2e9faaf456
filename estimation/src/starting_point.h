// Where the optimiser starts: one function per InitMethod.
#ifndef DPE_ESTIMATION_STARTING_POINT_H_
#define DPE_ESTIMATION_STARTING_POINT_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/estimation/estimator.h"
#include "dpe/estimation/trajectory_evaluator.h"
#include "stop_control.h"

namespace dpe {

struct StartingPoint {
  bool ok = false;
  std::string message;          // why not
  Eigen::VectorXd coordinates;  // of ParameterMap
  std::string init;             // the method that gave it
  std::vector<std::string> notes;
};

// The sum of the masses of each object's free vertices, kg.
std::vector<double> FreeMass(const Scene& scene);

// The same, NaN for objects whose scale a prior on mass, stiffness or drag fixes.
std::vector<double> MassToKeep(const Scene& scene, const std::vector<Prior>& priors);

// True if scaling all unknown masses, stiffnesses and drags of `object` together leaves
// its motion unchanged: mass and stiffness are unknown, drag is zero or unknown, and
// there are no colliders.
bool ScaleIsFree(const Scene& scene, int object);

// The note that says so.
std::string ScaleNote(int object, double free_mass);

// Scales the parameters of objects with a free scale so that the masses of their free
// vertices add up to `free_mass` (kg, one per object; NaN: leave as it is).
// @return  one note per such object
std::vector<std::string> NormaliseScale(const Scene& scene,
                                        const ParameterLayout& layout,
                                        const std::vector<double>& free_mass,
                                        Eigen::VectorXd* parameters);

// Finds the start that `options` ask for. `scene` is the caller's: of its estimated
// quantities only the total masses are read, and all of them for InitMethod::kScene.
// @param evaluator  of the fit; rollouts are run with it
StartingPoint FindStartingPoint(const Scene& scene, const Observations& observations,
                                const EstimatorOptions& options, StopControl* stop,
                                TrajectoryEvaluator* evaluator);

// Log-spaced trial values, one common value per parameter block, on a short horizon
// first, then the best few over all frames. Blocks that are not positive by nature
// start at 0.
StartingPoint ScreenStartingPoints(StopControl* stop, TrajectoryEvaluator* evaluator);

// Looks for log-spaced values of single parameters, the others as at the best point so
// far, that give a lower cost than that point.
// @return  the coordinates of the best such trial point; empty if there is none
Eigen::VectorXd FindBetterTrialPoint(StopControl* stop, TrajectoryEvaluator* evaluator);

}  // namespace dpe

#endif  // DPE_ESTIMATION_STARTING_POINT_H_
