#include "dpe/estimation/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dpe/estimation/parameterization.h"
#include "tall_qr.h"
#include "uncertainty_algebra.h"
#include "uncertainty_directions.h"
#include "uncertainty_names.h"
#include "uncertainty_text.h"

namespace dpe {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A parameter belongs to the null space if its unit vector has a part of this length in
// it. Null vectors are exact to rounding over the gap between singular values.
constexpr double kParticipation = 1e-4;
// Squared length outside a subspace, see ReadableBasis: for null spaces rounding, for
// weak ones what readability costs.
constexpr double kExactTolerance = 1e-6;
constexpr double kWeakTolerance = 0.05;
// A parameter is its prior's alone if less than this part of its information is from
// the data.
constexpr double kLeastDataShare = 0.05;
// Where a positive quantity counts as gone to 0 or infinity: SI units, and relative to
// its block's median.
constexpr double kLowest = 1e3 * ParameterMap::kFloor;
constexpr double kHighest = 1e9;
constexpr double kFarFromMedian = 1e6;
// Least noise, m: far below rounding errors of positions of metres.
constexpr double kLeastNoise = 1e-20;
// An autocorrelation of residuals is mentioned above this and above as many of the
// standard deviations that it has by chance.
constexpr double kLeastAutocorrelation = 0.1;
constexpr double kChance = 5.0;
// Pairs of parameters reported as correlated.
constexpr double kLeastCorrelation = 0.9;
constexpr size_t kMaxPairs = 10;

std::string ProblemOf(const UncertaintyInput& input,
                      const UncertaintyOptions& options) {
  if (input.scene == nullptr || input.layout == nullptr) return "no scene or layout";
  const int n = input.layout->size();
  if (n == 0) return "nothing was estimated";
  if (n > options.max_parameters) {
    return "no standard deviations: " + std::to_string(n) +
           " parameters are more than the limit of " +
           std::to_string(options.max_parameters) + " for their decomposition";
  }
  if (input.coordinates.size() != n || input.data_triangle.rows() != n ||
      input.data_triangle.cols() != n ||
      (input.prior_rows.size() > 0 && input.prior_rows.cols() != n)) {
    return "coordinates, Jacobian and priors do not have the layout's " +
           std::to_string(n) + " parameters";
  }
  if (!input.coordinates.allFinite() || !input.data_triangle.allFinite() ||
      !input.prior_rows.allFinite() || !std::isfinite(input.residual_sum_of_squares) ||
      input.residual_sum_of_squares < 0.0) {
    return "no standard deviations: the Jacobian or the residuals at the result are "
           "not finite numbers";
  }
  return "";
}

class UncertaintyAnalysis {
 public:
  UncertaintyAnalysis(const UncertaintyInput& input, const UncertaintyOptions& options)
      : input_(input),
        options_(options),
        space_(*input.layout, input.coordinates),
        map_(*input.layout) {}

  Uncertainty Run() {
    result_.names = ParameterNames(*input_.scene, *input_.layout);
    result_.noise_is_known = input_.noise_is_known;
    result_.reduced_chi_square = kNan;
    const double chance =
        kChance / std::sqrt(std::max<double>(1.0, input_.num_residual_pairs));
    if (input_.residual_correlation > std::max(kLeastAutocorrelation, chance)) {
      result_.residual_correlation = input_.residual_correlation;
    }
    data_ = AnalyseInformation(input_.data_triangle * space_.unit.asDiagonal(),
                               options_.rank_tolerance);
    if (!data_.ok) return Failure("the decomposition of the Jacobian did not converge");
    result_.rank = data_.rank;
    if (!FindNoise()) {
      AddDirections(data_.null_basis, true);
      return Failure("no standard deviations: with " +
                     std::to_string(input_.num_residuals) + " residuals for " +
                     std::to_string(data_.rank) +
                     " determined directions the noise cannot be estimated; give it");
    }
    data_.root *= result_.noise;
    Eigen::MatrixXd weak;
    if (!AnalysePosterior() || !WeakSubspace(data_, options_.weak_threshold, &weak)) {
      return Failure("the decomposition of the Jacobian did not converge");
    }
    result_.num_weak_directions = static_cast<int>(weak.cols());
    result_.ok = true;
    FillBlocks();
    FillCorrelations();
    AddDirections(data_.null_basis, true);
    AddDirections(weak, false);
    result_.statements = MakeStatements(result_, options_);
    return std::move(result_);
  }

 private:
  Uncertainty Failure(const std::string& message) {
    result_.message = message;
    return std::move(result_);
  }

  bool FindNoise() {
    result_.degrees_of_freedom = input_.num_residuals - data_.rank;
    const double mean_square = input_.residual_sum_of_squares /
                               static_cast<double>(result_.degrees_of_freedom);
    if (input_.noise_is_known) {
      result_.noise = 1.0;
      if (result_.degrees_of_freedom > 0) result_.reduced_chi_square = mean_square;
      return true;
    }
    if (result_.degrees_of_freedom <= 0) {
      result_.noise = kNan;
      return false;
    }
    result_.noise = std::max(std::sqrt(mean_square), kLeastNoise);
    return true;
  }

  // Of [R / noise; P], folded into one triangle.
  bool AnalysePosterior() {
    if (input_.prior_rows.size() == 0) {
      posterior_ = data_;
    } else {
      const int n = input_.layout->size();
      const int num_rows = static_cast<int>(input_.prior_rows.rows());
      std::vector<int> chunk_rows = ChunkRows(num_rows);
      chunk_rows.insert(chunk_rows.begin(), n);
      Eigen::MatrixXd triangle;
      TallQr(
          chunk_rows, n, options_.num_threads,
          [&](int chunk, Eigen::Ref<Eigen::MatrixXd> rows) {
            if (chunk == 0) {
              rows = input_.data_triangle / result_.noise;
            } else {
              rows = input_.prior_rows.middleRows((chunk - 1) * kRowsPerChunk,
                                                  chunk_rows[chunk]);
            }
            rows *= space_.unit.asDiagonal();
            return true;
          },
          &triangle);
      posterior_ = AnalyseInformation(triangle, options_.rank_tolerance);
    }
    deviation_ = posterior_.root.colwise().norm().transpose();
    covariance_.noalias() = posterior_.root.transpose() * posterior_.root;
    return posterior_.ok;
  }

  bool TakesPart(const InformationAnalysis& analysis, int j) const {
    return analysis.null_basis.row(j).norm() > kParticipation;
  }

  // The part of each parameter's information that comes from the data. Of the error
  //   e = -C (J^T noise + P^T error of priors),
  //   Cov(e) = C = C J^T J C + C P^T P C,
  // the first term is the data's; with one parameter it is d / (d + p) of C where d and
  // p are the two informations. (Backus & Gilbert's resolution, as in Tarantola,
  // Inverse Problem Theory, 2005, section 3.3.2.)
  Eigen::VectorXd DataShares() const {
    const Eigen::MatrixXd part =
        (input_.data_triangle / result_.noise) * space_.unit.asDiagonal() * covariance_;
    return part.colwise().squaredNorm().transpose().cwiseQuotient(
        deviation_.cwiseAbs2());
  }

  void FillBlocks() {
    const Eigen::VectorXd parameters = map_.ToParameters(input_.coordinates);
    const Eigen::VectorXd slope = map_.Derivative(input_.coordinates).cwiseAbs();
    const bool has_priors = input_.prior_rows.size() > 0;
    const Eigen::VectorXd share = has_priors ? DataShares() : Eigen::VectorXd();
    for (const ParameterBlock& block : input_.layout->blocks()) {
      BlockUncertainty result;
      result.object = block.object;
      result.segment = block.segment;
      result.kind = ParameterKindName(block.kind);
      result.unit = ParameterKindUnit(block.kind);
      result.natural_unit = space_.unit[block.offset];
      result.mode = ParameterModeLetter(block.mode);
      result.values = parameters.segment(block.offset, block.size);
      result.determined_part.resize(block.size);
      result.standard_deviations.resize(block.size);
      result.relative.setConstant(block.size, kNan);
      const double median = Median(result.values);
      for (int k = 0; k < block.size; ++k) {
        const int j = block.offset + k;
        const double in_q = space_.unit[j] * deviation_[j];
        const double std = TakesPart(posterior_, j) ? kInfinity : in_q;
        result.determined_part[k] = slope[j] * in_q;
        result.standard_deviations[k] = slope[j] * std;
        if (map_.is_log(j)) result.relative[k] = std;
        result.flags.push_back(
            Flags(j, result.values[k], median, has_priors ? share[j] : 1.0));
      }
      result_.blocks.push_back(std::move(result));
    }
  }

  static double Median(Eigen::VectorXd values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  }

  unsigned Flags(int j, double value, double median, double data_share) const {
    unsigned flags = 0;
    const bool is_undetermined = TakesPart(posterior_, j);
    const bool is_weak = !is_undetermined && deviation_[j] > options_.weak_threshold;
    if (data_.null_basis.row(j).squaredNorm() >= 1.0 - kExactTolerance) {
      flags |= kNoInfluence;
    }
    if (is_undetermined) flags |= kUndetermined;
    if (is_weak) flags |= kWeaklyDetermined;
    if (!is_undetermined && data_share < kLeastDataShare) flags |= kPriorAlone;
    if (map_.is_log(j) && (is_undetermined || is_weak)) {
      if (value < std::max(kLowest, median / kFarFromMedian)) flags |= kAtLowerLimit;
      if (value > std::min(kHighest, median * kFarFromMedian)) flags |= kAtUpperLimit;
    }
    return flags;
  }

  void FillCorrelations() {
    const int n = input_.layout->size();
    Eigen::MatrixXd correlation = covariance_;
    for (int j = 0; j < n; ++j) {
      const double scale = TakesPart(posterior_, j) ? kNan : 1.0 / deviation_[j];
      correlation.col(j) *= scale;
      correlation.row(j) *= scale;
      correlation(j, j) = std::isnan(scale) ? kNan : 1.0;
    }
    std::vector<CorrelatedPair> pairs;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < j; ++i) {
        if (std::abs(correlation(i, j)) < kLeastCorrelation) continue;
        if (std::isnan(correlation(i, j))) continue;
        pairs.push_back({i, j, correlation(i, j), ""});
      }
    }
    const size_t count = std::min(pairs.size(), kMaxPairs);
    std::partial_sort(pairs.begin(), pairs.begin() + count, pairs.end(),
                      [](const CorrelatedPair& a, const CorrelatedPair& b) {
                        return std::abs(a.correlation) > std::abs(b.correlation);
                      });
    pairs.resize(count);
    for (CorrelatedPair& pair : pairs) {
      pair.text = result_.names[pair.first] + " and " + result_.names[pair.second] +
                  " are correlated: " + Short(pair.correlation);
    }
    result_.strongest_pairs = std::move(pairs);
    if (n > options_.max_matrix_parameters) return;
    result_.covariance =
        space_.unit.asDiagonal() * covariance_ * space_.unit.asDiagonal();
    result_.correlation = std::move(correlation);
  }

  void AddDirections(const Eigen::MatrixXd& subspace, bool is_exact) {
    std::vector<ReadableDirection> basis =
        ReadableBasis(space_, subspace, is_exact ? kExactTolerance : kWeakTolerance,
                      is_exact ? nullptr : &data_.root);
    if (static_cast<int>(basis.size()) > options_.max_directions) {
      basis.resize(options_.max_directions);
    }
    for (const ReadableDirection& readable : basis) Add(readable, is_exact);
  }

  void Add(const ReadableDirection& readable, bool is_exact) {
    constexpr double kPart = 0.01;
    constexpr size_t kMaxParts = 10;
    UndeterminedDirection direction;
    direction.is_exact = is_exact;
    direction.pattern = readable.pattern;
    for (int j = 0; j < readable.vector.size(); ++j) {
      if (std::abs(readable.vector[j]) > kPart) direction.parameters.push_back(j);
    }
    std::stable_sort(
        direction.parameters.begin(), direction.parameters.end(), [&](int a, int b) {
          return std::abs(readable.vector[a]) > std::abs(readable.vector[b]) + 1e-6;
        });
    if (direction.parameters.empty()) return;
    direction.num_parameters = static_cast<int>(direction.parameters.size());
    direction.parameters.resize(std::min(direction.parameters.size(), kMaxParts));
    for (const int j : direction.parameters) {
      direction.coefficients.push_back(readable.vector[j]);
    }
    direction.data_std = is_exact ? kInfinity : SpreadAlong(data_, readable.vector);
    direction.std = posterior_.ok ? SpreadAlong(posterior_, readable.vector) : kNan;
    direction.text = DirectionText(space_, result_.names, readable, direction);
    result_.directions.push_back(std::move(direction));
  }

  // Standard deviation of t where z moves by t v: of v^T z / |v|^2.
  double SpreadAlong(const InformationAnalysis& analysis,
                     const Eigen::VectorXd& v) const {
    if ((analysis.null_basis.transpose() * v).norm() > kParticipation * v.norm()) {
      return kInfinity;
    }
    return analysis.Deviation(v) / v.squaredNorm();
  }

  const UncertaintyInput& input_;
  const UncertaintyOptions& options_;
  const NaturalSpace space_;
  const ParameterMap map_;
  InformationAnalysis data_, posterior_;
  Eigen::VectorXd deviation_;   // of the determined part, natural units
  Eigen::MatrixXd covariance_;  // likewise
  Uncertainty result_;
};

}  // namespace

std::vector<std::string> ParameterFlagNames(unsigned flags) {
  static const char* const kNames[] = {"no_influence",      "undetermined",
                                       "weakly_determined", "prior_alone",
                                       "at_lower_limit",    "at_upper_limit"};
  std::vector<std::string> names;
  for (int bit = 0; bit < 6; ++bit) {
    if (flags & (1u << bit)) names.push_back(kNames[bit]);
  }
  return names;
}

Uncertainty ComputeUncertainty(const UncertaintyInput& input,
                               const UncertaintyOptions& options) {
  const std::string problem = ProblemOf(input, options);
  if (!problem.empty()) {
    Uncertainty result;
    result.message = problem;
    return result;
  }
  return UncertaintyAnalysis(input, options).Run();
}

}  // namespace dpe
