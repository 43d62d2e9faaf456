// Rest lengths from elsewhere than the first frame: a recording need not begin at rest.
#ifndef DPE_ESTIMATION_REST_SHAPE_H_
#define DPE_ESTIMATION_REST_SHAPE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/capture.h"
#include "dpe/estimation/export.h"

namespace dpe {

// Positions at rest of the vertices of a cloth, 3N, m. Only distances between them
// matter.
//
// @param source   an OBJ file with the vertices of the cloth in their order, or the
//                 texture coordinates of the capture's mesh: "uv" (1 m per unit of u
//                 and v), "uv:SIZE" (m per unit of both) or "uv:U,V" (m per unit of
//                 each)
// @param scale    m per unit of the OBJ file; 0: 1
// @param capture  whose mesh has the texture coordinates
// @throws SceneError naming file, line where there is one, value and what is accepted:
//         no texture coordinates, a vertex of a face without, a seam (a vertex that has
//         two), a file that is no mesh. Vertices of no face are left out.
DPE_ESTIMATION_API Eigen::VectorXd ReadRestShape(const std::string& source,
                                                 double scale, const Capture& capture);

// Sets the rest lengths of a cloth's springs to the distances of the rest shape.
//
// @param rest      3N, m
// @param source    stands for the rest shape in messages
// @param object    index of the cloth; -1: the only one with that number of vertices
// @param scene     whose rest lengths are set
// @param warnings  if not null, is told if springs are far from their rest length in
//                  the initial state (by more than a factor of 2): the order of the
//                  vertices or the size may be wrong
// @throws SceneError if no cloth has that number of vertices, or several do; for a
//         spring without length
DPE_ESTIMATION_API void SetRestShape(const Eigen::VectorXd& rest,
                                     const std::string& source, int object,
                                     Scene* scene,
                                     std::vector<std::string>* warnings = nullptr);

// A cloth that has the mass and the stiffness of its rest shape and starts in the first
// frame of a capture of meshes; all vertices are free.
//
// @param capture   with a mesh, in the scene's units (ToSceneUnits)
// @param rest      3N, m; empty: the first frame
// @param material  of the whole cloth
// @throws SceneError as BuildClothFromMesh, for a capture without triangles, and for a
//         rest shape of another size
DPE_ESTIMATION_API ClothObject BuildClothFromCapture(const Capture& capture,
                                                     const Eigen::VectorXd& rest,
                                                     const ClothMaterial& material);

}  // namespace dpe

#endif  // DPE_ESTIMATION_REST_SHAPE_H_
