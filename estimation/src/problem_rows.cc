#include "problem_rows.h"

#include <cmath>
#include <utility>

#include "tall_qr.h"

namespace dpe {

ProblemRows::ProblemRows(ceres::Problem* problem) : problem_(problem) {
  std::vector<ceres::ResidualBlockId> ids;
  problem->GetResidualBlocks(&ids);
  std::vector<double*> parameter_blocks;
  for (const ceres::ResidualBlockId id : ids) {
    ResidualBlock block;
    block.id = id;
    block.num_rows = problem->GetCostFunctionForResidualBlock(id)->num_residuals();
    problem->GetParameterBlocksForResidualBlock(id, &parameter_blocks);
    for (double* values : parameter_blocks) {
      block.free_blocks.push_back(
          problem->IsParameterBlockConstant(values) ? -1 : FreeIndex(values));
    }
    num_rows_ += block.num_rows;
    residual_blocks_.push_back(std::move(block));
  }
  MakeChunks();
}

int ProblemRows::FreeIndex(double* values) {
  const auto [it, is_new] =
      free_index_.emplace(values, static_cast<int>(free_blocks_.size()));
  if (is_new) {
    FreeBlock block;
    block.values = values;
    block.size = problem_->ParameterBlockSize(values);
    block.column = num_parameters_;
    block.tangent_size = problem_->ParameterBlockTangentSize(values);
    block.manifold = problem_->GetManifold(values);
    num_parameters_ += block.tangent_size;
    free_blocks_.push_back(block);
  }
  return it->second;
}

void ProblemRows::MakeChunks() {
  for (size_t b = 0; b < residual_blocks_.size(); ++b) {
    if (chunk_rows_.empty() || chunk_rows_.back() >= kRowsPerChunk) {
      chunk_begins_.push_back(static_cast<int>(b));
      chunk_rows_.push_back(0);
    }
    chunk_rows_.back() += residual_blocks_[b].num_rows;
  }
  chunk_begins_.push_back(static_cast<int>(residual_blocks_.size()));
}

bool ProblemRows::EvaluateCost(double* cost) {
  *cost = 0.0;
  for (const ResidualBlock& block : residual_blocks_) {
    double part = 0.0;
    if (!problem_->EvaluateResidualBlockAssumingParametersUnchanged(
            block.id, /*apply_loss_function=*/true, &part, nullptr, nullptr)) {
      return false;
    }
    *cost += part;
  }
  return std::isfinite(*cost);
}

bool ProblemRows::EvaluateChunk(int chunk, Eigen::Ref<Eigen::MatrixXd> rows,
                                double* cost) {
  int row = 0;
  for (int b = chunk_begins_[chunk]; b < chunk_begins_[chunk + 1]; ++b) {
    const ResidualBlock& block = residual_blocks_[b];
    double part = 0.0;
    if (!EvaluateBlock(block, rows.middleRows(row, block.num_rows), &part)) {
      return false;
    }
    *cost += part;
    row += block.num_rows;
  }
  return std::isfinite(*cost);
}

bool ProblemRows::EvaluateBlock(const ResidualBlock& block,
                                Eigen::Ref<Eigen::MatrixXd> rows, double* cost) {
  const size_t num_blocks = block.free_blocks.size();
  if (derivatives_.size() < num_blocks) derivatives_.resize(num_blocks);
  std::vector<double*> pointers(num_blocks, nullptr);
  for (size_t k = 0; k < num_blocks; ++k) {
    if (block.free_blocks[k] < 0) continue;
    derivatives_[k].resize(block.num_rows,
                           free_blocks_[block.free_blocks[k]].tangent_size);
    pointers[k] = derivatives_[k].data();
  }
  if (!problem_->EvaluateResidualBlockAssumingParametersUnchanged(
          block.id, /*apply_loss_function=*/true, cost,
          rows.col(num_parameters_).data(), pointers.data())) {
    return false;
  }
  rows.leftCols(num_parameters_).setZero();
  for (size_t k = 0; k < num_blocks; ++k) {
    if (block.free_blocks[k] < 0) continue;
    const FreeBlock& free = free_blocks_[block.free_blocks[k]];
    rows.middleCols(free.column, free.tangent_size) = derivatives_[k];
  }
  return true;
}

}  // namespace dpe
