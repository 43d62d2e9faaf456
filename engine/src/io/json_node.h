// Typed reading of a JSON document with errors that name file, path and value.
#ifndef DPE_ENGINE_SRC_IO_JSON_NODE_H_
#define DPE_ENGINE_SRC_IO_JSON_NODE_H_

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "io/json_io.h"

namespace dpe {

// What all nodes of a document share.
struct JsonContext {
  std::string file;
  std::vector<std::string>* warnings = nullptr;  // may be null
  int num_warnings = 0;
};

// A value in a document and its path, like objects[0].vertMass. The document and the
// context must outlive it. The As... functions throw SceneError if the value is not
// of their type, out of range, or a number is not finite.
class JsonNode {
 public:
  JsonNode(const Json& value, const std::string& path, JsonContext* context)
      : value_(&value), path_(path), context_(context) {}

  // The member of an object. @throws SceneError if this is not an object.
  std::optional<JsonNode> Find(const std::string& key) const;

  // As Find; a missing member is an error. @param accepted  "the positions of ..."
  JsonNode Require(const std::string& key, const std::string& accepted) const;

  // The elements of an array. @throws SceneError if this is not an array.
  std::vector<JsonNode> Elements() const;

  double AsNumber() const;
  int AsInt(int lowest) const;  // a whole number from `lowest` to INT_MAX
  bool AsBool() const;
  std::string AsString() const;
  Eigen::Vector3d AsVector() const;  // {"x": 1, "y": 2, "z": 3}

  Eigen::VectorXd AsNumbers() const;
  std::vector<int> AsInts(int lowest) const;
  std::vector<char> AsBools() const;
  Eigen::Matrix3Xd AsVectors() const;

  bool IsString() const { return value_->is_string(); }
  size_t size() const { return value_->size(); }
  const std::string& path() const { return path_; }
  const JsonContext& context() const { return *context_; }
  // The value for messages, shortened.
  std::string ValueText() const;

  // Warns of each member whose key is not among `known`.
  void WarnOfUnknownKeys(std::initializer_list<const char*> known) const;

  [[noreturn]] void Fail(const std::string& accepted) const;

 private:
  JsonNode Member(const Json& value, const std::string& key) const;
  JsonNode Element(size_t index) const;
  const Json::array_t& Array(const std::string& accepted) const;
  template <typename Convert>
  void MapElements(const std::string& accepted, Convert convert) const;

  const Json* value_;
  std::string path_;
  JsonContext* context_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_SRC_IO_JSON_NODE_H_
