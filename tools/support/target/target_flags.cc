#include "support/target/target_flags.h"

#include <gflags/gflags.h>

#include "support/flag_ranges.h"
#include "support/flag_values.h"

DEFINE_double(target_scale, 0.0,
              "Metres per unit of the target; 0: what the file says, else 1.");
DEFINE_string(target_up, "y", "The target's axis that points up: y or z.");
DEFINE_double(target_rate, 0.0,
              "Frames per second of a target without times; 0: the scene's.");
DEFINE_string(target_origin, "auto",
              "When the scene begins: first (at the target's first sample), file (at "
              "its time 0), or auto: file for frame numbers, else first.");
DEFINE_bool(target_nan_is_missing, false,
            "Take a position of three NaN as not observed; otherwise it is an error.");
DEFINE_string(target_attach, "auto",
              "What the target's markers are: vertex (named by number), position (the "
              "nearest point of the cloth at the start), or auto.");
DEFINE_int32(target_object, -1,
             "The object that the target belongs to; -1: all, counted through.");
DEFINE_string(marker_map, "",
              "File of lines marker,vertex that says which vertex a marker is.");
DEFINE_double(
    marker_limit, 0.0,
    "Greatest distance (m) of a marker from the cloth that it is attached to; "
    "0: half the mean edge length of its triangles.");
DEFINE_bool(follow_pins, false,
            "Fixed vertices follow the target where it shows them.");
DEFINE_string(initial_state, "scene",
              "Where the vertices begin: scene, or target (its first frame, where it "
              "shows them).");

namespace dpe::tools {

TargetOptions TargetFromFlags() {
  RequireAtLeast("target_scale", FLAGS_target_scale, 0.0);
  RequireAtLeast("target_rate", FLAGS_target_rate, 0.0);
  RequireAtLeast("target_object", FLAGS_target_object, -1);
  RequireAtLeast("marker_limit", FLAGS_marker_limit, 0.0);
  TargetOptions target;
  target.capture.scale = FLAGS_target_scale;
  target.capture.up = FromFlag("target_up", FLAGS_target_up, UpAxisFromName);
  target.capture.rate = FLAGS_target_rate;
  target.capture.origin =
      FromFlag("target_origin", FLAGS_target_origin, TimeOriginFromName);
  target.capture.nan_is_missing = FLAGS_target_nan_is_missing;
  target.attach.method =
      FromFlag("target_attach", FLAGS_target_attach, AttachMethodFromName);
  target.attach.object = FLAGS_target_object;
  target.attach.max_distance = FLAGS_marker_limit;
  target.marker_map = FLAGS_marker_map;
  target.follow_pins = FLAGS_follow_pins;
  if (FLAGS_initial_state != "scene" && FLAGS_initial_state != "target") {
    throw SceneError("--initial_state: \"" + FLAGS_initial_state +
                     "\" is not accepted; expected scene or target");
  }
  target.start_from_target = FLAGS_initial_state == "target";
  return target;
}

}  // namespace dpe::tools
