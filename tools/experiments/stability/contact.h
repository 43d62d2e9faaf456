// Which vertices of a state touch the collider, and how deep they are in it.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_CONTACT_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_CONTACT_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dpe/engine/simulator.h"

namespace dpe::experiments {

// Taken from the engine's own penalty force, F = K depth n, with all other forces left
// out: whatever the engine calls contact is contact here.
class ContactProbe {
 public:
  // @param scene  with one object; of its colliders only the first one counts
  explicit ContactProbe(const Scene& scene);

  // @param x  3N (m)
  // @return   N depths (m), 0 where there is no contact and at fixed vertices
  Eigen::VectorXd Depths(const Eigen::VectorXd& x) const;

  // The deepest of any vertex in any column of 3N x frames (m).
  double Deepest(const Eigen::MatrixXd& positions) const;

 private:
  std::unique_ptr<Simulator> simulator_;  // null: no collider
  double stiffness_ = 0.0;
};

// States of a motion in which other vertices are in contact than in any before, and how
// many frames of the motion have the same ones: contact changes K only by which
// vertices take part.
struct ContactState {
  int frame = 0;  // the first of them
  int count = 0;
  std::vector<bool> touching;  // per vertex
};

// @param positions  3N x frames
// @return           at most `most` of them, those with the most frames
std::vector<ContactState> ContactStates(const Scene& scene,
                                        const Eigen::MatrixXd& positions, int most);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_CONTACT_H_
