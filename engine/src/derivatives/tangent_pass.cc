// Forward sensitivity, stage by stage (integrator.h), for a block of directions dp at
// once: A dv = Rx dx_in + Rv dv_in + B dp, dx = dx_in + p dv_in + c dv.
#include <algorithm>
#include <atomic>
#include <utility>

#include "derivatives/jacobian_pass.h"
#include "derivatives/stage_matrices.h"
#include "dpe/engine/parallel.h"
#include "linear/vector_kernels.h"

namespace dpe {
namespace {

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
  TangentSweep(const ObjectRecord& record, const RowMajorMatrix* seed)
      : system_(*record.system), seed_(seed), matrices_(record, /*transposed=*/false) {
    const int columns = static_cast<int>(system_.local_columns().used().size());
    num_directions_ = seed ? static_cast<int>(seed->cols()) : columns;
    for (int first = 0; first < num_directions_; first += kPassBlock) {
      TangentBlock block;
      block.first = first;
      block.count = std::min(kPassBlock, num_directions_ - first);
      block.dx = RowMajorMatrix::Zero(system_.pattern().num_rows(), block.count);
      block.dv = block.dv_next = block.dx;
      SeedInitialState(ParameterKind::kInitialPosition, block, &block.dx);
      SeedInitialState(ParameterKind::kInitialVelocity, block, &block.dv);
      blocks_.push_back(std::move(block));
    }
  }

  const std::vector<TangentBlock>& blocks() const { return blocks_; }

  // Moves all directions over step `s`.
  StepOutcome Step(int s) {
    StepOutcome outcome = matrices_.Read(s);
    if (!outcome.ok()) return outcome;
    const int num_stages = matrices_.num_stages();
    for (int stage = 0; stage < num_stages; ++stage) {
      std::atomic<bool> ok{matrices_.Linearize(stage, num_directions_)};
      if (!ok) return UnsolvedStep(IsFinite(), /*transposed=*/false);
      const bool keep_start = stage == 0 && num_stages > 1;
      ParallelFor(matrices_.num_threads(), static_cast<int>(blocks_.size()),
                  [&](int b) {
                    if (!StepBlock(keep_start, &blocks_[b])) ok = false;
                  });
      if (!ok) return UnsolvedStep(IsFinite(), /*transposed=*/false);
    }
    return {};
  }

 private:
  bool IsFinite() const {
    for (const TangentBlock& block : blocks_) {
      if (!block.dx.allFinite() || !block.dv.allFinite()) return false;
    }
    return true;
  }

  // state := the seed of the initial state, where that is a parameter.
  void SeedInitialState(ParameterKind kind, const TangentBlock& block,
                        RowMajorMatrix* state) const {
    const ParameterColumns& local = system_.local_columns();
    if (!local.Has(kind)) return;
    for (int c = 0; c < system_.num_coordinates(); ++c) {
      const int column = local.Column(kind, c);
      if (column < 0) continue;
      AddSeed({3 * system_.node_of_vertex()[c / 3] + c % 3, column, 1.0}, block, state);
    }
  }

  // target(row, :) += value * seed(column, block), for an entry of B.
  void AddSeed(const ParameterEntry& e, const TangentBlock& block,
               RowMajorMatrix* target) const {
    if (seed_ == nullptr) {
      const int k = e.column - block.first;
      if (k >= 0 && k < block.count) (*target)(e.row, k) += e.value;
    } else {
      AddScaled(block.count, e.value, seed_->row(e.column).data() + block.first,
                target->row(e.row).data());
    }
  }

  // target += B seed.
  void AddParameters(const TangentBlock& block, RowMajorMatrix* target) const {
    const int only = seed_ == nullptr ? block.first / kPassBlock : 0;
    const int last = seed_ == nullptr ? only + 1 : matrices_.num_entry_blocks();
    for (int i = only; i < last; ++i) {
      for (const ParameterEntry& e : matrices_.entries(i)) AddSeed(e, block, target);
    }
  }

  bool StepBlock(bool keep_start, TangentBlock* block) const {
    const StageLinearization& linear = matrices_.linear();
    double* dx = block->dx.data();
    double* dv = block->dv.data();
    const long size = block->dx.size();
    if (keep_start) {
      block->dx_start = block->dx;
      block->dv_start = block->dv;
    }
    if (linear.start_weight != 0.0) {  // (dx, dv) := the stage's input
      Combine(size, linear.weight, dx, linear.start_weight, block->dx_start.data(), dx);
      Combine(size, linear.weight, dv, linear.start_weight, block->dv_start.data(), dv);
    }
    double* next = block->dv_next.data();
    matrices_.rx().Multiply(dx, block->count, 0.0, nullptr, next);
    matrices_.rv().Multiply(dv, block->count, 1.0, next, next);
    AddParameters(*block, &block->dv_next);
    if (!matrices_.Solve(next, block->count)) return false;
    if (linear.p != 0.0) AddScaled(size, linear.p, dv, dx);
    if (linear.c != 0.0) AddScaled(size, linear.c, next, dx);
    block->dv.swap(block->dv_next);
    return true;
  }

  ObjectSystem& system_;
  const RowMajorMatrix* seed_;
  StageMatrices matrices_;
  std::vector<TangentBlock> blocks_;
  int num_directions_ = 0;
};

// jacobian rows += d_state * tangent, for one block of columns.
void AddRows(const ObjectSystem& system, const SparseRows& d_state, int first_row,
             const RowMajorMatrix& tangent, int first_column,
             RowMajorMatrix* jacobian) {
  const int* columns = system.columns().used().data() + first_column;
  const int count = static_cast<int>(tangent.cols());
  const bool is_contiguous = columns[count - 1] - columns[0] == count - 1;
  for (int r = 0; r < d_state.outerSize(); ++r) {
    double* out = jacobian->row(first_row + r).data();
    for (SparseRows::InnerIterator it(d_state, r); it; ++it) {
      const int node = system.node_of_vertex()[it.col() / 3];
      if (node < 0) continue;
      const double* row = tangent.row(3 * node + it.col() % 3).data();
      if (is_contiguous) {
        AddScaled(count, it.value(), row, out + columns[0]);
      } else {
        for (int k = 0; k < count; ++k) out[columns[k]] += it.value() * row[k];
      }
    }
  }
}

}  // namespace

PassOutcome AddTangentJacobian(const ObjectRecord& record,
                               const StateDerivatives& derivatives,
                               RowMajorMatrix* jacobian) {
  if (derivatives.empty() || record.system->columns().used().empty()) return {};
  TangentSweep sweep(record, nullptr);
  const int steps_per_frame = record.scene->steps_per_frame;
  int step = 0;
  for (const StateDerivative* d : derivatives) {
    for (; step < d->frame * steps_per_frame; ++step) {
      StepOutcome outcome = sweep.Step(step);
      if (!outcome.ok()) return {std::move(outcome), step};
    }
    ParallelFor(record.options->num_threads, static_cast<int>(sweep.blocks().size()),
                [&](int b) {
                  const TangentBlock& block = sweep.blocks()[b];
                  AddRows(*record.system, d->d_position, d->first_row, block.dx,
                          block.first, jacobian);
                  AddRows(*record.system, d->d_velocity, d->first_row, block.dv,
                          block.first, jacobian);
                });
  }
  return {};
}

PassOutcome PropagateTangent(const ObjectRecord& record, const Eigen::VectorXd& dp,
                             Eigen::MatrixXd* dx, Eigen::MatrixXd* dv) {
  const ObjectSystem& system = *record.system;
  const int num_frames = static_cast<int>(record.positions->cols());
  dx->setZero(system.num_coordinates(), num_frames);
  dv->setZero(system.num_coordinates(), num_frames);
  const std::vector<int>& columns = system.columns().used();
  if (columns.empty()) return {};
  RowMajorMatrix seed(columns.size(), 1);
  for (size_t k = 0; k < columns.size(); ++k) seed(k, 0) = dp[columns[k]];
  TangentSweep sweep(record, &seed);
  const int steps_per_frame = record.scene->steps_per_frame;
  for (int frame = 0; frame < num_frames; ++frame) {
    const int end = frame * steps_per_frame;
    for (int s = std::max(end - steps_per_frame, 0); s < end; ++s) {
      StepOutcome outcome = sweep.Step(s);
      if (!outcome.ok()) return {std::move(outcome), s};
    }
    system.ScatterFree(sweep.blocks()[0].dx.data(), dx->col(frame).data());
    system.ScatterFree(sweep.blocks()[0].dv.data(), dv->col(frame).data());
    if (!dx->col(frame).allFinite() || !dv->col(frame).allFinite()) {
      return {{RolloutStatus::Code::kNotFinite, ""}, std::max(end - 1, 0)};
    }
  }
  return {};
}

}  // namespace dpe
