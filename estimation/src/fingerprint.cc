#include "fingerprint.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>

#include "dpe/engine/scene_io.h"

namespace dpe {
namespace {

// FNV-1a, 64 bits: enough to notice a mistake; nobody forges checkpoints.
class Digest {
 public:
  void AddBytes(const void* data, size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (size_t i = 0; i < size; ++i) {
      hash_ = (hash_ ^ bytes[i]) * 1099511628211ULL;
    }
  }
  void Add(const std::string& text) {
    Add(static_cast<double>(text.size()));
    AddBytes(text.data(), text.size());
  }
  void Add(double value) {
    // All NaN and both zeros count as the same.
    if (std::isnan(value)) value = std::numeric_limits<double>::quiet_NaN();
    if (value == 0.0) value = 0.0;
    AddBytes(&value, sizeof(value));
  }
  void Add(const Eigen::MatrixXd& matrix) {
    Add(static_cast<double>(matrix.rows()));
    Add(static_cast<double>(matrix.cols()));
    for (Eigen::Index i = 0; i < matrix.size(); ++i) Add(matrix.data()[i]);
  }
  std::string Text() const {
    char text[17];
    std::snprintf(text, sizeof(text), "%016llx",
                  static_cast<unsigned long long>(hash_));
    return text;
  }

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

std::string DigestOf(const std::string& text) {
  Digest digest;
  digest.Add(text);
  return digest.Text();
}

std::string DigestOf(const Observations& observations) {
  Digest digest;
  for (const Eigen::MatrixXd& positions : observations.positions) digest.Add(positions);
  for (const Eigen::MatrixXd& sigmas : observations.sigmas) digest.Add(sigmas);
  for (const Marker& marker : observations.markers) {
    digest.Add(static_cast<double>(marker.object));
    for (const int vertex : marker.vertices) digest.Add(static_cast<double>(vertex));
    for (const double weight : marker.weights) digest.Add(weight);
  }
  for (const MarkerSample& sample : observations.samples) {
    digest.Add(static_cast<double>(sample.marker));
    digest.Add(sample.time);
    digest.Add(Eigen::MatrixXd(sample.position));
    digest.Add(sample.sigma);
  }
  digest.Add(observations.sigma);
  return digest.Text();
}

std::string PriorsText(const EstimatorOptions& options) {
  std::string text;
  for (const Prior& prior : options.priors) {
    text += (text.empty() ? "" : ";") + PriorText(prior);
  }
  return text;
}

std::string Start(const EstimatorOptions& options) {
  switch (options.init) {
    case InitMethod::kAuto:
      return "auto";
    case InitMethod::kInverseDynamics:
      return "inverse_dynamics";
    case InitMethod::kScene:
      return "scene";
    case InitMethod::kUniform:
      return "uniform:" + Number(options.uniform_value);
    case InitMethod::kScreen:
      return "screen";
  }
  return "";
}

std::string HorizonName(Horizon horizon) {
  switch (horizon) {
    case Horizon::kAuto:
      return "auto";
    case Horizon::kFull:
      return "full";
    case Horizon::kShooting:
      return "shooting";
    case Horizon::kGrow:
      return "grow";
  }
  return "";
}

std::string Solver(SolverType solver) {
  switch (solver) {
    case SolverType::kAuto:
      return "auto";
    case SolverType::kLevenbergMarquardt:
      return "lm";
    case SolverType::kLbfgs:
      return "lbfgs";
  }
  return "";
}

}  // namespace

Fingerprint FingerprintOf(const std::vector<CaptureView>& captures,
                          const EstimatorOptions& options) {
  Fingerprint fingerprint;
  for (size_t c = 0; c < captures.size(); ++c) {
    // Of one capture alone the names are those of its only scene and target.
    const std::string which = captures.size() == 1 ? "" : " " + std::to_string(c + 1);
    const Scene& scene = *captures[c].scene;
    const Observations& observations = *captures[c].observations;
    fingerprint.insert(
        fingerprint.end(),
        {{"scene" + which, DigestOf(SceneToJson(scene))},
         {"settings" + which, SettingsString(scene)},
         {"target" + which, DigestOf(observations)},
         {"frames" + which,
          std::to_string(options.num_frames > 0 ? options.num_frames
                                                : observations.num_frames())}});
  }
  fingerprint.insert(fingerprint.end(),
                     {{"loss", LossTypeName(options.loss)},
                      {"loss_scale", Number(options.loss_scale)},
                      {"horizon", HorizonName(options.horizon)},
                      {"solver", Solver(options.solver)},
                      {"init", Start(options)},
                      {"init_perturbation", Number(options.init_perturbation)},
                      {"seed", std::to_string(options.seed)}});
  if (!options.priors.empty()) fingerprint.push_back({"priors", PriorsText(options)});
  if (!options.smoothness.empty()) {
    fingerprint.push_back({"smoothness", SmoothnessText(options.smoothness)});
  }
  return fingerprint;
}

void RequireSameProblem(const Checkpoint& checkpoint, const Fingerprint& problem,
                        const std::string& name) {
  std::string differences;
  const auto value_in = [](const Fingerprint& fingerprint, const std::string& key) {
    for (const auto& [known, value] : fingerprint) {
      if (known == key) return value;
    }
    return std::string("not given");
  };
  for (const auto& [key, value] : problem) {
    const std::string other = value_in(checkpoint.problem, key);
    if (other != value) {
      differences += (differences.empty() ? "" : ", ") + key + " (" + other +
                     " in the checkpoint, " + value + " now)";
    }
  }
  for (const auto& [key, value] : checkpoint.problem) {
    if (value_in(problem, key) == "not given") {
      differences += (differences.empty() ? "" : ", ") + key + " (" + value +
                     " in the checkpoint, not given now)";
    }
  }
  if (differences.empty()) return;
  throw SceneError(name + ": is the checkpoint of another fit, with another " +
                   differences);
}

}  // namespace dpe
