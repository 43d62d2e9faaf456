// Records as JSON: one flat object on one line.
#ifndef DPE_TOOLS_EXPERIMENTS_RECORD_IO_H_
#define DPE_TOOLS_EXPERIMENTS_RECORD_IO_H_

#include <string>
#include <vector>

#include "experiments/record.h"

namespace dpe::experiments {

// Numbers are written with as many digits as reading them back needs; whole ones of
// type double keep their ".0". What is not finite is null, and bytes that are not UTF-8
// are replaced.
std::string RecordToJson(const Record& record);

// @param where  "jobs.jsonl:3", for messages
// @throws SceneError naming where, key, value and what is accepted: what is not one
//         object of truth values, numbers and texts, a key that is there twice, a
//         number that no double or 64-bit integer holds
Record RecordFromJson(const std::string& text, const std::string& where);

// One record per line; lines of white space are left out.
// @throws SceneError as above, the place being PATH:LINE, and if the file cannot be
//         read
std::vector<Record> ReadRecords(const std::string& path);

// Several named records in one object: {"job": {...}, "result": {...}}.
using NamedRecords = std::vector<std::pair<std::string, Record>>;
std::string NamedRecordsToJson(const NamedRecords& records);
// @throws SceneError as RecordFromJson
NamedRecords NamedRecordsFromJson(const std::string& text, const std::string& where);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_RECORD_IO_H_
