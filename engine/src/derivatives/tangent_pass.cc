// Forward sensitivity, stage by stage (integrator.h), for a block of directions dp at
// once: A dv = Rx dx_in + Rv dv_in + B dp, dx = dx_in + p dv_in + c dv.
#include <algorithm>
#include <atomic>

#include "derivatives/jacobian_pass.h"
#include "integrators/integrator.h"
#include "linear/block_solver.h"
#include "linear/multiply_many.h"
#include "parallel.h"

namespace dpe {
namespace {

constexpr int kBlockColumns = 96;

// Directions [first, first + count) of the seed: dX and dV of all nodes.
struct TangentBlock {
  int first = 0;
  int count = 0;
  RowMajorMatrix dx, dv, dv_next;     // 3 nodes x count
  RowMajorMatrix dx_start, dv_start;  // before the step, for methods of two stages
};

class TangentSweep {
 public:
  // @param seed  local columns x directions, or null: the identity
  TangentSweep(const PassInput& input, const Eigen::MatrixXd* seed)
      : input_(input),
        system_(*input.system),
        seed_(seed),
        integrator_(MakeIntegrator(input.scene->integration_method, *input.options)),
        solver_(system_.pattern()),
        v0_(system_.num_coordinates()) {
    const int columns = static_cast<int>(system_.local_columns().used().size());
    const int directions = seed ? static_cast<int>(seed->cols()) : columns;
    num_directions_ = directions;
    for (int first = 0; first < directions; first += kBlockColumns) {
      TangentBlock block;
      block.first = first;
      block.count = std::min(kBlockColumns, directions - first);
      block.dx = RowMajorMatrix::Zero(system_.pattern().num_rows(), block.count);
      block.dv = block.dx;
      SeedInitialVelocity(&block);
      blocks_.push_back(std::move(block));
    }
  }

  const std::vector<TangentBlock>& blocks() const { return blocks_; }

  // Moves all directions over step `s`. False if its system cannot be solved.
  bool Step(int s) {
    const StepStates states =
        StatesOfStep(system_, *input_.tape, s, input_.scene->step_length(), &v0_);
    const int num_stages = integrator_->num_stages();
    for (int stage = 0; stage < num_stages; ++stage) {
      integrator_->TangentStage(stage, &system_, system_.solver(), states, &linear_);
      if (!SolveStage(/*keep_start=*/stage == 0 && num_stages > 1)) return false;
    }
    return true;
  }

 private:
  bool SolveStage(bool keep_start) {
    if (!linear_.a_is_mass &&
        !solver_.Prepare(system_.solver(), system_.IsSymmetric(), num_directions_)) {
      return false;
    }
    std::atomic<bool> ok{true};
    const bool serial = !linear_.a_is_mass && !solver_.thread_safe();
    ParallelFor(serial ? 1 : input_.options->num_threads,
                static_cast<int>(blocks_.size()), [&](int b) {
                  TangentBlock& block = blocks_[b];
                  if (keep_start) {
                    block.dx_start = block.dx;
                    block.dv_start = block.dv;
                  }
                  CombineInput(&block);
                  if (!StepBlock(&block)) ok = false;
                });
    return ok;
  }

  // (dx, dv) := the stage's input.
  void CombineInput(TangentBlock* block) const {
    if (linear_.start_weight == 0.0) return;
    block->dx = linear_.weight * block->dx + linear_.start_weight * block->dx_start;
    block->dv = linear_.weight * block->dv + linear_.start_weight * block->dv_start;
  }

  void SeedInitialVelocity(TangentBlock* block) const {
    const ParameterColumns& local = system_.local_columns();
    if (!local.Has(ParameterKind::kInitialVelocity)) return;
    for (int c = 0; c < system_.num_coordinates(); ++c) {
      const int column = local.Column(ParameterKind::kInitialVelocity, c);
      if (column < 0) continue;
      AddSeed(column, 1.0, block, &block->dv,
              3 * system_.node_of_vertex()[c / 3] + c % 3);
    }
  }

  // target(row, :) += value * seed(column, block).
  void AddSeed(int column, double value, const TangentBlock* block,
               RowMajorMatrix* target, int row) const {
    if (seed_ == nullptr) {
      const int k = column - block->first;
      if (k >= 0 && k < block->count) (*target)(row, k) += value;
    } else {
      target->row(row) +=
          value * seed_->row(column).segment(block->first, block->count);
    }
  }

  bool StepBlock(TangentBlock* block) const {
    const BlockPattern& pattern = system_.pattern();
    RowMajorMatrix& next = block->dv_next;
    next.setZero(block->dv.rows(), block->count);
    AddMultiplyMany(pattern, linear_.rx.data(), false, block->dx.data(), block->count,
                    next.data());
    AddMultiplyMany(pattern, linear_.rv.data(), false, block->dv.data(), block->count,
                    next.data());
    for (const ParameterEntry& e : linear_.entries) {
      const int row = 3 * system_.node_of_vertex()[e.row / 3] + e.row % 3;
      AddSeed(e.column, e.value, block, &next, row);
    }
    if (linear_.a_is_mass) {
      for (int node = 0; node < pattern.num_nodes(); ++node) {
        next.middleRows<3>(3 * node) /=
            system_.parameters().mass[system_.free_vertices()[node]];
      }
    } else if (!solver_.Solve(next.data(), block->count, /*transposed=*/false)) {
      return false;
    }
    if (linear_.p != 0.0) block->dx += linear_.p * block->dv;
    if (linear_.c != 0.0) block->dx += linear_.c * next;
    block->dv.swap(next);
    return true;
  }

  const PassInput& input_;
  ObjectSystem& system_;
  const Eigen::MatrixXd* seed_;
  std::unique_ptr<Integrator> integrator_;
  BlockSolver solver_;
  StageLinearization linear_;
  Eigen::VectorXd v0_;
  std::vector<TangentBlock> blocks_;
  int num_directions_ = 0;
};

// jacobian rows += d_state * tangent, for one block of columns.
void AddRows(const ObjectSystem& system, const SparseRows& d_state, int first_row,
             const RowMajorMatrix& tangent, int first_column,
             RowMajorMatrix* jacobian) {
  const std::vector<int>& columns = system.columns().used();
  for (int r = 0; r < d_state.outerSize(); ++r) {
    for (SparseRows::InnerIterator it(d_state, r); it; ++it) {
      const int node = system.node_of_vertex()[it.col() / 3];
      if (node < 0) continue;
      const auto row = tangent.row(3 * node + it.col() % 3);
      for (int k = 0; k < tangent.cols(); ++k) {
        (*jacobian)(first_row + r, columns[first_column + k]) += it.value() * row[k];
      }
    }
  }
}

}  // namespace

bool AddTangentJacobian(const PassInput& input, RowMajorMatrix* jacobian) {
  if (input.derivatives.empty() || input.system->columns().used().empty()) return true;
  TangentSweep sweep(input, nullptr);
  const int steps_per_frame = input.scene->steps_per_frame;
  int step = 0;
  for (const StateDerivative* d : input.derivatives) {
    for (; step < d->frame * steps_per_frame; ++step) {
      if (!sweep.Step(step)) return false;
    }
    ParallelFor(input.options->num_threads, static_cast<int>(sweep.blocks().size()),
                [&](int b) {
                  const TangentBlock& block = sweep.blocks()[b];
                  AddRows(*input.system, d->d_position, d->first_row, block.dx,
                          block.first, jacobian);
                  AddRows(*input.system, d->d_velocity, d->first_row, block.dv,
                          block.first, jacobian);
                });
  }
  return true;
}

bool PropagateTangent(const PassInput& input, const Eigen::VectorXd& dp, int num_frames,
                      Eigen::MatrixXd* dx, Eigen::MatrixXd* dv) {
  const ObjectSystem& system = *input.system;
  dx->setZero(system.num_coordinates(), num_frames);
  dv->setZero(system.num_coordinates(), num_frames);
  const std::vector<int>& columns = system.columns().used();
  if (columns.empty()) return true;
  Eigen::MatrixXd seed(columns.size(), 1);
  for (size_t k = 0; k < columns.size(); ++k) seed(k, 0) = dp[columns[k]];
  TangentSweep sweep(input, &seed);
  for (int frame = 0; frame < num_frames; ++frame) {
    for (int s = (frame - 1) * input.scene->steps_per_frame;
         frame > 0 && s < frame * input.scene->steps_per_frame; ++s) {
      if (!sweep.Step(s)) return false;
    }
    system.ScatterFree(sweep.blocks()[0].dx.data(), dx->col(frame).data());
    system.ScatterFree(sweep.blocks()[0].dv.data(), dv->col(frame).data());
  }
  return true;
}

}  // namespace dpe
