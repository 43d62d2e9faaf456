#include "app/video.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#ifdef _WIN32
#define popen _popen
#define pclose _pclose
#endif

namespace dpe::viewer {
namespace {

#ifdef _WIN32
constexpr char kPipeMode[] = "wb";
constexpr char kFindFfmpeg[] = "where ffmpeg > NUL 2>&1";
std::string Quote(const std::string& text) { return '"' + text + '"'; }
#else
constexpr char kPipeMode[] = "w";
constexpr char kFindFfmpeg[] = "command -v ffmpeg > /dev/null 2>&1";
// For the shell: nothing in single quotes is special but a single quote.
std::string Quote(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}
#endif

}  // namespace

VideoWriter::VideoWriter(const std::string& path, int width, int height, double rate)
    : path_(path) {
  if (std::system(kFindFfmpeg) != 0) {
    throw std::runtime_error(path + ": a video needs ffmpeg, which was not found");
  }
#ifndef _WIN32
  // An ffmpeg that ends early is an error of its own, not the end of this program.
  std::signal(SIGPIPE, SIG_IGN);
#endif
  // H.264 in this form plays everywhere; it wants even numbers of pixels. A name that
  // begins with '-' is no option.
  const std::string name = path[0] == '-' ? "./" + path : path;
  const std::string command =
      "ffmpeg -loglevel error -y -f rawvideo -pix_fmt rgba -s " +
      std::to_string(width) + "x" + std::to_string(height) + " -r " +
      std::to_string(rate) +
      " -i - -vf \"pad=ceil(iw/2)*2:ceil(ih/2)*2\" -pix_fmt yuv420p " + Quote(name);
  pipe_ = popen(command.c_str(), kPipeMode);
  if (pipe_ == nullptr)
    throw std::runtime_error(path + ": ffmpeg could not be started");
}

VideoWriter::~VideoWriter() {
  if (pipe_ != nullptr) pclose(pipe_);
}

void VideoWriter::Add(const Image& image) {
  if (std::fwrite(image.rgba.data(), 1, image.rgba.size(), pipe_) !=
      image.rgba.size()) {
    throw std::runtime_error(path_ + ": ffmpeg takes no more pictures");
  }
}

void VideoWriter::Finish() {
  const int code = pclose(pipe_);
  pipe_ = nullptr;
  if (code != 0) throw std::runtime_error(path_ + ": ffmpeg could not write it");
}

}  // namespace dpe::viewer
