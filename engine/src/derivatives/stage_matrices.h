// The derivative of one stage in the form that blocks of vectors are multiplied with.
#ifndef DPE_ENGINE_DERIVATIVES_STAGE_MATRICES_H_
#define DPE_ENGINE_DERIVATIVES_STAGE_MATRICES_H_

#include <memory>
#include <vector>

#include "derivatives/jacobian_pass.h"
#include "integrators/integrator.h"
#include "linear/block_solver.h"
#include "linear/multiply_many.h"

namespace dpe {

// Linearises the stages of a rollout's steps one by one, and solves with their
// matrices.
class StageMatrices {
 public:
  // @param transposed  for adjoints: Rx, Rv and A are those of the transposed equations
  StageMatrices(const ObjectRecord& record, bool transposed);

  int num_stages() const { return integrator_->num_stages(); }

  // Reads the states around step `s`; Linearize then takes its stages. Not ok if they
  // could not be made again.
  StepOutcome Read(int s) { return reader_.Read(s, &states_); }

  // @param num_columns  of all blocks that will be solved for
  // @return false if the matrix cannot be factorised
  bool Linearize(int stage, int num_columns);

  // Threads that may work on blocks at once.
  int num_threads() const {
    return linear_.a_is_mass || solver_.thread_safe() ? num_threads_ : 1;
  }

  const StageLinearization& linear() const { return linear_; }
  const BlockRows& rx() const { return rx_; }
  const BlockRows& rv() const { return rv_; }
  // B by blocks of kPassBlock columns; rows are those of unknowns.
  const std::vector<ParameterEntry>& entries(int column_block) const {
    return entries_[column_block];
  }
  int num_entry_blocks() const { return static_cast<int>(entries_.size()); }

  // Row-major n x count, in place: A^{-1} or A^{-T}.
  bool Solve(double* right, int count) const;

 private:
  void SortEntries();

  ObjectSystem& system_;
  bool transposed_;
  int num_threads_;
  std::unique_ptr<Integrator> integrator_;
  StepReader reader_;
  BlockSolver solver_;
  StepStates states_;
  StageLinearization linear_;
  BlockRows rx_, rv_;
  std::vector<std::vector<ParameterEntry>> entries_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_DERIVATIVES_STAGE_MATRICES_H_
