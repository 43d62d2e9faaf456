// A campaign from its name to its results: what run_experiments does, without flags.
#ifndef DPE_TOOLS_EXPERIMENTS_CAMPAIGN_RUN_H_
#define DPE_TOOLS_EXPERIMENTS_CAMPAIGN_RUN_H_

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/executors/slurm.h"

namespace dpe::experiments {

struct CampaignOptions {
  std::string name;                // of an experiment, or a file of jobs
  std::string output_dir;          // empty: results/NAME
  std::string executor = "local";  // or "slurm"
  int num_at_once = 0;     // 0: as many as there are processors; or as Slurm decides
  double timeout_s = 0.0;  // of a job; 0: none
  std::string filter;      // regular expression of ids; empty: all
  bool retry_failed = false;
  SlurmOptions slurm;  // max_running is num_at_once
};

struct CampaignCallbacks {
  std::function<bool()> interrupted;
  std::function<void(const std::string&)> message;   // what a user must see
  std::function<void(const std::string&)> progress;  // one line, over and over
};

struct CampaignOutcome {
  bool interrupted = false;
  int num_jobs = 0;                     // that were to run, with those that had a row
  int num_found = 0;                    // had a row before
  std::map<std::string, int> outcomes;  // of all rows
  std::string output_dir;
  std::vector<std::string> files;  // written

  std::string Text() const;  // for the user
  int exit_code() const;     // of the program
};

// Runs what has no row yet and writes the results of all rows.
// @throws SceneError for bad input, and where a folder or process cannot be made
CampaignOutcome RunCampaign(const CampaignOptions& options,
                            const CampaignCallbacks& callbacks);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_CAMPAIGN_RUN_H_
