// Campaigns on this machine: what becomes of jobs, and of a campaign that is stopped.
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "tools/run_experiments_support.h"

namespace dpe::test {
namespace {

#ifdef __linux__
// How many processes have a text in their command line.
int CountProcesses(const std::string& text) {
  int count = 0;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    std::ifstream file(entry.path() / "cmdline");
    std::ostringstream command;
    if (file) command << file.rdbuf();
    count += command.str().find(text) != std::string::npos;
  }
  return count;
}
#endif

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(RunExperimentsTest, WhatBecomesOfAJobIsARow) {
  WriteDisasters();
  const ProgramResult result = Run({"--job_timeout=1", "--jobs=3"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");  // no progress outside a terminal
  EXPECT_THAT(result.out, HasSubstr("7 rows in"));
  EXPECT_THAT(result.out, HasSubstr("2 crashed, 2 done, 2 failed, 1 timed_out"));
  const std::string table = ReadFile(output_ + "/my campaign.csv");
  EXPECT_THAT(table, HasSubstr("2.25"));
  EXPECT_THAT(table, HasSubstr("failed,thrown as asked for"));
  EXPECT_THAT(table, HasSubstr("crashed,SIGSEGV (segmentation fault)"));
  EXPECT_THAT(table, HasSubstr("crashed,it ended with code 7 without a result"));
  EXPECT_THAT(table, HasSubstr("timed_out,killed after 1 s"));
  EXPECT_THAT(table, HasSubstr("vlaue: there is no such argument of selftest"));
  const std::string report = ReadFile(output_ + "/report.md");
  EXPECT_THAT(report, HasSubstr("jobs: 7, 2 crashed, 2 done, 2 failed, 1 timed_out"));
  EXPECT_THAT(report, HasSubstr("- forever: timed_out: killed after 1 s"));
  EXPECT_THAT(report, HasSubstr("- machine: "));
}

TEST_F(RunExperimentsTest, TablesDoNotDependOnHowManyJobsRunAtOnce) {
  WriteDisasters();
  Run({"--job_timeout=0.5", "--jobs=1"});
  const std::string one = TimelessTable();
  output_ = folder_.File("two");
  Run({"--job_timeout=0.5", "--jobs=2"});
  EXPECT_EQ(TimelessTable(), one);
  EXPECT_THAT(one, HasSubstr("timed_out"));
}

TEST_F(RunExperimentsTest, ARestartRunsOnlyWhatHasNoRow) {
  WriteDisasters();
  Run({"--job_timeout=0.5", "--filter=square|throws"});
  EXPECT_EQ(Runs(), (std::map<std::string, int>{{"square", 1}, {"throws", 1}}));
  Run({"--job_timeout=0.5"});
  const ProgramResult again = Run({"--job_timeout=0.5"});
  EXPECT_THAT(again.out, HasSubstr("7 were there before"));
  for (const auto& [id, count] : Runs()) EXPECT_EQ(count, 1) << id;
  EXPECT_EQ(Runs().size(), 6u);
}

TEST_F(RunExperimentsTest, AJobThatChangedIsRunAgain) {
  WriteJobs({CountedJob("a", "\"value\":1"), CountedJob("b", "\"value\":2")});
  Run({});
  WriteJobs({CountedJob("a", "\"value\":1"), CountedJob("b", "\"value\":5")});
  Run({});
  EXPECT_EQ(Runs(), (std::map<std::string, int>{{"a", 1}, {"b", 2}}));
  EXPECT_THAT(TimelessTable(), AllOf(HasSubstr("25"), Not(HasSubstr("4.0"))));
}

TEST_F(RunExperimentsTest, JobsThatFailedAreRunAgainOnRequest) {
  WriteJobs({CountedJob("a", ""), CountedJob("b", "\"action\":\"throw\"")});
  Run({});
  Run({"--retry_failed"});
  EXPECT_EQ(Runs(), (std::map<std::string, int>{{"a", 1}, {"b", 2}}));
}

// Jobs of a tenth of a second, killed at moments that have nothing to do with them.
TEST_F(RunExperimentsTest, KilledAndStartedAgainItLosesAndRepeatsNothing) {
  std::vector<std::string> jobs;
  for (int i = 0; i < 24; ++i) {
    jobs.push_back(CountedJob("job" + std::to_string(i),
                              "\"sleep\":0.1,\"value\":" + std::to_string(i)));
  }
  WriteJobs(jobs);
  int kills = 0, finished_before_kill = 0;
  for (const double moment : {0.25, 0.41, 0.37}) {
    RunProgramOptions options;
    options.timeout = moment;  // then it is killed with SIGKILL
    kills += Run({"--jobs=2"}, options).exit_code == -SIGKILL;
  }
  // What was running is gone with it: it would write its line late.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto before = Runs();
  std::vector<std::string> had_row;
  for (const auto& [id, count] : before) {
    if (std::filesystem::exists(output_ + "/rows/" + id + ".json")) {
      had_row.push_back(id);
      ++finished_before_kill;
    }
  }
  EXPECT_EQ(kills, 3);
  EXPECT_GT(finished_before_kill, 0);
  EXPECT_LT(finished_before_kill, 24);
  const ProgramResult result = Run({"--jobs=2"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("24 done"));
  const auto after = Runs();
  EXPECT_EQ(after.size(), 24u);
  for (const std::string& id : had_row) EXPECT_EQ(after.at(id), before.at(id)) << id;
  // A job that was under way when the campaign was killed began again, at most once per
  // kill.
  for (const auto& [id, count] : after) EXPECT_LE(count, 1 + kills) << id;
}

#ifdef __linux__
// Or else a campaign that was killed would go on in the background, and run beside the
// one that is started to replace it.
TEST_F(RunExperimentsTest, JobsDieWithTheCampaignThatIsKilled) {
  WriteJobs({CountedJob("a", "\"sleep\":300"), CountedJob("b", "\"action\":\"loop\"")});
  std::thread run([&] {
    RunProgramOptions options;
    options.timeout = 3.0;
    EXPECT_EQ(Run({"--jobs=2"}, options).exit_code, -SIGKILL);
  });
  int most = 0;
  for (int i = 0; i < 25; ++i) {
    most = std::max(most, CountProcesses(output_ + "/rows/"));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  run.join();
  EXPECT_EQ(most, 2);
  for (int i = 0; i < 50 && CountProcesses(output_ + "/rows/") > 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_EQ(CountProcesses(output_ + "/rows/"), 0);
}
#endif

TEST_F(RunExperimentsTest, InterruptedItSaysHowToGoOn) {
  WriteJobs({CountedJob("a", ""), CountedJob("b", "\"sleep\":30")});
  RunProgramOptions options;
  options.interrupt_after = 0.7;
  const ProgramResult result = Run({"--jobs=1"}, options);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_LT(result.seconds, 20.0);
  EXPECT_THAT(result.out, HasSubstr("Run the same command again"));
  EXPECT_THAT(result.out, HasSubstr("1 rows in"));
  WriteJobs({CountedJob("a", ""), CountedJob("b", "\"sleep\":0.01")});
  EXPECT_EQ(Run({}).exit_code, 0);
  EXPECT_EQ(Runs(), (std::map<std::string, int>{{"a", 1}, {"b", 2}}));
}

TEST_F(RunExperimentsTest, TwoAtOnceInOneFolderAreRefused) {
  WriteJobs({CountedJob("a", "\"sleep\":3")});
  std::thread first([&] { EXPECT_EQ(Run({}).exit_code, 0); });
  for (int i = 0; i < 100 && !std::filesystem::exists(count_); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const ProgramResult second = Run({});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, AllOf(HasSubstr(output_), HasSubstr("another")));
  first.join();
  EXPECT_EQ(Runs().at("a"), 1);
}

TEST_F(RunExperimentsTest, PathsOfACampaignFileStartAtItsFolder) {
  WriteJobs({"{\"id\":\"a\",\"kind\":\"selftest\",\"count_file\":\"here.txt\"}"});
  EXPECT_EQ(Run({}).exit_code, 0);
  EXPECT_EQ(ReadFile(folder_.File("here.txt")), "a\n");
}

TEST_F(RunExperimentsTest, WithoutSlurmTheSlurmExecutorSaysSo) {
  WriteJobs({CountedJob("a", "")});
  const std::string path = getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const ProgramResult result = Run({"--executor=slurm"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("squeue was not found"), HasSubstr("--executor local")));
  EXPECT_FALSE(std::filesystem::exists(count_));
}

TEST_F(RunExperimentsTest, WithoutAnyJobDoneItIsANumericalFailure) {
  WriteJobs({CountedJob("a", "\"action\":\"throw\"")});
  EXPECT_EQ(Run({}).exit_code, 3);
}

TEST_F(RunExperimentsTest, BadCampaignsAreRefusedNamingFileLineAndWhatIsAccepted) {
  const std::string good = CountedJob("a", "");
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"{\"id\":\"b\"", ".jsonl:2: not JSON"},
      {"[1]", ".jsonl:2: [1] is not accepted"},
      {"{\"id\":\"b\",\"id\":\"c\",\"kind\":\"selftest\"}", "\"id\" is there twice"},
      {"{\"id\":\"b\",\"kind\":\"selftest\",\"value\":[1]}", ".jsonl:2, value: [1]"},
      {"{\"id\":\"b\",\"kind\":\"selftest\",\"value\":1e999}", ".jsonl:2"},
      {"{\"id\":\"a/b\",\"kind\":\"selftest\"}", "job 2, id: \"a/b\""},
      {"{\"kind\":\"selftest\"}", "job 2, id: \"\""},
      {"{\"id\":\"b\",\"kind\":\"slftest\"}", "kind: \"slftest\""},
      {good, "id: \"a\" is there twice"}};
  for (const auto& [line, message] : wrong) {
    WriteJobs({good, line});
    const ProgramResult result = Run({});
    EXPECT_EQ(result.exit_code, 1) << line;
    EXPECT_THAT(result.err, HasSubstr(message)) << line;
  }
  WriteJobs({"", " "});
  EXPECT_THAT(Run({}).err, HasSubstr("there is no job in it"));
}

TEST_F(RunExperimentsTest, BadFlagsAreRefused) {
  WriteJobs({CountedJob("a", "")});
  EXPECT_THAT(Run({"--executor=cloud"}).err, HasSubstr("expected local or slurm"));
  EXPECT_THAT(Run({"--filter=("}).err, HasSubstr("not a regular expression"));
  EXPECT_THAT(Run({"--filter=zzz"}).err, HasSubstr("none of the 1 ids"));
  EXPECT_THAT(Run({"--jobs=-1"}).err, HasSubstr("--jobs: -1"));
  const ProgramResult unknown = RunProgram("run_experiments", {"experiment7"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("experiment7"), HasSubstr("experiment1")));
  EXPECT_EQ(RunProgram("run_experiments", {}).exit_code, 1);
  EXPECT_THAT(RunProgram("run_experiments", {"a", "b"}).err, HasSubstr("\"b\""));
  const ProgramResult help = RunProgram("run_experiments", {"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("--executor"), HasSubstr("FILE.jsonl")));
  EXPECT_THAT(
      RunProgram("run_experiments", {"--list"}).out,
      AllOf(HasSubstr("experiment2"), HasSubstr("selftest"), HasSubstr("estimate")));
}

}  // namespace
}  // namespace dpe::test
