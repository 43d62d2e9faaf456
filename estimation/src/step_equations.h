// The step equations of all objects and steps, one below the other, as one residual
// vector of the parameters with its sparse Jacobian.
#ifndef DPE_ESTIMATION_STEP_EQUATIONS_H_
#define DPE_ESTIMATION_STEP_EQUATIONS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "dpe/engine/simulator.h"
#include "observed_motion.h"

namespace dpe {

class StepEquations {
 public:
  // The simulator must outlive this object; every simulated object must be observed.
  StepEquations(Simulator* simulator, const Observations& observations, int num_frames);

  // Adds the row  sum of the masses of `object`'s free vertices = total_mass (kg),
  // weighted like the other rows.
  void FixTotalMass(int object, double total_mass, double weight);

  int num_parameters() const { return simulator_->layout().size(); }
  const std::vector<int>& objects() const { return objects_; }
  const ObservedMotion& motion(int object) const;

  // @param residual  all rows, kg m/s
  // @param jacobian  if not null, receives d(residual)/dp
  void Evaluate(const Eigen::VectorXd& parameters, Eigen::VectorXd* residual,
                Eigen::SparseMatrix<double>* jacobian) const;

  // The part of the last gauge-free residual that belongs to one object, RMS per row.
  double ObjectRms(const Eigen::VectorXd& residual, int object) const;

 private:
  struct TotalMassRow {
    Eigen::VectorXd coefficients;  // one per parameter, weighted
    double rhs = 0.0;
  };

  Simulator* simulator_;
  std::vector<int> objects_;
  std::vector<ObservedMotion> motions_;  // one per entry of objects_
  std::vector<int> first_rows_;          // the same, and the total at the end
  std::vector<TotalMassRow> total_mass_rows_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_STEP_EQUATIONS_H_
