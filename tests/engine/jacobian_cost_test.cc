// The choice between tangent and adjoint follows predicted costs; here they are
// compared with the processor time that both take, on both sides of the crossover.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <limits>

#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

double CpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Shape {
  const char* what;
  int num_columns;     // groups of springs
  int rows_per_frame;  // of every frame from first_frame on
  int first_frame;
  int num_frames;
  bool same_rows;  // all frames add to the same rows
  JacobianMethod cheaper;
};

// So many springs have stiffnesses of their own.
Scene MakeScene(int num_columns) {
  Scene scene = MakeDerivativeScene("side", 9);
  ClothObject& cloth = scene.objects[0];
  cloth.stiffness_mode = ParameterMode::kGroup;
  cloth.spring_group.resize(cloth.num_springs());
  int group = 0;
  for (int s = 0; s < cloth.num_springs(); ++s) {
    const auto& [a, b] = cloth.springs[s];
    const bool moves = !cloth.is_fixed[a] || !cloth.is_fixed[b];
    cloth.spring_group[s] = moves ? group++ % num_columns : 0;
  }
  return scene;
}

std::vector<StateDerivative> MakeRows(const Shape& shape, int num_coordinates,
                                      int* num_rows) {
  std::vector<StateDerivative> derivatives;
  *num_rows = 0;
  for (int frame = shape.first_frame; frame < shape.num_frames; ++frame) {
    StateDerivative d;
    d.frame = frame;
    d.first_row = shape.same_rows ? 0 : *num_rows;
    d.d_position.resize(shape.rows_per_frame, num_coordinates);
    for (int r = 0; r < shape.rows_per_frame; ++r) {
      d.d_position.insert(r, (7 * r + 40) % num_coordinates) = 1.0;
    }
    *num_rows = d.first_row + shape.rows_per_frame;
    derivatives.push_back(d);
  }
  return derivatives;
}

constexpr JacobianMethod kTangent = JacobianMethod::kTangent;
constexpr JacobianMethod kAdjoint = JacobianMethod::kAdjoint;
constexpr Shape kShapes[] = {
    {"few columns, many rows of one frame", 1, 200, 1, 2, false, kTangent},
    {"few columns, many rows of many frames", 2, 40, 1, 11, false, kTangent},
    {"many columns, few rows of one frame", 200, 3, 8, 9, false, kAdjoint},
    {"many columns, few rows of many frames", 200, 3, 1, 9, false, kAdjoint},
    {"many columns, more rows", 100, 200, 1, 5, false, kTangent},
    // Steps times columns alone would choose the other one: one backward sweep serves
    // all frames of a row.
    {"some columns, one row that reads every frame", 12, 1, 1, 30, true, kAdjoint},
};

class JacobianCostTest : public testing::TestWithParam<Shape> {};

TEST_P(JacobianCostTest, TheChoiceIsTheFasterOne) {
  const Shape& shape = GetParam();
  const Scene scene = MakeScene(shape.num_columns);
  Simulator simulator(scene);
  ASSERT_EQ(simulator.layout().size(), shape.num_columns);
  const Rollout rollout =
      simulator.Run(simulator.layout().Extract(scene), shape.num_frames);
  ASSERT_TRUE(rollout.status().ok()) << rollout.status().Message();
  int num_rows = 0;
  const auto rows = MakeRows(shape, 3 * scene.objects[0].num_vertices(), &num_rows);
  Sensitivity sensitivity(&simulator, &rollout);
  double seconds[2] = {std::numeric_limits<double>::max(),
                       std::numeric_limits<double>::max()};
  RowMajorMatrix jacobian;
  for (int repeat = 0; repeat < 5; ++repeat) {
    for (const JacobianMethod method : {kTangent, kAdjoint}) {
      const double start = CpuSeconds();
      sensitivity.Jacobian(rows, num_rows, method, &jacobian);
      double& least = seconds[method == kTangent ? 0 : 1];
      least = std::min(least, CpuSeconds() - start);
    }
  }
  const JacobianCosts costs = sensitivity.PredictCosts(rows);
  const double predicted = costs.tangent / costs.adjoint;
  const double measured = seconds[0] / seconds[1];
  RecordProperty("predicted", std::to_string(predicted));
  RecordProperty("measured", std::to_string(measured));
  EXPECT_EQ(sensitivity.CheaperMethod(rows), shape.cheaper);
  if (shape.cheaper == kTangent) {
    EXPECT_LT(measured, 1.0);
  } else {
    EXPECT_GT(measured, 1.0);
  }
  EXPECT_LT(predicted / measured, 2.5);
  EXPECT_GT(predicted / measured, 0.4);
}

INSTANTIATE_TEST_SUITE_P(All, JacobianCostTest, testing::ValuesIn(kShapes),
                         [](const auto& info) {
                           std::string name = info.param.what;
                           name.erase(std::remove(name.begin(), name.end(), ','),
                                      name.end());
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(JacobianCostTest, ThreadsSaveNothingOfOneBlock) {
  // 280 columns are three blocks, 3 rows are one.
  const Shape shape = {"", 200, 3, 4, 5, false, kAdjoint};
  const Scene scene = MakeScene(shape.num_columns);
  JacobianCosts costs[2];
  for (const int num_threads : {1, 3}) {
    SimulatorOptions options;
    options.num_threads = num_threads;
    Simulator simulator(scene, options);
    const Rollout rollout = simulator.Run(simulator.layout().Extract(scene), 5);
    int num_rows = 0;
    const auto rows = MakeRows(shape, 3 * scene.objects[0].num_vertices(), &num_rows);
    costs[num_threads > 1] = Sensitivity(&simulator, &rollout).PredictCosts(rows);
  }
  EXPECT_EQ(costs[1].adjoint, costs[0].adjoint);
  EXPECT_LT(costs[1].tangent, 0.8 * costs[0].tangent);
}

}  // namespace
}  // namespace dpe::test
