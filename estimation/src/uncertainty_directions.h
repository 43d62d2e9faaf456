// A readable basis of a subspace of parameter space: single parameters, then whole
// blocks that change together, then as few elements as possible.
#ifndef DPE_ESTIMATION_UNCERTAINTY_DIRECTIONS_H_
#define DPE_ESTIMATION_UNCERTAINTY_DIRECTIONS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/estimation/uncertainty.h"

namespace dpe {

// Parameter space in natural units, see uncertainty.h.
struct NaturalSpace {
  // @param coordinates  q
  NaturalSpace(const ParameterLayout& layout, const Eigen::VectorXd& coordinates);

  const ParameterLayout& layout;
  Eigen::VectorXd unit;             // u
  std::vector<ParameterKind> kind;  // per parameter
  // n x blocks: the change of z when a block as a whole changes by 100 %: ones for
  // logarithms, z itself for velocities (zero if these are zero), zero for positions,
  // which have no zero to be measured from.
  Eigen::MatrixXd block_changes;
};

struct ReadableDirection {
  Eigen::VectorXd vector;  // n, largest component 1 or -1
  DirectionPattern pattern = DirectionPattern::kGeneral;
  std::vector<int> blocks;     // of the patterns that have whole blocks
  std::vector<double> powers;  // relative change of each, largest 1
};

// @param subspace   n x k, orthonormal columns
// @param tolerance  squared length that a unit vector may have outside the subspace and
//                   still be taken for a part of it
// @param root       L of uncertainty.h: directions that have no pattern are the
//                   subspace's principal axes of L^T L, greatest first; null: as few
//                   elements as possible
std::vector<ReadableDirection> ReadableBasis(const NaturalSpace& space,
                                             const Eigen::MatrixXd& subspace,
                                             double tolerance,
                                             const Eigen::MatrixXd* root);

// The sentence. `direction` has everything but its text.
std::string DirectionText(const NaturalSpace& space,
                          const std::vector<std::string>& names,
                          const ReadableDirection& readable,
                          const UndeterminedDirection& direction);

}  // namespace dpe

#endif  // DPE_ESTIMATION_UNCERTAINTY_DIRECTIONS_H_
