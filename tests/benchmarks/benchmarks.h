// The groups of benchmarks. Each function registers its own with Google Benchmark.
//
// Processor time is measured, and every figure that table.py prints is a counter in
// milliseconds; where a benchmark does more than one thing, they are timed apart.
#ifndef DPE_TESTS_BENCHMARKS_BENCHMARKS_H_
#define DPE_TESTS_BENCHMARKS_BENCHMARKS_H_

namespace dpe::bench {

void RegisterMachine();
void RegisterForward();
void RegisterGradient();
void RegisterMemory();
void RegisterJacobian();
void RegisterLmIteration();
void RegisterEstimation();

}  // namespace dpe::bench

#endif  // DPE_TESTS_BENCHMARKS_BENCHMARKS_H_
