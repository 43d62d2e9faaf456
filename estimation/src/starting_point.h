// Where the optimiser starts: one function per InitMethod.
#ifndef DPE_ESTIMATION_STARTING_POINT_H_
#define DPE_ESTIMATION_STARTING_POINT_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/estimation/estimator.h"
#include "dpe/estimation/trajectory_evaluator.h"
#include "fit_setup.h"
#include "stop_control.h"

namespace dpe {

struct StartingPoint {
  bool ok = false;
  std::string message;          // why not
  Eigen::VectorXd coordinates;  // of ParameterMap
  std::string init;             // the method that gave it
  std::vector<std::string> notes;
};

// The sum of the masses of each object's vertices that are free in any capture, kg.
std::vector<double> FreeMass(const std::vector<CaptureView>& captures);

// The same, NaN for objects whose scale a prior on mass, stiffness or drag fixes.
std::vector<double> MassToKeep(const std::vector<CaptureView>& captures,
                               const std::vector<Prior>& priors);

// True if scaling all unknown masses, stiffnesses and drags of `object` together leaves
// its motion unchanged: mass and stiffness are unknown, drag is zero or unknown, and
// no capture has colliders.
bool ScaleIsFree(const std::vector<CaptureView>& captures, int object);

// @throws SceneError if the captures give different masses to an object with a free
//         scale
void RequireOneMass(const std::vector<CaptureView>& captures);

// The note that says so.
std::string ScaleNote(int object, double free_mass);

// Scales the parameters of objects with a free scale so that the masses of their free
// vertices add up to `free_mass` (kg, one per object; NaN: leave as it is).
// @return  one note per such object
std::vector<std::string> NormaliseScale(const std::vector<CaptureView>& captures,
                                        const ParameterLayout& layout,
                                        const std::vector<double>& free_mass,
                                        Eigen::VectorXd* parameters);

// What a start is looked for with.
struct StartContext {
  // The caller's: of the scenes' estimated quantities only the total masses are read,
  // and all of them for InitMethod::kScene.
  const std::vector<CaptureView>* given = nullptr;
  const std::vector<FitCapture>* captures = nullptr;  // what is fitted of them
  const EstimatorOptions* options = nullptr;
  StopControl* stop = nullptr;
  TrajectoryEvaluator* evaluator = nullptr;  // of the fit; rollouts are run with it
};

// Finds the start that the options ask for. Inverse dynamics is of all captures
// together that are observed completely; a note says so if others are not.
StartingPoint FindStartingPoint(const StartContext& context);

// True if every capture is observed completely.
bool AllAreComplete(const std::vector<FitCapture>& captures);

// Log-spaced trial values, one common value per parameter block, on a short horizon
// first, then the best few over all frames. Blocks that are not positive by nature
// start at 0.
StartingPoint ScreenStartingPoints(StopControl* stop, TrajectoryEvaluator* evaluator);

// By what fraction of the cost a point has to be lower to be worth another fit.
constexpr double kBetter = 1e-6;

// Looks for log-spaced values of single parameters, the others as at the best point so
// far, that give a lower cost than that point.
// @return  the coordinates of the best such trial point; empty if there is none
Eigen::VectorXd FindBetterTrialPoint(StopControl* stop, TrajectoryEvaluator* evaluator);

}  // namespace dpe

#endif  // DPE_ESTIMATION_STARTING_POINT_H_
