// NumPy arrays (.npy): bytes \x93NUMPY, version (2 bytes), length of the header (2
// bytes in version 1, 4 in 2 and 3, little-endian), the header, a Python dictionary as
// text,
//
//   {'descr': '<f8', 'fortran_order': False, 'shape': (100, 144, 3), }
//
// and the numbers.
#include <cmath>
#include <string_view>

#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"

namespace dpe {
namespace {

class NpyHeader {
 public:
  NpyHeader(const std::string& path, const std::string& content)
      : path_(path), content_(content) {}

  DenseBlock Read() {
    const int major = Byte(6);
    if (major < 1 || major > 3) {
      FailAtByte(path_, 6,
                 "the version is " + std::to_string(major) + "; accepted are 1 to 3");
    }
    begin_ = major == 1 ? 10 : 12;
    long length = 0;
    for (long i = begin_ - 1; i >= 8; --i) length = length << 8 | Byte(i);
    if (begin_ + length > static_cast<long>(content_.size())) {
      FailAtByte(path_, static_cast<long>(content_.size()),
                 "is the end of the file, within the header");
    }
    header_ = std::string_view(content_).substr(begin_, length);
    DenseBlock block;
    block.path = path_;
    block.offset = begin_ + length;
    ReadType(&block);
    ReadOrder(&block);
    ReadShape(&block);
    return block;
  }

 private:
  int Byte(long index) const {
    if (index >= static_cast<long>(content_.size())) {
      FailAtByte(path_, static_cast<long>(content_.size()),
                 "is the end of the file, within the header");
    }
    return static_cast<unsigned char>(content_[index]);
  }

  [[noreturn]] void Fail(const std::string& what) const {
    FailAtByte(path_, begin_,
               what + " (header '" + std::string(Trim(header_.substr(0, 200))) + "')");
  }

  // What follows 'key': in the dictionary.
  std::string_view Value(const std::string& key) const {
    for (const char quote : {'\'', '"'}) {
      const std::string name = quote + key + quote;
      const size_t found = header_.find(name);
      if (found == std::string_view::npos) continue;
      const std::string_view rest = header_.substr(found + name.size());
      const size_t colon = rest.find_first_not_of(' ');
      if (colon == std::string_view::npos || rest[colon] != ':') continue;
      return Trim(rest.substr(colon + 1));
    }
    Fail("has no '" + key + "'");
  }

  void ReadType(DenseBlock* block) const {
    const std::string_view value = Value("descr");
    const std::string type(
        value.size() < 2 ? value : value.substr(1, value.find(value[0], 1) - 1));
    if (type != "<f4" && type != "<f8" && type != ">f4" && type != ">f8") {
      Fail("the type is '" + type +
           "'; accepted are <f4, <f8, >f4 and >f8, which are "
           "float32 and float64");
    }
    block->bytes = type[2] - '0';
    block->big_endian = type[0] == '>';
  }

  void ReadOrder(DenseBlock* block) const {
    const std::string_view value = Value("fortran_order");
    block->fortran_order = value.substr(0, 4) == "True";
    if (!block->fortran_order && value.substr(0, 5) != "False") {
      Fail("fortran_order is '" + Excerpt(value) + "'; accepted are True and False");
    }
  }

  void ReadShape(DenseBlock* block) const {
    const std::string_view value = Value("shape");
    const size_t end = value.find(')');
    const std::string shape(value.substr(0, end == value.npos ? end : end + 1));
    std::vector<std::string_view> parts;
    if (shape.size() > 2) {
      SplitFields(std::string_view(shape).substr(1, shape.size() - 2), ',', &parts);
    }
    long sizes[3] = {0, 0, 0};
    bool ok = parts.size() == 3;
    for (size_t i = 0; ok && i < 3; ++i) {
      ok = ParseNumber(parts[i], &sizes[i]) && sizes[i] > 0 && sizes[i] < kMaxFrame;
    }
    if (!ok || sizes[2] != 3) {
      Fail("the shape is " + shape + "; accepted is (frames, vertices, 3)");
    }
    block->num_frames = sizes[0];
    block->num_vertices = sizes[1];
  }

  const std::string& path_;
  const std::string& content_;
  long begin_ = 0;
  std::string_view header_;
};

}  // namespace

Capture ReadNpyCapture(const std::string& path, const std::string& content,
                       const CaptureOptions& options) {
  const DenseBlock block = NpyHeader(path, content).Read();
  const double expected = static_cast<double>(block.offset) +
                          3.0 * block.bytes * static_cast<double>(block.num_frames) *
                              static_cast<double>(block.num_vertices);
  if (expected != static_cast<double>(content.size())) {
    FailAtByte(path, static_cast<long>(content.size()),
               "is the end of the file; accepted is an end at byte " +
                   std::to_string(static_cast<long>(expected)) + ", after " +
                   std::to_string(block.num_frames) + " frames of " +
                   std::to_string(block.num_vertices) + " vertices");
  }
  Capture capture;
  capture.path = path;
  capture.format = "NPY";
  capture.num_vertices = static_cast<int>(block.num_vertices);
  AppendDenseSamples(block, content, 1.0, options.nan_is_missing, &capture);
  return capture;
}

}  // namespace dpe
