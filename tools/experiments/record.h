// A flat list of named values: what a job is told, and what it reports.
#ifndef DPE_TOOLS_EXPERIMENTS_RECORD_H_
#define DPE_TOOLS_EXPERIMENTS_RECORD_H_

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dpe::experiments {

// Keys keep the order in which they were first set. As JSON it is one object on one
// line (record_io.h).
class Record {
 public:
  // Not-a-number and infinities are written as null, and null is read as not-a-number.
  using Value = std::variant<bool, std::int64_t, double, std::string>;

  // Replaces the value of a key that is there already.
  void Set(const std::string& key, Value value);
  // Numbers and truth values convert to each other more readily than to a Value: each
  // type has its own way in, or a double would be stored as a whole number.
  void Set(const std::string& key, const char* value) {
    Set(key, Value(std::string(value)));
  }
  void Set(const std::string& key, bool value) { Set(key, Value(value)); }
  void Set(const std::string& key, double value) { Set(key, Value(value)); }
  void Set(const std::string& key, std::int64_t value) { Set(key, Value(value)); }
  void Set(const std::string& key, int value) { Set(key, std::int64_t{value}); }

  bool Has(const std::string& key) const;
  // Null if there is no such key.
  const Value* Find(const std::string& key) const;

  // The value of a key as a number, a whole number or text; `missing` if it is absent.
  // @throws SceneError naming key, value and what is accepted, if it is of another type
  double Number(const std::string& key, double missing) const;
  int Integer(const std::string& key, int missing) const;
  std::string Text(const std::string& key, const std::string& missing) const;
  bool Flag(const std::string& key, bool missing) const;

  const std::vector<std::pair<std::string, Value>>& values() const { return values_; }

 private:
  std::vector<std::pair<std::string, Value>> values_;
};

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_RECORD_H_
