#include "derivatives/jacobian_cost.h"

#include <algorithm>
#include <cmath>

#include "derivatives/row_groups.h"
#include "linear/block_solver.h"

namespace dpe {
namespace {

// Counted by callgrind on cloths of 12 x 12 and 24 x 24 vertices with drag and damping
// (kFactor and kSolve: set from times at 12 x 12 in the same measure), instructions per
constexpr double kLinearize = 300.0;  // nonzero of the step matrix
constexpr double kFactor = 0.3;       // operation of a factorisation
constexpr double kSolve = 0.35;       // number in the factors, with a block of columns
constexpr double kProduct = 0.4;      // operation of a product with Rx or Rv
constexpr double kSparseProduct = 2.0;  // nonzero, in products with one vector
constexpr double kVector = 0.5;         // number in sums of vectors
constexpr double kEntry = 15.0;         // entry of B that the tangent adds
constexpr double kEntryOfRow = 0.5;     // entry of B that multiplies into a row,
constexpr double kEntryOfGroup = 30.0;  // and into a group of rows
constexpr double kSeed = 0.5;           // column added to a row that reads a state
// Iterations that the Krylov method takes, and numbers that one of them touches.
constexpr double kIterations = 60.0;
constexpr double kIterationVectors = 12.0;

struct SolveWork {
  double fixed = 0.0;
  double per_column = 0.0;
  bool shared_out = false;  // whether threads take part
};

class StageWork {
 public:
  explicit StageWork(const ObjectRecord& record) : system_(*record.system) {
    const auto integrator =
        MakeIntegrator(record.scene->integration_method, *record.options);
    num_stages_ = integrator->num_stages();
    uses_solver_ = integrator->UsesSolver();
    num_threads_ = record.options->num_threads;
    n_ = system_.pattern().num_rows();
    nonzeros_ = system_.pattern().num_nonzeros();
    std::vector<ParameterEntry> entries;
    ParameterSink sink(system_.local_columns(), 1.0, system_.node_of_vertex(),
                       &entries);
    const std::vector<double> zero(system_.num_coordinates());
    system_.VisitStepParameters(
        {record.positions->data(), record.velocities->data(), nullptr, nullptr}, 1.0,
        zero.data(), &sink);
    entries_ = static_cast<double>(entries.size());
  }

  int num_stages() const { return num_stages_; }
  double entries() const { return entries_; }

  // One stage, with `columns` vectors in blocks of kPassBlock, each of which also costs
  // `extra` per vector.
  double Of(int columns, double extra) const {
    const SolveWork solve = Solve(columns);
    const double products =
        kProduct * 4.0 * nonzeros_ + kVector * 6.0 * n_;  // two matrices
    return kLinearize * nonzeros_ + solve.fixed +
           Shared(columns, solve.shared_out) * (solve.per_column + products + extra);
  }

 private:
  // Vectors that the busiest thread has.
  double Shared(int columns, bool shared_out) const {
    if (!shared_out || num_threads_ == 1) return columns;
    const int blocks = (columns + kPassBlock - 1) / kPassBlock;
    const int rounds = (blocks + num_threads_ - 1) / num_threads_;
    return std::min(columns, rounds * kPassBlock);
  }

  SolveWork Solve(int columns) const {
    const double n = n_;
    if (!uses_solver_) return {0.0, n, true};
    if (!system_.KeepingFactorsPays() &&
        columns < BlockSolver::kMinColumnsToFactorize) {
      const double iteration =
          kSparseProduct * nonzeros_ + kVector * kIterationVectors * n;
      return {kVector * nonzeros_, kIterations * iteration, false};
    }
    const double factor = static_cast<double>(system_.factor_values());
    const double triangles = system_.IsSymmetric() ? 1.0 : 2.0;
    return {kFactor * triangles * factor * factor / n, kSolve * 2.0 * factor, true};
  }

  ObjectSystem& system_;
  int num_stages_ = 1;
  bool uses_solver_ = true;
  int num_threads_ = 1;
  int n_ = 0;
  double nonzeros_ = 0.0;
  double entries_ = 0.0;
};

}  // namespace

JacobianCosts PredictJacobianCosts(const ObjectRecord& record,
                                   const StateDerivatives& derivatives) {
  const int columns = static_cast<int>(record.system->columns().used().size());
  if (derivatives.empty() || columns == 0) return {};
  const StageWork work(record);
  const double stages_per_frame = record.scene->steps_per_frame * work.num_stages();
  const std::vector<RowGroup> groups = GroupRows(derivatives);
  const int last_frame = groups.empty() ? 0 : groups.front().last_frame;
  JacobianCosts costs;
  costs.tangent =
      last_frame * stages_per_frame * (work.Of(columns, 0.0) + kEntry * work.entries());
  for (const StateDerivative* d : derivatives) {
    costs.tangent +=
        kSeed * columns *
        static_cast<double>(d->d_position.nonZeros() + d->d_velocity.nonZeros());
  }
  // Frames with the same groups active at once.
  int rows = 0;
  for (size_t g = 0; g < groups.size(); ++g) {
    rows += static_cast<int>(groups[g].rows.size());
    const int next = g + 1 < groups.size() ? groups[g + 1].last_frame : 0;
    costs.adjoint += (groups[g].last_frame - next) * stages_per_frame *
                     (work.Of(rows, kEntryOfRow * work.entries()) +
                      kEntryOfGroup * work.entries() * static_cast<double>(g + 1));
  }
  costs.adjoint += kSeed * columns * rows;
  return costs;
}

}  // namespace dpe
