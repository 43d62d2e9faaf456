// A mutex that is given to those who wait for it in the order in which they came: a
// thread that takes it again and again cannot keep the others from it.
#ifndef DPE_UNITY_FAIR_MUTEX_H_
#define DPE_UNITY_FAIR_MUTEX_H_

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace dpe::c {

class FairMutex {
 public:
  void lock() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::uint64_t ticket = next_++;
    turn_.wait(lock, [&] { return serving_ == ticket; });
  }
  void unlock() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++serving_;
    }
    turn_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable turn_;
  std::uint64_t next_ = 0;
  std::uint64_t serving_ = 0;
};

}  // namespace dpe::c

#endif  // DPE_UNITY_FAIR_MUTEX_H_
