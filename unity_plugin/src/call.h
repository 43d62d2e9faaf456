// What every function of the C interface does around its work: it finds the handle,
// catches what is thrown, and keeps the message.
#ifndef DPE_UNITY_CALL_H_
#define DPE_UNITY_CALL_H_

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dpe/c/types.h"
#include "handle_table.h"

namespace dpe::c {

// A failure whose status is known.
class ApiError : public std::runtime_error {
 public:
  ApiError(dpe_status status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  dpe_status status() const { return status_; }

 private:
  dpe_status status_;
};

// Those of the calling thread. Never throw: without memory for it the message is lost.
void SetThreadError(const char* message) noexcept;
const std::string& ThreadError() noexcept;

// The status for the exception that is being handled; keeps its message for the thread,
// and for `object` if there is one.
dpe_status StatusOfException(HandleObject* object) noexcept;

// @throws ApiError if condition is false
inline void Require(bool condition, const char* what) {
  if (!condition) throw ApiError(DPE_ERROR_ARGUMENT, what);
}
// @throws ApiError naming the index and what is accepted
void RequireIndex(const char* what, int index, int count);
// ... and that it is not null and UTF-8
void RequireText(const char* what, const char* text);
void RequireFinite(const char* what, const double* values, int count);
void RequireVersion(std::uint32_t header);
// The message for a number that is not a live handle of this kind.
const char* NotAHandle(HandleKind kind);

template <class Work>
dpe_status Call(const Work& work) noexcept {
  try {
    work();
    return DPE_OK;
  } catch (...) {
    return StatusOfException(nullptr);
  }
}

// The object of a handle, null if it is not one of its class; a message is then kept.
template <class Object>
std::shared_ptr<Object> Find(dpe_handle handle) noexcept {
  if (HandleTable::KindOf(handle) == Object::kKind) {
    auto object = HandleTable::Global().Find(handle);
    if (object) return std::static_pointer_cast<Object>(std::move(object));
  }
  SetThreadError(NotAHandle(Object::kKind));
  return nullptr;
}

// work(Object&) for the object of a handle.
template <class Object, class Work>
dpe_status CallWith(dpe_handle handle, const Work& work) noexcept {
  const std::shared_ptr<Object> object = Find<Object>(handle);
  if (!object) return DPE_ERROR_HANDLE;
  try {
    work(*object);
    return DPE_OK;
  } catch (...) {
    return StatusOfException(object.get());
  }
}

// make() gives a shared_ptr to a new object, whose handle goes to *handle.
template <class Object, class Make>
dpe_status CreateWith(dpe_handle* handle, const Make& make) noexcept {
  return Call([&] {
    Require(handle != nullptr, "the pointer that receives the handle is null");
    *handle = HandleTable::Global().Add(Object::kKind, make());
  });
}

template <class Object>
dpe_status Destroy(dpe_handle handle) noexcept {
  if (HandleTable::Global().Destroy(handle, Object::kKind)) return DPE_OK;
  SetThreadError(NotAHandle(Object::kKind));
  return DPE_ERROR_HANDLE;
}

// Copies text to a caller's buffer as types.h says of dpe_last_error.
// @throws ApiError(DPE_ERROR_BUFFER)
void CopyText(const std::string& text, char* buffer, int capacity, int* length);

// Copies numbers likewise.
template <class Number>
void CopyNumbers(const Number* from, long size, Number* to, int capacity, int* count) {
  if (count != nullptr) *count = static_cast<int>(size);
  if (size > capacity) {
    throw ApiError(DPE_ERROR_BUFFER, std::to_string(size) +
                                         " numbers do not fit into a buffer for " +
                                         std::to_string(capacity));
  }
  Require(size == 0 || to != nullptr, "the buffer is null");
  for (long i = 0; i < size; ++i) to[i] = from[i];
}

}  // namespace dpe::c

#endif  // DPE_UNITY_CALL_H_
