// Runs campaigns of many independent jobs and makes tables and plots of what they give.
#include <gflags/gflags.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "experiments/campaign.h"
#include "experiments/campaign_run.h"
#include "experiments/executors/internal.h"
#include "support/flag_ranges.h"
#include "support/flag_values.h"
#include "support/interrupt.h"
#include "support/run_main.h"

DEFINE_string(output_dir, "",
              "Folder for rows and results; default results/NAME. A campaign that was "
              "interrupted goes on where it stopped.");
DEFINE_bool(list, false, "List the experiments and the kinds of jobs.");
DEFINE_string(executor, "local",
              "local: processes on this machine; slurm: a job array on a Slurm cluster "
              "that shares the output folder and this program with this machine.");
DEFINE_int32(
    retries, 2,
    "With slurm: how often jobs that ended without a row are submitted again.");
DEFINE_string(partition, "", "With slurm: the partition to submit to.");
DEFINE_string(slurm_options, "",
              "With slurm: more options for sbatch, separated by spaces: "
              "\"--time=1:00:00 --mem=2G\".");
DEFINE_double(poll_interval, 2.0,
              "With slurm: seconds between two looks at the queue.");
DEFINE_int32(
    jobs, 0,
    "Most jobs that run at once; 0: as many as there are processors, or as Slurm "
    "decides.");
DEFINE_double(job_timeout, 0.0, "Seconds after which a job is killed; 0: never.");
DEFINE_string(filter, "",
              "Run only the jobs whose id matches this regular expression (anywhere in "
              "it).");
DEFINE_bool(retry_failed, false,
            "Run the jobs again that failed, crashed or timed out before.");

namespace dpe::tools {
namespace {

using namespace dpe::experiments;

std::string campaign_name;

int PrintList() {
  std::cout << "Experiments:\n";
  for (const Experiment& e : Experiments()) {
    std::cout << "  " << e.name << ": " << e.summary << "\n";
  }
  std::cout << "Kinds of jobs:\n";
  for (const JobKind& kind : JobKinds()) {
    std::cout << "  " << kind.name << ": " << kind.summary << "\n";
  }
  return 0;
}

CampaignOptions OptionsFromFlags() {
  RequireAtLeast("jobs", FLAGS_jobs, 0);
  RequireAtLeast("job_timeout", FLAGS_job_timeout, 0.0);
  CampaignOptions options;
  options.name = campaign_name;
  options.output_dir = FLAGS_output_dir;
  options.executor = FLAGS_executor;
  options.num_at_once = FLAGS_jobs;
  options.timeout_s = FLAGS_job_timeout;
  options.filter = FLAGS_filter;
  options.retry_failed = FLAGS_retry_failed;
  RequireAtLeast("retries", FLAGS_retries, 0);
  RequireAtLeast("poll_interval", FLAGS_poll_interval, 0.1);
  options.slurm.max_retries = FLAGS_retries;
  options.slurm.partition = FLAGS_partition;
  for (const std::string& option : Split(FLAGS_slurm_options, ' ')) {
    if (!option.empty()) options.slurm.sbatch_options.push_back(option);
  }
  options.slurm.poll_interval_s = FLAGS_poll_interval;
  return options;
}

// One line that is written over again and again, on a terminal only.
class ProgressLine {
 public:
  void Show(const std::string& text) {
    if (!is_terminal_) return;
    std::cerr << "\r" << text
              << std::string(width_ - std::min(width_, text.size()), ' ') << std::flush;
    width_ = text.size();
  }
  void Clear() {
    if (!is_terminal_ || width_ == 0) return;
    std::cerr << "\r" << std::string(width_, ' ') << "\r" << std::flush;
    width_ = 0;
  }

 private:
  const bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  size_t width_ = 0;
};

int Main() {
  if (FLAGS_list) return PrintList();
  if (campaign_name.empty()) {
    throw SceneError(
        "what to run is missing: the name of an experiment (see --list) or a file of "
        "jobs, FILE.jsonl");
  }
  const CampaignOptions options = OptionsFromFlags();
  CatchInterrupts();
  ProgressLine line;
  CampaignCallbacks callbacks;
  callbacks.interrupted = WasInterrupted;
  callbacks.message = [&](const std::string& text) {
    line.Clear();
    std::cerr << "run_experiments: " << text << "\n";
  };
  callbacks.progress = [&](const std::string& text) { line.Show(text); };
  const CampaignOutcome outcome = RunCampaign(options, callbacks);
  line.Clear();
  std::cout << outcome.Text();
  return outcome.exit_code();
}

}  // namespace
}  // namespace dpe::tools

int main(int argc, char** argv) {
  if (dpe::experiments::IsInternalCommand(argc, argv)) {
    try {
      return dpe::experiments::RunInternalCommand(argv);
    } catch (const std::exception& error) {
      std::cerr << "run_experiments: error: " << error.what() << std::endl;
      return 1;
    }
  }
  const dpe::tools::Program program = {
      "run_experiments",
      "Runs a campaign of independent jobs, each in a process of its own, and writes "
      "tables and plots. Exit codes: 0 every job has a row (rows also say which jobs "
      "failed), 1 bad flags or input, 2 interrupted (run the same command again to go "
      "on), 3 no job could be done.",
      "NAME|FILE.jsonl [--output_dir DIR] [--jobs N] [--filter REGEX]", __FILE__,
      &dpe::tools::campaign_name};
  return dpe::tools::RunMain(argc, argv, program, dpe::tools::Main);
}
