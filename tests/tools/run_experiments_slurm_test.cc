// Campaigns on a real Slurm cluster of one machine.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <thread>

#include "tools/run_experiments_support.h"
#include "tools/slurm_cluster.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class SlurmExperimentsTest : public RunExperimentsTest {
 protected:
  void SetUp() override {
    const std::string obstacle = SlurmCluster::Obstacle();
    if (!obstacle.empty()) GTEST_SKIP() << obstacle;
    // Small, so that campaigns need several arrays.
    cluster_ = std::make_unique<SlurmCluster>(/*max_array_size=*/4);
  }

  ProgramResult RunSlurm(std::vector<std::string> flags = {},
                         const RunProgramOptions& options = {}) {
    flags.insert(flags.end(), {"--executor=slurm", "--poll_interval=0.5"});
    return Run(flags, options);
  }

  // Until a job has begun.
  void WaitForRun(const std::string& id) const {
    for (int i = 0; i < 600; ++i) {
      if (std::filesystem::exists(count_) && Runs().count(id) > 0) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    FAIL() << id << " does not begin";
  }

  std::unique_ptr<SlurmCluster> cluster_;
};

TEST_F(SlurmExperimentsTest, LongGivesTheSameTableAsTheLocalExecutor) {
  WriteDisasters();
  const ProgramResult slurm = RunSlurm({"--job_timeout=2"});
  EXPECT_EQ(slurm.exit_code, 0) << slurm.err;
  EXPECT_THAT(slurm.out, HasSubstr("2 crashed, 2 done, 2 failed, 1 timed_out"));
  const std::string table = TimelessTable();
  output_ = folder_.File("local");
  Run({"--job_timeout=2"});
  EXPECT_EQ(TimelessTable(), table);
  EXPECT_THAT(table, AllOf(HasSubstr("SIGSEGV"), HasSubstr("2.25")));
}

// The campaign dies, its arrays do not: what starts it again finds them.
TEST_F(SlurmExperimentsTest, LongKilledAndStartedAgainItLosesAndRepeatsNothing) {
  std::vector<std::string> jobs;
  for (int i = 0; i < 10; ++i) {
    jobs.push_back(CountedJob("job" + std::to_string(i), "\"sleep\":1"));
  }
  WriteJobs(jobs);
  std::thread first([&] {
    RunProgramOptions options;
    options.timeout = 6.0;  // then it is killed with SIGKILL
    EXPECT_EQ(RunSlurm({}, options).exit_code, -SIGKILL);
  });
  WaitForRun("job0");
  first.join();
  const ProgramResult again = RunSlurm();
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("10 done"));
  EXPECT_EQ(Runs().size(), 10u);
  for (const auto& [id, count] : Runs()) EXPECT_EQ(count, 1) << id;
  // Three arrays of at most four; nothing was submitted a second time.
  EXPECT_TRUE(std::filesystem::exists(output_ + "/slurm/tasks_2.txt"));
  EXPECT_FALSE(std::filesystem::exists(output_ + "/slurm/tasks_3.txt"));
}

TEST_F(SlurmExperimentsTest, LongTasksThatVanishAreSubmittedAgainAndThenARowSaysSo) {
  WriteJobs({CountedJob("vanishes", "\"sleep\":600"), CountedJob("stays", "")});
  std::thread killer([&] {
    for (int times = 1; times <= 2; ++times) {
      for (int i = 0; i < 1200; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        if (std::filesystem::exists(count_) && Runs()["vanishes"] == times) break;
      }
      // All that is in the queue, as a node that fails would take it along.
      cluster_->Ask({"scancel", "--user=root", "--signal=KILL", "--full"});
      cluster_->Ask({"scancel", "--user=root"});
    }
  });
  const ProgramResult result = RunSlurm({"--retries=1"});
  killer.join();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(TimelessTable(), HasSubstr("no result from Slurm after 2 submissions"));
  EXPECT_EQ(Runs(), (std::map<std::string, int>{{"stays", 1}, {"vanishes", 2}}));
}

// Killed alone, by the system for want of memory say, it is a row like any other.
TEST_F(SlurmExperimentsTest, LongAJobThatIsKilledWhileItsTaskLivesIsARow) {
  WriteJobs({CountedJob("a", "\"action\":\"kill\"")});
  RunSlurm();
  EXPECT_THAT(TimelessTable(), HasSubstr("crashed,\"SIGKILL (killed from outside"));
  EXPECT_EQ(Runs().at("a"), 1);
}

TEST_F(SlurmExperimentsTest, LongInterruptedItCancelsItsArrays) {
  WriteJobs({CountedJob("a", "\"sleep\":600"), CountedJob("b", "\"sleep\":600")});
  RunProgramOptions options;
  options.interrupt_after = 5.0;
  const ProgramResult result = RunSlurm({}, options);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, HasSubstr("Run the same command again"));
  std::string queue = "?";
  for (int i = 0; i < 100 && !queue.empty(); ++i) {
    queue = cluster_->Ask({"squeue", "--noheader"});
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_EQ(queue, "");
}

TEST_F(SlurmExperimentsTest, LongWhatSbatchRefusesIsAnError) {
  WriteJobs({CountedJob("a", "")});
  const ProgramResult result = RunSlurm({"--partition=nowhere"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("sbatch failed"), HasSubstr("partition")));
}

}  // namespace
}  // namespace dpe::test
