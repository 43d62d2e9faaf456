// Hands values from one thread to another without either ever waiting: the writer fills
// one of three slots, the reader reads another, and the third holds the newest value
// that was published and not yet taken. What the reader does not take in time is
// overwritten.
#ifndef DPE_VIEWER_PLAYBACK_TRIPLE_BUFFER_H_
#define DPE_VIEWER_PLAYBACK_TRIPLE_BUFFER_H_

#include <array>
#include <atomic>

namespace dpe::viewer {

// One thread calls back() and Publish(), one other Update() and front().
template <class T>
class TripleBuffer {
 public:
  TripleBuffer() = default;
  explicit TripleBuffer(const T& value) { slots_.fill(value); }

  // What the writer fills. It holds some older value.
  T& back() { return slots_[back_]; }
  // Hands back() over; back() is another slot afterwards.
  void Publish() {
    back_ = middle_.exchange(back_ | kIsNew, std::memory_order_acq_rel) & kIndex;
  }

  // Takes the newest value over. False if there is none since the last call.
  bool Update() {
    if ((middle_.load(std::memory_order_relaxed) & kIsNew) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  const T& front() const { return slots_[front_]; }

 private:
  static constexpr unsigned kIndex = 3, kIsNew = 4;
  std::array<T, 3> slots_{};
  std::atomic<unsigned> middle_{1};
  alignas(64) unsigned back_ = 0;   // the writer's
  alignas(64) unsigned front_ = 2;  // the reader's
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PLAYBACK_TRIPLE_BUFFER_H_
