// dpe_benchmarks: see README.md for how to run it.
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "benchmarks.h"

int main(int argc, char** argv) {
  dpe::bench::RegisterMachine();
  dpe::bench::RegisterForward();
  dpe::bench::RegisterGradient();
  dpe::bench::RegisterMemory();
  dpe::bench::RegisterJacobian();
  dpe::bench::RegisterLmIteration();
  dpe::bench::RegisterEstimation();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const char* blas_threads = std::getenv("OPENBLAS_NUM_THREADS");
  benchmark::AddCustomContext("OPENBLAS_NUM_THREADS",
                              blas_threads != nullptr ? blas_threads : "not set");
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
