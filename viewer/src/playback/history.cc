#include "playback/history.h"

#include <algorithm>
#include <utility>

namespace dpe::viewer {
namespace {

std::size_t Bytes(const Moment& moment) {
  std::size_t sum = 0;
  for (const MotionState& motion : moment.motions) sum += motion.bytes();
  return sum;
}

}  // namespace

void History::Clear() {
  moments_.clear();
  bytes_ = 0;
}

void History::Add(Moment moment) {
  bytes_ += Bytes(moment);
  moments_.push_back(std::move(moment));
  while (bytes_ > max_bytes_ && moments_.size() > 1) {
    bytes_ -= Bytes(moments_.front());
    moments_.pop_front();
  }
}

const Moment& History::At(int frame) const {
  return frame < first_frame() ? moments_.front() : *std::prev(FirstAfter(frame));
}

const Moment& History::After(int frame) const { return *FirstAfter(frame); }

std::deque<Moment>::const_iterator History::FirstAfter(int frame) const {
  return std::upper_bound(moments_.begin(), moments_.end(), frame,
                          [](int f, const Moment& moment) { return f < moment.frame; });
}

}  // namespace dpe::viewer
