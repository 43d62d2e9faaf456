/* What may change in a scene, also while it runs. A change takes effect with the frame
 * that follows; the call may wait for the frame that is being computed, and for calls
 * that came before it. dpe/dpe_c.h has the rules. */
#ifndef DPE_C_CHANGES_H_
#define DPE_C_CHANGES_H_

#include "dpe/c/types.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  DPE_MASS = 0,      /* kg, one per vertex */
  DPE_STIFFNESS = 1, /* N/m, one per spring */
  DPE_DAMPING = 2,   /* 1/s, one */
  DPE_DRAG = 3,      /* drag coefficient, one */
  DPE_WIND = 4       /* m/s, three; of the scene, `object` means nothing */
};

/* The values of a parameter of an object.
 *
 * capacity  of values, in numbers
 * count     receives how many there are; may be null
 * returns   DPE_ERROR_BUFFER if they do not fit */
DPE_API dpe_status dpe_scene_get_parameter(dpe_scene scene, int32_t object,
                                           int32_t kind, double* values,
                                           int32_t capacity, int32_t* count);

/* Sets a parameter of an object.
 *
 * count    as many as there are values, or 1 for all of them
 * returns  DPE_ERROR_ARGUMENT for another count; DPE_ERROR_INPUT for a value that a
 * scene file could not have either (a negative stiffness, a free vertex without mass)
 */
DPE_API dpe_status dpe_scene_set_parameter(dpe_scene scene, int32_t object,
                                           int32_t kind, const double* values,
                                           int32_t count);

/* Takes over masses, stiffnesses, damping and drag of all objects, and the wind, from a
 * scene file of the same cloths, such as an estimation writes. DPE_ERROR_INPUT if it
 * cannot be read or is of other cloths (as many objects of the same numbers of vertices
 * and the same springs). */
DPE_API dpe_status dpe_scene_load_optimized(dpe_scene scene, const char* path);

enum { DPE_PLANE = 0, DPE_SPHERE = 1 };

typedef struct dpe_collider {
  int32_t type;               /* DPE_PLANE: the half-space below a plane; DPE_SPHERE */
  int32_t reserved;           /* 0 */
  double position[3];         /* m: centre, or a point of the plane */
  double rotation_degrees[3]; /* of a plane whose normal was +y: R_y R_x R_z */
  double radius;              /* m, of a sphere; > 0 */
  double stiffness;           /* N/m of its penalty; > 0 */
} dpe_collider;

/* Adds a collider. *id names it from then on. The colliders of the scene's file have
 * the ids 0, 1, ... DPE_ERROR_INPUT for one that a scene file could not have. */
DPE_API dpe_status dpe_scene_add_collider(dpe_scene scene, const dpe_collider* collider,
                                          int32_t* id);
/* Moves a collider, or changes it in any other way; DPE_ERROR_ARGUMENT: no such id. */
DPE_API dpe_status dpe_scene_set_collider(dpe_scene scene, int32_t id,
                                          const dpe_collider* collider);
DPE_API dpe_status dpe_scene_get_collider(dpe_scene scene, int32_t id,
                                          dpe_collider* collider);
DPE_API dpe_status dpe_scene_remove_collider(dpe_scene scene, int32_t id);
/* The ids of all colliders; capacity, count and DPE_ERROR_BUFFER as for parameters. */
DPE_API dpe_status dpe_scene_get_collider_ids(dpe_scene scene, int32_t* ids,
                                              int32_t capacity, int32_t* count);

/* Moves fixed vertices of an object: they are at `positions` (x, y, z of each, m) at
 * the end of the next frame, go there along a straight line, and then stay. The path
 * that the scene may have for them is forgotten until it is stopped. DPE_ERROR_ARGUMENT
 * for a vertex that is not fixed; the others are then not moved either. */
DPE_API dpe_status dpe_scene_move_vertices(dpe_scene scene, int32_t object,
                                           const int32_t* vertices,
                                           const double* positions, int32_t count);

/* Makes a vertex fixed where it is, or free (is_fixed 0). The scene's equations are
 * set up anew, which takes as long as loading them: not for every frame. Without effect
 * if the vertex is that already. DPE_ERROR_INPUT if the object would have no free
 * vertex left, or a vertex without mass would become free. */
DPE_API dpe_status dpe_scene_set_fixed(dpe_scene scene, int32_t object, int32_t vertex,
                                       int32_t is_fixed);

#ifdef __cplusplus
}
#endif

#endif /* DPE_C_CHANGES_H_ */
