// When a picture is drawn as a draft, with one sample per pixel.
#ifndef DPE_VIEWER_APP_DRAFT_POLICY_H_
#define DPE_VIEWER_APP_DRAFT_POLICY_H_

namespace dpe::viewer {

// While things move many pictures are worth more than smooth outlines: as soon as one
// of them has taken too long, drafts follow until things stand still. What stands still
// is always drawn in full.
class DraftPolicy {
 public:
  // s, of a picture that keeps up: as many per second as a film has.
  static constexpr double kLongest = 1.0 / 24.0;

  // Whether the next picture shall be a draft. @param moving  things move, or did just
  // now
  bool Next(bool moving) {
    if (!moving) is_slow_ = false;
    return is_slow_;
  }
  // What a picture took, s.
  void Took(double seconds) { is_slow_ = is_slow_ || seconds > kLongest; }

 private:
  bool is_slow_ = false;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_DRAFT_POLICY_H_
