// Priors and smoothness (priors.h) as residual rows on the optimiser's coordinates q.
//
//   r = scale (u(q_a) - q_b - centre)          u = exp for a normal prior on a quantity
//                                              whose logarithm is q, else the identity;
//                                              q_b for differences alone
//   dr/dq_a = scale u'(q_a),  dr/dq_b = -scale
//
// Every row reads one or two coordinates of a single parameter block. Rows of a block
// stand together, in pieces that stay small as dense matrices (a residual block of
// Ceres is one), since those of a smoothness prior are several times as many as there
// are springs.
#ifndef DPE_ESTIMATION_PRIOR_ROWS_H_
#define DPE_ESTIMATION_PRIOR_ROWS_H_

#include <Eigen/Core>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/priors.h"

namespace dpe {

class PriorRows {
 public:
  struct Row {
    int a = 0;   // parameter, layout order
    int b = -1;  // likewise; -1: none
    double scale = 0.0;
    double centre = 0.0;
    bool is_exponential = false;

    // @param q  all coordinates from parameter `offset` on
    double Residual(const double* q, int offset) const;
    double Slope(const double* q, int offset) const;  // dr/dq_a
  };

  // Rows begin ... end - 1, all of one block.
  struct Piece {
    int block = 0;  // of the layout
    int begin = 0, end = 0;
  };

  PriorRows() = default;
  // @param scene  of the layout; with several segments the first one's
  // @throws SceneError naming a prior that is not possible or acts on nothing that is
  //         estimated, and what is accepted
  PriorRows(const Scene& scene, const ParameterLayout& layout,
            const std::vector<Prior>& priors,
            const std::vector<SmoothnessPrior>& smoothness);

  int size() const { return static_cast<int>(rows_.size()); }
  bool empty() const { return rows_.empty(); }
  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<Piece>& pieces() const { return pieces_; }

  double Cost(const Eigen::VectorXd& q) const;  // 1/2 |r|^2
  // gradient += d Cost / dq
  void AddGradient(const Eigen::VectorXd& q, Eigen::VectorXd* gradient) const;

  // P with as many rows as there are, or, where that is less, as there are parameters:
  // the same P^T P = (dr/dq)^T dr/dq.
  Eigen::MatrixXd Triangle(const Eigen::VectorXd& q, int num_threads) const;

 private:
  std::vector<Row> rows_;
  std::vector<Piece> pieces_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_PRIOR_ROWS_H_
