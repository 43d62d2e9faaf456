// The batched force laws against the same laws one element at a time, at numbers of
// elements around the size of a batch.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "forces/drag.h"
#include "forces/spring.h"
#include "reference_kernels.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

constexpr int kNumbersOfElements[] = {1,          3,          kBatch - 1,    kBatch,
                                      kBatch + 1, 2 * kBatch, 2 * kBatch + 7};

enum class Law { kSprings, kDrag };

struct BatchCase {
  Law law;
  double coefficient;  // damping or drag
  AerodynamicsLaw aerodynamics;
  int num_elements;
};

std::vector<BatchCase> SpringCases(const std::vector<double>& dampings) {
  std::vector<BatchCase> cases;
  for (int n : kNumbersOfElements) {
    for (double damping : dampings) {
      cases.push_back({Law::kSprings, damping, AerodynamicsLaw::kAuthored, n});
    }
  }
  return cases;
}

std::vector<BatchCase> DragCases() {
  std::vector<BatchCase> cases;
  for (int n : kNumbersOfElements) {
    for (auto law : {AerodynamicsLaw::kAuthored, AerodynamicsLaw::kUnitNormal}) {
      for (double drag : {0.0, 0.7}) cases.push_back({Law::kDrag, drag, law, n});
    }
  }
  return cases;
}

std::string CaseName(const testing::TestParamInfo<BatchCase>& info) {
  const BatchCase& c = info.param;
  std::string name = c.law == Law::kSprings ? "Springs" : "Drag";
  if (c.aerodynamics == AerodynamicsLaw::kUnitNormal) name += "UnitNormal";
  return name + (c.coefficient > 0.0 ? "On" : "Zero") + std::to_string(c.num_elements);
}

void PrintTo(const BatchCase& batch_case, std::ostream* out) {
  *out << CaseName(testing::TestParamInfo<BatchCase>(batch_case, 0));
}

// The two differ in the order of operations alone.
constexpr double kRounding = 2e-14;

void ExpectSame(const Eigen::VectorXd& actual, const Eigen::VectorXd& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  ASSERT_TRUE(actual.allFinite());
  EXPECT_LE((actual - expected).lpNorm<Eigen::Infinity>(),
            kRounding * expected.lpNorm<Eigen::Infinity>());
}

class BatchTermTest : public testing::TestWithParam<BatchCase> {
 protected:
  BatchTermTest() : scene_(MakeDerivativeScene("corners", 7)) {
    const BatchCase& c = GetParam();
    Perturb(5, &scene_);
    ClothObject& cloth = scene_.objects[0];
    // One edge between fixed vertices, and vertices fixed in all positions of elements.
    for (int vertex : {1, 9, 17, 24, 33}) cloth.is_fixed[vertex] = 1;
    Truncate(c, &cloth);
    cloth.damping = c.law == Law::kSprings ? c.coefficient : 0.0;
    cloth.drag_coefficient = c.law == Law::kDrag ? c.coefficient : 0.0;
    EstimateEverything(ParameterMode::kLocal, &scene_);
    parameters_.mass = cloth.mass;
    parameters_.stiffness = cloth.stiffness;
    parameters_.damping = cloth.damping;
    parameters_.drag_coefficient = cloth.drag_coefficient;
    parameters_.wind = scene_.wind;
    if (c.law == Law::kSprings) {
      batched_ = std::make_unique<SpringTerm>(SpringLaw(cloth, &parameters_));
      reference_ = std::make_unique<ElementTerm<SpringKernel>>(
          SpringKernel(cloth, &parameters_));
    } else {
      batched_ =
          std::make_unique<DragTerm>(DragLaw(cloth, c.aerodynamics, &parameters_));
      reference_ = std::make_unique<ElementTerm<DragKernel>>(
          DragKernel(cloth, c.aerodynamics, &parameters_));
    }
    NumberNodes(cloth);
    const int n = 3 * cloth.num_vertices();
    x_ = cloth.positions + 0.3 * RandomVector(n, 1);
    v_ = RandomVector(n, 2);
    dx_ = RandomVector(n, 3);
    dv_ = RandomVector(n, 4);
    lambda_ = RandomVector(n, 5);
    for (int i = 0; i < n; ++i) {
      if (node_of_vertex_[i / 3] < 0) lambda_[i] = 0.0;
    }
    start_ = RandomVector(n, 6);
  }

  // Leaves as many elements as the case asks for, of those with a free vertex.
  static void Truncate(const BatchCase& c, ClothObject* cloth) {
    const auto keep = [&](auto* elements) {
      size_t end = 0;
      for (int kept = 0; end < elements->size() && kept < c.num_elements; ++end) {
        bool is_free = false;
        for (int vertex : (*elements)[end]) is_free |= !cloth->is_fixed[vertex];
        kept += is_free;
      }
      elements->resize(end);
      return end;
    };
    const size_t num_springs = keep(&cloth->springs);
    cloth->stiffness = cloth->stiffness.head(num_springs).eval();
    keep(&cloth->triangles);
  }

  // Nodes in another order than vertices.
  void NumberNodes(const ClothObject& cloth) {
    node_of_vertex_.assign(cloth.num_vertices(), -1);
    int num_nodes = 0;
    for (int k = 0; k < cloth.num_vertices(); ++k) {
      const int vertex = (k * 10) % cloth.num_vertices();
      if (!cloth.is_fixed[vertex]) node_of_vertex_[vertex] = num_nodes++;
    }
    std::vector<std::pair<int, int>> pairs, reference_pairs;
    batched_->AppendCouplings(&pairs);
    reference_->AppendCouplings(&reference_pairs);
    EXPECT_EQ(pairs, reference_pairs);
    const int pairs_per_element = GetParam().law == Law::kSprings ? 1 : 3;
    EXPECT_EQ(pairs.size(), GetParam().num_elements * pairs_per_element);
    for (auto& [a, b] : pairs) {
      a = node_of_vertex_[a];
      b = node_of_vertex_[b];
    }
    pattern_ = BlockPattern(num_nodes, pairs);
    batched_->BindPattern(pattern_, node_of_vertex_);
    reference_->BindPattern(pattern_, node_of_vertex_);
  }

  ForceState Point(bool directional) const {
    return {x_.data(), v_.data(), directional ? dx_.data() : nullptr,
            directional ? dv_.data() : nullptr};
  }

  Eigen::VectorXd Force(const ForceTerm& term, bool directional) const {
    Eigen::VectorXd force = start_;
    term.AddForce(Point(directional), force.data());
    return force - start_;
  }

  Eigen::VectorXd Jacobian(const ForceTerm& term, bool directional, double cx,
                           double cv, VelocityPart part) const {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(pattern_.num_nonzeros());
    term.AddJacobian(Point(directional), cx, cv, part, values.data());
    // Assembly adds to what is there.
    Eigen::VectorXd twice = values;
    term.AddJacobian(Point(directional), cx, cv, part, twice.data());
    EXPECT_LE((twice - 2.0 * values).norm(), 1e-14 * values.norm());
    return values;
  }

  Eigen::VectorXd Adjoint(const ForceTerm& term, bool directional,
                          VelocityPart part) const {
    Eigen::VectorXd gx = start_, gv = 2.0 * start_;
    term.AddAdjoint(Point(directional), lambda_.data(), 0.7, part, gx.data(), gv.data(),
                    /*sink=*/nullptr);
    Eigen::VectorXd both(2 * gx.size());
    both << gx - start_, gv - 2.0 * start_;
    return both;
  }

  Eigen::VectorXd Gradient(const ForceTerm& term, bool directional) const {
    const ParameterLayout layout(scene_);
    const ParameterColumns columns(layout, 0);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(layout.size());
    ParameterSink sink(columns, 1.3, lambda_.data(), gradient.data());
    term.VisitParameters(Point(directional), &sink);
    return gradient;
  }

  Eigen::VectorXd Entries(const ForceTerm& term, bool directional) const {
    const ParameterLayout layout(scene_);
    const ParameterColumns columns(layout, 0);
    std::vector<ParameterEntry> entries;
    ParameterSink sink(columns, 1.3, node_of_vertex_, &entries);
    term.VisitParameters(Point(directional), &sink);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(x_.size(), layout.size());
    for (const ParameterEntry& e : entries) dense(e.row, e.column) += e.value;
    return dense.reshaped();
  }

  Scene scene_;
  ObjectParameters parameters_;
  std::unique_ptr<ForceTerm> batched_, reference_;
  BlockPattern pattern_;
  std::vector<int> node_of_vertex_;
  Eigen::VectorXd x_, v_, dx_, dv_, lambda_, start_;
};

constexpr VelocityPart kParts[] = {VelocityPart::kWhole, VelocityPart::kMinusPlain};

TEST_P(BatchTermTest, Force) {
  for (bool directional : {false, true}) {
    ExpectSame(Force(*batched_, directional), Force(*reference_, directional));
  }
  EXPECT_EQ(batched_->IsSymmetric(), reference_->IsSymmetric());
}

TEST_P(BatchTermTest, Jacobian) {
  for (bool directional : {false, true}) {
    for (VelocityPart part : kParts) {
      const double factors[][2] = {{1.0, 0.0}, {0.0, 1.0}, {-0.3, 0.8}};
      for (const auto& [cx, cv] : factors) {
        ExpectSame(Jacobian(*batched_, directional, cx, cv, part),
                   Jacobian(*reference_, directional, cx, cv, part));
      }
    }
  }
}

TEST_P(BatchTermTest, Adjoint) {
  for (bool directional : {false, true}) {
    for (VelocityPart part : kParts) {
      ExpectSame(Adjoint(*batched_, directional, part),
                 Adjoint(*reference_, directional, part));
    }
  }
}

TEST_P(BatchTermTest, Parameters) {
  for (bool directional : {false, true}) {
    ExpectSame(Gradient(*batched_, directional), Gradient(*reference_, directional));
    ExpectSame(Entries(*batched_, directional), Entries(*reference_, directional));
    EXPECT_GT(Entries(*batched_, directional).norm(), 0.0);
  }
}

// Parameters and adjoint in one pass, as each by itself; the adjoint of velocities may
// be left out.
TEST_P(BatchTermTest, AdjointWithParameters) {
  const ParameterLayout layout(scene_);
  const ParameterColumns columns(layout, 0);
  for (const ForceTerm* term : {batched_.get(), reference_.get()}) {
    for (bool directional : {false, true}) {
      for (VelocityPart part : kParts) {
        for (bool wants_gv : {false, true}) {
          Eigen::VectorXd gradient = Eigen::VectorXd::Zero(layout.size());
          ParameterSink sink(columns, 1.3, lambda_.data(), gradient.data());
          Eigen::VectorXd gx = start_, gv = 2.0 * start_;
          term->AddAdjoint(Point(directional), lambda_.data(), 1.3, part, gx.data(),
                           wants_gv ? gv.data() : nullptr, &sink);
          Eigen::VectorXd both(2 * gx.size());
          both << gx - start_, gv - 2.0 * start_;
          Eigen::VectorXd expected = 1.3 / 0.7 * Adjoint(*term, directional, part);
          if (!wants_gv) expected.tail(gv.size()).setZero();
          ExpectSame(both, expected);
          ExpectSame(gradient, Gradient(*term, directional));
        }
      }
    }
  }
}

class UndampedSpringTest : public BatchTermTest {};

TEST_P(UndampedSpringTest, ReadsNoVelocities) {
  v_.setConstant(NAN);
  dv_.setConstant(NAN);
  for (bool directional : {false, true}) {
    EXPECT_TRUE(Force(*batched_, directional).allFinite());
    EXPECT_TRUE(
        Jacobian(*batched_, directional, 1.0, 1.0, VelocityPart::kWhole).allFinite());
    const Eigen::VectorXd adjoint =
        Adjoint(*batched_, directional, VelocityPart::kWhole);
    EXPECT_TRUE(adjoint.allFinite());
    EXPECT_EQ(adjoint.tail(x_.size()).norm(), 0.0);
  }
}

class DragTest : public BatchTermTest {
 protected:
  void ExpectNoForce() const {
    for (bool directional : {false, true}) {
      EXPECT_EQ(Force(*batched_, directional), Eigen::VectorXd::Zero(x_.size()));
      EXPECT_EQ(Jacobian(*batched_, directional, 1.0, 1.0, VelocityPart::kWhole),
                Eigen::VectorXd::Zero(pattern_.num_nonzeros()));
      EXPECT_EQ(Adjoint(*batched_, directional, VelocityPart::kWhole),
                Eigen::VectorXd::Zero(2 * x_.size()));
      EXPECT_TRUE(Gradient(*batched_, directional).isZero(0.0));
    }
  }
};

TEST_P(DragTest, CollapsedTrianglesCatchNoAir) {
  x_.setConstant(0.5);
  ExpectNoForce();
  // On a line, so that the direction opens them. Whole numbers: no rounding is left.
  for (int i = 0; i < x_.size(); ++i) x_[i] = (i % 3 - 1.0) * (i / 3);
  ExpectNoForce();
}

TEST_P(DragTest, WhatIsNotANumberIsNoCollapsedTriangle) {
  if (GetParam().coefficient == 0.0) return;
  x_[3 * scene_.objects[0].triangles[0][0]] = NAN;
  EXPECT_FALSE(Force(*batched_, false).allFinite());
}

INSTANTIATE_TEST_SUITE_P(Springs, BatchTermTest,
                         testing::ValuesIn(SpringCases({0.0, 0.8})), CaseName);
INSTANTIATE_TEST_SUITE_P(Drag, BatchTermTest, testing::ValuesIn(DragCases()), CaseName);
INSTANTIATE_TEST_SUITE_P(Springs, UndampedSpringTest,
                         testing::ValuesIn(SpringCases({0.0})), CaseName);
INSTANTIATE_TEST_SUITE_P(Drag, DragTest, testing::ValuesIn(DragCases()), CaseName);

}  // namespace
}  // namespace dpe::test
