// The step between two levels of a multigrid method: aggregates of the finer level's
// nodes, interpolation from them, and the coarser level's matrix.
//
// Smoothed aggregation (Vanek, Mandel & Brezina 1996) with one scalar weight per node
// and aggregate, P (x) I3: for the piecewise constant T (1 where node i belongs to
// aggregate g) and the non-negative couplings w_ij = max(0, -trace A_ij) of strongly
// coupled neighbours,
//   P = (I - omega D^{-1} (diag(sum_j w_ij) - W)) T,  D = diag(max(trace A_ii, sum w)),
// whose rows sum to 1, so that a translation of the cloth is interpolated exactly. The
// coarse matrix is P^T A P. Which entries are not zero, and where each product goes, is
// worked out once; a new matrix of the same pattern costs arithmetic only.
#ifndef DPE_ENGINE_LINEAR_PROLONGATION_H_
#define DPE_ENGINE_LINEAR_PROLONGATION_H_

#include <cstdint>
#include <vector>

#include "linear/aggregation.h"
#include "linear/block_rows.h"

namespace dpe {

class Prolongation {
 public:
  // Chooses the aggregates by the couplings in `fine`'s present values.
  //
  // @param coarse  out: a matrix of the coarse pattern, with zeros
  Prolongation(const SingleRows& fine, SingleRows* coarse);

  int num_fine() const { return static_cast<int>(starts_.size()) - 1; }
  int num_coarse() const { return num_coarse_; }

  // Computes P and coarse := P^T A P for the values that `fine` has now.
  void Update(const SingleRows& fine, SingleRows* coarse);

  // coarse := P^T fine, and fine += P coarse, for three numbers per node.
  void Restrict(const float* fine, float* coarse) const;
  void AddProlonged(const float* coarse, float* fine) const;

 private:
  void FindEntries(const SingleRows& fine, const Aggregates& aggregates,
                   const std::vector<char>& strong);
  void FindProducts(const SingleRows& fine);
  void FindCoarse(SingleRows* coarse);
  void UpdateWeights(const SingleRows& fine);

  int num_coarse_ = 0;
  // P by rows, in no order; weight_of_block_[k] is where block k of the fine matrix
  // contributes, -1 if it does not.
  std::vector<int> starts_, columns_, weight_of_block_;
  std::vector<float> weights_;
  // A P by rows, in no order. product_slots_ lists, for every block of A and every
  // entry of P that it meets, the place in that row of A P; coarse_slots_, for every
  // entry of P^T and every block of A P that it meets, the block's place in the coarse
  // matrix.
  std::vector<int> product_starts_, product_columns_;
  std::vector<std::uint16_t> product_slots_;
  std::vector<int> coarse_slots_;
  std::vector<float> product_row_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_PROLONGATION_H_
