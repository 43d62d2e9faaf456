// Simulates a cloth in free fall and compares it with the equation of motion, and
// catches the library's exception, whose type both sides must agree on.
#include <dpe/engine/cloth_builder.h>
#include <dpe/engine/parallel.h>
#include <dpe/engine/scene_io.h>
#include <dpe/engine/simulator.h>

#include <atomic>
#include <cmath>
#include <cstdio>

namespace {

bool Expect(bool holds, const char* what) {
  if (!holds) std::printf("FAILED: %s\n", what);
  return holds;
}

// A cloth in free fall: symplectic Euler gives y_f = -g h^2 f (f + 1) / 2.
bool FallsFreely() {
  dpe::Scene scene = dpe::MakePresetScene(dpe::ScenePreset::kSide);
  scene.integration_method = dpe::IntegrationMethod::kSymplecticEuler;
  scene.wind.setZero();
  dpe::ClothObject& cloth = scene.objects[0];
  dpe::UnpinAll(&cloth);
  cloth.drag_coefficient = cloth.damping = 0.0;
  constexpr int kFrames = 10;
  const dpe::Trajectory motion = dpe::Simulator(scene).Simulate(kFrames);
  const double h = scene.step_length();
  const double expected = scene.gravity.y() * h * h * (kFrames - 1) * kFrames / 2;
  const Eigen::VectorXd moved =
      motion.positions[0].col(kFrames - 1) - motion.positions[0].col(0);
  double error = 0.0;
  for (int v = 0; v < cloth.num_vertices(); ++v) {
    error = std::max(error, std::abs(moved[3 * v + 1] - expected));
  }
  std::printf("fell %.6f m, error %.1e m\n", -expected, error);
  return Expect(motion.status.ok() && error < 1e-12, "a free fall");
}

bool CatchesErrors() {
  try {
    dpe::ParseScene("{}", "empty.txt");
  } catch (const dpe::SceneError& error) {
    std::printf("%s\n", error.what());
    return Expect(std::string(error.what()).rfind("empty.txt", 0) == 0, "a file name");
  }
  return Expect(false, "an exception");
}

bool RunsThreads() {
  std::atomic<int> sum{0};
  dpe::ParallelFor(2, 10, [&sum](int i) { sum += i; });
  return Expect(sum == 45, "a sum over threads");
}

}  // namespace

int main() {
  const bool ok = FallsFreely() & CatchesErrors() & RunsThreads();
  return ok ? 0 : 1;
}
