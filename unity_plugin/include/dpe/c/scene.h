/* A scene: loading it, what it is made of, stepping it, and a thread of its own that
 * runs it. dpe/dpe_c.h has the rules. */
#ifndef DPE_C_SCENE_H_
#define DPE_C_SCENE_H_

#include "dpe/c/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a scene, or a playback, is doing. */
enum {
  DPE_STOPPED = 0, /* at its beginning */
  DPE_RUNNING = 1, /* its thread computes one frame after the other */
  DPE_PAUSED = 2,  /* somewhere on its way */
  DPE_FAILED = 3   /* the last frame could not be computed; dpe_last_error says why.
                      Change something and start again, or stop. */
};

typedef struct dpe_scene_info {
  int32_t num_objects;
  int32_t num_colliders;
  int32_t num_frames;      /* that the file asks for; a scene runs on beyond them */
  int32_t steps_per_frame; /* integration steps */
  double frame_length;     /* s */
  int32_t state;           /* DPE_STOPPED, ... */
  int32_t reserved;        /* 0 */
  int64_t frame;           /* the newest one; 0 is the initial state */
} dpe_scene_info;

typedef struct dpe_object_info {
  int32_t num_vertices;
  int32_t num_triangles;
  int32_t num_springs;
  int32_t num_fixed; /* vertices */
} dpe_object_info;

/* Loads a scene file (JSON; also an optimised one). On success *scene is its handle, to
 * be given to dpe_scene_destroy. DPE_ERROR_VERSION; DPE_ERROR_INPUT names file, place
 * in it, value and what is accepted.
 *
 * header_version  DPE_C_VERSION */
DPE_API dpe_status dpe_scene_create_from_file(uint32_t header_version, const char* path,
                                              dpe_scene* scene);

/* The same from the text of a scene file. Messages call it "scene". */
DPE_API dpe_status dpe_scene_create_from_json(uint32_t header_version, const char* json,
                                              dpe_scene* scene);

/* Destroys a scene in whatever state it is. A frame that is being computed is given up;
 * returns when the scene's thread has ended. */
DPE_API dpe_status dpe_scene_destroy(dpe_scene scene);

/* What the loader accepted but found worth a look, one line each (see dpe_last_error
 * for buffer, capacity and length; DPE_ERROR_BUFFER). */
DPE_API dpe_status dpe_scene_warnings(dpe_scene scene, char* buffer, int32_t capacity,
                                      int32_t* length);

/* Both may wait for the frame that is being computed. */
DPE_API dpe_status dpe_scene_get_info(dpe_scene scene, dpe_scene_info* info);
DPE_API dpe_status dpe_scene_get_object_info(dpe_scene scene, int32_t object,
                                             dpe_object_info* info);

/* The topology of an object: three vertices for each triangle, two for each spring, one
 * flag (1 fixed, 0 free) for each vertex. Triangles and springs never change.
 *
 * capacity  of the buffer, in numbers
 * count     receives how many numbers there are; may be null
 * returns   DPE_ERROR_BUFFER if they do not fit; the buffer may be null if there are
 *           none or capacity is 0 */
DPE_API dpe_status dpe_scene_get_triangles(dpe_scene scene, int32_t object,
                                           int32_t* vertices, int32_t capacity,
                                           int32_t* count);
DPE_API dpe_status dpe_scene_get_springs(dpe_scene scene, int32_t object,
                                         int32_t* vertices, int32_t capacity,
                                         int32_t* count);
DPE_API dpe_status dpe_scene_get_fixed(dpe_scene scene, int32_t object, uint8_t* flags,
                                       int32_t capacity, int32_t* count);

/* Computes num_frames >= 0 frames in the calling thread and returns when they are done;
 * a stopped or failed scene is paused afterwards. DPE_ERROR_STATE while the scene's
 * thread runs, or if the scene is stopped or destroyed meanwhile; DPE_ERROR_SIMULATION:
 * the frames before the failure stand, and the scene is in DPE_FAILED. */
DPE_API dpe_status dpe_scene_step(dpe_scene scene, int32_t num_frames);

/* Lets a thread of the scene compute frames at the rate that was set, from where the
 * scene is. Without effect on a running scene. A scene that cannot keep up falls
 * behind; it does not try to catch up with more than a quarter of a second. */
DPE_API dpe_status dpe_scene_start(dpe_scene scene);

/* Halts the thread after the frame that it is computing and returns then. The scene can
 * be started again, or stepped. Without effect on a scene that does not run. */
DPE_API dpe_status dpe_scene_pause(dpe_scene scene);

/* Halts the thread (a frame that is being computed is given up) and puts the scene back
 * to its initial state: positions, velocities, and which vertices are fixed.
 * Parameters, wind and colliders stay as they are. */
DPE_API dpe_status dpe_scene_stop(dpe_scene scene);

/* How fast time passes in a scene that runs, relative to the clock: 1 (as at first) is
 * real time, 0 is as fast as possible. DPE_ERROR_ARGUMENT for a negative one. */
DPE_API dpe_status dpe_scene_set_rate(dpe_scene scene, double rate);

/* Copies the newest positions of an object unless the caller has them. Returns at once:
 * it never waits for a frame to be computed.
 *
 * positions  receives x, y, z of each vertex as float, m
 * capacity   of positions, in floats; at least 3 per vertex
 * sequence   in: what the last call wrote there, or 0; out: the number of the newest
 *            state. It grows with every state, also when the scene is stopped, while
 *            frames then begin again at 0.
 * frame      receives the frame of the newest state; may be null
 * is_new     receives 1 if positions were written, 0 if *sequence was the newest
 * returns    DPE_ERROR_BUFFER if they do not fit */
DPE_API dpe_status dpe_scene_copy_positions(dpe_scene scene, int32_t object,
                                            float* positions, int32_t capacity,
                                            uint64_t* sequence, int64_t* frame,
                                            int32_t* is_new);

/* The scene as a scene file's text, with parameters, wind and colliders as they are now
 * and the initial state that it was loaded with. As dpe_last_error for buffer, capacity
 * and length; DPE_ERROR_BUFFER. */
DPE_API dpe_status dpe_scene_to_json(dpe_scene scene, char* buffer, int32_t capacity,
                                     int32_t* length);

/* The same into a file, whole or not at all. DPE_ERROR_INPUT if it cannot be written.
 */
DPE_API dpe_status dpe_scene_save(dpe_scene scene, const char* path);

#ifdef __cplusplus
}
#endif

#endif /* DPE_C_SCENE_H_ */
