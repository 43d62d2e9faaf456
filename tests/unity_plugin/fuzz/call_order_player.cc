#include "fuzz/call_order_player.h"

#include <cmath>
#include <limits>

namespace dpe::test {

int CallOrderPlayer::Int() {
  const int byte = Byte();
  switch (byte) {
    case 255:
      return std::numeric_limits<int>::max();
    case 254:
      return std::numeric_limits<int>::min();
    case 253:
      return -1;
    default:
      return byte % 12;
  }
}

double CallOrderPlayer::Number() {
  const int byte = Byte();
  switch (byte) {
    case 255:
      return std::nan("");
    case 254:
      return std::numeric_limits<double>::infinity();
    case 253:
      return -1e300;
    case 252:
      return 1e300;
    case 251:
      return 1e-300;
    default:
      return (byte % 64 - 16) / 16.0;
  }
}

const char* CallOrderPlayer::Path() {
  switch (Byte() % 8) {
    case 0:
      return nullptr;
    case 1:
      return "\xC3\x28";  // not UTF-8
    case 2:
      return files_.folder.c_str();
    case 3:
      return "nowhere/at/all";
    case 4:
      return files_.recording.c_str();
    default:
      return files_.scene.c_str();
  }
}

HandleModel* CallOrderPlayer::Handle(Kind kind) {
  const int byte = Byte();
  if (byte >= 240) {
    static constexpr dpe_handle kOdd[] = {0, 1, ~dpe_handle{0}, dpe_handle{1} << 56,
                                          (dpe_handle{1} << 56) | (1 << 24)};
    none_ = {kOdd[byte % 5], Kind::kNone, false};
    for (HandleModel& model : handles_) {
      if (model.is_live && model.handle == none_.handle) return &model;
    }
    return &none_;
  }
  if (byte < 200) {
    for (std::size_t i = 0; i < handles_.size(); ++i) {
      HandleModel& model = handles_[(byte + i) % handles_.size()];
      if (model.is_live && model.kind == kind) return &model;
    }
  }
  return &handles_[byte % handles_.size()];
}

void CallOrderPlayer::Remember(dpe_handle handle, Kind kind) {
  HandleModel& slot = handles_[next_];
  next_ = (next_ + 1) % static_cast<int>(handles_.size());
  // One that is forgotten stays live until dpe_shutdown.
  slot = {handle, kind, true};
}

void CallOrderPlayer::AllDestroyed() {
  for (HandleModel& handle : handles_) handle.is_live = false;
}

void CallOrderPlayer::Check(const char* call, dpe_status status) {
  if (status < DPE_OK || status >= DPE_ERROR_INTERNAL) {
    char message[512] = "";
    dpe_last_error(0, message, sizeof(message), nullptr);
    Fail(std::string(call) + " returned " + std::to_string(status) + ": " + message);
  }
}

void CallOrderPlayer::Check(const char* call, dpe_status status,
                            const HandleModel& handle, Kind kind) {
  Check(call, status);
  const bool is_valid = handle.is_live && handle.kind == kind;
  if (is_valid == (status == DPE_ERROR_HANDLE)) {
    Fail(std::string(call) + " returned " + std::to_string(status) + " for a handle " +
         "that is " + (is_valid ? "" : "not ") + "live and of its kind");
  }
}

}  // namespace dpe::test
