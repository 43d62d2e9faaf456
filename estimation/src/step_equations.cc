#include "step_equations.h"

#include <algorithm>
#include <cmath>

namespace dpe {

StepEquations::StepEquations(Simulator* simulator, const Observations& observations,
                             int num_frames)
    : simulator_(simulator), first_rows_({0}) {
  const Scene& scene = simulator->scene();
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    if (!simulator->is_simulated(object)) continue;
    objects_.push_back(object);
    motions_.emplace_back(scene, object, observations, num_frames);
    const int num_steps = motions_.back().num_steps() - motions_.back().first_step();
    first_rows_.push_back(first_rows_.back() +
                          3 * scene.objects[object].num_vertices() *
                              std::max(num_steps, 0));
  }
}

void StepEquations::FixTotalMass(int object, double total_mass, double weight) {
  TotalMassRow row;
  row.coefficients.setZero(num_parameters());
  for (const ParameterBlock& block : simulator_->layout().blocks()) {
    if (block.object != object || block.kind != ParameterKind::kMass) continue;
    for (int local : block.element_to_local) {
      if (local >= 0) row.coefficients[block.offset + local] += weight;
    }
  }
  row.rhs = weight * total_mass;
  total_mass_rows_.push_back(std::move(row));
}

const ObservedMotion& StepEquations::motion(int object) const {
  const auto it = std::find(objects_.begin(), objects_.end(), object);
  return motions_[it - objects_.begin()];
}

void StepEquations::Evaluate(const Eigen::VectorXd& parameters,
                             Eigen::VectorXd* residual,
                             Eigen::SparseMatrix<double>* jacobian) const {
  const int num_step_rows = first_rows_.back();
  const int num_rows = num_step_rows + static_cast<int>(total_mass_rows_.size());
  residual->setZero(num_rows);
  std::vector<Eigen::Triplet<double>> triplets;
  std::vector<Eigen::Triplet<double>> step_triplets;
  Eigen::VectorXd x0, v0, x1, v1, r;
  const double h = simulator_->scene().delta;
  for (size_t i = 0; i < objects_.size(); ++i) {
    int row = first_rows_[i];
    for (int n = motions_[i].first_step(); n < motions_[i].num_steps(); ++n) {
      motions_[i].GetStep(n, &x0, &v0, &x1, &v1);
      step_triplets.clear();
      simulator_->StepResidual(objects_[i], h, x0, v0, x1, v1, parameters, &r,
                               &step_triplets);
      residual->segment(row, r.size()) = r;
      for (const Eigen::Triplet<double>& t : step_triplets) {
        triplets.emplace_back(row + t.row(), t.col(), t.value());
      }
      row += static_cast<int>(r.size());
    }
  }
  for (size_t i = 0; i < total_mass_rows_.size(); ++i) {
    const TotalMassRow& mass_row = total_mass_rows_[i];
    const int row = num_step_rows + static_cast<int>(i);
    (*residual)[row] = mass_row.coefficients.dot(parameters) - mass_row.rhs;
    for (int j = 0; j < mass_row.coefficients.size(); ++j) {
      if (mass_row.coefficients[j] != 0.0) {
        triplets.emplace_back(row, j, mass_row.coefficients[j]);
      }
    }
  }
  if (jacobian == nullptr) return;
  jacobian->resize(num_rows, num_parameters());
  jacobian->setFromTriplets(triplets.begin(), triplets.end());
}

double StepEquations::ObjectRms(const Eigen::VectorXd& residual, int object) const {
  const size_t i =
      std::find(objects_.begin(), objects_.end(), object) - objects_.begin();
  const int num_rows = first_rows_[i + 1] - first_rows_[i];
  if (num_rows == 0) return 0.0;
  return residual.segment(first_rows_[i], num_rows).norm() / std::sqrt(num_rows);
}

}  // namespace dpe
