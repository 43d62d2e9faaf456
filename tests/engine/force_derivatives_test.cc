// The derivatives of each force law, and of its directional expansion, against
// differences of the force itself.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "object_system.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

// A scene reduced to the one force law that is tested.
struct ForceCase {
  std::string name;
  bool springs = false;
  double damping = 0.0;
  double drag = 0.0;
  AerodynamicsLaw law = AerodynamicsLaw::kAuthored;
  bool colliders = false;
};

void PrintTo(const ForceCase& force_case, std::ostream* out) {
  *out << force_case.name;
}

class ForceDerivativesTest : public testing::TestWithParam<ForceCase> {
 protected:
  ForceDerivativesTest() {
    const ForceCase& force_case = GetParam();
    scene_ = MakeDerivativeScene(force_case.colliders ? "collider" : "corners", 4);
    Perturb(5, &scene_);
    ClothObject& cloth = scene_.objects[0];
    if (!force_case.springs) {
      cloth.springs.clear();
      cloth.spring_kind.clear();
      cloth.stiffness.resize(0);
    }
    if (force_case.colliders) {  // deep contact of several vertices with both
      scene_.colliders[0].position = {0.0, -1.5, -2.0};
      scene_.colliders[0].scale *= 2.5;
      scene_.colliders[1].position.z() = 0.5;
    }
    cloth.damping = force_case.damping;
    cloth.drag_coefficient = force_case.drag;
    scene_.aerodynamics = force_case.law;
    EstimateEverything(ParameterMode::kLocal, &scene_);
    system_ = std::make_unique<ObjectSystem>(scene_, 0, ParameterLayout(scene_));
    const int n = system_->num_coordinates();
    x_ = system_->initial_positions() + 0.3 * RandomVector(n, 1);
    v_ = system_->initial_velocities();
    dx_ = RandomVector(n, 2);
    dv_ = RandomVector(n, 3);
    // Fixed vertices have no direction: their motion is prescribed.
    Eigen::VectorXd mask(system_->pattern().num_rows());
    mask.setOnes();
    free_ = Eigen::VectorXd::Zero(n);
    system_->ScatterFree(mask.data(), free_.data());
  }

  ForceState Point(const Eigen::VectorXd& x, const Eigen::VectorXd& v,
                   bool directional) const {
    return {x.data(), v.data(), directional ? dx_.data() : nullptr,
            directional ? dv_.data() : nullptr};
  }

  Eigen::VectorXd Force(const Eigen::VectorXd& x, const Eigen::VectorXd& v,
                        bool directional) const {
    Eigen::VectorXd f(x.size());
    system_->Force(Point(x, v, directional), f.data());
    return f;
  }

  // dphi/dx or dphi/dv of the free vertices, applied to `direction`.
  Eigen::VectorXd Apply(double cx, double cv, VelocityPart part, bool directional,
                        const Eigen::VectorXd& direction) const {
    const BlockPattern& pattern = system_->pattern();
    std::vector<double> values(pattern.num_nonzeros(), 0.0);
    system_->AddJacobian(Point(x_, v_, directional), cx, cv, part, values.data());
    Eigen::VectorXd in(pattern.num_rows()), out(pattern.num_rows());
    system_->GatherFree(direction.data(), in.data());
    pattern.Multiply(values.data(), in.data(), out.data());
    Eigen::VectorXd result = Eigen::VectorXd::Zero(x_.size());
    system_->ScatterFree(out.data(), result.data());
    return result;
  }

  void CheckJacobians(bool directional) {
    const Eigen::VectorXd d =
        RandomVector(static_cast<int>(x_.size()), 4).cwiseProduct(free_);
    const Eigen::VectorXd of_x = Apply(1.0, 0.0, VelocityPart::kWhole, directional, d);
    const DerivativeCheck x_check = CheckDirectionalDerivative(
        [&](const Eigen::VectorXd& x) { return Force(x, v_, directional); }, x_, d,
        of_x);
    if (of_x.norm() > 0.0) {
      EXPECT_LT(x_check.relative_error, 1e-8) << "x: " << x_check;
    }
    const Eigen::VectorXd of_v = Apply(0.0, 1.0, VelocityPart::kWhole, directional, d);
    const DerivativeCheck v_check = CheckDirectionalDerivative(
        [&](const Eigen::VectorXd& v) { return Force(x_, v, directional); }, v_, d,
        of_v);
    if (of_v.norm() > 0.0) {
      EXPECT_LT(v_check.relative_error, 1e-8) << "v: " << v_check;
    }
    EXPECT_GT(of_x.norm() + of_v.norm(), 0.0);
  }

  Scene scene_;
  std::unique_ptr<ObjectSystem> system_;
  Eigen::VectorXd x_, v_, dx_, dv_, free_;
};

TEST_P(ForceDerivativesTest, DirectionalExpansionIsTheDerivativeOfTheForce) {
  const auto along = [&](const Eigen::VectorXd& t) {
    return Force(x_ + t[0] * dx_, v_ + t[0] * dv_, false);
  };
  const Eigen::VectorXd expansion = Force(x_, v_, true) - Force(x_, v_, false);
  const DerivativeCheck check = CheckDirectionalDerivative(
      along, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1), expansion);
  EXPECT_LT(check.relative_error, 1e-8) << check;
}

TEST_P(ForceDerivativesTest, JacobianOfTheForce) { CheckJacobians(false); }

TEST_P(ForceDerivativesTest, JacobianOfTheExpansion) { CheckJacobians(true); }

TEST_P(ForceDerivativesTest, AdjointIsTheTransposedJacobian) {
  const Eigen::VectorXd lambda =
      RandomVector(static_cast<int>(x_.size()), 6).cwiseProduct(free_);
  const Eigen::VectorXd d =
      RandomVector(static_cast<int>(x_.size()), 4).cwiseProduct(free_);
  for (const bool directional : {false, true}) {
    for (const VelocityPart part : {VelocityPart::kWhole, VelocityPart::kMinusPlain}) {
      Eigen::VectorXd gx = Eigen::VectorXd::Zero(x_.size()), gv = gx;
      system_->AddAdjoint(Point(x_, v_, directional), lambda.data(), 0.7, part,
                          gx.data(), gv.data());
      const double expected = 0.7 * lambda.dot(Apply(1.0, 1.0, part, directional, d));
      EXPECT_NEAR(d.dot(gx + gv), expected,
                  1e-12 * lambda.norm() * d.norm() * (1.0 + gx.norm() + gv.norm()));
    }
  }
}

TEST_P(ForceDerivativesTest, SymmetryIsDeclaredTruthfully) {
  const Eigen::VectorXd a =
      RandomVector(static_cast<int>(x_.size()), 8).cwiseProduct(free_);
  const Eigen::VectorXd b =
      RandomVector(static_cast<int>(x_.size()), 9).cwiseProduct(free_);
  const Eigen::VectorXd fa = Apply(1.0, 1.0, VelocityPart::kWhole, false, a);
  const Eigen::VectorXd fb = Apply(1.0, 1.0, VelocityPart::kWhole, false, b);
  const double asymmetry = std::abs(b.dot(fa) - a.dot(fb)) / (b.norm() * fa.norm());
  if (system_->IsSymmetric()) {
    EXPECT_LT(asymmetry, 1e-13);
  } else {
    EXPECT_GT(asymmetry, 1e-6);
  }
}

TEST_P(ForceDerivativesTest, ParameterDerivatives) {
  const ParameterLayout layout(scene_);
  const Eigen::VectorXd p = layout.Extract(scene_);
  const int n = static_cast<int>(x_.size());
  for (const bool directional : {false, true}) {
    const auto force_of = [&](const Eigen::VectorXd& parameters) {
      Scene scene = scene_;
      layout.Insert(parameters, &scene);
      system_->SetParameters(scene);
      return Force(x_, v_, directional);
    };
    force_of(p);
    std::vector<ParameterEntry> entries;
    ParameterSink sink(system_->columns(), 1.0, system_->node_of_vertex(), &entries);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
    system_->VisitStepParameters(Point(x_, v_, directional), 1.0, zero.data(), &sink);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(n, layout.size());
    for (const ParameterEntry& e : entries) jacobian(e.row, e.column) += e.value;
    const DerivativeCheck check = CheckJacobian(force_of, p, jacobian);
    EXPECT_LT(check.relative_error, 1e-8) << check;
    EXPECT_GT(jacobian.norm(), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, ForceDerivativesTest,
    testing::Values(
        ForceCase{"springs", true}, ForceCase{"damped_springs", true, 0.8},
        ForceCase{"drag_authored", false, 0.0, 0.7},
        ForceCase{"drag_unit_normal", false, 0.0, 0.7, AerodynamicsLaw::kUnitNormal},
        ForceCase{"mass_damping", false, 1.3},
        ForceCase{"colliders", false, 0.0, 0.0, AerodynamicsLaw::kAuthored, true},
        ForceCase{"everything", true, 0.4, 0.3, AerodynamicsLaw::kUnitNormal, true}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace dpe::test
