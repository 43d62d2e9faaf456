// The evaluations that steps are built from, apart from any solver: forces, the step
// matrix, the adjoint of the forces, and products with the matrix.
//
// The state is the preset's cloth, shaken by a tenth of an edge, with springs, their
// damping and drag. Short as they are, other programs disturb them: take the least of
// --benchmark_repetitions=9.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "benchmarks.h"
#include "cases.h"
#include "object_system.h"

namespace dpe::bench {
namespace {

constexpr double kStep = 0.01;  // s

// Which terms the scene has beside gravity and springs.
struct ForcesCase {
  const char* name;
  bool damping;
  bool drag;
};

constexpr ForcesCase kForcesCases[] = {
    {"springs", false, false}, {"damped", true, false}, {"everything", true, true}};

struct ForcesFixture {
  ForcesFixture(const ForcesCase& forces, int size) {
    Case c;
    c.plan.size = size;
    Scene scene = MakeScene(c);
    scene.objects[0].damping = forces.damping ? 0.3 : 0.0;
    scene.objects[0].drag_coefficient = forces.drag ? 0.5 : 0.0;
    const ParameterLayout layout(scene);
    system = std::make_unique<ObjectSystem>(scene, 0, layout);
    gradient.resize(layout.size());
    std::mt19937 generator(1);
    std::normal_distribution<double> normal;
    const double edge = 7.0 / (size - 1);
    for (auto* vector : {&x, &v, &dx, &dv, &lambda, &gx, &gv, &force}) {
      vector->resize(system->num_coordinates());
      for (double& value : *vector) value = 0.1 * edge * normal(generator);
    }
    for (size_t i = 0; i < x.size(); ++i) x[i] += system->initial_positions()[i];
    for (size_t i = 0; i < x.size(); ++i) {
      if (system->node_of_vertex()[i / 3] < 0) lambda[i] = 0.0;
    }
    values.resize(system->pattern().num_nonzeros());
    in.assign(system->pattern().num_rows(), 1.0);
    out = in;
  }

  ForceState Point(bool directional) const {
    if (!directional) return {x.data(), v.data(), nullptr, nullptr};
    return {x.data(), v.data(), dx.data(), dv.data()};
  }

  void AssembleStepMatrix() {
    system->AssembleStepMatrix(x.data(), v.data(), kStep, &values);
  }

  std::unique_ptr<ObjectSystem> system;
  std::vector<double> x, v, dx, dv, lambda, gx, gv, force, values, gradient, in, out;
};

template <class Work>
void Register(const std::string& what, const ForcesCase& forces, int size, Work work) {
  const std::string name =
      "forces/" + what + "/" + forces.name + "/grid:" + std::to_string(size);
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    ForcesFixture fixture(forces, size);
    fixture.AssembleStepMatrix();
    for (auto _ : state) {
      work(&fixture);
      benchmark::ClobberMemory();
    }
  })->Unit(benchmark::kMicrosecond);
}

void RegisterCase(const ForcesCase& forces, int size) {
  for (const bool directional : {false, true}) {
    const std::string along = directional ? "_along_direction" : "";
    Register("force" + along, forces, size, [=](ForcesFixture* f) {
      f->system->Force(f->Point(directional), f->force.data());
    });
    Register("adjoint" + along, forces, size, [=](ForcesFixture* f) {
      f->system->AddAdjoint(f->Point(directional), f->lambda.data(), kStep,
                            VelocityPart::kWhole, f->gx.data(), f->gv.data());
    });
  }
  Register("step_matrix", forces, size,
           [](ForcesFixture* f) { f->AssembleStepMatrix(); });
  Register("tangent_matrix", forces, size, [](ForcesFixture* f) {
    f->system->AddJacobian(f->Point(true), kStep, 0.0, VelocityPart::kWhole,
                           f->values.data());
  });
  Register("parameters", forces, size, [](ForcesFixture* f) {
    ParameterSink sink(f->system->columns(), 1.0, f->lambda.data(), f->gradient.data());
    f->system->VisitStepParameters(f->Point(true), kStep, f->dv.data(), &sink);
  });
  Register("multiply", forces, size, [](ForcesFixture* f) {
    f->system->pattern().Multiply(f->values.data(), f->in.data(), f->out.data());
  });
  Register("multiply_transposed", forces, size, [](ForcesFixture* f) {
    f->system->pattern().MultiplyTransposed(f->values.data(), f->in.data(),
                                            f->out.data());
  });
}

}  // namespace

void RegisterForces() {
  for (const int size : {12, 96}) {
    for (const ForcesCase& forces : kForcesCases) RegisterCase(forces, size);
  }
}

}  // namespace dpe::bench
