// The frames of a live simulation that are remembered, so that a person can go back.
#ifndef DPE_VIEWER_PLAYBACK_HISTORY_H_
#define DPE_VIEWER_PLAYBACK_HISTORY_H_

#include <cstddef>
#include <deque>
#include <vector>

#include "playback/motion_state.h"

namespace dpe::viewer {

struct Moment {
  int frame = 0;
  std::vector<MotionState> motions;
};

// In the order of frames, some of which may be missing. The oldest are forgotten when
// there are more bytes than may be kept.
class History {
 public:
  explicit History(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  void Clear();
  // @param moment  later than all that are there
  void Add(Moment moment);

  bool empty() const { return moments_.empty(); }
  int first_frame() const { return moments_.front().frame; }
  int last_frame() const { return moments_.back().frame; }
  // The last moment that is not after a frame, or the first there is.
  const Moment& At(int frame) const;
  // The first moment after a frame; there is one if frame < last_frame().
  const Moment& After(int frame) const;

 private:
  std::deque<Moment>::const_iterator FirstAfter(int frame) const;

  std::size_t max_bytes_;
  std::size_t bytes_ = 0;
  std::deque<Moment> moments_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PLAYBACK_HISTORY_H_
