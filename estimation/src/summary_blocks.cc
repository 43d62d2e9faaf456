#include "summary_blocks.h"

#include <cmath>
#include <limits>

#include "dpe/estimation/joint_layout.h"

namespace dpe {
namespace {

constexpr double kSameTruth = 1e-12;  // relative

}  // namespace

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
    estimated.capture = block.segment;
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

TrueParameters TrueParametersOf(const std::vector<const Scene*>& truths) {
  const JointLayout joint(truths, /*own_wind=*/true);
  TrueParameters truth;
  truth.values = joint.Extract(truths);
  truth.is_known.assign(joint.layout().blocks().size(), 1);
  for (int s = 0; s < joint.num_segments(); ++s) {
    const ParameterLayout own(*truths[s]);
    const Eigen::VectorXd own_values = own.Extract(*truths[s]);
    const Eigen::VectorXd joint_values = joint.Gather(truth.values, s);
    for (int b = 0; b < static_cast<int>(own.blocks().size()); ++b) {
      const ParameterBlock& block = own.blocks()[b];
      const auto here = own_values.segment(block.offset, block.size).array();
      const auto there = joint_values.segment(block.offset, block.size).array();
      const bool is_same = ((here - there).abs() <= kSameTruth * there.abs()).all();
      if (own.Represents(*truths[s], b) && is_same) continue;
      truth.is_known[joint.JointBlock(s, b)] = 0;
    }
  }
  return truth;
}

double ParameterDeviationPercent(const EstimatorSummary& summary, const Scene& truth) {
  return ParameterDeviationPercent(summary, std::vector<const Scene*>{&truth});
}

double ParameterDeviationPercent(const EstimatorSummary& summary,
                                 const std::vector<const Scene*>& truths) {
  const JointLayout joint(truths, /*own_wind=*/true);
  const TrueParameters truth = TrueParametersOf(truths);
  double sum = 0.0;
  int count = 0;
  for (size_t b = 0; b < truth.is_known.size(); ++b) {
    if (!truth.is_known[b]) continue;
    const ParameterBlock& block = joint.layout().blocks()[b];
    for (int j = block.offset; j < block.offset + block.size; ++j) {
      // Relative to nothing: a true value of zero has no relative deviation.
      if (truth.values[j] == 0.0) continue;
      sum +=
          std::abs(summary.parameters[j] - truth.values[j]) / std::abs(truth.values[j]);
      ++count;
    }
  }
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return 100.0 * sum / count;
}

}  // namespace dpe
