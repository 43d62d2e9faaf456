#include "dpe/estimation/load_target.h"

#include "dpe/engine/scene_io.h"
#include "dpe/estimation/observed_scene.h"
#include "dpe/estimation/rest_shape.h"

namespace dpe {
namespace {

[[noreturn]] void Refuse(const std::string& what, const std::string& name,
                         const std::string& accepted) {
  throw SceneError(what + ": \"" + name + "\" is not accepted; expected " + accepted);
}

}  // namespace

Observations LoadTarget(const std::string& path, const TargetOptions& options,
                        Scene* scene, std::vector<std::string>* warnings) {
  Capture capture = ReadCapture(path, options.capture);
  ToSceneUnits(options.capture, scene->delta, &capture);
  AttachOptions attach = options.attach;
  if (!options.marker_map.empty()) attach.vertex_of = ReadMarkerMap(options.marker_map);
  Observations observations = AttachCapture(capture, *scene, attach, warnings);
  if (options.start_from_target) StartFromObservation(observations, scene);
  if (options.follow_pins) FollowObservedPins(observations, path, scene);
  // Last, so that what is said of stretched springs is about the state they start in.
  if (!options.rest_shape.empty()) {
    SetRestShape(ReadRestShape(options.rest_shape, options.capture.scale, capture),
                 options.rest_shape, attach.object, scene, warnings);
  }
  // The warnings about the scene were given when it was loaded.
  ValidateScene(*scene, path + " and the scene", nullptr);
  return observations;
}

UpAxis UpAxisFromName(const std::string& name) {
  if (name == "y") return UpAxis::kY;
  if (name == "z") return UpAxis::kZ;
  Refuse("axis", name, "y or z");
}

TimeOrigin TimeOriginFromName(const std::string& name) {
  if (name == "auto") return TimeOrigin::kAuto;
  if (name == "first") return TimeOrigin::kFirstSample;
  if (name == "file") return TimeOrigin::kFile;
  Refuse("time origin", name, "auto, first or file");
}

AttachMethod AttachMethodFromName(const std::string& name) {
  if (name == "auto") return AttachMethod::kAuto;
  if (name == "vertex") return AttachMethod::kVertex;
  if (name == "position") return AttachMethod::kPosition;
  Refuse("attachment", name, "auto, vertex or position");
}

}  // namespace dpe
