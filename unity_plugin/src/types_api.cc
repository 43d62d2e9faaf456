#include "call.h"
#include "dpe/dpe_c.h"

using dpe::c::Call;
using dpe::c::CopyText;
using dpe::c::HandleTable;

uint32_t dpe_version(void) { return DPE_C_VERSION; }

dpe_status dpe_check_version(uint32_t header) {
  return Call([&] { dpe::c::RequireVersion(header); });
}

const char* dpe_status_name(dpe_status status) {
  static const char* const kNames[] = {"DPE_OK",           "DPE_ERROR_ARGUMENT",
                                       "DPE_ERROR_HANDLE", "DPE_ERROR_VERSION",
                                       "DPE_ERROR_INPUT",  "DPE_ERROR_STATE",
                                       "DPE_ERROR_BUFFER", "DPE_ERROR_SIMULATION",
                                       "DPE_ERROR_MEMORY", "DPE_ERROR_INTERNAL"};
  if (status < DPE_OK || status > DPE_ERROR_INTERNAL) return "unknown status";
  return kNames[status];
}

// A failure of this function leaves the messages as they are: they would be lost to who
// asks with too small a buffer first.
dpe_status dpe_last_error(dpe_handle handle, char* buffer, int32_t capacity,
                          int32_t* length) {
  try {
    std::string message;
    if (handle == 0) {
      message = dpe::c::ThreadError();
    } else {
      const auto object = HandleTable::Global().Find(handle);
      if (!object) return DPE_ERROR_HANDLE;
      message = object->last_error();
    }
    CopyText(message, buffer, capacity, length);
    return DPE_OK;
  } catch (const dpe::c::ApiError& e) {
    return e.status();
  } catch (...) {
    return DPE_ERROR_MEMORY;
  }
}

dpe_status dpe_shutdown(void) {
  return Call([] { HandleTable::Global().CloseAll(); });
}

int32_t dpe_live_handles(void) { return HandleTable::Global().size(); }
