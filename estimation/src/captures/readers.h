// One reader per format. Each takes the whole content of a file, throws SceneError as
// ReadCapture says, and leaves units as they are in the file.
#ifndef DPE_ESTIMATION_SRC_CAPTURES_READERS_H_
#define DPE_ESTIMATION_SRC_CAPTURES_READERS_H_

#include <string>
#include <vector>

#include "dpe/estimation/capture.h"

namespace dpe {

Capture ReadCsvCapture(const std::string& path, const std::string& content,
                       const CaptureOptions& options);
Capture ReadTrcCapture(const std::string& path, const std::string& content,
                       const CaptureOptions& options);
Capture ReadPc2Capture(const std::string& path, const std::string& content,
                       const CaptureOptions& options);
Capture ReadNpyCapture(const std::string& path, const std::string& content,
                       const CaptureOptions& options);

// A file of a sequence and the number of its frame.
struct SequenceFile {
  std::string path;
  int number = 0;
};

// The files of a folder (*.obj) or of a pattern, in the order of the one number in
// which their names differ.
// @throws SceneError if there are none, or they differ otherwise
std::vector<SequenceFile> FindSequence(const std::string& pattern);

// True for a folder and for a name with * or ?.
bool IsSequenceName(const std::string& path);

// @param pattern  what was asked for
Capture ReadObjSequence(const std::string& pattern,
                        const std::vector<SequenceFile>& files);

// Frames x vertices x 3 numbers of a binary file.
struct DenseBlock {
  std::string path;
  long offset = 0;  // byte at which the numbers begin
  long num_frames = 0;
  long num_vertices = 0;
  int bytes = 8;  // of a number: 4 or 8
  bool big_endian = false;
  bool fortran_order = false;  // the first index is the fastest
};

// Appends the samples of all frames, frame f at time f * step. The content must hold
// them all.
void AppendDenseSamples(const DenseBlock& block, const std::string& content,
                        double step, bool nan_is_missing, Capture* capture);

// "FILE: byte 12: what", as a SceneError.
[[noreturn]] void FailAtByte(const std::string& path, long byte,
                             const std::string& what);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SRC_CAPTURES_READERS_H_
