// How well the data determine the parameters: standard deviations, correlations, and
// the directions in parameter space that the data say nothing about, in words.
//
// The model. Observations are those of the true coordinates q* with independent normal
// noise of standard deviation 1 (residuals r are whitened), priors are normal in q with
// whitened rows P. To first order about the optimum q, whose error is e = q - q*,
//
//   r(q) = noise + J e,   e = -(J^T J + P^T P)^-1 (J^T noise + P^T (error of priors)),
//   Cov(e) = (J^T J + P^T P)^-1 = C.                                               (1)
//
// C is the inverse of the Fisher information, also the posterior covariance of the
// linearised model (Seber & Wild, Nonlinear Regression, 1989, section 2.1 and 2.8).
//
// Unknown noise. Residuals in metres have J and r in metres; the variance of the noise
// is then estimated as s^2 = |r|^2 / (m - rank J), and J / s takes the place of J
// (Seber & Wild, eq. 2.28).
//
// SI units. A quantity p = map(q) has, to first order (the delta method),
//
//   std(p) = |dp/dq| std(q):   p std(q) for p = exp q, so that std(q) is the relative
//                              standard deviation.                                 (2)
//
// Directions. J's coordinates are measured in natural units, z = q / u: u = 1 for
// logarithms (a factor e), for velocities the largest component of their block, at
// least 1 m/s, for positions half the cloth's extent. With unit columns, J diag(u) = B
// D^-1, |B e_j| = 1, the singular value decomposition B = U S V^T gives
//
//   S_i <= rank_tolerance S_1:  V_i is exactly undetermined. The columns of D V_i span
//                               the null space N; rounding errors of a column are of
//                               the size of that column, which is why B is decomposed
//                               and not J (Belsley, Kuh & Welsch, Regression
//                               Diagnostics, 1980, section 3.2: scaled condition
//                               indexes)
//   the rest:                   C = L^T L,  L = S^-1 V^T D (I - N N^T)             (3)
//
// (3) is the pseudo-inverse of J^T J in z: the covariance of the determined part (Golub
// & Van Loan, Matrix Computations, 4th ed., section 5.5.2). Parameters orthogonal to N
// have their variance from it whatever stands for the undetermined part; the others
// have an infinite one. Right singular vectors of L whose singular value, a standard
// deviation in z, exceeds weak_threshold are weakly determined: beyond a factor of e
// the linearisation (1) means little more than that.
//
// Null spaces have no natural basis. Theirs here is chosen to be readable: single
// parameters first, then whole blocks that change together (masses and stiffnesses of
// an object), then as few elements as possible.
#ifndef DPE_ESTIMATION_UNCERTAINTY_H_
#define DPE_ESTIMATION_UNCERTAINTY_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/export.h"

namespace dpe {

struct UncertaintyInput {
  const Scene* scene = nullptr;             // for names; that of the layout
  const ParameterLayout* layout = nullptr;  // n parameters
  Eigen::VectorXd coordinates;              // q at the optimum, see ParameterMap
  // n x n, upper triangular, R^T R = J^T J: of dr/dq without priors.
  Eigen::MatrixXd data_triangle;
  // k x n: d(whitened residuals of the priors)/dq; empty: none.
  Eigen::MatrixXd prior_rows;
  double residual_sum_of_squares = 0.0;  // |r|^2 at the optimum, without priors
  long num_residuals = 0;                // m, without priors
  // True: residuals are whitened. False: they are in metres.
  bool noise_is_known = false;
  // Autocorrelation of residuals from frame to frame, and of how many pairs; 0:
  // unknown.
  double residual_correlation = 0.0;
  long num_residual_pairs = 0;
};

struct UncertaintyOptions {
  // Singular values below this, relative to the largest, are rounding errors of the
  // Jacobian.
  double rank_tolerance = 1e-12;
  double weak_threshold = 1.0;  // standard deviation in natural units
  // A decomposition takes some 25 n^3 operations and 10 n^2 numbers; with more
  // parameters none is made and a sentence says so.
  int max_parameters = 3000;
  int max_matrix_parameters = 50;  // with more, no matrices but the strongest pairs
  int max_directions = 20;         // described, of each kind; all are counted
  int num_threads = 1;             // for priors; the result does not depend on it
};

// What is to be said of one parameter; several may hold.
enum ParameterFlag : unsigned {
  kNoInfluence = 1,       // what was observed does not depend on it, to rounding
  kUndetermined = 2,      // part of an undetermined direction: infinite deviation
  kWeaklyDetermined = 4,  // deviation above weak_threshold
  kPriorAlone = 8,        // the data add next to nothing to its prior
  kAtLowerLimit = 16,     // positive quantity that went to 0, and is weakly determined
  kAtUpperLimit = 32,     // positive quantity that went to infinity, likewise
};

// "no_influence", "undetermined", "weakly_determined", "prior_alone",
// "at_lower_limit", "at_upper_limit".
DPE_ESTIMATION_API std::vector<std::string> ParameterFlagNames(unsigned flags);

// One block of parameters, as EstimatedBlock.
struct BlockUncertainty {
  int object = -1;
  int segment = -1;  // as in ParameterBlock
  std::string kind;
  std::string unit;
  double natural_unit = 1.0;  // u, SI units; 1 for logarithms
  char mode = 'G';
  Eigen::VectorXd values;               // SI units
  Eigen::VectorXd standard_deviations;  // SI units; infinite: undetermined
  Eigen::VectorXd relative;             // std / value; NaN where q is not a logarithm
  // SI units, of the part that is determined: with what is undetermined left where it
  // is (the pseudo-inverse). Equal to standard_deviations without kUndetermined.
  Eigen::VectorXd determined_part;
  std::vector<unsigned> flags;  // ParameterFlag
};

enum class DirectionPattern {
  kSingle,    // one parameter
  kRatio,     // whole blocks by the same factor: only ratios were determined
  kProduct,   // two whole blocks by inverse factors: only the product was
  kBlocks,    // whole blocks by different powers of a factor
  kElements,  // a handful of parameters
  kGeneral,
};

DPE_ESTIMATION_API std::string DirectionPatternName(
    DirectionPattern pattern);  // "single", ...

// One direction in which the data do not, or hardly, fix the parameters.
struct UndeterminedDirection {
  bool is_exact = true;  // to rounding; false: weakly determined
  DirectionPattern pattern = DirectionPattern::kGeneral;
  // The largest parts, largest first, in natural units and relative to the largest: for
  // positive quantities relative changes.
  std::vector<int> parameters;
  std::vector<double> coefficients;
  int num_parameters = 0;  // with a part in it above one per cent of the largest
  // Standard deviation of the largest part if parameters move along this direction, in
  // natural units, from the data alone and with priors. Infinite: undetermined.
  double data_std = 0.0;
  double std = 0.0;
  std::string text;  // one sentence
};

// Two parameters whose errors are correlated.
struct CorrelatedPair {
  int first = 0, second = 0;
  double correlation = 0.0;
  std::string text;
};

struct Uncertainty {
  bool ok = false;      // false: nothing but `message`, and exact directions if any
  std::string message;  // why not
  bool noise_is_known = false;
  double noise = 0.0;  // standard deviation used for residuals: 1, or s in metres
  long degrees_of_freedom = 0;  // m - rank
  // |r|^2 / degrees_of_freedom of whitened residuals, about 1 if model and noise are
  // right; NaN if the noise is not known.
  double reduced_chi_square = 0.0;
  // Of successive frames, if it is more than chance; else 0. With it the standard
  // deviations, which take residuals for independent, are too small.
  double residual_correlation = 0.0;
  int rank = 0;                    // of the data Jacobian
  int num_weak_directions = 0;     // of the data
  std::vector<std::string> names;  // of all parameters
  std::vector<BlockUncertainty> blocks;
  // In the coordinates q; undetermined parts as in BlockUncertainty::determined_part.
  // Empty beyond max_matrix_parameters.
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd correlation;  // NaN for undetermined parameters
  std::vector<CorrelatedPair> strongest_pairs;
  std::vector<UndeterminedDirection> directions;  // exact ones first
  // What is to be said of noise, directions and parameters, in sentences.
  std::vector<std::string> statements;
};

// Analyses the linearised problem above. Never throws: input that does not fit together
// or is not finite, more parameters than max_parameters, and a noise that cannot be
// estimated (no more residuals than determined directions) give ok == false.
DPE_ESTIMATION_API Uncertainty ComputeUncertainty(
    const UncertaintyInput& input, const UncertaintyOptions& options = {});

// "all 5 parameters were determined", or how many were and which were not.
DPE_ESTIMATION_API std::string DeterminedText(const Uncertainty& uncertainty);

// What a program prints: one line per block, DeterminedText, then the statements.
DPE_ESTIMATION_API std::vector<std::string> UncertaintyLines(
    const Uncertainty& uncertainty);

}  // namespace dpe

#endif  // DPE_ESTIMATION_UNCERTAINTY_H_
