// Block adjoint: for every residual row one adjoint vector (wx, wv), swept backward
// together, stage by stage (integrator.h). With mu = wv + c wx and A^T lambda = mu the
// adjoint of the stage's input is (wx + Rx^T lambda, Rv^T lambda + p wx), and
// row += B^T lambda.
#include <algorithm>
#include <atomic>
#include <numeric>

#include "derivatives/jacobian_pass.h"
#include "integrators/integrator.h"
#include "linear/block_solver.h"
#include "linear/multiply_many.h"
#include "parallel.h"

namespace dpe {
namespace {

constexpr int kBlockRows = 64;

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
  AdjointSweep(const PassInput& input, int num_rows)
      : input_(input),
        system_(*input.system),
        integrator_(MakeIntegrator(input.scene->integration_method, *input.options)),
        solver_(system_.pattern()),
        v0_(system_.num_coordinates()),
        place_of_row_(num_rows, {-1, -1}) {
    MakeBlocks(num_rows);
  }

  int last_frame() const { return blocks_.empty() ? 0 : blocks_.front().last_frame; }

  void AddSeed(const StateDerivative& d) {
    AddSeed(d.d_position, d.first_row, /*velocity=*/false);
    AddSeed(d.d_velocity, d.first_row, /*velocity=*/true);
  }

  // Moves the adjoints of all rows that depend on a later state back over step `s`.
  bool StepBack(int s) {
    const StepStates states =
        StatesOfStep(system_, *input_.tape, s, input_.scene->step_length(), &v0_);
    const int steps_per_frame = input_.scene->steps_per_frame;
    int active = 0;
    while (active < static_cast<int>(blocks_.size()) &&
           blocks_[active].last_frame * steps_per_frame > s) {
      ++active;
    }
    for (int stage = integrator_->num_stages() - 1; stage >= 0; --stage) {
      integrator_->TangentStage(stage, &system_, system_.solver(), states, &linear_);
      if (!SolveStage(active, stage)) return false;
    }
    return true;
  }

  void Finish(RowMajorMatrix* jacobian) {
    const ParameterColumns& local = system_.local_columns();
    const std::vector<int>& columns = system_.columns().used();
    for (AdjointBlock& block : blocks_) {
      for (int c = 0; c < system_.num_coordinates(); ++c) {
        const int column = local.Column(ParameterKind::kInitialVelocity, c);
        if (column < 0) continue;
        const int node = system_.node_of_vertex()[c / 3];
        block.gradient.row(column) += block.wv.row(3 * node + c % 3);
      }
      for (size_t k = 0; k < block.rows.size(); ++k) {
        for (size_t c = 0; c < columns.size(); ++c) {
          (*jacobian)(block.rows[k], columns[c]) += block.gradient(c, k);
        }
      }
    }
  }

 private:
  bool SolveStage(int active, int stage) {
    if (!linear_.a_is_mass && !solver_.Prepare(system_.solver(), system_.IsSymmetric(),
                                               active * kBlockRows)) {
      return false;
    }
    const bool last_of_two = stage > 0;
    const bool first_of_two = stage == 0 && integrator_->num_stages() > 1;
    std::atomic<bool> ok{true};
    const bool serial = !linear_.a_is_mass && !solver_.thread_safe();
    ParallelFor(serial ? 1 : input_.options->num_threads, active, [&](int b) {
      AdjointBlock& block = blocks_[b];
      if (!StepBlockBack(&block)) ok = false;
      if (last_of_two) {
        block.wx_start = linear_.start_weight * block.wx;
        block.wv_start = linear_.start_weight * block.wv;
        block.wx *= linear_.weight;
        block.wv *= linear_.weight;
      } else if (first_of_two) {
        block.wx += block.wx_start;
        block.wv += block.wv_start;
      }
    });
    return ok;
  }

  // Rows with the latest last frame come first, so that a step touches a prefix.
  void MakeBlocks(int num_rows) {
    std::vector<int> last(num_rows, -1);
    for (const StateDerivative* d : input_.derivatives) {
      const int rows =
          static_cast<int>(std::max(d->d_position.rows(), d->d_velocity.rows()));
      for (int r = d->first_row; r < d->first_row + rows; ++r) {
        last[r] = std::max(last[r], d->frame);
      }
    }
    std::vector<int> order(num_rows);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return last[a] > last[b]; });
    for (int row : order) {
      if (last[row] < 0) break;
      if (blocks_.empty() || blocks_.back().rows.size() == kBlockRows) {
        blocks_.emplace_back();
        blocks_.back().last_frame = last[row];
      }
      place_of_row_[row] = {static_cast<int>(blocks_.size()) - 1,
                            static_cast<int>(blocks_.back().rows.size())};
      blocks_.back().rows.push_back(row);
    }
    const int n = system_.pattern().num_rows();
    for (AdjointBlock& block : blocks_) {
      block.wx = RowMajorMatrix::Zero(n, block.rows.size());
      block.wv = block.wx;
      block.gradient = RowMajorMatrix::Zero(system_.local_columns().used().size(),
                                            block.rows.size());
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

  bool StepBlockBack(AdjointBlock* block) const {
    const BlockPattern& pattern = system_.pattern();
    const int count = static_cast<int>(block->rows.size());
    block->lambda = block->wv;
    if (linear_.c != 0.0) block->lambda += linear_.c * block->wx;
    if (linear_.a_is_mass) {
      for (int node = 0; node < pattern.num_nodes(); ++node) {
        block->lambda.middleRows<3>(3 * node) /=
            system_.parameters().mass[system_.free_vertices()[node]];
      }
    } else if (!solver_.Solve(block->lambda.data(), count, /*transposed=*/true)) {
      return false;
    }
    block->wv = linear_.p * block->wx;
    AddMultiplyMany(pattern, linear_.rv.data(), true, block->lambda.data(), count,
                    block->wv.data());
    AddMultiplyMany(pattern, linear_.rx.data(), true, block->lambda.data(), count,
                    block->wx.data());
    for (const ParameterEntry& e : linear_.entries) {
      const int row = 3 * system_.node_of_vertex()[e.row / 3] + e.row % 3;
      block->gradient.row(e.column) += e.value * block->lambda.row(row);
    }
    return true;
  }

  const PassInput& input_;
  ObjectSystem& system_;
  std::unique_ptr<Integrator> integrator_;
  BlockSolver solver_;
  StageLinearization linear_;
  Eigen::VectorXd v0_;
  std::vector<AdjointBlock> blocks_;
  std::vector<std::pair<int, int>> place_of_row_;  // (block, column in it)
};

}  // namespace

bool AddAdjointJacobian(const PassInput& input, RowMajorMatrix* jacobian) {
  if (input.derivatives.empty() || input.system->columns().used().empty()) return true;
  AdjointSweep sweep(input, static_cast<int>(jacobian->rows()));
  const int steps_per_frame = input.scene->steps_per_frame;
  int step = sweep.last_frame() * steps_per_frame;
  for (auto it = input.derivatives.rbegin(); it != input.derivatives.rend(); ++it) {
    for (; step > (*it)->frame * steps_per_frame; --step) {
      if (!sweep.StepBack(step - 1)) return false;
    }
    sweep.AddSeed(**it);
  }
  for (; step > 0; --step) {
    if (!sweep.StepBack(step - 1)) return false;
  }
  sweep.Finish(jacobian);
  return true;
}

}  // namespace dpe
