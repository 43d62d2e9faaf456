// Handles: numbers that stand for objects, which can be checked without touching memory
// that may be gone.
//
//   bits 63-56  kind   55-24  generation of the slot   23-0  slot
//
// A slot's generation grows when its object is removed, so that a handle is never that
// of a later object.
#ifndef DPE_UNITY_HANDLE_TABLE_H_
#define DPE_UNITY_HANDLE_TABLE_H_

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "dpe/c/types.h"

namespace dpe::c {

enum class HandleKind : std::uint8_t {
  kScene = 1,
  kPlayback = 2,
  kBuilder = 3,
  kEstimation = 4,
};

// What a handle stands for. Its functions lock for themselves.
class HandleObject {
 public:
  virtual ~HandleObject() = default;

  // Ends whatever goes on in the object; called once, when its handle is removed, while
  // other threads may still be inside of it.
  virtual void Close() {}

  std::string last_error() const {
    const std::lock_guard<std::mutex> lock(error_mutex_);
    return last_error_;
  }
  void set_last_error(const std::string& message) {
    const std::lock_guard<std::mutex> lock(error_mutex_);
    last_error_ = message;
  }

 private:
  mutable std::mutex error_mutex_;
  std::string last_error_;
};

class HandleTable {
 public:
  // That of the process. Its objects are closed when the library is unloaded.
  static HandleTable& Global();

  ~HandleTable() { CloseAll(); }

  // @throws std::bad_alloc, std::length_error; nothing is added then
  dpe_handle Add(HandleKind kind, std::shared_ptr<HandleObject> object);

  // The object of a live handle; null for all other numbers.
  std::shared_ptr<HandleObject> Find(dpe_handle handle) const;

  // Closes the object and makes the handle invalid. False if it was not a live one of
  // this kind.
  bool Destroy(dpe_handle handle, HandleKind kind);

  // Also joins the threads that were adopted, but the caller's own.
  void CloseAll();
  int size() const;

  // Takes a thread that cannot be joined by its object, which it destroyed itself. It
  // is joined later, so that none runs on while the library is unloaded.
  void Adopt(std::thread thread);

  static HandleKind KindOf(dpe_handle handle) {
    return static_cast<HandleKind>(handle >> 56);
  }

 private:
  struct Slot {
    HandleKind kind{};
    std::uint32_t generation = 1;
    std::shared_ptr<HandleObject> object;
  };

  const Slot* SlotOf(dpe_handle handle) const;
  std::shared_ptr<HandleObject> Take(int slot);

  mutable std::mutex mutex_;
  std::vector<Slot> slots_;
  std::vector<int> free_;  // with room for all slots
  std::vector<std::thread> adopted_;
};

}  // namespace dpe::c

#endif  // DPE_UNITY_HANDLE_TABLE_H_
