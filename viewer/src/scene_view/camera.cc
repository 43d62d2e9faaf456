#include "scene_view/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace dpe::viewer {
namespace {

constexpr float kFieldOfView = 0.7f;  // rad, of the height
constexpr float kMaxPitch = 1.55f;    // short of the pole, where up has no direction
constexpr float kMargin = 1.05f;

}  // namespace

void OrbitCamera::SetHome(const Ball& ball) {
  home_ = ball;
  Reset();
}

void OrbitCamera::Reset() {
  yaw_ = home_yaw_;
  pitch_ = home_pitch_;
  Frame(home_);
  distance_ /= home_zoom_;
}

void OrbitCamera::SetHomeAngles(float yaw, float pitch) {
  home_yaw_ = yaw;
  home_pitch_ = std::clamp(pitch, -kMaxPitch, kMaxPitch);
  Reset();
}

void OrbitCamera::SetHomeZoom(float zoom) {
  home_zoom_ = zoom;
  Reset();
}

void OrbitCamera::Frame(const Ball& ball) {
  target_ = ball.center;
  distance_ = kMargin * std::max(ball.radius, 1e-4f) / std::sin(0.5f * kFieldOfView);
}

void OrbitCamera::Orbit(float dx, float dy, float height) {
  constexpr float kPi = 3.14159265f;
  yaw_ = std::remainder(yaw_ - kPi * dx / height, 2.0f * kPi);
  pitch_ = std::clamp(pitch_ + kPi * dy / height, -kMaxPitch, kMaxPitch);
}

void OrbitCamera::Pan(float dx, float dy, float height) {
  const glm::vec3 back = Backward();
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), back));
  const glm::vec3 up = glm::cross(back, right);
  // Metres per pixel at the target.
  const float scale = 2.0f * distance_ * std::tan(0.5f * kFieldOfView) / height;
  target_ += scale * (dy * up - dx * right);
}

void OrbitCamera::Zoom(float steps) {
  distance_ = std::clamp(distance_ * std::pow(0.9f, steps), 1e-3f * home_.radius,
                         1e3f * home_.radius);
}

glm::vec3 OrbitCamera::Backward() const {
  return {std::cos(pitch_) * std::sin(yaw_), std::sin(pitch_),
          std::cos(pitch_) * std::cos(yaw_)};
}

Camera OrbitCamera::Get(int width, int height, int left) const {
  const auto w = static_cast<float>(std::max(width, 1));
  const auto h = static_cast<float>(std::max(height, 1));
  const auto covered = static_cast<float>(left);
  Camera camera;
  camera.position = target_ + distance_ * Backward();
  camera.view = glm::lookAtRH(camera.position, target_, glm::vec3(0.0f, 1.0f, 0.0f));
  // What is higher than wide shows as much from side to side.
  const float free_aspect = std::min((w - covered) / h, 1.0f);
  const float angle = 2.0f * std::atan(std::tan(0.5f * kFieldOfView) / free_aspect);
  const float far_plane = distance_ + 100.0f * home_.radius;
  camera.projection = glm::perspectiveRH_ZO(angle, w / h, 1e-2f * distance_, far_plane);
  camera.projection[1][1] *= -1.0f;  // Vulkan's y points down
  // The middle of what is free: (covered + w) / 2 of w.
  camera.projection[2][0] = -covered / w;
  return camera;
}

}  // namespace dpe::viewer
