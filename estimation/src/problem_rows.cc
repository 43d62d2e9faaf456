#include "problem_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "tall_qr.h"

namespace dpe {
namespace {

// Several groups have to do with this fraction of the work of a single one.
constexpr double kWorthSplitting = 0.4;

double Work(const ProblemRows::Group& group) {
  const double columns = group.num_columns + 1.0;
  return group.num_rows * columns * columns;
}

}  // namespace

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
  MakeGroups();
}

int ProblemRows::FreeIndex(double* values) {
  const auto [it, is_new] =
      free_index_.emplace(values, static_cast<int>(free_blocks_.size()));
  if (is_new) {
    FreeBlock block;
    block.values = values;
    block.size = problem_->ParameterBlockSize(values);
    block.tangent_size = problem_->ParameterBlockTangentSize(values);
    block.manifold = problem_->GetManifold(values);
    num_parameters_ += block.tangent_size;
    free_blocks_.push_back(block);
  }
  return it->second;
}

void ProblemRows::MakeGroups() {
  std::map<std::vector<int>, int> group_of;  // by the blocks that are read, sorted
  Group all;
  for (size_t b = 0; b < residual_blocks_.size(); ++b) {
    std::vector<int> key = residual_blocks_[b].free_blocks;
    std::sort(key.begin(), key.end());
    key.erase(std::unique(key.begin(), key.end()), key.end());
    if (!key.empty() && key.front() < 0) key.erase(key.begin());
    // What reads nothing goes with anything.
    if (key.empty() && !groups_.empty()) key = groups_.front().free_blocks;
    const auto [it, is_new] = group_of.emplace(key, static_cast<int>(groups_.size()));
    if (is_new) {
      groups_.emplace_back();
      groups_.back().free_blocks = key;
    }
    groups_[it->second].residual_blocks.push_back(static_cast<int>(b));
    all.residual_blocks.push_back(static_cast<int>(b));
  }
  all.free_blocks.resize(free_blocks_.size());
  std::iota(all.free_blocks.begin(), all.free_blocks.end(), 0);
  FinishGroup(&all);
  double work = 0.0;
  for (Group& group : groups_) {
    FinishGroup(&group);
    work += Work(group);
  }
  if (work > kWorthSplitting * Work(all)) groups_ = {std::move(all)};
}

void ProblemRows::FinishGroup(Group* group) const {
  group->column_of_block.assign(free_blocks_.size(), -1);
  for (int free : group->free_blocks) {
    group->column_of_block[free] = group->num_columns;
    group->columns.push_back(group->num_columns);
    group->num_columns += free_blocks_[free].tangent_size;
  }
  for (size_t k = 0; k < group->residual_blocks.size(); ++k) {
    if (group->chunk_rows.empty() || group->chunk_rows.back() >= kRowsPerChunk) {
      group->chunk_begins.push_back(static_cast<int>(k));
      group->chunk_rows.push_back(0);
    }
    const int rows = residual_blocks_[group->residual_blocks[k]].num_rows;
    group->chunk_rows.back() += rows;
    group->num_rows += rows;
  }
  group->chunk_begins.push_back(static_cast<int>(group->residual_blocks.size()));
}

bool ProblemRows::EvaluateCost(int group, double* cost) {
  *cost = 0.0;
  for (int b : groups_[group].residual_blocks) {
    double part = 0.0;
    if (!problem_->EvaluateResidualBlockAssumingParametersUnchanged(
            residual_blocks_[b].id, /*apply_loss_function=*/true, &part, nullptr,
            nullptr)) {
      return false;
    }
    *cost += part;
  }
  return std::isfinite(*cost);
}

bool ProblemRows::EvaluateChunk(int group, int chunk, Eigen::Ref<Eigen::MatrixXd> rows,
                                double* cost) {
  const Group& g = groups_[group];
  int row = 0;
  for (int k = g.chunk_begins[chunk]; k < g.chunk_begins[chunk + 1]; ++k) {
    const ResidualBlock& block = residual_blocks_[g.residual_blocks[k]];
    double part = 0.0;
    if (!EvaluateBlock(g, block, rows.middleRows(row, block.num_rows), &part)) {
      return false;
    }
    *cost += part;
    row += block.num_rows;
  }
  return std::isfinite(*cost);
}

bool ProblemRows::EvaluateBlock(const Group& group, const ResidualBlock& block,
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
          rows.col(group.num_columns).data(), pointers.data())) {
    return false;
  }
  rows.leftCols(group.num_columns).setZero();
  for (size_t k = 0; k < num_blocks; ++k) {
    const int free = block.free_blocks[k];
    if (free < 0) continue;
    rows.middleCols(group.column_of_block[free], free_blocks_[free].tangent_size) =
        derivatives_[k];
  }
  return true;
}

}  // namespace dpe
