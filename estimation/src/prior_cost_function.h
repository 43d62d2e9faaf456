// A piece of the prior rows as Ceres sees it.
#ifndef DPE_ESTIMATION_PRIOR_COST_FUNCTION_H_
#define DPE_ESTIMATION_PRIOR_COST_FUNCTION_H_

#include <ceres/ceres.h>

#include "prior_rows.h"

namespace dpe {

class PriorCostFunction : public ceres::CostFunction {
 public:
  // @param rows   must outlive this
  // @param block  the piece's
  PriorCostFunction(const PriorRows* rows, const PriorRows::Piece& piece,
                    const ParameterBlock& block)
      : rows_(rows), piece_(piece), offset_(block.offset) {
    set_num_residuals(piece.end - piece.begin);
    mutable_parameter_block_sizes()->push_back(block.size);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const int columns = parameter_block_sizes()[0];
    const bool has_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    if (has_jacobian) std::fill_n(jacobians[0], num_residuals() * columns, 0.0);
    for (int i = 0; i < num_residuals(); ++i) {
      const PriorRows::Row& row = rows_->rows()[piece_.begin + i];
      residuals[i] = row.Residual(parameters[0], offset_);
      if (!has_jacobian) continue;
      double* derivatives = jacobians[0] + static_cast<std::ptrdiff_t>(i) * columns;
      derivatives[row.a - offset_] = row.Slope(parameters[0], offset_);
      if (row.b >= 0) derivatives[row.b - offset_] = -row.scale;
    }
    return true;
  }

 private:
  const PriorRows* rows_;
  PriorRows::Piece piece_;
  int offset_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_PRIOR_COST_FUNCTION_H_
