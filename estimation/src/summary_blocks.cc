#include "summary_blocks.h"

#include <cmath>
#include <limits>

namespace dpe {

std::string TerminationName(Termination termination) {
  switch (termination) {
    case Termination::kConverged:
      return "converged";
    case Termination::kMaxIterations:
      return "max_iterations";
    case Termination::kMaxSeconds:
      return "max_seconds";
    case Termination::kInterrupted:
      return "interrupted";
    case Termination::kStartFailed:
      return "start_failed";
    case Termination::kNumericalFailure:
      break;
  }
  return "numerical_failure";
}

std::vector<EstimatedBlock> MakeEstimatedBlocks(const ParameterLayout& layout,
                                                const Eigen::VectorXd& parameters) {
  std::vector<EstimatedBlock> result;
  for (const ParameterBlock& block : layout.blocks()) {
    EstimatedBlock estimated;
    estimated.object = block.object;
    estimated.kind = ParameterKindName(block.kind);
    estimated.mode = ParameterModeLetter(block.mode);
    estimated.unit = ParameterKindUnit(block.kind);
    estimated.values = parameters.segment(block.offset, block.size);
    if (block.mode == ParameterMode::kLocal) estimated.elements.resize(block.size);
    for (size_t element = 0; element < block.element_to_local.size(); ++element) {
      const int local = block.element_to_local[element];
      if (local < 0) {
        estimated.inactive.push_back(static_cast<int>(element));
      } else if (block.mode == ParameterMode::kLocal) {
        estimated.elements[local] = static_cast<int>(element);
      }
    }
    result.push_back(std::move(estimated));
  }
  return result;
}

double ParameterDeviationPercent(const EstimatorSummary& summary, const Scene& truth) {
  const ParameterLayout layout(summary.scene);
  const Eigen::VectorXd true_values = layout.Extract(truth);
  double sum = 0.0;
  int count = 0;
  for (int b = 0; b < static_cast<int>(layout.blocks().size()); ++b) {
    if (!layout.Represents(truth, b)) continue;
    const ParameterBlock& block = layout.blocks()[b];
    for (int j = block.offset; j < block.offset + block.size; ++j) {
      // Relative to nothing: a true value of zero has no relative deviation.
      if (true_values[j] == 0.0) continue;
      sum +=
          std::abs(summary.parameters[j] - true_values[j]) / std::abs(true_values[j]);
      ++count;
    }
  }
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return 100.0 * sum / count;
}

}  // namespace dpe
