#include "step_equations.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dpe {

StepEquations::StepEquations(const std::vector<InverseDynamicsMotion>& motions,
                             const JointLayout& joint)
    : joint_(joint) {
  for (const InverseDynamicsMotion& motion : motions) {
    const Scene& scene = motion.simulator->scene();
    for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
      if (!motion.simulator->is_simulated(object)) continue;
      ObservedMotion observed(scene, object, *motion.observations, motion.num_frames);
      const int num_steps = std::max(observed.num_steps() - observed.first_step(), 0);
      const int num_rows = 3 * scene.objects[object].num_vertices() * num_steps;
      parts_.push_back({motion.simulator, motion.segment, object, std::move(observed),
                        num_step_rows_, num_rows});
      num_step_rows_ += num_rows;
      objects_.push_back(object);
    }
  }
  std::sort(objects_.begin(), objects_.end());
  objects_.erase(std::unique(objects_.begin(), objects_.end()), objects_.end());
}

void StepEquations::FixTotalMass(int object, double total_mass, double weight) {
  TotalMassRow row;
  row.coefficients.setZero(num_parameters());
  for (const ParameterBlock& block : joint_.layout().blocks()) {
    if (block.object != object || block.kind != ParameterKind::kMass) continue;
    for (int local : block.element_to_local) {
      if (local >= 0) row.coefficients[block.offset + local] += weight;
    }
  }
  row.rhs = weight * total_mass;
  total_mass_rows_.push_back(std::move(row));
}

const ObservedMotion* StepEquations::motion(int object, int segment) const {
  for (const Part& part : parts_) {
    // Without other motions a block is not said to be one's own.
    const bool is_of_segment = segment < 0 || part.segment == segment;
    if (part.object == object && is_of_segment) return &part.motion;
  }
  return nullptr;
}

void StepEquations::Evaluate(const Eigen::VectorXd& parameters,
                             Eigen::VectorXd* residual,
                             Eigen::SparseMatrix<double>* jacobian) const {
  const int num_rows = num_step_rows_ + static_cast<int>(total_mass_rows_.size());
  residual->setZero(num_rows);
  std::vector<Eigen::Triplet<double>> triplets;
  std::vector<Eigen::Triplet<double>> step_triplets;
  Eigen::VectorXd x0, v0, x1, v1, r;
  for (const Part& part : parts_) {
    int row = part.first_row;
    const double h = part.simulator->scene().delta;
    const Eigen::VectorXd own = joint_.Gather(parameters, part.segment);
    const std::vector<int>& columns = joint_.indices(part.segment);
    for (int n = part.motion.first_step(); n < part.motion.num_steps(); ++n) {
      part.motion.GetStep(n, &x0, &v0, &x1, &v1);
      step_triplets.clear();
      part.simulator->StepResidual(part.object, h, x0, v0, x1, v1, own, &r,
                                   &step_triplets);
      residual->segment(row, r.size()) = r;
      for (const Eigen::Triplet<double>& t : step_triplets) {
        triplets.emplace_back(row + t.row(), columns[t.col()], t.value());
      }
      row += static_cast<int>(r.size());
    }
  }
  for (size_t i = 0; i < total_mass_rows_.size(); ++i) {
    const TotalMassRow& mass_row = total_mass_rows_[i];
    const int row = num_step_rows_ + static_cast<int>(i);
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

double StepEquations::ObjectRms(const Eigen::VectorXd& residual, int object,
                                const std::function<double(const Scene&)>& unit) const {
  double largest = 0.0;
  for (const Part& part : parts_) {
    if (part.object != object || part.num_rows == 0) continue;
    const double rms = residual.segment(part.first_row, part.num_rows).norm() /
                       std::sqrt(part.num_rows);
    largest = std::max(largest, rms / unit(part.simulator->scene()));
  }
  return largest;
}

}  // namespace dpe
