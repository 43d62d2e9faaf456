#include "experiments/campaign.h"

#include <cctype>
#include <filesystem>
#include <set>

#include "dpe/engine/scene.h"
#include "dpe/engine/scene_io.h"
#include "experiments/record_io.h"

namespace dpe::experiments {
namespace {

namespace fs = std::filesystem;

// With the endings of row and log files they stay below the 255 bytes of a file name.
constexpr size_t kMaxIdLength = 200;

bool IsValidId(const std::string& id) {
  if (id.empty() || id.size() > kMaxIdLength || id[0] == '.') return false;
  for (const char c : id) {
    const bool is_fine = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                         std::string("._-=+").find(c) != std::string::npos;
    if (!is_fine) return false;
  }
  return true;
}

std::string KindNames() {
  std::string names;
  for (const JobKind& kind : JobKinds()) {
    names += (names.empty() ? "" : ", ") + kind.name;
  }
  return names;
}

}  // namespace

void RequireValidJobs(const std::vector<Job>& jobs, const std::string& where) {
  if (jobs.empty()) throw SceneError(where + ": there is no job in it");
  std::set<std::string> ids;
  for (size_t j = 0; j < jobs.size(); ++j) {
    const std::string place = where + ", job " + std::to_string(j + 1);
    const std::string id = jobs[j].Text("id", "");
    if (!IsValidId(id)) {
      throw SceneError(place + ", id: \"" + id +
                       "\" is not accepted; expected 1 to 200 letters, digits and "
                       "._-=+, the first no dot");
    }
    if (!ids.insert(id).second) {
      throw SceneError(place + ", id: \"" + id + "\" is there twice");
    }
    const std::string kind = jobs[j].Text("kind", "");
    if (FindJobKind(kind) == nullptr) {
      throw SceneError(place + " (" + id + "), kind: \"" + kind +
                       "\" is not accepted; expected one of " + KindNames());
    }
  }
}

Campaign LoadCampaign(const std::string& path) {
  Campaign campaign;
  campaign.jobs = ReadRecords(path);
  RequireValidJobs(campaign.jobs, path);
  campaign.working_dir = fs::absolute(path).parent_path().lexically_normal().string();
  return campaign;
}

const Experiment* FindExperiment(const std::string& name) {
  for (const Experiment& experiment : Experiments()) {
    if (experiment.name == name) return &experiment;
  }
  return nullptr;
}

const JobKind* FindJobKind(const std::string& name) {
  for (const JobKind& kind : JobKinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

std::string JobsPath(const std::string& dir) { return dir + "/jobs.jsonl"; }

void WriteJobs(const std::string& dir, const std::vector<Job>& jobs) {
  std::string lines;
  for (const Job& job : jobs) lines += RecordToJson(job) + "\n";
  WriteFileAtomically(JobsPath(dir), lines);
}

std::string JobId(const Job& job) { return job.Text("id", ""); }

Job ReadJob(const std::string& dir, const std::string& id) {
  for (const Job& job : ReadRecords(JobsPath(dir))) {
    if (JobId(job) == id) return job;
  }
  throw SceneError(JobsPath(dir) + ": there is no job \"" + id + "\" in it");
}

}  // namespace dpe::experiments
