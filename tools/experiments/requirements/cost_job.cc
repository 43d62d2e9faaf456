#include "experiments/requirements/cost_job.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "dpe/engine/scene_io.h"
#include "experiments/requirements/cost_configuration.h"
#include "experiments/requirements/instruction_count.h"
#include "experiments/requirements/timed_program.h"

namespace dpe::experiments {
namespace {

// "2 iterations, 3 rollouts, 3 derivative passes, ..."
int Rollouts(const std::string& output) {
  const size_t end = output.find(" rollouts");
  if (end == std::string::npos) return 1;
  return std::stoi(output.substr(output.rfind(' ', end - 1) + 1));
}

Record RunCostJob(const Job& job) {
  const ScratchFolder folder;
  const std::string scene = folder.File("scene.txt");
  const std::string output = folder.File("out");
  const int time_frames = job.Integer("time_frames", kTimeFrames);
  WriteFileAtomically(scene, CostSceneText(job));
  const InstructionCount count =
      CountInstructions(CostCommand(job, scene, output, job.Integer("frames", 20)),
                        CountedFunctions(job));
  Record row;
  row.Set("instructions", count.total);
  for (const FeatureCode& code : CodeOfFeatures()) {
    row.Set("code_" + code.name, count.In(code.functions));
  }
  double least = std::numeric_limits<double>::infinity();
  int rollouts = 1;
  for (int i = 0; i < job.Integer("repetitions", 7); ++i) {
    std::filesystem::remove_all(output);
    const TimedResult run = RunTimed(CostCommand(job, scene, output, time_frames));
    if (run.exit_code != 0 && run.exit_code != 2) throw std::runtime_error(run.err);
    least = std::min(least, run.cpu_s);
    rollouts = Rollouts(run.out);
  }
  row.Set("rollouts", rollouts);
  row.Set("program_cpu_s", least);
  return row;
}

}  // namespace

const std::vector<FeatureCode>& CodeOfFeatures() {
  static const std::vector<FeatureCode> codes = {
      {"drag", {"DragLaw"}},
      {"collider", {"ColliderKernel"}},
      {"mass_derivative", {"dpe::ObjectSystem::VisitMass"}},
      {"drag_derivative", {"dpe::BatchTerm<dpe::DragLaw>::VisitParameters"}},
      {"uncertainty", {"Uncertainty", "Covariance"}},
      {"checkpoint", {"Checkpoint"}},
      {"robust_loss", {"dpe::RobustLoss::"}},
      {"prior", {"dpe::Prior"}},
  };
  return codes;
}

JobKind CostJobKind() {
  return {"cost",
          "counts the instructions of a simulation or an estimation, and measures its "
          "processor time (needs valgrind)",
          RunCostJob};
}

}  // namespace dpe::experiments
