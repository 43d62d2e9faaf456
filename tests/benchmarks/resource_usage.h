// Processor time and memory of this process.
#ifndef DPE_TESTS_BENCHMARKS_RESOURCE_USAGE_H_
#define DPE_TESTS_BENCHMARKS_RESOURCE_USAGE_H_

namespace dpe::bench {

// Processor time of all threads, s. Unlike wall time it does not count what other
// programs take, and unlike a thread's own it does not hide work in others.
double CpuSeconds();

// The most memory that was resident at once since construction, beyond what was
// resident then.
class MemoryPeak {
 public:
  MemoryPeak();
  double Mebibytes() const;  // 0 where the system does not tell
  // The same with what was resident at construction.
  double ResidentMebibytes() const;

 private:
  double start_;
};

}  // namespace dpe::bench

#endif  // DPE_TESTS_BENCHMARKS_RESOURCE_USAGE_H_
