// What the jobs of a campaign gave, a file for each.
#ifndef DPE_TOOLS_EXPERIMENTS_ROW_STORE_H_
#define DPE_TOOLS_EXPERIMENTS_ROW_STORE_H_

#include <optional>
#include <string>

#include "experiments/experiment.h"

namespace dpe::experiments {

// A row file is written atomically: it is there as a whole or not at all, whenever the
// program, the machine or another node stops. It holds the job, too, so that a row is
// known to be of another job that had the same id.
struct StoredRow {
  Job job;
  Record result;   // what the job reported, and what the executor added
  Record machine;  // name, model, date: where and when; not part of the row

  // The job's keys and then the result's.
  Row row() const;
};

class RowStore {
 public:
  // @param dir  of the campaign; its folders for rows and logs are created
  explicit RowStore(const std::string& dir);

  // The row of this very job, all arguments being equal. What is in the file of a
  // different job, or is no row, counts as absent.
  std::optional<StoredRow> Find(const Job& job) const;

  // @throws SceneError if it cannot be written
  void Write(const StoredRow& row) const;

  // Nothing if there is none.
  void Remove(const Job& job) const;

  const std::string& dir() const { return dir_; }
  std::string LogPath(const std::string& id) const;

 private:
  std::string RowPath(const std::string& id) const;

  std::string dir_;
};

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_ROW_STORE_H_
