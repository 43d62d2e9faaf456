// Sparse linear least squares by QR: min_x |A x - b|.
//
// QR of A, not a Cholesky factorization of A^T A: the normal equations would lose half
// of the digits. Columns are scaled to unit length first, so that the rank decision
// does not depend on the units of the unknowns.
#ifndef DPE_ESTIMATION_SPARSE_LEAST_SQUARES_H_
#define DPE_ESTIMATION_SPARSE_LEAST_SQUARES_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace dpe {

class SparseLeastSquares {
 public:
  // Factors `matrix`. A column that is zero, or depends on others to within
  // `rank_tolerance` of its length, is dead: its unknown is not determined.
  explicit SparseLeastSquares(const Eigen::SparseMatrix<double>& matrix,
                              double rank_tolerance = 1e-14);
  ~SparseLeastSquares();

  // False if the factorization ran out of memory.
  bool ok() const { return ok_; }
  bool is_dead(int column) const { return is_dead_[column] != 0; }
  int num_dead() const;

  // A least-squares solution, 0 at dead columns.
  Eigen::VectorXd Solve(const Eigen::VectorXd& rhs) const;

 private:
  struct Factor;

  bool ok_ = false;
  std::vector<char> is_dead_;
  std::vector<int> kept_columns_;  // those that are not zero
  Eigen::VectorXd scale_;          // 1 / length, one per kept column
  std::unique_ptr<Factor> factor_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_SPARSE_LEAST_SQUARES_H_
