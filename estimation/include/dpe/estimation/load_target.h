// A file of recorded motion as the target of an estimation: everything from the file to
// observations and the scene that belongs to them, in one call.
#ifndef DPE_ESTIMATION_LOAD_TARGET_H_
#define DPE_ESTIMATION_LOAD_TARGET_H_

#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/estimation/attach.h"
#include "dpe/estimation/capture.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/observations.h"

namespace dpe {

struct TargetOptions {
  CaptureOptions capture;
  AttachOptions attach;
  std::string marker_map;          // file for attach.vertex_of, see ReadMarkerMap
  bool follow_pins = false;        // see FollowObservedPins
  bool start_from_target = false;  // see StartFromObservation
  // Empty: the scene's own rest lengths; else as ReadRestShape. An OBJ file has the
  // units of the target.
  std::string rest_shape;
};

// Reads a capture, attaches it to the scene's initial state, and lets the scene take
// over what the options say. Rest lengths change with `rest_shape` only.
//
// @param path      file, folder or pattern, see ReadCapture
// @param options   how it is read and attached, and what the scene takes over
// @param scene     is changed; valid afterwards if it was before
// @param warnings  if not null, receives one line per thing that is worth a look
// @throws SceneError naming file, line or byte, value and what is accepted
DPE_ESTIMATION_API Observations
LoadTarget(const std::string& path, const TargetOptions& options, Scene* scene,
           std::vector<std::string>* warnings = nullptr);

// "y" or "z"; "auto", "first" or "file"; "auto", "vertex" or "position".
// @throws SceneError naming what is accepted
DPE_ESTIMATION_API UpAxis UpAxisFromName(const std::string& name);
DPE_ESTIMATION_API TimeOrigin TimeOriginFromName(const std::string& name);
DPE_ESTIMATION_API AttachMethod AttachMethodFromName(const std::string& name);

}  // namespace dpe

#endif  // DPE_ESTIMATION_LOAD_TARGET_H_
