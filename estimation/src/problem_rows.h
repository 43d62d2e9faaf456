// The residuals r and the Jacobian J of a ceres::Problem, read a few rows at a time.
//
// A row of the matrix [J r] is one residual; columns are the tangent spaces of the
// parameter blocks that are not constant, one after the other, and last the residual.
// Loss functions are applied, as Ceres applies them for its own linear solvers.
//
// Where residuals read different parameter blocks, J is mostly zeros: rows of a segment
// know nothing of the initial states of others. Rows come in groups, all rows of which
// read the same parameter blocks, and a group's columns are those of its blocks alone.
// What one pays for rows is rows x columns^2; unless groups save three fifths of
// that, there is one group of all rows and columns. Within a group rows come in chunks
// of whole residual blocks, for tall_qr.h.
#ifndef DPE_ESTIMATION_PROBLEM_ROWS_H_
#define DPE_ESTIMATION_PROBLEM_ROWS_H_

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <unordered_map>
#include <vector>

#include "dpe/engine/sensitivity.h"

namespace dpe {

class ProblemRows {
 public:
  // A parameter block that some residual reads and that is not constant.
  struct FreeBlock {
    double* values = nullptr;  // the user's memory
    int size = 0;
    int tangent_size = 0;
    const ceres::Manifold* manifold = nullptr;  // null: a vector space
  };

  struct Group {
    std::vector<int> free_blocks;  // that its rows read, indices into free_blocks()
    std::vector<int> columns;      // of each one's tangent space in the group's rows
    int num_columns = 0;           // of J
    int num_rows = 0;
    std::vector<int> chunk_rows;
    std::vector<int> residual_blocks;  // by chunks
    std::vector<int> chunk_begins;     // in residual_blocks, and the end
    std::vector<int> column_of_block;  // for each of free_blocks(); -1: not read
  };

  // The problem's structure as it stands now. `problem` must outlive this object.
  explicit ProblemRows(ceres::Problem* problem);

  const std::vector<FreeBlock>& free_blocks() const { return free_blocks_; }
  int num_rows() const { return num_rows_; }
  int num_parameters() const { return num_parameters_; }  // columns of J
  const std::vector<Group>& groups() const { return groups_; }

  // The cost of a group at the point in the parameter blocks' memory. False if a
  // residual cannot be evaluated there or the sum is not finite.
  bool EvaluateCost(int group, double* cost);

  // Rows of one chunk of a group's [J r] at that point, and adds up their cost. False
  // as above, or if a derivative is not finite.
  bool EvaluateChunk(int group, int chunk, Eigen::Ref<Eigen::MatrixXd> rows,
                     double* cost);

 private:
  struct ResidualBlock {
    ceres::ResidualBlockId id = nullptr;
    int num_rows = 0;
    std::vector<int> free_blocks;  // of each parameter block it reads; -1: constant
  };

  int FreeIndex(double* values);
  void MakeGroups();
  void FinishGroup(Group* group) const;
  bool EvaluateBlock(const Group& group, const ResidualBlock& block,
                     Eigen::Ref<Eigen::MatrixXd> rows, double* cost);

  ceres::Problem* problem_;
  std::unordered_map<double*, int> free_index_;
  std::vector<FreeBlock> free_blocks_;
  std::vector<ResidualBlock> residual_blocks_;
  std::vector<Group> groups_;
  int num_rows_ = 0;
  int num_parameters_ = 0;
  std::vector<RowMajorMatrix> derivatives_;  // of one residual block, kept as memory
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_PROBLEM_ROWS_H_
