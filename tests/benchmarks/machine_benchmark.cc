// What the machine can do, so that milliseconds of one can be scaled to another.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "benchmarks.h"
#include "resource_usage.h"

extern "C" void dgemm_(const char* op_a, const char* op_b, const int* m, const int* n,
                       const int* k, const double* alpha, const double* a,
                       const int* lda, const double* b, const int* ldb,
                       const double* beta, double* c, const int* ldc);

namespace dpe::bench {
namespace {

constexpr int kSize = 512;

// Product of two 512 x 512 matrices by the BLAS that the engine uses.
void Dgemm(benchmark::State& state) {
  const std::vector<double> a(kSize * kSize, 1.5), b(kSize * kSize, 0.5);
  std::vector<double> c(kSize * kSize);
  const double one = 1.0, zero = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const double start = CpuSeconds();
    dgemm_("N", "N", &kSize, &kSize, &kSize, &one, a.data(), &kSize, b.data(), &kSize,
           &zero, c.data(), &kSize);
    least = std::min(least, CpuSeconds() - start);
    benchmark::DoNotOptimize(c.data());
  }
  state.counters["ms"] = 1e3 * least;
  state.counters["gflops"] = 2e-9 * kSize * kSize * kSize / least;
}

}  // namespace

void RegisterMachine() {
  benchmark::RegisterBenchmark("machine_dgemm/512", Dgemm)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(50);
}

}  // namespace dpe::bench
