// Block adjoint: for every residual row one adjoint vector (wx, wv), swept backward
// together, stage by stage (integrator.h). With mu = wv + c wx and A^T lambda = mu the
// adjoint of the stage's input is (wx + Rx^T lambda, Rv^T lambda + p wx), and
// row += B^T lambda.
#include <atomic>
#include <utility>

#include "derivatives/jacobian_pass.h"
#include "derivatives/row_groups.h"
#include "derivatives/stage_matrices.h"
#include "dpe/engine/parallel.h"
#include "linear/vector_kernels.h"

namespace dpe {
namespace {

// A group of residual rows; column k of the matrices belongs to rows[k].
struct AdjointBlock {
  std::vector<int> rows;
  int last_frame = 0;                 // no row of the block depends on a later one
  RowMajorMatrix wx, wv, lambda;      // 3 nodes x rows
  RowMajorMatrix wx_start, wv_start;  // what later stages leave to the step's start
  RowMajorMatrix gradient;            // local columns x rows
};

class AdjointSweep {
 public:
  AdjointSweep(const ObjectRecord& record, const StateDerivatives& derivatives,
               int num_rows)
      : system_(*record.system),
        steps_per_frame_(record.scene->steps_per_frame),
        matrices_(record, /*transposed=*/true),
        place_of_row_(num_rows, {-1, -1}) {
    MakeBlocks(derivatives);
  }

  int last_frame() const { return blocks_.empty() ? 0 : blocks_.front().last_frame; }

  void AddSeed(const StateDerivative& d) {
    AddSeed(d.d_position, d.first_row, /*velocity=*/false);
    AddSeed(d.d_velocity, d.first_row, /*velocity=*/true);
  }

  // Moves the adjoints of all rows that depend on a later state back over step `s`.
  StepOutcome StepBack(int s) {
    StepOutcome outcome = matrices_.Read(s);
    if (!outcome.ok()) return outcome;
    int active = 0, num_columns = 0;
    while (active < static_cast<int>(blocks_.size()) &&
           blocks_[active].last_frame * steps_per_frame_ > s) {
      num_columns += static_cast<int>(blocks_[active++].rows.size());
    }
    for (int stage = matrices_.num_stages() - 1; stage >= 0; --stage) {
      std::atomic<bool> ok{matrices_.Linearize(stage, num_columns)};
      if (!ok) return UnsolvedStep(IsFinite(), /*transposed=*/true);
      ParallelFor(matrices_.num_threads(), active, [&](int b) {
        if (!StepBlockBack(stage, &blocks_[b])) ok = false;
      });
      if (!ok) return UnsolvedStep(IsFinite(), /*transposed=*/true);
    }
    return {};
  }

  void Finish(RowMajorMatrix* jacobian) {
    const std::vector<int>& columns = system_.columns().used();
    for (AdjointBlock& block : blocks_) {
      AddInitialState(ParameterKind::kInitialPosition, block.wx, &block.gradient);
      AddInitialState(ParameterKind::kInitialVelocity, block.wv, &block.gradient);
      for (size_t k = 0; k < block.rows.size(); ++k) {
        for (size_t c = 0; c < columns.size(); ++c) {
          (*jacobian)(block.rows[k], columns[c]) += block.gradient(c, k);
        }
      }
    }
  }

 private:
  bool IsFinite() const {
    for (const AdjointBlock& block : blocks_) {
      if (!block.wx.allFinite() || !block.wv.allFinite()) return false;
    }
    return true;
  }

  // gradient += the adjoint of the initial state, where that is a parameter.
  void AddInitialState(ParameterKind kind, const RowMajorMatrix& adjoint,
                       RowMajorMatrix* gradient) const {
    const ParameterColumns& local = system_.local_columns();
    if (!local.Has(kind)) return;
    for (int c = 0; c < system_.num_coordinates(); ++c) {
      const int column = local.Column(kind, c);
      if (column < 0) continue;
      const int node = system_.node_of_vertex()[c / 3];
      gradient->row(column) += adjoint.row(3 * node + c % 3);
    }
  }

  void MakeBlocks(const StateDerivatives& derivatives) {
    const int n = system_.pattern().num_rows();
    for (RowGroup& group : GroupRows(derivatives)) {
      const size_t count = group.rows.size();
      for (size_t k = 0; k < count; ++k) {
        place_of_row_[group.rows[k]] = {static_cast<int>(blocks_.size()),
                                        static_cast<int>(k)};
      }
      AdjointBlock block;
      block.rows = std::move(group.rows);
      block.last_frame = group.last_frame;
      block.wx = RowMajorMatrix::Zero(n, count);
      block.wv = block.lambda = block.wx;
      block.gradient =
          RowMajorMatrix::Zero(system_.local_columns().used().size(), count);
      blocks_.push_back(std::move(block));
    }
  }

  void AddSeed(const SparseRows& d_state, int first_row, bool velocity) {
    for (int r = 0; r < d_state.outerSize(); ++r) {
      const auto [b, k] = place_of_row_[first_row + r];
      RowMajorMatrix& w = velocity ? blocks_[b].wv : blocks_[b].wx;
      for (SparseRows::InnerIterator it(d_state, r); it; ++it) {
        const int node = system_.node_of_vertex()[it.col() / 3];
        if (node >= 0) w(3 * node + it.col() % 3, k) += it.value();
      }
    }
  }

  bool StepBlockBack(int stage, AdjointBlock* block) const {
    const StageLinearization& linear = matrices_.linear();
    const int count = static_cast<int>(block->rows.size());
    const long size = block->wx.size();
    double* wx = block->wx.data();
    double* wv = block->wv.data();
    double* lambda = block->lambda.data();
    Combine(size, 1.0, wv, linear.c, wx, lambda);
    if (!matrices_.Solve(lambda, count)) return false;
    matrices_.rv().Multiply(lambda, count, linear.p, linear.p != 0.0 ? wx : nullptr,
                            wv);
    matrices_.rx().Multiply(lambda, count, 1.0, wx, wx);
    for (int i = 0; i < matrices_.num_entry_blocks(); ++i) {
      for (const ParameterEntry& e : matrices_.entries(i)) {
        AddScaled(count, e.value, block->lambda.row(e.row).data(),
                  block->gradient.row(e.column).data());
      }
    }
    if (stage > 0) {
      block->wx_start = linear.start_weight * block->wx;
      block->wv_start = linear.start_weight * block->wv;
      block->wx *= linear.weight;
      block->wv *= linear.weight;
    } else if (matrices_.num_stages() > 1) {
      block->wx += block->wx_start;
      block->wv += block->wv_start;
    }
    return true;
  }

  ObjectSystem& system_;
  int steps_per_frame_;
  StageMatrices matrices_;
  std::vector<AdjointBlock> blocks_;
  std::vector<std::pair<int, int>> place_of_row_;  // (block, column in it)
};

}  // namespace

PassOutcome AddAdjointJacobian(const ObjectRecord& record,
                               const StateDerivatives& derivatives,
                               RowMajorMatrix* jacobian) {
  if (derivatives.empty() || record.system->columns().used().empty()) return {};
  AdjointSweep sweep(record, derivatives, static_cast<int>(jacobian->rows()));
  const int steps_per_frame = record.scene->steps_per_frame;
  int step = sweep.last_frame() * steps_per_frame;
  for (auto it = derivatives.rbegin(); it != derivatives.rend(); ++it) {
    for (; step > (*it)->frame * steps_per_frame; --step) {
      StepOutcome outcome = sweep.StepBack(step - 1);
      if (!outcome.ok()) return {std::move(outcome), step - 1};
    }
    sweep.AddSeed(**it);
  }
  for (; step > 0; --step) {
    StepOutcome outcome = sweep.StepBack(step - 1);
    if (!outcome.ok()) return {std::move(outcome), step - 1};
  }
  sweep.Finish(jacobian);
  return {};
}

}  // namespace dpe
