/* A recorded motion of a scene's cloths, played by the clock. dpe/dpe_c.h has the
 * rules.
 *
 * A playback has no thread: where it is follows from the clock when it is asked. */
#ifndef DPE_C_PLAYBACK_H_
#define DPE_C_PLAYBACK_H_

#include "dpe/c/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dpe_playback_info {
  int32_t num_objects;
  int32_t num_frames;
  double frame_length; /* s */
  double duration;     /* s: (num_frames - 1) frame_length */
  double time;         /* s, where it is, in the recording */
  double rate;
  int32_t state; /* DPE_STOPPED, DPE_RUNNING or DPE_PAUSED, see scene.h */
  int32_t loop;  /* 1 or 0 */
} dpe_playback_info;

/* Reads a recording of the cloths of `scene` in any format that estimate_cloth --target
 * reads (CSV, TRC, OBJ files, PC2, NumPy). The scene gives the number of vertices and
 * the frame length; it is not needed afterwards. Objects of which the recording has
 * nothing stay at their initial state. DPE_ERROR_VERSION; DPE_ERROR_INPUT if the
 * recording cannot be read, or lacks a vertex of an object at a frame. */
DPE_API dpe_status dpe_playback_create(uint32_t header_version, dpe_scene scene,
                                       const char* path, dpe_playback* playback);
DPE_API dpe_status dpe_playback_destroy(dpe_playback playback);

DPE_API dpe_status dpe_playback_get_info(dpe_playback playback,
                                         dpe_playback_info* info);

/* Time passes, halts, or halts at the first frame. Started at the end of the recording
 * (at its beginning, where the rate is negative) without a loop, it starts over. */
DPE_API dpe_status dpe_playback_start(dpe_playback playback);
DPE_API dpe_status dpe_playback_pause(dpe_playback playback);
DPE_API dpe_status dpe_playback_stop(dpe_playback playback);

/* Goes to a time in the recording, s; beyond either end: to that end. */
DPE_API dpe_status dpe_playback_seek(dpe_playback playback, double time);

/* How fast it plays relative to the clock, 1 as at first; negative: backwards. */
DPE_API dpe_status dpe_playback_set_rate(dpe_playback playback, double rate);

/* Whether it goes on at the other end; otherwise (as at first) it pauses at the end. */
DPE_API dpe_status dpe_playback_set_loop(dpe_playback playback, int32_t loop);

/* The positions of an object at the frame that was last reached. As
 * dpe_scene_copy_positions; returns at once. */
DPE_API dpe_status dpe_playback_copy_positions(dpe_playback playback, int32_t object,
                                               float* positions, int32_t capacity,
                                               uint64_t* sequence, int64_t* frame,
                                               int32_t* is_new);

#ifdef __cplusplus
}
#endif

#endif /* DPE_C_PLAYBACK_H_ */
