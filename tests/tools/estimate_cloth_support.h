// Runs estimate_cloth on a scene and reads what it wrote.
#ifndef DPE_TESTS_TOOLS_ESTIMATE_CLOTH_SUPPORT_H_
#define DPE_TESTS_TOOLS_ESTIMATE_CLOTH_SUPPORT_H_

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dpe/engine/scene_io.h"
#include "support/run_program.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe::test {

class EstimateClothTest : public ::testing::Test {
 protected:
  EstimateClothTest() {
    Perturb(2, &scene_);
    scene_.num_frames = 20;
    ApplySettings("nL", &scene_);
    SaveScene(scene_, path_);
  }

  ProgramResult Run(std::vector<std::string> flags,
                    const RunProgramOptions& options = {}) {
    flags.push_back("--scene=" + path_);
    flags.push_back("--output_dir=" + output_);
    return RunProgram("estimate_cloth", flags, options);
  }

  nlohmann::json Report() const {
    return nlohmann::json::parse(ReadFile(output_ + "/report.json"));
  }

  const TempDir folder_;
  const std::string path_ = folder_.File("cloth.v1.txt");
  const std::string output_ = folder_.File("out/deep");
  Scene scene_ = MakeDerivativeScene("side", 5);
};

}  // namespace dpe::test

#endif  // DPE_TESTS_TOOLS_ESTIMATE_CLOTH_SUPPORT_H_
