// The step equations of all motions, objects and steps, one below the other, as one
// residual vector of the parameters with its sparse Jacobian.
#ifndef DPE_ESTIMATION_STEP_EQUATIONS_H_
#define DPE_ESTIMATION_STEP_EQUATIONS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include "dpe/engine/simulator.h"
#include "dpe/estimation/inverse_dynamics.h"
#include "dpe/estimation/joint_layout.h"
#include "observed_motion.h"

namespace dpe {

class StepEquations {
 public:
  // Simulators and layout must outlive this object; every simulated object must be
  // observed.
  StepEquations(const std::vector<InverseDynamicsMotion>& motions,
                const JointLayout& joint);

  // Adds the row  sum of the masses of `object`'s free vertices = total_mass (kg),
  // weighted like the other rows.
  void FixTotalMass(int object, double total_mass, double weight);

  int num_parameters() const { return joint_.layout().size(); }
  // Those that are simulated in any motion, ascending.
  const std::vector<int>& objects() const { return objects_; }
  // Null where the object is not simulated in that segment, or the segment has none.
  const ObservedMotion* motion(int object, int segment) const;

  // @param residual  all rows, kg m/s
  // @param jacobian  if not null, receives d(residual)/dp
  void Evaluate(const Eigen::VectorXd& parameters, Eigen::VectorXd* residual,
                Eigen::SparseMatrix<double>* jacobian) const;

  // The part of the last gauge-free residual that belongs to one object, RMS per row of
  // the motion where that is greatest in relation to `unit` of its scene.
  double ObjectRms(const Eigen::VectorXd& residual, int object,
                   const std::function<double(const Scene&)>& unit) const;

 private:
  struct TotalMassRow {
    Eigen::VectorXd coefficients;  // one per parameter, weighted
    double rhs = 0.0;
  };

  // One object of one motion.
  struct Part {
    Simulator* simulator;
    int segment;
    int object;
    ObservedMotion motion;
    int first_row;
    int num_rows;
  };

  const JointLayout& joint_;
  std::vector<Part> parts_;
  std::vector<int> objects_;
  int num_step_rows_ = 0;
  std::vector<TotalMassRow> total_mass_rows_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_STEP_EQUATIONS_H_
