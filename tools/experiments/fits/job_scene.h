// The scene of a job: a file, or one of the presets that make_scene writes.
#ifndef DPE_TOOLS_EXPERIMENTS_FITS_JOB_SCENE_H_
#define DPE_TOOLS_EXPERIMENTS_FITS_JOB_SCENE_H_

#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "experiments/experiment.h"

namespace dpe::experiments {

// The arguments that JobScenes reads:
//   scene      path of a scene file, or several separated by commas
//   preset     side, corners, flag or flag_no_wind, instead of scene
//   grid       vertices per side of the preset, default 12
const std::vector<std::string>& JobSceneArguments();

// The scenes as files, which is how estimations read them. A preset's is in a temporary
// folder that is gone when this object dies.
class JobScenes {
 public:
  // @throws SceneError for bad arguments, also if neither or both of scene and preset
  //         are given where `is_required`
  JobScenes(const Job& job, bool is_required);
  ~JobScenes();
  JobScenes(const JobScenes&) = delete;
  JobScenes& operator=(const JobScenes&) = delete;

  const std::vector<std::string>& paths() const { return paths_; }

 private:
  std::vector<std::string> paths_;
  std::string folder_;
};

// The preset that the arguments describe.
Scene PresetOf(const Job& job);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FITS_JOB_SCENE_H_
