/* Makes a scene of triangle meshes. dpe/dpe_c.h has the rules. */
#ifndef DPE_C_BUILDER_H_
#define DPE_C_BUILDER_H_

#include "dpe/c/changes.h"
#include "dpe/c/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dpe_material {
  double traction_stiffness; /* N/m; k = K volume / length^2 for each spring */
  double bending_stiffness;  /* N/m, likewise */
  double shear_stiffness;    /* N/m, of diagonal edges; negative: as traction */
  double density;            /* kg/m^2 */
  double damping;            /* 1/s */
  double drag;               /* drag coefficient */
} dpe_material;

DPE_API dpe_status dpe_builder_create(uint32_t header_version, dpe_builder* builder);
DPE_API dpe_status dpe_builder_destroy(dpe_builder builder);

/* The material that cloths have unless something else is said. */
DPE_API dpe_status dpe_material_default(dpe_material* material);

/* Adds a cloth: springs along the edges of the mesh and across them (bending), masses
 * from the areas of its triangles. Vertices keep their order.
 *
 * positions      x, y, z of each vertex, m
 * num_positions  numbers in it, 3 per vertex
 * triangles      three vertices each
 * num_indices    numbers in it, 3 per triangle
 * material       null: the default
 * object         receives the index of the cloth; may be null
 * returns        DPE_ERROR_INPUT for a mesh that makes no cloth: a vertex without a
 *                triangle, a triangle without area, vertices that coincide */
DPE_API dpe_status dpe_builder_add_mesh(dpe_builder builder, const double* positions,
                                        int32_t num_positions, const int32_t* triangles,
                                        int32_t num_indices,
                                        const dpe_material* material, int32_t* object);

/* Fixes the vertices of a cloth that lie in a box, or on its sides.
 *
 * lower, upper  opposite corners, x, y, z, m; lower <= upper
 * count         receives how many the box holds; may be null */
DPE_API dpe_status dpe_builder_pin_box(dpe_builder builder, int32_t object,
                                       const double* lower, const double* upper,
                                       int32_t* count);
DPE_API dpe_status dpe_builder_pin_vertices(dpe_builder builder, int32_t object,
                                            const int32_t* vertices, int32_t count);

DPE_API dpe_status dpe_builder_add_collider(dpe_builder builder,
                                            const dpe_collider* collider);

/* wind  x, y, z, m/s */
DPE_API dpe_status dpe_builder_set_wind(dpe_builder builder, const double* wind);

/* The length of a frame (s, > 0), integration steps in it (>= 1), and how many frames
 * to fit (>= 2). At first 0.02 s, 1 and 100. */
DPE_API dpe_status dpe_builder_set_time(dpe_builder builder, double frame_length,
                                        int32_t steps_per_frame, int32_t num_frames);

/* Two letters per object, mass then stiffness, objects separated by commas: "nL,nn".
 * n: not estimated, G: one value, L: one per vertex or spring, R: one per group.
 * DPE_ERROR_INPUT for others, or more than there are objects. */
DPE_API dpe_status dpe_builder_set_settings(dpe_builder builder, const char* settings);

/* The title, and the integration method by its name in scene files. null: as it is. */
DPE_API dpe_status dpe_builder_set_method(dpe_builder builder, const char* title,
                                          const char* integration_method);

/* Makes a scene of what was added. The builder can go on. DPE_ERROR_INPUT if it is not
 * a scene: no object, or one without a free vertex. */
DPE_API dpe_status dpe_builder_build(dpe_builder builder, dpe_scene* scene);

#ifdef __cplusplus
}
#endif

#endif /* DPE_C_BUILDER_H_ */
