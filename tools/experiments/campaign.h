// A campaign: the jobs, and where its files are.
//
// DIR/jobs.jsonl        the jobs as they were last submitted
// DIR/rows/ID.json      what a job that ended gave (row_store.h)
// DIR/logs/ID.txt       what its process printed
// DIR/NAME.csv, report.md, NAME.svg   the results
#ifndef DPE_TOOLS_EXPERIMENTS_CAMPAIGN_H_
#define DPE_TOOLS_EXPERIMENTS_CAMPAIGN_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

struct Campaign {
  std::vector<Job> jobs;
  // Absolute. Jobs run in it, so paths in a campaign file start at the folder of that
  // file, and those of an experiment at where the program was started.
  std::string working_dir;
};

// What is known about jobs before any of them runs.
// @param where  "my.jsonl", for messages
// @throws SceneError naming the job and what is accepted: an id that is missing, there
//         twice or not fit for a file name, a kind that does not exist
void RequireValidJobs(const std::vector<Job>& jobs, const std::string& where);

// The campaign in a file of JSON lines.
// @throws SceneError if it cannot be read, is empty, or its jobs are not valid
Campaign LoadCampaign(const std::string& path);

// One of Experiments(), or null.
const Experiment* FindExperiment(const std::string& name);

// One of JobKinds(), or null.
const JobKind* FindJobKind(const std::string& name);

// "DIR/jobs.jsonl"
std::string JobsPath(const std::string& dir);
void WriteJobs(const std::string& dir, const std::vector<Job>& jobs);

std::string JobId(const Job& job);

// The job of this id in DIR/jobs.jsonl.
// @throws SceneError if there is none
Job ReadJob(const std::string& dir, const std::string& id);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_CAMPAIGN_H_
