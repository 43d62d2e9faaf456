// Writing simulated trajectories, and reading them back as they are written by default.
#ifndef DPE_ESTIMATION_TRAJECTORY_IO_H_
#define DPE_ESTIMATION_TRAJECTORY_IO_H_

#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/trajectory.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/observations.h"

namespace dpe {

// Reads `frame,vertex,x,y,z[,sigma]` lines (one header line, any order, missing rows
// are missing data), in m. Vertices are counted through the objects of the scene:
// object 0 first, then object 1, and so on. ReadCapture and AttachCapture read
// everything else.
//
// @param path        CSV file
// @param scene       gives the number of vertices of each object
// @param num_frames  frames to keep; later ones are read and checked but dropped;
//                    <= 0: all
// @throws SceneError naming file, line, value and what is accepted (ragged lines, text
//         where a number should be, NaN, a vertex or frame out of range, a pair of
//         frame and vertex given twice, no data).
DPE_ESTIMATION_API Observations ReadTrajectoryCsv(const std::string& path,
                                                  const Scene& scene, int num_frames);

// A trajectory as CSV text `frame,vertex,x,y,z`, numbers that round-trip. Objects that
// were not simulated are left out, but keep their place in the vertex numbering.
DPE_ESTIMATION_API std::string TrajectoryToCsv(const Trajectory& trajectory,
                                               const Scene& scene);

enum class TrajectoryFormat {
  kAuto,  // by the end of the name: .obj, .pc2, .npy, else CSV
  kCsv,   // round-trips
  kObj,   // one file per frame with the faces; round-trips
  kPc2,   // float32: 7 digits
  kNpy,   // float64, frames x vertices x 3; round-trips
};

// auto, csv, obj, pc2 or npy. @throws SceneError naming what is accepted
DPE_ESTIMATION_API TrajectoryFormat TrajectoryFormatFromName(const std::string& name);

// Throws what WriteTrajectory would throw for the name of its output, before there is
// anything to write.
DPE_ESTIMATION_API void CheckTrajectoryOutput(const std::string& path,
                                              TrajectoryFormat format, int num_frames);

// Writes a trajectory, each file to a temporary name that is then renamed. All formats
// but CSV hold the vertices of the simulated objects only, one object after another,
// and the frames before the first that has a number which is not finite.
//
// @param path        file; for OBJ a pattern with one '*', which becomes the number of
//                    the frame, of four or more digits: "frames/cloth_*.obj". Its
//                    folder is created if it is missing; files of frames that the
//                    trajectory did not reach are removed.
// @param format      which
// @param trajectory  simulated states
// @param scene       whose they are; its triangles become faces
// @return            the files written
// @throws SceneError if a file cannot be written, for a pattern without '*' or with
// more
//         than one, for OBJ files that match the pattern and would not be overwritten
//         (of an earlier, longer run: who reads the pattern would get a mixture), and
//         for OBJ, PC2 and NPY if there is no whole frame
DPE_ESTIMATION_API std::vector<std::string> WriteTrajectory(
    const std::string& path, TrajectoryFormat format, const Trajectory& trajectory,
    const Scene& scene);

}  // namespace dpe

#endif  // DPE_ESTIMATION_TRAJECTORY_IO_H_
