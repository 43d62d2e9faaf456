#include "call.h"

#include <cmath>
#include <cstring>
#include <new>

#include "dpe/engine/scene.h"
#include "utf8.h"

namespace dpe::c {
namespace {

std::string& MutableThreadError() {
  thread_local std::string message;
  return message;
}

dpe_status Keep(dpe_status status, const char* message, HandleObject* object) noexcept {
  SetThreadError(message);
  try {
    if (object != nullptr) object->set_last_error(message);
  } catch (...) {
    // There is no memory for the message; the status says enough.
  }
  return status;
}

}  // namespace

void SetThreadError(const char* message) noexcept {
  try {
    MutableThreadError() = message;
  } catch (...) {
    MutableThreadError().clear();
  }
}

const std::string& ThreadError() noexcept { return MutableThreadError(); }

dpe_status StatusOfException(HandleObject* object) noexcept {
  try {
    throw;
  } catch (const ApiError& e) {
    return Keep(e.status(), e.what(), object);
  } catch (const SceneError& e) {
    return Keep(DPE_ERROR_INPUT, e.what(), object);
  } catch (const std::bad_alloc&) {
    return Keep(DPE_ERROR_MEMORY, "not enough memory", object);
  } catch (const std::exception& e) {
    return Keep(DPE_ERROR_INTERNAL, e.what(), object);
  } catch (...) {
    return Keep(DPE_ERROR_INTERNAL, "unknown exception", object);
  }
}

void RequireIndex(const char* what, int index, int count) {
  if (index >= 0 && index < count) return;
  throw ApiError(DPE_ERROR_ARGUMENT,
                 std::string(what) + " " + std::to_string(index) +
                     (count > 0 ? "; accepted are 0 to " + std::to_string(count - 1)
                                : "; there are none"));
}

void RequireText(const char* what, const char* text) {
  if (text == nullptr) {
    throw ApiError(DPE_ERROR_ARGUMENT, std::string(what) + " is null");
  }
  if (IsUtf8(text)) return;
  throw ApiError(DPE_ERROR_ARGUMENT, std::string(what) + " is not UTF-8");
}

void RequireFinite(const char* what, const double* values, int count) {
  Require(values != nullptr, what);
  for (int i = 0; i < count; ++i) {
    if (std::isfinite(values[i])) continue;
    throw ApiError(DPE_ERROR_ARGUMENT, std::string(what) + ": number " +
                                           std::to_string(i) + " is not finite");
  }
}

void RequireVersion(std::uint32_t header) {
  const std::uint32_t major = header >> 16, minor = header & 0xFFFF;
  if (major == DPE_C_VERSION_MAJOR && minor <= DPE_C_VERSION_MINOR) return;
  throw ApiError(DPE_ERROR_VERSION, "headers of version " + std::to_string(major) +
                                        "." + std::to_string(minor) +
                                        " do not fit this library, which has " +
                                        std::to_string(DPE_C_VERSION_MAJOR) + "." +
                                        std::to_string(DPE_C_VERSION_MINOR));
}

const char* NotAHandle(HandleKind kind) {
  switch (kind) {
    case HandleKind::kScene:
      return "not the handle of a live scene";
    case HandleKind::kPlayback:
      return "not the handle of a live playback";
    case HandleKind::kBuilder:
      return "not the handle of a live builder";
    case HandleKind::kEstimation:
      return "not the handle of a live estimation";
  }
  return "not a handle";
}

void CopyText(const std::string& text, char* buffer, int capacity, int* length) {
  const int size = static_cast<int>(text.size());
  if (length != nullptr) *length = size;
  if (capacity <= size) {
    throw ApiError(DPE_ERROR_BUFFER, "a text of " + std::to_string(size) +
                                         " bytes and a zero byte does not fit into " +
                                         std::to_string(capacity));
  }
  Require(buffer != nullptr, "the buffer is null");
  std::memcpy(buffer, text.c_str(), size + 1);
}

}  // namespace dpe::c
