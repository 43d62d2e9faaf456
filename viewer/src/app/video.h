// A video, through ffmpeg.
#ifndef DPE_VIEWER_APP_VIDEO_H_
#define DPE_VIEWER_APP_VIDEO_H_

#include <cstdio>
#include <string>

#include "png/image.h"

namespace dpe::viewer {

class VideoWriter {
 public:
  // @param path    what ffmpeg makes of its ending: out.mp4
  // @param rate    pictures per second
  // Throws std::runtime_error, naming the file, if there is no ffmpeg.
  VideoWriter(const std::string& path, int width, int height, double rate);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  // Throws std::runtime_error if ffmpeg takes no more.
  void Add(const Image& image);
  // Ends the file; throws std::runtime_error if ffmpeg failed.
  void Finish();

 private:
  std::string path_;
  std::FILE* pipe_ = nullptr;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_VIDEO_H_
