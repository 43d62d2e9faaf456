#include "experiments/executors/slurm.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>
#include <utility>

#include "dpe/engine/scene.h"
#include "dpe/engine/scene_io.h"
#include "experiments/campaign.h"
#include "experiments/executors/slurm_commands.h"
#include "experiments/hash.h"
#include "experiments/machine.h"

namespace dpe::experiments {
namespace {

namespace fs = std::filesystem;

// How long a row may take from the node that wrote it to here, on a network file
// system: attributes are cached for up to a minute on some, but a file that was never
// looked for is seen within seconds.
constexpr double kRowDelay = 10.0;

// Within it Slurm ends the watching process of a task whose job it has ended.
constexpr double kKilledDelay = 5.0;

std::string KeyOf(const std::string& dir) {
  char text[20];
  std::snprintf(text, sizeof(text), "%016llx",
                static_cast<unsigned long long>(Hash(dir.data(), dir.size())));
  return text;
}

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::vector<std::string> ReadLines(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  std::string line;
  while (std::getline(file, line)) lines.push_back(line);
  return lines;
}

class SlurmCampaign {
 public:
  SlurmCampaign(const std::vector<Job>& jobs, const WorkerSettings& settings,
                const SlurmOptions& options, const RowStore& store,
                const ExecutorCallbacks& callbacks)
      : settings_(settings),
        options_(options),
        store_(store),
        callbacks_(callbacks),
        folder_(store.dir() + "/slurm"),
        prefix_("dpe_" + KeyOf(store.dir()) + "_") {
    for (const Job& job : jobs) waiting_.emplace(JobId(job), job);
    fs::create_directories(folder_);
    ReadEarlierSubmissions();
  }

  bool Run(const std::vector<Job>& jobs) {
    std::vector<QueuedTask> queue = ReadQueue(prefix_);
    Submit(NotQueued(jobs, queue));
    while (!waiting_.empty()) {
      if (!Pause(options_.poll_interval_s)) return Cancel();
      queue = ReadQueue(prefix_);
      CollectRows();
      if (queue.empty() && !waiting_.empty()) {
        if (!WaitForRows()) return Cancel();
        Submit(GiveUpOrRetry(jobs));
      }
      callbacks_.tick(static_cast<int>(std::count_if(
          queue.begin(), queue.end(), [](const auto& t) { return t.is_running; })));
    }
    return true;
  }

 private:
  std::string TasksPath(int submission) const {
    return folder_ + "/tasks_" + std::to_string(submission) + ".txt";
  }

  void ReadEarlierSubmissions() {
    while (fs::exists(TasksPath(num_submissions_))) ++num_submissions_;
  }

  // Jobs that no task in the queue is going to run.
  std::vector<Job> NotQueued(const std::vector<Job>& jobs,
                             const std::vector<QueuedTask>& queue) const {
    std::set<std::string> queued;
    for (const QueuedTask& task : queue) {
      const int submission = std::atoi(task.name.c_str() + prefix_.size());
      const std::vector<std::string> ids = ReadLines(TasksPath(submission));
      if (task.index < static_cast<int>(ids.size())) queued.insert(ids[task.index]);
    }
    std::vector<Job> result;
    for (const Job& job : jobs) {
      if (queued.count(JobId(job)) == 0) result.push_back(job);
    }
    return result;
  }

  void Submit(const std::vector<Job>& jobs) {
    if (jobs.empty()) return;
    if (max_array_size_ == 0) max_array_size_ = MaxArraySize();
    for (size_t first = 0; first < jobs.size();
         first += static_cast<size_t>(max_array_size_)) {
      const size_t last =
          std::min(jobs.size(), first + static_cast<size_t>(max_array_size_));
      std::string ids;
      for (size_t j = first; j < last; ++j) {
        ids += JobId(jobs[j]) + "\n";
        ++submitted_[JobId(jobs[j])];
      }
      SubmitChunk(ids, static_cast<int>(last - first));
    }
  }

  // The tasks are written before Slurm hears of them, so that whatever is in the queue
  // can be told which job it runs.
  void SubmitChunk(const std::string& ids, int count) {
    const int number = num_submissions_++;
    WriteFileAtomically(TasksPath(number), ids);
    const std::string script = folder_ + "/submit_" + std::to_string(number) + ".sh";
    WriteFileAtomically(script, "#!/bin/sh\nexport OPENBLAS_NUM_THREADS=1\nexec " +
                                    Quoted(settings_.program) + " --internal_task " +
                                    Quoted(store_.dir()) + " " +
                                    Quoted(TasksPath(number)) +
                                    " \"$SLURM_ARRAY_TASK_ID\" " +
                                    std::to_string(settings_.timeout_s) + "\n");
    std::string array = "--array=0-" + std::to_string(count - 1);
    if (options_.max_running > 0) array += "%" + std::to_string(options_.max_running);
    std::vector<std::string> arguments = {
        array, "--job-name=" + prefix_ + std::to_string(number),
        "--chdir=" + settings_.working_dir, "--output=" + folder_ + "/task_%A_%a.txt",
        "--cpus-per-task=1"};
    if (!options_.partition.empty()) {
      arguments.push_back("--partition=" + options_.partition);
    }
    arguments.insert(arguments.end(), options_.sbatch_options.begin(),
                     options_.sbatch_options.end());
    SubmitArray(arguments, script);
  }

  void CollectRows() {
    for (auto job = waiting_.begin(); job != waiting_.end();) {
      const std::optional<StoredRow> row = store_.Find(job->second);
      if (row) {
        callbacks_.finished(job->second, row->result.Text("outcome", ""));
        job = waiting_.erase(job);
      } else {
        ++job;
      }
    }
  }

  // False: interrupted.
  bool WaitForRows() {
    for (double waited = 0.0; waited < kRowDelay && !waiting_.empty(); waited += 0.5) {
      if (!Pause(0.5)) return false;
      CollectRows();
    }
    return true;
  }

  // The jobs to submit again; the others get a row that says that they were lost.
  std::vector<Job> GiveUpOrRetry(const std::vector<Job>& jobs) {
    std::vector<Job> again;
    for (const Job& job : jobs) {
      const std::string id = JobId(job);
      if (waiting_.count(id) == 0) continue;
      if (submitted_[id] <= options_.max_retries) {
        again.push_back(job);
        continue;
      }
      Record result;
      result.Set("outcome", "crashed");
      result.Set("reason", "no result from Slurm after " +
                               std::to_string(submitted_[id]) + " submissions");
      store_.Write({job, result, ThisMachine()});
    }
    CollectRows();
    return again;
  }

  bool Pause(double seconds) const {
    constexpr double kSlice = 0.1;
    for (double waited = 0.0; waited < seconds; waited += kSlice) {
      if (callbacks_.interrupted()) return false;
      std::this_thread::sleep_for(std::chrono::duration<double>(kSlice));
    }
    return !callbacks_.interrupted();
  }

  bool Cancel() {
    std::set<std::string> arrays;
    for (const QueuedTask& task : ReadQueue(prefix_)) arrays.insert(task.array);
    CancelArrays(arrays);
    return false;
  }

  const WorkerSettings settings_;
  const SlurmOptions options_;
  const RowStore& store_;
  const ExecutorCallbacks& callbacks_;
  const std::string folder_, prefix_;
  std::map<std::string, Job> waiting_;    // jobs without a row
  std::map<std::string, int> submitted_;  // how often, by this program
  int num_submissions_ = 0;
  int max_array_size_ = 0;  // 0: not known yet
};

}  // namespace

bool RunOnSlurm(const std::vector<Job>& jobs, const WorkerSettings& settings,
                const SlurmOptions& options, const RowStore& store,
                const ExecutorCallbacks& callbacks) {
  if (jobs.empty()) return true;
  return SlurmCampaign(jobs, settings, options, store, callbacks).Run(jobs);
}

int RunSlurmTask(const std::string& program, const std::string& dir,
                 const std::string& tasks_path, int index, double timeout_s) {
  const std::vector<std::string> ids = ReadLines(tasks_path);
  if (index < 0 || index >= static_cast<int>(ids.size())) {
    throw SceneError(tasks_path + ": there is no line " + std::to_string(index + 1));
  }
  const RowStore store(dir);
  const Job job = ReadJob(dir, ids[index]);
  if (store.Find(job)) return 0;
  Worker worker(job, {program, fs::current_path().string(), timeout_s, kKilledDelay},
                store);
  while (!worker.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return 0;
}

}  // namespace dpe::experiments
