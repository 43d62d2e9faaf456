// Runs run_experiments on campaigns of the kind "selftest" and reads its tables.
#ifndef DPE_TESTS_TOOLS_RUN_EXPERIMENTS_SUPPORT_H_
#define DPE_TESTS_TOOLS_RUN_EXPERIMENTS_SUPPORT_H_

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/output/tables.h"
#include "experiments/record_io.h"
#include "support/run_program.h"
#include "support/temp_dir.h"

namespace dpe::test {

class RunExperimentsTest : public ::testing::Test {
 protected:
  ProgramResult Run(std::vector<std::string> flags,
                    const RunProgramOptions& options = {}) {
    flags.insert(flags.begin(), {path_, "--output_dir=" + output_});
    return RunProgram("run_experiments", flags, options);
  }

  void WriteJobs(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    WriteFile(path_, text);
  }

  // A job that leaves a line in count_ whenever it is run.
  std::string CountedJob(const std::string& id, const std::string& more) const {
    return "{\"id\":\"" + id + "\",\"kind\":\"selftest\",\"count_file\":\"" + count_ +
           "\"" + (more.empty() ? "" : "," + more) + "}";
  }

  // One job for each thing that can become of one.
  void WriteDisasters() {
    WriteJobs({CountedJob("square", "\"value\":1.5"),
               CountedJob("throws", "\"action\":\"throw\""),
               CountedJob("segfault", "\"action\":\"segfault\""),
               CountedJob("forever", "\"action\":\"loop\""),
               CountedJob("no-result", "\"action\":\"exit\""),
               "{\"id\":\"typo\",\"kind\":\"selftest\",\"vlaue\":1}",
               CountedJob("last", "\"value\":3")});
  }

  // How often each job was run.
  std::map<std::string, int> Runs() const {
    std::map<std::string, int> runs;
    std::istringstream lines(ReadFile(count_));
    std::string id;
    while (std::getline(lines, id)) ++runs[id];
    return runs;
  }

  // The table without the columns that are measurements of the machine.
  std::string TimelessTable() const {
    using experiments::Record;
    std::vector<experiments::Row> rows;
    for (const Record& job : experiments::ReadRecords(output_ + "/jobs.jsonl")) {
      const std::string row = output_ + "/rows/" + job.Text("id", "") + ".json";
      for (const auto& [name, record] :
           experiments::NamedRecordsFromJson(ReadFile(row), row)) {
        if (name == "job") rows.push_back(record);
        if (name != "result") continue;
        for (const auto& [key, value] : record.values()) {
          if (!EndsWith(key, "_s") && !EndsWith(key, "_mib"))
            rows.back().Set(key, value);
        }
      }
    }
    return experiments::TableToCsv(experiments::TableOfRows("rows", rows));
  }

  static bool EndsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
  }

  const TempDir folder_;
  const std::string path_ = folder_.File("my campaign.jsonl");
  const std::string count_ = folder_.File("count.txt");
  std::string output_ = folder_.File("out");
};

}  // namespace dpe::test

#endif  // DPE_TESTS_TOOLS_RUN_EXPERIMENTS_SUPPORT_H_
