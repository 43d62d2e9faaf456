#include <glob.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"

namespace dpe {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> ObjFilesOf(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::string extension = entry.path().extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(c));
    if (extension == ".obj") paths.push_back(entry.path().string());
  }
  if (error) throw SceneError(folder + ": cannot be read: " + error.message());
  return paths;
}

std::vector<std::string> Matches(const std::string& pattern) {
  std::vector<std::string> paths;
  glob_t found = {};
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0) {
    for (size_t i = 0; i < found.gl_pathc; ++i) paths.emplace_back(found.gl_pathv[i]);
  }
  globfree(&found);
  return paths;
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// "cloth_0012.obj" -> texts {"cloth_", ".obj"}, numbers {"0012"}.
struct NameParts {
  std::vector<std::string> texts = {""};
  std::vector<std::string> numbers;
};

NameParts PartsOf(const std::string& name) {
  NameParts parts;
  for (size_t i = 0; i < name.size(); ++i) {
    if (!IsDigit(name[i])) {
      parts.texts.back() += name[i];
      continue;
    }
    if (i == 0 || !IsDigit(name[i - 1])) {
      parts.numbers.emplace_back();
      parts.texts.emplace_back();
    }
    parts.numbers.back() += name[i];
  }
  return parts;
}

[[noreturn]] void FailNames(const std::string& pattern, const std::string& a,
                            const std::string& b) {
  throw SceneError(pattern + ": matches " + a + " and " + b +
                   "; accepted are files whose names differ in one number, that of "
                   "the frame");
}

// Index of the one number in which `parts` differ; the last one if there is one file.
size_t VaryingNumber(const std::string& pattern, const std::vector<std::string>& paths,
                     const std::vector<NameParts>& parts) {
  const NameParts& first = parts[0];
  size_t varying = first.numbers.size();
  for (size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].texts != first.texts) FailNames(pattern, paths[0], paths[i]);
    for (size_t n = 0; n < first.numbers.size(); ++n) {
      if (parts[i].numbers[n] == first.numbers[n]) continue;
      if (varying < first.numbers.size() && varying != n) {
        FailNames(pattern, paths[0], paths[i]);
      }
      varying = n;
    }
  }
  return parts.size() == 1 && varying > 0 ? varying - 1 : varying;
}

}  // namespace

bool IsSequenceName(const std::string& path) {
  std::error_code ignored;
  return path.find_first_of("*?") != std::string::npos ||
         fs::is_directory(path, ignored);
}

std::vector<SequenceFile> FindSequence(const std::string& pattern) {
  std::error_code ignored;
  const bool is_folder = fs::is_directory(pattern, ignored);
  const std::vector<std::string> paths =
      is_folder ? ObjFilesOf(pattern) : Matches(pattern);
  if (paths.empty()) {
    throw SceneError(pattern +
                     (is_folder ? ": has no files that end in .obj"
                                : ": there is no file that matches") +
                     "; accepted is a folder or pattern of OBJ files");
  }
  std::vector<NameParts> parts;
  for (const std::string& path : paths) parts.push_back(PartsOf(path));
  const size_t varying = VaryingNumber(pattern, paths, parts);
  std::vector<SequenceFile> files;
  for (size_t i = 0; i < paths.size(); ++i) {
    SequenceFile file{paths[i], 0};
    if (varying < parts[i].numbers.size()) {
      const std::string& number = parts[i].numbers[varying];
      if (!ParseNumber(std::string_view(number), &file.number) ||
          file.number >= kMaxFrame) {
        throw SceneError(paths[i] + ": the number of the frame is '" + number +
                         "'; accepted are 0 to " + std::to_string(kMaxFrame - 1));
      }
    }
    files.push_back(file);
  }
  std::sort(
      files.begin(), files.end(),
      [](const SequenceFile& a, const SequenceFile& b) { return a.number < b.number; });
  for (size_t i = 1; i < files.size(); ++i) {
    // 1.obj and 01.obj.
    if (files[i].number == files[i - 1].number) {
      throw SceneError(files[i - 1].path + " and " + files[i].path +
                       " are both frame " + std::to_string(files[i].number));
    }
  }
  return files;
}

}  // namespace dpe
