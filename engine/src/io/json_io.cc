#include "io/json_io.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "dpe/engine/scene.h"

namespace dpe {
namespace {

std::string LineAndColumn(const std::string& text, size_t position) {
  const std::string_view read(text.data(), std::min(position, text.size()));
  const auto line = 1 + std::count(read.begin(), read.end(), '\n');
  const size_t line_begin = read.rfind('\n') + 1;  // 0 in the first line
  return "line " + std::to_string(line) + ", column " +
         std::to_string(read.size() - line_begin);
}

// Builds the document and knows at every moment which JSON path is being read: the
// library's own builder does not tell, and takes the last of two equal keys silently.
class DocumentBuilder : public nlohmann::json_sax<Json> {
 public:
  DocumentBuilder(const std::string& text, const std::string& name)
      : text_(text), name_(name) {}

  Json TakeDocument() { return std::move(document_); }

  bool null() override { return Add(nullptr); }
  bool boolean(bool value) override { return Add(value); }
  bool number_integer(number_integer_t value) override { return Add(value); }
  bool number_unsigned(number_unsigned_t value) override { return Add(value); }
  bool number_float(number_float_t value, const string_t&) override {
    return Add(value);
  }
  bool string(string_t& value) override { return Add(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // does not occur in text

  bool start_object(std::size_t) override { return Open(Json::object()); }
  bool start_array(std::size_t) override { return Open(Json::array()); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }

  bool key(string_t& key) override {
    levels_.back().key = key;
    if (levels_.back().container->contains(key)) {
      throw SceneError(name_ + ": " + Path() +
                       " is given twice; expected each key once");
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    const std::string path = Path();
    throw SceneError(name_ + ": " + (path.empty() ? "" : path + ": ") +
                     Message(error.what(), position));
  }

 private:
  struct Level {
    Json* container = nullptr;
    std::string key;  // of the member that is being read, in an object
  };

  // Scenes need 6 levels; deeper text is not a scene, and freeing it is recursive.
  static constexpr size_t kMaxDepth = 64;

  Json* Place(Json value) {
    if (levels_.empty()) return &(document_ = std::move(value));
    Level& level = levels_.back();
    if (level.container->is_object()) {
      return &((*level.container)[level.key] = std::move(value));
    }
    level.container->push_back(std::move(value));
    return &level.container->back();
  }

  bool Add(Json value) {
    Place(std::move(value));
    return true;
  }

  bool Open(Json container) {
    if (levels_.size() >= kMaxDepth) {
      throw SceneError(name_ + ": " + Path().substr(0, 100) +
                       ": brackets are nested too deep; expected at most " +
                       std::to_string(kMaxDepth) + " levels");
    }
    // Only the innermost array grows, so the addresses of the outer ones are stable.
    Json* place = Place(std::move(container));
    levels_.push_back({place, ""});
    return true;
  }

  bool Close() {
    levels_.pop_back();
    return true;
  }

  std::string Path() const {
    std::string path;
    for (const Level& level : levels_) {
      if (level.container->is_object()) {
        if (level.key.empty()) continue;
        path += (path.empty() ? "" : ".") + level.key;
      } else {
        // An element that is open itself has been appended already.
        const bool is_innermost = &level == &levels_.back();
        path += '[' + std::to_string(level.container->size() - (is_innermost ? 0 : 1)) +
                ']';
      }
    }
    return path;
  }

  // The library's explanation without its bracketed identifier; line and column are
  // added where it has none.
  std::string Message(std::string message, std::size_t position) const {
    const size_t identifier_end = message.find("] ");
    if (identifier_end != std::string::npos) message.erase(0, identifier_end + 2);
    for (const char* prefix : {"parse error at ", "parse error: "}) {
      if (message.rfind(prefix, 0) == 0) message.erase(0, std::string(prefix).size());
    }
    if (message.rfind("line ", 0) == 0) {
      message = "not JSON: " + message;
    } else {
      message = LineAndColumn(text_, position) + ": " + message +
                "; expected a finite number";
    }
    constexpr size_t kMaxLength = 300;  // an unclosed string runs to the file's end
    for (char& c : message) {
      if (static_cast<signed char>(c) < ' ') c = '?';  // a binary file's bytes
    }
    if (message.size() > kMaxLength) message = message.substr(0, kMaxLength) + " ...";
    return message;
  }

  const std::string& text_;
  const std::string& name_;
  Json document_;
  std::vector<Level> levels_;
};

}  // namespace

Json ParseJsonDocument(const std::string& text, const std::string& name) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw SceneError(name + ": the file is empty; expected a scene in JSON");
  }
  DocumentBuilder builder(text, name);
  Json::sax_parse(text, &builder, nlohmann::detail::input_format_t::json,
                  /*strict=*/true, /*ignore_comments=*/true);
  return builder.TakeDocument();
}

}  // namespace dpe
