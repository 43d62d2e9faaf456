// Reading and writing observed and simulated trajectories.
#ifndef DPE_ESTIMATION_TRAJECTORY_IO_H_
#define DPE_ESTIMATION_TRAJECTORY_IO_H_

#include <string>

#include "dpe/engine/scene.h"
#include "dpe/engine/trajectory.h"
#include "dpe/estimation/observations.h"

namespace dpe {

// Reads `frame,vertex,x,y,z` lines (one header line, any order, missing rows are
// missing data). Vertices are counted through the objects of the scene: object 0 first,
// then object 1, and so on.
//
// @param path        CSV file
// @param scene       gives the number of vertices of each object
// @param num_frames  frames to keep; later ones are read and checked but dropped;
//                    <= 0: all
// @throws SceneError naming file, line, value and what is accepted (ragged lines, text
//         where a number should be, NaN, a vertex or frame out of range, a pair of
//         frame and vertex given twice, no data).
Observations ReadTrajectoryCsv(const std::string& path, const Scene& scene,
                               int num_frames);

// A trajectory as CSV text `frame,vertex,x,y,z`, numbers that round-trip. Objects that
// were not simulated are left out, but keep their place in the vertex numbering.
std::string TrajectoryToCsv(const Trajectory& trajectory, const Scene& scene);

}  // namespace dpe

#endif  // DPE_ESTIMATION_TRAJECTORY_IO_H_
