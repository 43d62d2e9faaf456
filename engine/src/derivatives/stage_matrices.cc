#include "derivatives/stage_matrices.h"

namespace dpe {

StageMatrices::StageMatrices(const ObjectRecord& record, bool transposed)
    : system_(*record.system),
      transposed_(transposed),
      num_threads_(record.options->num_threads),
      integrator_(MakeIntegrator(record.scene->integration_method, *record.options)),
      reader_(record),
      solver_(system_.pattern()),
      entries_((system_.local_columns().used().size() + kPassBlock - 1) / kPassBlock) {}

bool StageMatrices::Linearize(int stage, int num_columns) {
  integrator_->TangentStage(stage, &system_, system_.solver(), states_, &linear_);
  rx_.Assign(system_.pattern(), linear_.rx.data(), transposed_);
  rv_.Assign(system_.pattern(), linear_.rv.data(), transposed_);
  SortEntries();
  return linear_.a_is_mass ||
         solver_.Prepare(system_.solver(), system_.IsSymmetric(), num_columns);
}

void StageMatrices::SortEntries() {
  for (auto& entries : entries_) entries.clear();
  for (const ParameterEntry& e : linear_.entries) {
    const int row = 3 * system_.node_of_vertex()[e.row / 3] + e.row % 3;
    entries_[e.column / kPassBlock].push_back({row, e.column, e.value});
  }
}

bool StageMatrices::Solve(double* right, int count) const {
  if (!linear_.a_is_mass) return solver_.Solve(right, count, transposed_);
  for (int node = 0; node < system_.pattern().num_nodes(); ++node) {
    const double m = system_.parameters().mass[system_.free_vertices()[node]];
    double* rows = right + 3L * node * count;
    for (long k = 0; k < 3L * count; ++k) rows[k] /= m;
  }
  return true;
}

}  // namespace dpe
