#include "scene_view/picture_maker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene_view/collider_shapes.h"
#include "scene_view/guides.h"

namespace dpe::viewer {
namespace {

const glm::vec4 kBackground(0.030f, 0.034f, 0.042f, 1.0f);
const glm::vec4 kClothColor(0.52f, 0.47f, 0.40f, 1.0f);
const glm::vec4 kEdgeColor(0.03f, 0.035f, 0.045f, 1.0f);
const glm::vec4 kSpringColor(0.55f, 0.55f, 0.60f, 1.0f);
const glm::vec4 kGreen(0.05f, 0.80f, 0.15f, 1.0f);
const glm::vec4 kOrange(0.95f, 0.35f, 0.03f, 1.0f);
const glm::vec4 kFixedColor(0.90f, 0.10f, 0.08f, 1.0f);
const glm::vec4 kMarkerColor(0.95f, 0.75f, 0.05f, 1.0f);

bool Moves(ColorMode mode) {
  return mode == ColorMode::kStretch || mode == ColorMode::kSpeed ||
         mode == ColorMode::kDistance;
}

const Eigen::VectorXd* At(const std::vector<Eigen::VectorXd>& all, size_t object) {
  return object < all.size() && all[object].size() > 0 ? &all[object] : nullptr;
}

std::vector<glm::vec4> Colors(const ColorScale& scale,
                              const std::vector<double>& values) {
  std::vector<glm::vec4> colors;
  colors.reserve(values.size());
  for (const double value : values) colors.push_back(scale.Color(value));
  return colors;
}

std::vector<ClothShape> Shapes(const Scene& scene) {
  std::vector<ClothShape> shapes;
  for (const ClothObject& object : scene.objects) shapes.emplace_back(object);
  return shapes;
}

}  // namespace

// The cloths that are drawn as surfaces.
struct PictureMaker::Layer {
  const MotionState* state = nullptr;
  const MotionState* reference = nullptr;  // of distances; null: none
};

PictureMaker::PictureMaker(const Scene& scene, const Scene* compared,
                           Deviations deviations)
    : shapes_(Shapes(scene)),
      deviations_(std::move(deviations)),
      home_(BallAbout(scene)),
      ground_(GroundLevel(scene)),
      top_(TopOf(scene)) {
  if (compared != nullptr) compared_shapes_ = Shapes(*compared);
  for (const Collider& collider : scene.colliders) {
    colliders_.push_back(ColliderSurface(collider, home_));
  }
}

void PictureMaker::ForgetScales() { seen_.fill(0.0); }

Ball PictureMaker::BallAboutNow(const Player& player) const {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
  const auto add = [&](const MotionState& state) {
    for (const Eigen::VectorXd& x : state.positions) {
      for (Eigen::Index c = 0; c < x.size(); c += 3) {
        if (!std::isfinite(x[c])) continue;
        low = low.cwiseMin(x.segment<3>(c));
        high = high.cwiseMax(x.segment<3>(c));
      }
    }
  };
  add(player.motion());
  if (player.target_state() != nullptr) add(*player.target_state());
  if (low.x() > high.x()) return home_;
  return {ToPoint(0.5 * (low + high)), static_cast<float>(0.5 * (high - low).norm())};
}

Picture PictureMaker::Make(const Player& player, const ViewOptions& options) {
  Picture picture;
  picture.background = kBackground;
  AddGuides(player, options, &picture);
  const MotionState* target = player.target_state();
  const MotionState* compared = player.compared_motion();
  Layer layer{&player.motion(), compared};
  if (target != nullptr) layer = {target, &player.motion()};
  missing_ = Missing(layer, options.color);
  // Parameters that were turned are those of the scene; so are its colours.
  const Tuning* tuning = player.tunes_scene() ? &player.tuning() : nullptr;
  AddCloths(layer, options, tuning, &picture);
  if (target != nullptr) AddWireframe(shapes_, player.motion(), kGreen, &picture);
  if (compared != nullptr) {
    AddWireframe(compared_shapes_, *compared, target != nullptr ? kOrange : kGreen,
                 &picture);
  }
  if (options.fixed_vertices) AddFixedVertices(player.motion(), &picture);
  AddMarkers(player, &picture);
  return picture;
}

std::string PictureMaker::Missing(const Layer& layer, ColorMode mode) const {
  if (mode == ColorMode::kDeviation && !has_deviations()) {
    return "no standard deviation is known: give an estimate's --report";
  }
  if (mode == ColorMode::kDistance && layer.reference == nullptr) {
    return "no distance is known: give a --target of vertices or a scene to --compare";
  }
  return "";
}

std::vector<QuantityValues> PictureMaker::Values(const Layer& layer,
                                                 const Tuning* tuning,
                                                 ColorMode mode) const {
  std::vector<QuantityValues> values(shapes_.size());
  for (size_t o = 0; o < shapes_.size(); ++o) {
    QuantityInput input;
    input.object = &shapes_[o].object();
    input.rest_lengths = &shapes_[o].rest_lengths();
    input.positions = At(layer.state->positions, o);
    if (input.positions == nullptr) continue;
    input.velocities = At(layer.state->velocities, o);
    if (layer.reference != nullptr) input.reference = At(layer.reference->positions, o);
    input.stiffness_deviation = At(deviations_.stiffness, o);
    input.mass_deviation = At(deviations_.mass, o);
    values[o] = ValuesOf(mode, input);
    if (tuning == nullptr || o >= tuning->objects.size()) continue;
    const ObjectTuning& factors = tuning->objects[o];
    double factor = 1.0;
    if (mode == ColorMode::kStiffness) factor = factors.stiffness_factor;
    if (mode == ColorMode::kMass) factor = factors.mass_factor;
    for (double& value : values[o].of_vertices) value *= factor;
    for (double& value : values[o].of_springs) value *= factor;
  }
  return values;
}

void PictureMaker::SetScale(ColorMode mode, const std::vector<QuantityValues>& values) {
  scale_.reset();
  if (mode == ColorMode::kPlain || !missing_.empty()) return;
  std::vector<double> all;
  for (const QuantityValues& one : values) {
    all.insert(all.end(), one.of_vertices.begin(), one.of_vertices.end());
    all.insert(all.end(), one.of_springs.begin(), one.of_springs.end());
  }
  if (Moves(mode)) {
    // A scale that changed with every frame could not be read. Vertices alone: single
    // springs go much farther.
    double& seen = seen_[static_cast<int>(mode)];
    for (const QuantityValues& one : values) {
      for (const double value : one.of_vertices) {
        if (std::isfinite(value)) seen = std::max(seen, std::abs(value));
      }
    }
    scale_.emplace();
    scale_->high = RoundUp(seen > 0.0 ? seen : 1e-3);
    scale_->low = mode == ColorMode::kStretch ? -scale_->high : 0.0;
  } else {
    scale_ = ScaleOver(all);
  }
  const bool of_mass = mode == ColorMode::kDeviation && !deviations_.has_stiffness();
  scale_->title = QuantityTitle(mode, of_mass);
  scale_->unit = QuantityUnit(mode, of_mass);
}

void PictureMaker::AddCloths(const Layer& layer, const ViewOptions& options,
                             const Tuning* tuning, Picture* picture) {
  const std::vector<QuantityValues> values = Values(layer, tuning, options.color);
  SetScale(options.color, values);
  const glm::vec4 uncolored = missing_.empty() ? kClothColor : kUnknownColor;
  for (size_t o = 0; o < shapes_.size(); ++o) {
    const Eigen::VectorXd* x = At(layer.state->positions, o);
    if (x == nullptr) continue;
    const ClothShape& shape = shapes_[o];
    const int n = shape.object().num_vertices();
    if (options.surface) {
      picture->surfaces.push_back(
          shape.MakeSurface(*x, scale_ && !values[o].of_vertices.empty()
                                    ? Colors(*scale_, values[o].of_vertices)
                                    : std::vector<glm::vec4>(n, uncolored)));
      picture->surfaces.back().edge_color = kEdgeColor;
      // Where there is a reference, one of the two is a wireframe along the other.
      picture->surfaces.back().under_lines =
          options.springs || layer.reference != nullptr;
      picture->surfaces.back().edge_width = options.wireframe ? 1.0f : 0.0f;
    }
    if (options.surface && options.wireframe) {
      // Of a line at the border the surface has the inner half only.
      picture->lines.push_back(ClothShape::MakeLines(*x, shape.border(), {kEdgeColor}));
    } else if (options.wireframe) {
      // Without a surface edges are the cloth.
      picture->lines.push_back(ClothShape::MakeLines(*x, shape.edges(), {kClothColor}));
    }
    if (options.springs) {
      const bool colored = scale_ && !values[o].of_springs.empty();
      picture->lines.push_back(
          ClothShape::MakeLines(*x, shape.object().springs,
                                colored ? Colors(*scale_, values[o].of_springs)
                                        : std::vector<glm::vec4>{kSpringColor}));
      picture->lines.back().width = 1.5f;
    }
  }
}

void PictureMaker::AddWireframe(const std::vector<ClothShape>& shapes,
                                const MotionState& state, const glm::vec4& color,
                                Picture* picture) {
  for (size_t o = 0; o < shapes.size(); ++o) {
    const Eigen::VectorXd* x = At(state.positions, o);
    if (x == nullptr) continue;
    picture->lines.push_back(ClothShape::MakeLines(*x, shapes[o].edges(), {color}));
    picture->lines.back().width = 1.5f;
  }
}

void PictureMaker::AddFixedVertices(const MotionState& state, Picture* picture) const {
  Points points;
  points.color = kFixedColor;
  points.size = 7.0f;
  for (size_t o = 0; o < shapes_.size(); ++o) {
    const Eigen::VectorXd* x = At(state.positions, o);
    if (x == nullptr) continue;
    for (int i = 0; i < shapes_[o].object().num_vertices(); ++i) {
      if (!shapes_[o].object().is_fixed[i] || !std::isfinite((*x)[3 * i])) continue;
      points.positions.push_back(ToPoint(x->segment<3>(3 * i)));
    }
  }
  if (!points.positions.empty()) picture->points.push_back(std::move(points));
}

void PictureMaker::AddMarkers(const Player& player, Picture* picture) {
  if (player.target() == nullptr) return;
  Points points;
  points.color = kMarkerColor;
  points.size = 6.0f;
  for (const SeenMarker& seen : player.target()->MarkersAt(player.frame())) {
    points.positions.push_back(ToPoint(seen.position));
  }
  if (!points.positions.empty()) picture->points.push_back(std::move(points));
}

void PictureMaker::AddGuides(const Player& player, const ViewOptions& options,
                             Picture* picture) const {
  if (options.ground) picture->lines.push_back(GroundGrid(home_, ground_, kBackground));
  if (options.axes) picture->lines.push_back(Axes(home_, ground_));
  if (options.colliders) picture->surfaces = colliders_;
  if (!options.wind) return;
  const Eigen::Vector3d wind =
      player.tunes_scene() ? player.tuning().wind : player.scene().wind;
  Lines arrow = WindArrow(home_, top_, wind);
  if (!arrow.positions.empty()) picture->lines.push_back(std::move(arrow));
}

}  // namespace dpe::viewer
