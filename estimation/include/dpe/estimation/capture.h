// A recording of moving points as it was read from a file. It knows nothing of a cloth:
// attach.h brings the two together.
#ifndef DPE_ESTIMATION_CAPTURE_H_
#define DPE_ESTIMATION_CAPTURE_H_

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "dpe/estimation/export.h"

namespace dpe {

enum class UpAxis {
  kY,
  kZ,  // (x, y, z) of the file is (x, z, -y), which keeps right-handed right-handed
};

enum class TimeOrigin {
  // Frame numbers in CSV files stand as they are, frame 0 being the initial state. In
  // every other format the first sample is the initial state.
  kAuto,
  kFirstSample,  // the first sample is the initial state
  kFile,         // time 0 or frame 0 of the file is the initial state
};

// What a file does not say of itself.
struct CaptureOptions {
  double scale = 0.0;  // m per unit of the file; 0: as the file says (TRC), else 1
  UpAxis up = UpAxis::kY;
  // Hz, of formats that number frames and give no times; 0: a frame of the file is a
  // frame of the scene.
  double rate = 0.0;
  TimeOrigin origin = TimeOrigin::kAuto;
  // Whether three NaN coordinates mean "not seen". Otherwise NaN is an error, because a
  // missing row, an empty field or a flag in the file is how these formats say so.
  bool nan_is_missing = false;
};

// One point seen at one moment.
struct CaptureSample {
  int marker = 0;  // index into marker_names, or of a vertex
  int line = 0;    // of the file it was read from, for messages; 0: no text file
  double time = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double sigma = 0.0;  // standard deviation per coordinate; 0: not given
};

// The mesh of an OBJ file. Vertices are counted as in the file, from 0.
struct CaptureMesh {
  std::string path;  // of the file it was read from
  std::vector<std::array<int, 3>> triangles;
  std::vector<char> in_a_face;  // one per vertex
  // 2 x vertices; NaN where a vertex has none; empty if the file has none at all.
  Eigen::Matrix2Xd texture_coordinates;
  // "FILE:LINE: vertex 7 has two ..." where the texture has a seam, else empty.
  std::string texture_seam;
};

struct Capture {
  enum class TimeUnit { kSeconds, kFrames };

  std::string path;  // as it was asked for
  std::string format;
  // Empty: markers are indices of vertices.
  std::vector<std::string> marker_names;
  // Vertices that every frame of the file holds; 0: the format does not say.
  int num_vertices = 0;
  TimeUnit time_unit = TimeUnit::kFrames;
  bool frame_zero_is_initial = false;  // what TimeOrigin::kAuto stands for
  std::string length_unit;             // "mm"; empty: the format does not say
  std::vector<CaptureSample> samples;
  CaptureMesh mesh;  // without triangles unless the format has them

  bool markers_are_vertices() const { return marker_names.empty(); }
};

// Reads a capture, in whatever format it is:
//
//   CSV   header frame|time,vertex|marker,x,y,z[,sigma]; an empty sigma is not given;
//         times in s, increasing for each marker; frames in any order
//   TRC   marker files of motion capture systems; empty fields are missing samples.
//         Times are frame number / DataRate if the Time column agrees with that to 1 ms
//         (it is usually rounded), else the Time column
//   OBJ   a folder, or a pattern with * or ?, of files whose names differ in one
//   number,
//         the number of the frame; faces must be the same in all of them
//   PC2   point caches; sample s is frame s * sampleRate
//   NPY   NumPy array, frames x vertices x 3, float32 or float64
//
// The format is recognised by the content. Positions, times and sigmas are as in the
// file; ToSceneUnits converts them.
// @throws SceneError naming file, line (of binary files: byte), value and what is
//         accepted
DPE_ESTIMATION_API Capture ReadCapture(const std::string& path,
                                       const CaptureOptions& options = {});

// The one place where units are converted: afterwards positions and sigmas are in m, y
// is up, and times are in frames of the scene since its initial state.
//
// @param options       with which the capture was read
// @param frame_length  s, the scene's delta
// @param capture       as ReadCapture returned it; is changed
// @throws SceneError for options that do not fit the capture, a sample before the
//         initial state, and a unit of length that is not known
DPE_ESTIMATION_API void ToSceneUnits(const CaptureOptions& options, double frame_length,
                                     Capture* capture);

}  // namespace dpe

#endif  // DPE_ESTIMATION_CAPTURE_H_
