#include "scene_model.h"

#include <algorithm>

#include "call.h"

namespace dpe::c {
namespace {

void CopyParameters(const Scene& from, Scene* to) {
  to->wind = from.wind;
  for (std::size_t o = 0; o < to->objects.size(); ++o) {
    to->objects[o].mass = from.objects[o].mass;
    to->objects[o].stiffness = from.objects[o].stiffness;
    to->objects[o].damping = from.objects[o].damping;
    to->objects[o].drag_coefficient = from.objects[o].drag_coefficient;
  }
}

}  // namespace

SceneModel::SceneModel(const Scene& scene, const std::atomic<bool>* interrupted)
    : initial_(scene), interrupted_(interrupted), live_(MakeLive(scene)) {
  for (std::size_t c = 0; c < scene.colliders.size(); ++c) {
    collider_ids_.push_back(next_collider_id_++);
  }
}

std::unique_ptr<LiveSimulation> SceneModel::MakeLive(const Scene& scene) const {
  SimulatorOptions options;
  options.interrupted = [flag = interrupted_] { return flag->load(); };
  return std::make_unique<LiveSimulation>(scene, options);
}

Scene SceneModel::Changed() const {
  Scene scene = initial_;
  CopyParameters(now(), &scene);
  scene.colliders = now().colliders;
  return scene;
}

RolloutStatus SceneModel::Advance() {
  RolloutStatus status = live_->AdvanceFrame();
  if (status.ok()) {
    ++frame_;
  } else {
    status.frame = static_cast<int>(frame_) + 1;
  }
  return status;
}

void SceneModel::Restart() {
  if (was_rebuilt_) {
    live_ = MakeLive(Changed());
    was_rebuilt_ = false;
  } else {
    live_->Restart();
  }
  frame_ = 0;
}

const ClothObject& SceneModel::At(int object) const {
  RequireIndex("object", object, live_->num_objects());
  return now().objects[object];
}

std::vector<double> SceneModel::Parameter(int object, int kind) const {
  const auto all = [](const auto& v) {
    return std::vector<double>(v.data(), v.data() + v.size());
  };
  switch (kind) {
    case DPE_MASS:
      return all(At(object).mass);
    case DPE_STIFFNESS:
      return all(At(object).stiffness);
    case DPE_DAMPING:
      return {At(object).damping};
    case DPE_DRAG:
      return {At(object).drag_coefficient};
    case DPE_WIND:
      return all(now().wind);
    default:
      throw ApiError(DPE_ERROR_ARGUMENT, "parameter kind " + std::to_string(kind) +
                                             "; accepted are 0 to 4");
  }
}

void SceneModel::SetParameter(int object, int kind, const double* values, int count) {
  Require(values != nullptr, "the values are null");
  const int size = static_cast<int>(Parameter(object, kind).size());
  if (count != size && !(count == 1 && kind != DPE_WIND)) {
    throw ApiError(DPE_ERROR_ARGUMENT, std::to_string(count) +
                                           " values; accepted are " +
                                           std::to_string(size) + ", or 1 for all");
  }
  Eigen::VectorXd v(size);
  for (int i = 0; i < size; ++i) v[i] = values[count == 1 ? 0 : i];
  switch (kind) {
    case DPE_MASS:
      return live_->SetMass(object, v);
    case DPE_STIFFNESS:
      return live_->SetStiffness(object, v);
    case DPE_DAMPING:
      return live_->SetDamping(object, v[0]);
    case DPE_DRAG:
      return live_->SetDragCoefficient(object, v[0]);
    default:
      return live_->SetWind(v);
  }
}

void SceneModel::TakeParameters(const Scene& scene) {
  if (scene.objects.size() != initial_.objects.size()) {
    throw SceneError("the scene has " + std::to_string(scene.objects.size()) +
                     " objects; accepted is one with " +
                     std::to_string(initial_.objects.size()));
  }
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const ClothObject &theirs = scene.objects[o], &ours = now().objects[o];
    const std::string name = "object " + std::to_string(o);
    if (theirs.num_vertices() != ours.num_vertices() ||
        theirs.springs != ours.springs) {
      throw SceneError(name + " is not the same cloth: it has other vertices (" +
                       std::to_string(theirs.num_vertices()) + " of them, here " +
                       std::to_string(ours.num_vertices()) + ") or other springs");
    }
    for (int i = 0; i < ours.num_vertices(); ++i) {
      if (ours.is_fixed[i] || theirs.mass[i] > 0.0) continue;
      throw SceneError(name + ", vertex " + std::to_string(i) +
                       " is free here and has no mass there");
    }
  }
  // Whatever else could be wrong with these values, the scene's validation has refused.
  for (int o = 0; o < live_->num_objects(); ++o) {
    const ClothObject& theirs = scene.objects[o];
    live_->SetMass(o, theirs.mass);
    live_->SetStiffness(o, theirs.stiffness);
    live_->SetDamping(o, theirs.damping);
    live_->SetDragCoefficient(o, theirs.drag_coefficient);
  }
  live_->SetWind(scene.wind);
}

void SceneModel::MoveVertices(int object, const int* vertices, const double* positions,
                              int count) {
  const ClothObject& cloth = At(object);
  Require(count >= 0, "the count is negative");
  if (count == 0) return;
  Require(vertices != nullptr, "the vertices are null");
  RequireFinite("positions", positions, 3 * count);
  for (int i = 0; i < count; ++i) {
    RequireIndex("vertex", vertices[i], cloth.num_vertices());
    if (cloth.is_fixed[vertices[i]]) continue;
    throw ApiError(DPE_ERROR_ARGUMENT,
                   "vertex " + std::to_string(vertices[i]) + " is not fixed");
  }
  for (int i = 0; i < count; ++i) {
    live_->SetFixedPosition(object, vertices[i],
                            Eigen::Vector3d::Map(positions + 3 * i));
  }
}

Scene SceneModel::Continued() const {
  Scene scene = now();
  for (int o = 0; o < live_->num_objects(); ++o) {
    ClothObject& cloth = scene.objects[o];
    cloth.rest_length = RestLengths(cloth);
    cloth.positions = live_->positions(o);
    cloth.velocities = live_->velocities(o);
    for (PrescribedPath& path : cloth.prescribed_paths) {
      const long gone = std::min<long>(live_->frame(), path.positions.cols() - 1);
      const Eigen::Matrix3Xd left =
          path.positions.rightCols(path.positions.cols() - gone);
      path.positions = left;
      path.positions.col(0) = cloth.positions.segment<3>(3 * path.vertex);
    }
  }
  return scene;
}

void SceneModel::SetFixed(int object, int vertex, bool is_fixed) {
  RequireIndex("vertex", vertex, At(object).num_vertices());
  if ((At(object).is_fixed[vertex] != 0) == is_fixed) return;
  Scene scene = Continued();
  ClothObject& cloth = scene.objects[object];
  cloth.is_fixed[vertex] = is_fixed ? 1 : 0;
  auto& paths = cloth.prescribed_paths;
  paths.erase(std::remove_if(paths.begin(), paths.end(),
                             [&](const auto& path) { return path.vertex == vertex; }),
              paths.end());
  if (is_fixed) cloth.velocities.segment<3>(3 * vertex).setZero();
  live_ = MakeLive(scene);
  was_rebuilt_ = true;
}

}  // namespace dpe::c
