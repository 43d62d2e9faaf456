// One writer per binary or mesh format.
#ifndef DPE_ESTIMATION_SRC_CAPTURES_WRITERS_H_
#define DPE_ESTIMATION_SRC_CAPTURES_WRITERS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/trajectory.h"

namespace dpe {

// The simulated objects of a trajectory as one cloud of points.
struct PointFrames {
  int num_frames = 0;  // that are finite throughout
  std::vector<int> objects;
  std::vector<const Eigen::MatrixXd*> positions;  // of each of them, 3N x F
  long num_vertices() const;
};

PointFrames WholeFrames(const Trajectory& trajectory);

std::string PointsToPc2(const PointFrames& points);
std::string PointsToNpy(const PointFrames& points);
// One frame, with the triangles of the objects, which are groups of their own.
std::string FrameToObj(const PointFrames& points, const Scene& scene, int frame);

// The file of a frame: the pattern with its '*' replaced.
std::string ObjFrameName(const std::string& pattern, int frame);
// As CheckTrajectoryOutput.
void CheckObjPattern(const std::string& pattern, int num_frames);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SRC_CAPTURES_WRITERS_H_
