#include "uncertainty_directions.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "uncertainty_algebra.h"

namespace dpe {
namespace {

// Parts below this, relative to the largest, do not count.
constexpr double kPart = 0.01;
// With as many parts a direction can still be listed in full.
constexpr int kHandful = 6;
// Choices of pivots to try for the sparsest basis of block changes.
constexpr int kMaxChoices = 2000;

int NumParts(const Eigen::VectorXd& v) {
  return static_cast<int>(
      (v.array().abs() > kPart * v.lpNorm<Eigen::Infinity>()).count());
}

// v with its largest component 1; of the sign of the first of its large components, so
// that it does not depend on rounding.
Eigen::VectorXd Scaled(const Eigen::VectorXd& v) {
  const double largest = v.lpNorm<Eigen::Infinity>();
  int first = 0;
  while (std::abs(v[first]) < 0.5 * largest) ++first;
  return v / (v[first] < 0.0 ? -largest : largest);
}

// The combinations Y T of Y's columns with an identity in `pivots`' rows; empty if
// there are none, or if their pivots' ratio is below `least_rcond`.
Eigen::MatrixXd WithPivots(const Eigen::MatrixXd& y, const std::vector<int>& pivots,
                           double least_rcond) {
  Eigen::MatrixXd square(pivots.size(), y.cols());
  for (size_t k = 0; k < pivots.size(); ++k) square.row(k) = y.row(pivots[k]);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(square);
  const Eigen::VectorXd pivot = qr.matrixQR().diagonal().cwiseAbs();
  if (!(pivot.minCoeff() > least_rcond * pivot.maxCoeff())) return {};
  return y * qr.inverse();
}

// Rows of Y that a QR decomposition with column pivoting of Y^T takes: a well
// conditioned choice.
std::vector<int> PivotsOf(const Eigen::MatrixXd& y) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(y.transpose());
  const auto& indices = qr.colsPermutation().indices();
  return {indices.data(), indices.data() + y.cols()};
}

// The basis of Y's columns with the fewest parts, of all with an identity somewhere.
// Among equals that one in which the last rows (the scene's wind, which is common to
// all objects) take part least.
Eigen::MatrixXd SparsestBasis(const Eigen::MatrixXd& y) {
  const int n = static_cast<int>(y.rows());
  Eigen::MatrixXd best = WithPivots(y, PivotsOf(y), 1e-10);
  const auto weight = [n](const Eigen::MatrixXd& basis) {
    double sum = 0.0;
    for (int k = 0; k < basis.cols(); ++k) sum += NumParts(basis.col(k));
    return sum + 0.1 * (basis.row(n - 1).array().abs() > kPart).cast<double>().sum();
  };
  if (y.cols() == 1 || best.size() == 0) return best.size() == 0 ? y : best;
  std::vector<char> mask(n, 0);
  std::fill(mask.begin(), mask.begin() + y.cols(), 1);
  for (int choice = 0; choice < kMaxChoices; ++choice) {
    std::vector<int> pivots;
    for (int i = 0; i < n; ++i) {
      if (mask[i]) pivots.push_back(i);
    }
    const Eigen::MatrixXd basis = WithPivots(y, pivots, 1e-3);
    if (basis.size() > 0 && weight(basis) < weight(best)) best = basis;
    if (!std::prev_permutation(mask.begin(), mask.end())) break;
  }
  return best;
}

class BasisBuilder {
 public:
  BasisBuilder(const NaturalSpace& space, Eigen::MatrixXd subspace, double tolerance)
      : space_(space), rest_(std::move(subspace)), tolerance_(tolerance) {}

  void TakeSingles() {
    const int n = static_cast<int>(rest_.rows());
    is_taken_.assign(n, 0);
    std::vector<int> taken;
    // A subspace of dimension d holds d unit vectors at most; with a loose tolerance
    // more may seem to be in it.
    for (int j = 0; j < n && static_cast<int>(taken.size()) < rest_.cols(); ++j) {
      if (rest_.row(j).squaredNorm() < 1.0 - tolerance_) continue;
      taken.push_back(j);
      is_taken_[j] = 1;
      Add(Eigen::VectorXd::Unit(n, j), DirectionPattern::kSingle);
    }
    Eigen::MatrixXd coordinates(rest_.cols(), taken.size());
    for (size_t k = 0; k < taken.size(); ++k) {
      coordinates.col(k) = rest_.row(taken[k]).transpose();
    }
    Remove(coordinates);
  }

  // Unit vectors E y that lie in the subspace S, where the columns of E are
  // orthonormal: the right singular vectors of S^T E with singular value 1.
  void TakeBlocks() {
    const Eigen::VectorXd length = BlockLengths();
    std::vector<int> used;
    for (int b = 0; b < length.size(); ++b) {
      if (length[b] > 0.0) used.push_back(b);
    }
    if (used.empty() || rest_.cols() == 0) return;
    Eigen::MatrixXd e(rest_.rows(), used.size());
    for (size_t k = 0; k < used.size(); ++k) {
      e.col(k) = Untaken(used[k]) / length[used[k]];
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rest_.transpose() * e,
                                                Eigen::ComputeThinV);
    const Eigen::VectorXd& s = svd.singularValues();
    int count = 0;
    while (count < s.size() && s[count] * s[count] >= 1.0 - tolerance_) ++count;
    if (count == 0) return;
    const Eigen::MatrixXd y = svd.matrixV().leftCols(count);
    Eigen::MatrixXd powers = y;
    for (size_t k = 0; k < used.size(); ++k) powers.row(k) /= length[used[k]];
    powers = SparsestBasis(powers);
    for (int k = 0; k < count; ++k) AddBlocks(used, Scaled(powers.col(k)));
    Remove(rest_.transpose() * e * y);
  }

  void TakeRest(const Eigen::MatrixXd* root) {
    if (rest_.cols() == 0) return;
    Eigen::MatrixXd basis;
    if (root != nullptr) {
      Eigen::MatrixXd inside = *root * rest_;
      Eigen::VectorXd s;
      Eigen::MatrixXd vt;
      basis = Svd(&inside, &s, &vt) ? rest_ * vt.transpose() : rest_;
    } else {
      basis = WithPivots(rest_, PivotsOf(rest_), 1e-10);
      if (basis.size() == 0) basis = rest_;
    }
    for (int k = 0; k < basis.cols(); ++k) {
      const int parts = NumParts(basis.col(k));
      Add(Scaled(basis.col(k)),
          parts <= kHandful ? DirectionPattern::kElements : DirectionPattern::kGeneral);
    }
  }

  std::vector<ReadableDirection> Take() { return std::move(result_); }

 private:
  // What a block changes of the parameters that are not taken yet.
  Eigen::VectorXd Untaken(int block) const {
    Eigen::VectorXd change = space_.block_changes.col(block);
    for (int j = 0; j < change.size(); ++j) {
      if (is_taken_[j]) change[j] = 0.0;
    }
    return change;
  }

  Eigen::VectorXd BlockLengths() const {
    Eigen::VectorXd length(space_.block_changes.cols());
    for (int b = 0; b < length.size(); ++b) length[b] = Untaken(b).norm();
    return length;
  }

  void Add(const Eigen::VectorXd& vector, DirectionPattern pattern) {
    result_.emplace_back();
    result_.back().vector = vector;
    result_.back().pattern = pattern;
  }

  void AddBlocks(const std::vector<int>& used, const Eigen::VectorXd& powers) {
    Eigen::VectorXd vector = Eigen::VectorXd::Zero(rest_.rows());
    ReadableDirection direction;
    for (int k = 0; k < powers.size(); ++k) {
      if (std::abs(powers[k]) <= kPart) continue;
      direction.blocks.push_back(used[k]);
      direction.powers.push_back(powers[k]);
      vector += powers[k] * Untaken(used[k]);
    }
    const auto is_near = [&](size_t k, double value) {
      return std::abs(direction.powers[k] - value) < 0.05;
    };
    bool all_equal = true;
    for (size_t k = 0; k < direction.powers.size(); ++k) all_equal &= is_near(k, 1.0);
    direction.pattern = DirectionPattern::kBlocks;
    if (all_equal) direction.pattern = DirectionPattern::kRatio;
    if (direction.powers.size() == 2 && is_near(0, 1.0) && is_near(1, -1.0)) {
      direction.pattern = DirectionPattern::kProduct;
    }
    direction.vector = Scaled(vector);
    result_.push_back(std::move(direction));
  }

  // What is left of the subspace without these vectors, given in its coordinates.
  void Remove(const Eigen::MatrixXd& coordinates) {
    if (coordinates.cols() > 0) rest_ = rest_ * Complement(coordinates);
  }

  const NaturalSpace& space_;
  Eigen::MatrixXd rest_;  // orthonormal
  double tolerance_;
  std::vector<char> is_taken_;
  std::vector<ReadableDirection> result_;
};

// Half the greatest extent of points along an axis; of a single one, 1.
double HalfExtent(const Eigen::VectorXd& positions) {
  const Eigen::Map<const Eigen::Matrix3Xd> points(positions.data(), 3,
                                                  positions.size() / 3);
  const double extent =
      (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
  return extent > 0.0 ? 0.5 * extent : 1.0;
}

}  // namespace

NaturalSpace::NaturalSpace(const ParameterLayout& parameter_layout,
                           const Eigen::VectorXd& coordinates)
    : layout(parameter_layout), unit(Eigen::VectorXd::Ones(coordinates.size())) {
  const int num_blocks = static_cast<int>(layout.blocks().size());
  block_changes.setZero(coordinates.size(), num_blocks);
  for (int b = 0; b < num_blocks; ++b) {
    const ParameterBlock& block = layout.blocks()[b];
    kind.insert(kind.end(), block.size, block.kind);
    auto change = block_changes.col(b).segment(block.offset, block.size);
    if (ParameterKindIsPositive(block.kind)) {
      change.setOnes();
      continue;
    }
    const Eigen::VectorXd values = coordinates.segment(block.offset, block.size);
    const bool is_position = block.kind == ParameterKind::kInitialPosition;
    const double size = is_position ? HalfExtent(values)
                                    : std::max(1.0, values.lpNorm<Eigen::Infinity>());
    unit.segment(block.offset, block.size).setConstant(size);
    if (!is_position) change = values / size;
  }
}

std::vector<ReadableDirection> ReadableBasis(const NaturalSpace& space,
                                             const Eigen::MatrixXd& subspace,
                                             double tolerance,
                                             const Eigen::MatrixXd* root) {
  BasisBuilder builder(space, subspace, tolerance);
  if (subspace.cols() == 0) return {};
  builder.TakeSingles();
  builder.TakeBlocks();
  builder.TakeRest(root);
  return builder.Take();
}

}  // namespace dpe
