#include "fuzz/call_order.h"

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_io.h"
#include "fuzz/call_order_calls.h"
#include "fuzz/call_order_player.h"

namespace dpe::test {

CallOrderFiles MakeCallOrderFiles(const std::string& folder) {
  PresetOptions options;
  options.rows = options.cols = 3;
  Scene scene = MakePresetScene(ScenePreset::kSide, options);
  scene.num_frames = 4;
  ApplySettings("nG", &scene);
  const CallOrderFiles files = {folder + "/scene.txt", folder + "/motion.csv", folder};
  SaveScene(scene, files.scene);
  WriteTrajectory(files.recording, TrajectoryFormat::kCsv, Simulator(scene).Simulate(4),
                  scene);
  return files;
}

int NumCalls() { return static_cast<int>(AllCalls().size()); }

std::string RunCallOrder(const CallOrderFiles& files, const std::uint8_t* bytes,
                         std::size_t size) {
  CallOrderPlayer player(files, bytes, size);
  while (player.has_more() && player.failure().empty()) {
    AllCalls()[player.Byte() % AllCalls().size()](&player);
  }
  player.Check("dpe_shutdown", dpe_shutdown());
  if (dpe_live_handles() != 0) player.Fail("handles are left after dpe_shutdown");
  return player.failure();
}

}  // namespace dpe::test
