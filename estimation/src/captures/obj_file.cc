#include "captures/obj_file.h"

#include <string_view>

#include "captures/text.h"

namespace dpe {
namespace {

class ObjParser {
 public:
  ObjParser(const std::string& path, const std::string& content) : lines_(content) {
    file_.path = path;
  }

  ObjFile Parse() {
    std::string_view line;
    while (lines_.Next(&line)) {
      SplitWords(line, &words_);
      if (words_.empty()) continue;
      if (words_[0] == "v") ReadNumbers("xyz", &file_.positions);
      if (words_[0] == "v") file_.lines.push_back(lines_.number());
      if (words_[0] == "vt") ReadNumbers("uv", &file_.textures);
      if (words_[0] == "f") ReadFace();
    }
    CheckCorners();
    return std::move(file_);
  }

 private:
  [[noreturn]] void Fail(int line, const std::string& what) const {
    FailAtLine(file_.path, line, what);
  }

  // @param names  one letter for each number: "xyz"
  void ReadNumbers(const std::string& names, std::vector<double>* numbers) {
    const int line = lines_.number();
    if (words_.size() < names.size() + 1) {
      Fail(line, "has " + std::to_string(words_.size() - 1) +
                     " numbers; accepted are at least " + std::to_string(names.size()) +
                     " after " + std::string(words_[0]));
    }
    for (size_t i = 0; i < names.size(); ++i) {
      numbers->push_back(ParseFinite(words_[i + 1], std::string(1, names[i]),
                                     "a finite number", file_.path, line));
    }
  }

  // 7, 7/2, 7//5, 7/2/5; negative: counted back from the last one read so far.
  int ReadReference(std::string_view text, size_t num_so_far,
                    std::string_view corner) const {
    int value = 0;
    const bool is_number = ParseNumber(text, &value);
    const int index = value > 0 ? value - 1 : static_cast<int>(num_so_far) + value;
    if (!is_number || value == 0 || index < 0) {
      Fail(lines_.number(),
           "a corner is '" + Excerpt(corner) +
               "'; accepted are numbers of vertices like 7, 7/2 or 7/2/5, from 1, or "
               "negative ones, down to minus the number of vertices so far");
    }
    return index;
  }

  void ReadFace() {
    if (words_.size() < 4) {
      Fail(lines_.number(), "has " + std::to_string(words_.size() - 1) +
                                " corners; accepted are faces of three or more");
    }
    file_.faces.push_back({lines_.number(), static_cast<int>(file_.vertices.size()),
                           static_cast<int>(words_.size()) - 1});
    for (size_t i = 1; i < words_.size(); ++i) {
      SplitFields(words_[i], '/', &parts_);
      file_.vertices.push_back(ReadReference(parts_[0], file_.lines.size(), words_[i]));
      const bool has_texture = parts_.size() > 1 && !parts_[1].empty();
      file_.texture_of.push_back(
          has_texture ? ReadReference(parts_[1], file_.textures.size() / 2, words_[i])
                      : -1);
    }
  }

  // Faces may stand before the vertices that they name.
  void CheckCorners() const {
    const int num_textures = static_cast<int>(file_.textures.size() / 2);
    for (const ObjFace& face : file_.faces) {
      for (int i = face.begin; i < face.begin + face.size; ++i) {
        const int vertex = file_.vertices[i], texture = file_.texture_of[i];
        if (vertex < 0 || vertex >= file_.num_vertices()) {
          Fail(face.line, "names vertex " + std::to_string(vertex + 1) +
                              "; accepted are 1 to " +
                              std::to_string(file_.num_vertices()));
        }
        if (texture < -1 || texture >= num_textures) {
          Fail(face.line, "names texture coordinate " + std::to_string(texture + 1) +
                              "; accepted are 1 to " + std::to_string(num_textures));
        }
      }
    }
  }

  LineReader lines_;
  ObjFile file_;
  std::vector<std::string_view> words_, parts_;
};

}  // namespace

ObjFile ParseObjFile(const std::string& path, const std::string& content) {
  return ObjParser(path, content).Parse();
}

}  // namespace dpe
