#include "dpe/estimation/motion_sensitivity.h"

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/sensitivity.h"

namespace dpe {
namespace {

// Of the power iteration. Where one direction grows much faster than the others, two
// are enough; where none does, it matters little which one is found.
constexpr int kIterations = 4;
constexpr double kGain = 1e-3;

// Growth up to here is nothing to worry about, and from here on it decides.
constexpr double kFaded = 1.0;
constexpr double kStrong = 100.0;

// The scene whose parameters are the initial states.
Scene WithStatesAsParameters(Scene scene) {
  const std::vector<char> estimated = ParameterLayout::EstimatedObjects(scene);
  const bool any = ParameterLayout(scene).size() > 0;
  scene.estimate_wind = false;
  for (size_t o = 0; o < scene.objects.size(); ++o) {
    ClothObject& cloth = scene.objects[o];
    cloth.mass_mode = cloth.stiffness_mode = ParameterMode::kFixed;
    cloth.estimate_damping = cloth.estimate_drag = false;
    cloth.rest_length = RestLengths(cloth);
    cloth.estimate_initial_velocity = cloth.estimate_initial_position =
        !any || estimated[o] != 0;
  }
  return scene;
}

class Growth {
 public:
  Growth(const Scene& scene, int num_frames, SimulatorOptions options)
      : scene_(WithStatesAsParameters(scene)), num_frames_(num_frames) {
    options.only_estimated_objects = true;
    simulator_ = std::make_unique<Simulator>(scene_, options);
    // dp/dz: 1 for positions, 1 / h for velocities.
    const ParameterLayout& layout = simulator_->layout();
    scale_.setOnes(layout.size());
    for (const ParameterBlock& block : layout.blocks()) {
      if (block.kind != ParameterKind::kInitialVelocity) continue;
      scale_.segment(block.offset, block.size).setConstant(1.0 / scene_.delta);
    }
  }

  MotionSensitivity Run() {
    if (scale_.size() == 0) return Failure("there is no free vertex");
    const Rollout rollout =
        simulator_->Run(simulator_->layout().Extract(scene_), num_frames_);
    if (!rollout.status().ok()) return Failure(rollout.status().Message());
    Sensitivity sensitivity(simulator_.get(), &rollout);
    std::mt19937 generator(1);
    Eigen::VectorXd u(scale_.size());
    // Not a normal_distribution, whose numbers depend on the standard library.
    for (double& value : u) value = generator() / 4294967296.0 - 0.5;
    u.normalize();
    for (int i = 0; i < kIterations; ++i) {
      const Eigen::MatrixXd squares = Push(&sensitivity, u);
      if (!sensitivity.ok()) return Failure(sensitivity.status().Message());
      const double before = result_.growth;
      Keep(squares);
      if (result_.growth <= (1.0 + kGain) * before) break;
      if (i + 1 == kIterations) break;
      u = Pull(&sensitivity);
      if (!sensitivity.ok()) return Failure(sensitivity.status().Message());
      if (!(u.norm() > 0.0)) break;
      u.normalize();
    }
    result_.ok = true;
    Explain();
    return std::move(result_);
  }

 private:
  MotionSensitivity Failure(const std::string& message) {
    MotionSensitivity failure;
    failure.num_frames = num_frames_;
    failure.message = message;
    return failure;
  }

  // T_f u for all frames, kept in change_.
  // @return |T_f u|^2, one per frame
  Eigen::VectorXd Push(Sensitivity* sensitivity, const Eigen::VectorXd& u) {
    std::vector<Eigen::MatrixXd> velocities;
    sensitivity->JacobianVectorProduct(scale_.cwiseProduct(u), &change_, &velocities);
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(num_frames_);
    for (const Eigen::MatrixXd& dx : change_) {
      if (dx.size() > 0) squares += dx.colwise().squaredNorm().transpose();
    }
    return squares;
  }

  // T_F^T change_F.
  Eigen::VectorXd Pull(Sensitivity* sensitivity) {
    for (Eigen::MatrixXd& dx : change_) {
      if (dx.size() > 0) dx.leftCols(num_frames_ - 1).setZero();
    }
    return scale_.cwiseProduct(sensitivity->Gradient(change_));
  }

  void Keep(const Eigen::VectorXd& squares) {
    const double growth = std::sqrt(squares[num_frames_ - 1]);
    if (growth < result_.growth) return;
    result_.growth = growth;
    result_.growth_by_frame = squares.cwiseSqrt();
  }

  void Explain() {
    result_.num_frames = num_frames_;
    const double seconds = scene_.delta * (num_frames_ - 1);
    result_.doubling_time = result_.growth > kFaded
                                ? seconds / std::log2(result_.growth)
                                : std::numeric_limits<double>::infinity();
    std::ostringstream text;
    text.precision(3);
    text << "a small disturbance of the cloth's state at frame 0 ";
    if (result_.growth <= kFaded) {
      text << "has faded to " << result_.growth << " of itself " << seconds
           << " s later: the motion forgets where it started";
    } else if (result_.growth < kStrong) {
      text << "grows at most " << result_.growth << "-fold within " << seconds
           << " s: the motion can be fitted as a whole";
    } else {
      text << "grows up to " << result_.growth << "-fold within " << seconds
           << " s (doubling every " << result_.doubling_time
           << " s): small errors decide what comes late, fits of the whole motion at "
              "once have many local minima (let the horizon grow), and a forecast is "
              "worth no more than a few doublings";
    }
    result_.text = text.str();
  }

  const Scene scene_;
  const int num_frames_;
  std::unique_ptr<Simulator> simulator_;
  Eigen::VectorXd scale_;
  std::vector<Eigen::MatrixXd> change_;
  MotionSensitivity result_;
};

}  // namespace

MotionSensitivity ComputeMotionSensitivity(const Scene& scene, int num_frames,
                                           const SimulatorOptions& options) {
  return Growth(scene, num_frames, options).Run();
}

}  // namespace dpe
