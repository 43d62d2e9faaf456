// When a picture is drawn as a draft, with one sample per pixel.
#ifndef DPE_VIEWER_APP_DRAFT_POLICY_H_
#define DPE_VIEWER_APP_DRAFT_POLICY_H_

namespace dpe::viewer {

// While things move many pictures are worth more than smooth outlines: when some in a
// row have taken too long, drafts follow until things stand still, or until so many
// have been quick that pictures in full would keep up. What stands still is always
// drawn in full.
class DraftPolicy {
 public:
  // s, of a picture that keeps up: as many per second as a film has.
  static constexpr double kLongest = 1.0 / 24.0;
  // In full a picture takes at most so many times as long as a draft, by its samples.
  static constexpr double kMostRatio = 5.0;
  static constexpr int kSlowInARow = 3, kQuickInARow = 30;

  // Whether the next picture shall be a draft. @param moving  things move, or just did
  bool Next(bool moving) {
    if (!moving) Set(false);
    return drafts_;
  }
  // What a picture took that was drawn as Next said, s.
  void Took(double seconds) {
    const bool speaks_against =
        drafts_ ? kMostRatio * seconds < kLongest : seconds > kLongest;
    in_a_row_ = speaks_against ? in_a_row_ + 1 : 0;
    if (in_a_row_ == (drafts_ ? kQuickInARow : kSlowInARow)) Set(!drafts_);
  }

 private:
  void Set(bool drafts) {
    drafts_ = drafts;
    in_a_row_ = 0;
  }

  bool drafts_ = false;
  int in_a_row_ = 0;  // pictures that speak against what is done
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_DRAFT_POLICY_H_
