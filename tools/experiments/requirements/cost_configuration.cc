#include "experiments/requirements/cost_configuration.h"

#include <filesystem>
#include <sstream>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene.h"
#include "dpe/engine/scene_io.h"

namespace dpe::experiments {
namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

ClothObject Cloth(const Job& job, ClothObject cloth) {
  if (!job.Flag("triangles", false)) cloth.triangles.clear();
  cloth.drag_coefficient = job.Number("drag", 0.0);
  cloth.damping = job.Number("damping", 0.0);
  if (job.Flag("groups", false)) {
    cloth.vertex_group.resize(cloth.num_vertices());
    for (int i = 0; i < cloth.num_vertices(); ++i) {
      cloth.vertex_group[i] = cloth.positions[3 * i + 2] < 0.0 ? 0 : 1;
    }
  }
  return cloth;
}

std::vector<Collider> Colliders(const Job& job) {
  const bool contact = job.Flag("contact", false);
  const Eigen::Vector3d below = {0.0, -1000.0, 0.0}, beside = {1.5, 0.0, 0.0};
  Collider sphere = SphereCollider(contact ? beside : below, 2.0);
  sphere.stiffness = job.Number("collider_stiffness", 1000.0);
  return std::vector<Collider>(job.Integer("colliders", 0), sphere);
}

Scene CostScene(const Job& job) {
  PresetOptions options;
  options.rows = options.cols = job.Integer("rows", 12);
  Scene scene = MakePresetScene(ScenePreset::kFlag, options);
  scene.integration_method = IntegrationMethodFromName(
      job.Text("integrator", IntegrationMethodName(scene.integration_method)));
  scene.wind = {job.Number("wind", 0.0), 0.0, 0.0};
  scene.colliders = Colliders(job);
  const int objects = job.Integer("objects", 1);
  if (objects < 1) throw SceneError("objects: expected a number above 0");
  scene.objects.assign(objects, Cloth(job, scene.objects[0]));
  ApplySettings(job.Text("settings", "nG"), &scene);
  return scene;
}

// A scene file has a line for every member.
std::string WithoutLines(const std::string& text,
                         const std::vector<std::string>& keys) {
  std::string kept;
  std::istringstream lines(text);
  std::vector<bool> found(keys.size(), false);
  for (std::string line; std::getline(lines, line);) {
    bool keep = true;
    for (size_t k = 0; k < keys.size(); ++k) {
      const size_t start = line.find_first_not_of(' ');
      if (start == std::string::npos ||
          line.compare(start, keys[k].size() + 2, '"' + keys[k] + '"') != 0) {
        continue;
      }
      found[k] = true;
      keep = false;
    }
    if (keep) kept += line + '\n';
  }
  for (size_t k = 0; k < keys.size(); ++k) {
    if (!found[k]) throw SceneError("unmentioned: no line of the file has " + keys[k]);
  }
  return kept;
}

bool IsEstimation(const Job& job) {
  const std::string program = job.Text("program", "simulate_cloth");
  if (program != "simulate_cloth" && program != "estimate_cloth") {
    throw SceneError("program: \"" + program +
                     "\" is not accepted; expected simulate_cloth or estimate_cloth");
  }
  return program == "estimate_cloth";
}

// The programs are in one folder.
std::string PathOf(const std::string& program) {
  const auto self = std::filesystem::read_symlink("/proc/self/exe");
  return (self.parent_path() / program).string();
}

}  // namespace

std::string CostSceneText(const Job& job) {
  std::string text = SceneToJson(CostScene(job));
  text = WithoutLines(text, Split(job.Text("unmentioned", ""), ','));
  ParseScene(text, "the scene of a cost job");
  return text;
}

std::vector<std::string> CostCommand(const Job& job, const std::string& scene_path,
                                     const std::string& output_path, int frames) {
  const bool is_estimation = IsEstimation(job);
  std::vector<std::string> command = {
      PathOf(is_estimation ? "estimate_cloth" : "simulate_cloth"),
      "--scene=" + scene_path, "--frames=" + std::to_string(frames)};
  if (is_estimation) {
    const std::vector<std::string> flags = {"--output_dir=" + output_path,
                                            "--trajectory_format=npy",
                                            "--init=scene",
                                            "--init_perturbation=0.01",
                                            "--seed=1",
                                            "--max_iterations=1",
                                            "--solver=lm",
                                            "--horizon=full"};
    command.insert(command.end(), flags.begin(), flags.end());
  } else {
    command.push_back("--output=" + output_path + ".npy");
  }
  // The last of equal flags counts.
  for (std::string flag : Split(job.Text("flags", ""), ' ')) {
    const size_t folder = flag.find("{}");
    if (folder != std::string::npos) flag.replace(folder, 2, output_path);
    command.push_back(flag);
  }
  return command;
}

std::vector<std::string> CountedFunctions(const Job& job) {
  const std::string count = job.Text("count", "");
  if (!count.empty() && count != "validation") {
    throw SceneError("count: \"" + count + "\" is not accepted; expected validation");
  }
  if (!IsEstimation(job)) return {"dpe::Simulator::Simulate(int)"};
  std::vector<std::string> functions = {"dpe::Estimate(*"};
  if (!count.empty()) functions.push_back("dpe::Validate(*");
  return functions;
}

}  // namespace dpe::experiments
