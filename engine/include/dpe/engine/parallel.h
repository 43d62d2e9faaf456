// Runs independent pieces of work on several threads.
#ifndef DPE_ENGINE_PARALLEL_H_
#define DPE_ENGINE_PARALLEL_H_

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace dpe {

// Calls work(i) for i in [0, count) on up to `num_threads` threads (the caller's
// included) and returns when all are done. The pieces must not depend on each other and
// must not throw.
template <class Work>
void ParallelFor(int num_threads, int count, const Work& work) {
  const int extra = std::min(num_threads, count) - 1;
  if (extra <= 0) {
    for (int i = 0; i < count; ++i) work(i);
    return;
  }
  std::atomic<int> next{0};
  const auto loop = [&] {
    for (int i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < extra; ++t) threads.emplace_back(loop);
  loop();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace dpe

#endif  // DPE_ENGINE_PARALLEL_H_
