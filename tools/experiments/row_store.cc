#include "experiments/row_store.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "dpe/engine/scene.h"
#include "dpe/engine/scene_io.h"
#include "experiments/campaign.h"
#include "experiments/record_io.h"

namespace dpe::experiments {
namespace {

namespace fs = std::filesystem;

StoredRow FromRecords(const NamedRecords& records) {
  StoredRow row;
  for (const auto& [name, record] : records) {
    if (name == "job") row.job = record;
    if (name == "result") row.result = record;
    if (name == "machine") row.machine = record;
  }
  return row;
}

void CreateFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw SceneError(path + ": cannot be created: " + error.message());
}

}  // namespace

Row StoredRow::row() const {
  Row row = job;
  for (const auto& [key, value] : result.values()) row.Set(key, value);
  return row;
}

RowStore::RowStore(const std::string& dir) : dir_(dir) {
  CreateFolder(dir + "/rows");
  CreateFolder(dir + "/logs");
}

std::optional<StoredRow> RowStore::Find(const Job& job) const {
  std::ifstream file(RowPath(JobId(job)));
  if (!file) return std::nullopt;
  std::ostringstream text;
  text << file.rdbuf();
  StoredRow row;
  try {
    row = FromRecords(NamedRecordsFromJson(text.str(), RowPath(JobId(job))));
  } catch (const SceneError&) {
    return std::nullopt;
  }
  // As text, because not-a-number is not equal to itself.
  if (RecordToJson(row.job) != RecordToJson(job) || !row.result.Has("outcome")) {
    return std::nullopt;
  }
  return row;
}

void RowStore::Write(const StoredRow& row) const {
  WriteFileAtomically(
      RowPath(JobId(row.job)),
      NamedRecordsToJson(
          {{"job", row.job}, {"result", row.result}, {"machine", row.machine}}) +
          "\n");
}

void RowStore::Remove(const Job& job) const {
  std::error_code ignored;
  fs::remove(RowPath(JobId(job)), ignored);
}

std::string RowStore::RowPath(const std::string& id) const {
  return dir_ + "/rows/" + id + ".json";
}

std::string RowStore::LogPath(const std::string& id) const {
  return dir_ + "/logs/" + id + ".txt";
}

}  // namespace dpe::experiments
