// The matrix that a step of a rollout solves with, assembled anew from the state before
// the step: what the engine itself factorises, how and how often, makes no difference.
#ifndef DPE_TESTS_BENCHMARKS_STEP_MATRIX_H_
#define DPE_TESTS_BENCHMARKS_STEP_MATRIX_H_

#include <vector>

#include "cases.h"

namespace dpe::bench {

// Compressed columns; only entries on and below the diagonal count.
struct SymmetricMatrix {
  std::vector<int> column_starts;
  std::vector<int> row_indices;
  std::vector<double> values;

  int num_rows() const { return static_cast<int>(column_starts.size()) - 1; }
};

// The symmetric part of M - h D - h^2 K of the case's scene by method 2, half way
// through the case's rollout. The other methods' matrices have the same pattern, so
// their floor per system is the same. Without columns if the rollout fails.
SymmetricMatrix StepMatrix(Case c);

}  // namespace dpe::bench

#endif  // DPE_TESTS_BENCHMARKS_STEP_MATRIX_H_
