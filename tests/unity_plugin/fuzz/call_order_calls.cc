#include "fuzz/call_order_calls.h"

namespace dpe::test {
namespace {

OneCall Destroy(const char* name, Kind kind, dpe_status (*destroy)(dpe_handle)) {
  return [=](CallOrderPlayer* p) {
    HandleModel* handle = p->Handle(kind);
    const dpe_status status = destroy(handle->handle);
    p->Check(name, status, *handle, kind);
    if (status == DPE_OK) p->Destroyed(handle);
  };
}

std::vector<OneCall> CommonCalls() {
  return {
      [](CallOrderPlayer* p) {
        p->Check("dpe_check_version", dpe_check_version(p->Byte() << 16 | p->Byte()));
      },
      [](CallOrderPlayer* p) {
        const HandleModel handle = *p->Handle(Kind::kScene);
        p->WithBuffer<char>("dpe_last_error", [&](char* buffer, int size, int* length) {
          const dpe_status status = dpe_last_error(handle.handle, buffer, size, length);
          p->Check("dpe_last_error", status);
          if (handle.handle != 0 && handle.is_live == (status == DPE_ERROR_HANDLE)) {
            p->Fail("dpe_last_error returned " + std::to_string(status));
          }
        });
      },
      [](CallOrderPlayer* p) {
        if (dpe_status_name(p->Int()) == nullptr) p->Fail("no name");
        dpe_version();
      },
      [](CallOrderPlayer* p) {
        if (p->Byte() % 8 != 0) return;  // now and then
        p->Check("dpe_shutdown", dpe_shutdown());
        p->AllDestroyed();
      },
      Destroy("dpe_scene_destroy", Kind::kScene, dpe_scene_destroy),
      Destroy("dpe_playback_destroy", Kind::kPlayback, dpe_playback_destroy),
      Destroy("dpe_builder_destroy", Kind::kBuilder, dpe_builder_destroy),
      Destroy("dpe_estimation_destroy", Kind::kEstimation, dpe_estimation_destroy),
  };
}

}  // namespace

const std::vector<OneCall>& AllCalls() {
  static const std::vector<OneCall> calls = [] {
    std::vector<OneCall> all = CommonCalls();
    for (const auto& part : {SceneCalls(), ChangeCalls(), PlaybackCalls(),
                             BuilderCalls(), EstimationCalls()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return calls;
}

}  // namespace dpe::test
