// The camera of a person who looks at a cloth: it looks at a point from a distance, and
// turns about it. World y is up.
#ifndef DPE_VIEWER_SCENE_VIEW_CAMERA_H_
#define DPE_VIEWER_SCENE_VIEW_CAMERA_H_

#include <glm/vec3.hpp>

#include "picture/picture.h"

namespace dpe::viewer {

// A ball that shall be seen whole.
struct Ball {
  glm::vec3 center{0.0f};  // m
  float radius = 1.0f;
};

class OrbitCamera {
 public:
  // Looks at the ball from the front, the right and above; Reset comes back to it.
  void SetHome(const Ball& ball);
  void Reset();
  // From where Reset looks, rad.
  void SetHomeAngles(float yaw, float pitch);
  // How much larger than whole Reset shows the ball.
  void SetHomeZoom(float zoom);
  // Looks at the ball from where it looks now.
  void Frame(const Ball& ball);

  // Motions of the pointer over a window of `height` pixels, in pixels, y down. The
  // cloth follows the pointer.
  void Orbit(float dx, float dy, float height);
  void Pan(float dx, float dy, float height);
  // Steps of the wheel; positive comes closer.
  void Zoom(float steps);

  // For a picture of that many pixels, of which something covers some from the left.
  Camera Get(int width, int height, int left = 0) const;

  float yaw() const { return yaw_; }      // rad, about y; 0 looks along -z
  float pitch() const { return pitch_; }  // rad, from above if positive
  float distance() const { return distance_; }
  const glm::vec3& target() const { return target_; }

 private:
  glm::vec3 Backward() const;  // unit, from the target to the camera

  Ball home_;
  float home_yaw_ = 0.6f, home_pitch_ = 0.35f, home_zoom_ = 1.0f;
  float yaw_ = 0.0f, pitch_ = 0.0f, distance_ = 1.0f;
  glm::vec3 target_{0.0f};
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_CAMERA_H_
