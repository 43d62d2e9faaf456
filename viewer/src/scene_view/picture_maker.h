// Makes pictures of what a player shows.
//
// The surface is the target, where one shows vertices, else the scene; the scene is
// then a green wireframe over it, and so is the compared scene (orange, if green is
// taken).
#ifndef DPE_VIEWER_SCENE_VIEW_PICTURE_MAKER_H_
#define DPE_VIEWER_SCENE_VIEW_PICTURE_MAKER_H_

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "picture/picture.h"
#include "playback/player.h"
#include "scene_view/camera.h"
#include "scene_view/cloth_picture.h"
#include "scene_view/color_scale.h"
#include "scene_view/quantities.h"

namespace dpe::viewer {

struct ViewOptions {
  ColorMode color = ColorMode::kPlain;
  bool surface = true;
  bool wireframe = true;
  bool springs = false;
  bool fixed_vertices = true;
  bool colliders = true;
  bool ground = true;
  bool axes = true;
  bool wind = true;
};

class PictureMaker {
 public:
  // @param deviations  of the scene's estimate; may be empty
  PictureMaker(const Scene& scene, const Scene* compared, Deviations deviations);

  // All but the camera. Scales of what moves grow with what has been seen.
  Picture Make(const Player& player, const ViewOptions& options);

  // Of the last picture; none for plain, nor where nothing is known to be coloured.
  const std::optional<ColorScale>& scale() const { return scale_; }
  // What is missing for the last picture's colours, and how to give it; empty: nothing.
  const std::string& missing() const { return missing_; }
  void ForgetScales();

  const Ball& home() const { return home_; }
  // The ball about what the player shows now.
  Ball BallAboutNow(const Player& player) const;
  bool has_deviations() const {
    return deviations_.has_stiffness() || deviations_.has_mass();
  }

 private:
  struct Layer;
  std::string Missing(const Layer& layer, ColorMode mode) const;
  std::vector<QuantityValues> Values(const Layer& layer, const Tuning* tuning,
                                     ColorMode mode) const;
  void SetScale(ColorMode mode, const std::vector<QuantityValues>& values);
  void AddCloths(const Layer& layer, const ViewOptions& options, const Tuning* tuning,
                 Picture* picture);
  static void AddWireframe(const std::vector<ClothShape>& shapes,
                           const MotionState& state, const glm::vec4& color,
                           Picture* picture);
  void AddFixedVertices(const MotionState& state, Picture* picture) const;
  static void AddMarkers(const Player& player, Picture* picture);
  void AddGuides(const Player& player, const ViewOptions& options,
                 Picture* picture) const;

  std::vector<ClothShape> shapes_, compared_shapes_;
  Deviations deviations_;
  Ball home_;
  double ground_ = 0.0, top_ = 0.0;
  std::vector<Surface> colliders_;
  std::optional<ColorScale> scale_;
  std::string missing_;
  // The largest value seen so far of stretch (of its size), speed and distance.
  std::array<double, kNumColorModes> seen_{};
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_PICTURE_MAKER_H_
