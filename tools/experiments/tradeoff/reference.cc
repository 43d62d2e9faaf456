#include "experiments/tradeoff/reference.h"

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "experiments/hash.h"
#include "experiments/tradeoff/candidate.h"

namespace dpe::experiments::tradeoff {
namespace {

constexpr int kCoarse = 64;  // steps per frame
constexpr int kFine = 128;

Eigen::MatrixXd Positions(Scene scene, int steps, int frames) {
  scene.integration_method = IntegrationMethod::kTrBdf2;
  scene.steps_per_frame = steps;
  scene.solver = "cholesky";
  Trajectory trajectory = Simulator(scene).Simulate(frames);
  if (!trajectory.status.ok()) {
    throw SceneError("the reference motion: " + trajectory.status.Message());
  }
  return trajectory.positions[0];
}

std::uint64_t Key(const Scene& scene, int frames) {
  Scene plain = scene;
  ApplyStepSettings({IntegrationMethod::kTrBdf2, 1, "cholesky"}, &plain, nullptr);
  const std::string text = SceneToJson(plain);
  const Eigen::MatrixXd coarse = Positions(plain, 1, frames);
  return Hash(coarse.data(), coarse.size() * sizeof(double),
              Hash(text.data(), text.size()));
}

std::string CachePath(std::uint64_t key) {
  std::ostringstream name;
  name << "dpe-reference-" << getuid() << "-" << std::hex << key << ".bin";
  return (std::filesystem::temp_directory_path() / name.str()).string();
}

// False unless the file is whole: its last 8 bytes are the hash of the others.
bool Read(const std::string& path, Eigen::MatrixXd* positions,
          Eigen::MatrixXd* uncertainty) {
  std::ifstream file(path, std::ios::binary);
  const size_t bytes = positions->size() * sizeof(double);
  std::uint64_t found = 0;
  file.read(reinterpret_cast<char*>(positions->data()), bytes);
  file.read(reinterpret_cast<char*>(uncertainty->data()), bytes);
  file.read(reinterpret_cast<char*>(&found), sizeof(found));
  if (!file) return false;
  return found == Hash(uncertainty->data(), bytes, Hash(positions->data(), bytes, 1));
}

void Write(const std::string& path, const Reference& reference) {
  const size_t bytes = reference.positions.size() * sizeof(double);
  std::string content(2 * bytes, '\0');
  std::memcpy(content.data(), reference.positions.data(), bytes);
  std::memcpy(content.data() + bytes, reference.uncertainty.data(), bytes);
  const std::uint64_t hash = Hash(content.data(), content.size(), 1);
  content.append(reinterpret_cast<const char*>(&hash), sizeof(hash));
  WriteFileAtomically(path, content);
}

}  // namespace

Reference ComputeReference(const Scene& scene, int frames) {
  const Eigen::MatrixXd coarse = Positions(scene, kCoarse, frames);
  const Eigen::MatrixXd fine = Positions(scene, kFine, frames);
  Reference reference;
  reference.uncertainty = (fine - coarse) / 3.0;
  reference.positions = fine + reference.uncertainty;
  return reference;
}

Reference CachedReference(const Scene& scene, int frames) {
  const std::string path = CachePath(Key(scene, frames));
  Reference reference;
  const Eigen::Index rows = scene.objects[0].positions.size();
  reference.positions.resize(rows, frames);
  reference.uncertainty.resize(rows, frames);
  if (Read(path, &reference.positions, &reference.uncertainty)) return reference;
  reference = ComputeReference(scene, frames);
  try {
    Write(path, reference);
  } catch (const SceneError&) {
    // The next process computes it again.
  }
  return reference;
}

MotionError ErrorOver(const Eigen::MatrixXd& difference, const Scene& scene,
                      int horizon) {
  MotionError error;
  double sum = 0.0;
  long count = 0;
  for (int frame = 1; frame <= horizon; ++frame) {
    for (int i = 0; i < scene.objects[0].num_vertices(); ++i) {
      if (scene.objects[0].is_fixed[i] != 0) continue;
      const double squared = difference.block<3, 1>(3 * i, frame).squaredNorm();
      sum += squared;
      ++count;
      // Written so that a NaN stays.
      if (!(squared <= error.max)) error.max = squared;
    }
  }
  error.rms = std::sqrt(sum / static_cast<double>(count));
  error.max = std::sqrt(error.max);
  return error;
}

Record RunReferenceJob(const Job& job) {
  const Candidate candidate = CandidateFromRecord(job);
  const Scene scene = CandidateScene(candidate, job.Flag("uniform", false));
  const Reference reference = CachedReference(scene, candidate.frames);
  Record row;
  for (int horizon : kHorizons) {
    if (horizon >= candidate.frames) continue;
    const MotionError error = ErrorOver(reference.uncertainty, scene, horizon);
    row.Set("rms_" + std::to_string(horizon) + "_m", error.rms);
    row.Set("max_" + std::to_string(horizon) + "_m", error.max);
  }
  return row;
}

}  // namespace dpe::experiments::tradeoff
