#include "fuzz/call_order_calls.h"

namespace dpe::test {
namespace {

constexpr Kind kPlayback = Kind::kPlayback;

void Create(CallOrderPlayer* p) {
  const HandleModel scene = *p->Handle(Kind::kScene);
  dpe_playback playback = 0;
  const char* path = p->Byte() % 4 == 0 ? p->Path() : p->files().recording.c_str();
  const dpe_status status =
      dpe_playback_create(DPE_C_VERSION, scene.handle, path, p->OrNull(&playback));
  p->Check("dpe_playback_create", status, scene, Kind::kScene);
  if (status == DPE_OK) p->Remember(playback, kPlayback);
}

dpe_status CopyPositions(CallOrderPlayer* p, dpe_playback playback) {
  dpe_status status = DPE_OK;
  std::uint64_t sequence = p->Byte() % 4;
  std::int64_t frame = 0;
  std::int32_t is_new = 0;
  const int object = p->Int();
  p->WithBuffer<float>("dpe_playback_copy_positions", [&](float* to, int size, int*) {
    status =
        dpe_playback_copy_positions(playback, object, to, size, p->OrNull(&sequence),
                                    p->OrNull(&frame), p->OrNull(&is_new));
  });
  return status;
}

OneCall Simple(const char* name, dpe_status (*call)(dpe_playback)) {
  return OnHandle(name, kPlayback, [=](CallOrderPlayer*, dpe_playback playback) {
    return call(playback);
  });
}

}  // namespace

std::vector<OneCall> PlaybackCalls() {
  return {
      Create,
      Create,
      OnHandle("dpe_playback_get_info", kPlayback,
               [](CallOrderPlayer* p, dpe_playback playback) {
                 dpe_playback_info info;
                 return dpe_playback_get_info(playback, p->OrNull(&info));
               }),
      Simple("dpe_playback_start", dpe_playback_start),
      Simple("dpe_playback_pause", dpe_playback_pause),
      Simple("dpe_playback_stop", dpe_playback_stop),
      OnHandle("dpe_playback_seek", kPlayback,
               [](CallOrderPlayer* p, dpe_playback playback) {
                 return dpe_playback_seek(playback, p->Number());
               }),
      OnHandle("dpe_playback_set_rate", kPlayback,
               [](CallOrderPlayer* p, dpe_playback playback) {
                 return dpe_playback_set_rate(playback, p->Number());
               }),
      OnHandle("dpe_playback_set_loop", kPlayback,
               [](CallOrderPlayer* p, dpe_playback playback) {
                 return dpe_playback_set_loop(playback, p->Int());
               }),
      OnHandle("dpe_playback_copy_positions", kPlayback, CopyPositions),
  };
}

}  // namespace dpe::test
