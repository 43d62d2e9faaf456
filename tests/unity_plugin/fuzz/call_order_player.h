// The bytes, the handles and the buffers of RunCallOrder.
#ifndef DPE_TESTS_UNITY_PLUGIN_CALL_ORDER_PLAYER_H_
#define DPE_TESTS_UNITY_PLUGIN_CALL_ORDER_PLAYER_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "dpe/dpe_c.h"
#include "fuzz/call_order.h"

namespace dpe::test {

enum class Kind { kNone, kScene, kPlayback, kBuilder, kEstimation };

struct HandleModel {
  dpe_handle handle = 0;
  Kind kind = Kind::kNone;  // it was made as; kNone: it never was one
  bool is_live = false;
};

// A caller's buffer with a pattern behind its end.
template <class Number>
class GuardedBuffer {
 public:
  explicit GuardedBuffer(int capacity, bool is_null)
      : capacity_(capacity), is_null_(is_null), values_(capacity + kGuards, Guard()) {}
  Number* data() { return is_null_ ? nullptr : values_.data(); }
  int capacity() const { return capacity_; }
  bool IsIntact() const {
    for (int i = capacity_; i < capacity_ + kGuards; ++i) {
      if (values_[i] != Guard()) return false;
    }
    return true;
  }

 private:
  static constexpr int kGuards = 16;
  static Number Guard() { return static_cast<Number>(77); }

  int capacity_;
  bool is_null_;
  std::vector<Number> values_;
};

class CallOrderPlayer {
 public:
  CallOrderPlayer(const CallOrderFiles& files, const std::uint8_t* bytes,
                  std::size_t size)
      : files_(files), bytes_(bytes), end_(bytes + size) {}

  bool has_more() const { return bytes_ != end_; }
  const CallOrderFiles& files() const { return files_; }
  const std::string& failure() const { return failure_; }
  void Fail(const std::string& what) {
    if (failure_.empty()) failure_ = what;
  }

  std::uint8_t Byte() { return bytes_ == end_ ? 0 : *bytes_++; }
  // Mostly small and sensible, sometimes not.
  int Int();
  double Number();
  const char* Path();
  // Null once in a while.
  template <class T>
  T* OrNull(T* pointer) {
    return Byte() % 16 == 15 ? nullptr : pointer;
  }

  // A handle of any kind and state, or a number that is none; more often one that is
  // live and of this kind.
  HandleModel* Handle(Kind kind);
  void Remember(dpe_handle handle, Kind kind);
  void Destroyed(HandleModel* handle) { handle->is_live = false; }
  void AllDestroyed();

  // What has to hold of the status of any call; of one with a handle, too.
  void Check(const char* call, dpe_status status);
  void Check(const char* call, dpe_status status, const HandleModel& handle, Kind kind);

  // call(buffer, capacity, count) with a buffer of some size.
  template <class Value, class Call>
  void WithBuffer(const char* name, const Call& call) {
    static constexpr int kSizes[] = {0, 1, 3, 9, 64, 3000};
    GuardedBuffer<Value> buffer(kSizes[Byte() % 6], Byte() % 16 == 15);
    std::int32_t count = 0;
    call(buffer.data(), buffer.capacity(), OrNull(&count));
    if (!buffer.IsIntact()) Fail(std::string(name) + " wrote behind the buffer");
  }

 private:
  const CallOrderFiles& files_;
  const std::uint8_t* bytes_;
  const std::uint8_t* end_;
  std::string failure_;
  std::array<HandleModel, 12> handles_;
  int next_ = 0;
  HandleModel none_;
};

}  // namespace dpe::test

#endif  // DPE_TESTS_UNITY_PLUGIN_CALL_ORDER_PLAYER_H_
