#include "call.h"
#include "dpe/dpe_c.h"
#include "playback_handle.h"
#include "scene_handle.h"

using dpe::c::CallWith;
using dpe::c::PlaybackHandle;
using dpe::c::Require;
using dpe::c::SceneHandle;

dpe_status dpe_playback_create(uint32_t header_version, dpe_scene scene,
                               const char* path, dpe_playback* playback) {
  return CallWith<SceneHandle>(scene, [&](SceneHandle& s) {
    dpe::c::RequireVersion(header_version);
    dpe::c::RequireText("the path", path);
    Require(playback != nullptr, "the pointer that receives the playback is null");
    *playback = dpe::c::HandleTable::Global().Add(
        PlaybackHandle::kKind, std::make_shared<PlaybackHandle>(s.initial(), path));
  });
}

dpe_status dpe_playback_destroy(dpe_playback playback) {
  return dpe::c::Destroy<PlaybackHandle>(playback);
}

dpe_status dpe_playback_get_info(dpe_playback playback, dpe_playback_info* info) {
  return CallWith<PlaybackHandle>(playback, [&](PlaybackHandle& p) {
    Require(info != nullptr, "the info is null");
    *info = p.Info();
  });
}

dpe_status dpe_playback_start(dpe_playback playback) {
  return CallWith<PlaybackHandle>(playback, [](PlaybackHandle& p) { p.Start(); });
}

dpe_status dpe_playback_pause(dpe_playback playback) {
  return CallWith<PlaybackHandle>(playback, [](PlaybackHandle& p) { p.Pause(); });
}

dpe_status dpe_playback_stop(dpe_playback playback) {
  return CallWith<PlaybackHandle>(playback, [](PlaybackHandle& p) { p.Stop(); });
}

dpe_status dpe_playback_seek(dpe_playback playback, double time) {
  return CallWith<PlaybackHandle>(playback, [&](PlaybackHandle& p) { p.Seek(time); });
}

dpe_status dpe_playback_set_rate(dpe_playback playback, double rate) {
  return CallWith<PlaybackHandle>(playback,
                                  [&](PlaybackHandle& p) { p.SetRate(rate); });
}

dpe_status dpe_playback_set_loop(dpe_playback playback, int32_t loop) {
  return CallWith<PlaybackHandle>(playback,
                                  [&](PlaybackHandle& p) { p.SetLoop(loop != 0); });
}

dpe_status dpe_playback_copy_positions(dpe_playback playback, int32_t object,
                                       float* positions, int32_t capacity,
                                       uint64_t* sequence, int64_t* frame,
                                       int32_t* is_new) {
  return CallWith<PlaybackHandle>(playback, [&](PlaybackHandle& p) {
    p.CopyPositions(object, positions, capacity, sequence, frame, is_new);
  });
}
