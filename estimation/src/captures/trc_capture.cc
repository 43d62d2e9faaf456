// TRC files of motion capture systems:
//
//   PathFileType  4  (X/Y/Z)  NAME
//   DataRate  CameraRate  NumFrames  NumMarkers  Units  ...     labels
//   60        60          2          2           mm     ...     their values
//   Frame#    Time   A            B                             names of markers
//                    X1  Y1  Z1   X2  Y2  Z2                    labels
//   1         0.000  1   2   3                                  B was not seen
//   2         0.017  1   2   3    4   5   6
//
// with tabs between fields. An empty line may stand before the data.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"

namespace dpe {
namespace {

class TrcReader {
 public:
  TrcReader(const std::string& path, const std::string& content,
            const CaptureOptions& options)
      : path_(path), options_(options), lines_(content) {
    capture_.path = path;
    capture_.format = "TRC";
    capture_.time_unit = Capture::TimeUnit::kSeconds;
  }

  Capture Read() {
    NextFields("the line 'PathFileType 4 (X/Y/Z) NAME'");
    ReadSizes();
    ReadNames();
    NextFields("the line of labels X1, Y1, Z1");
    if (fields_.size() < 3 || fields_[2].empty() || fields_[2].front() != 'X') {
      // Without tabs the two empty fields in front are not there.
      if (fields_.empty() || fields_[0].empty() || fields_[0].front() != 'X') {
        Fail("is '" + Excerpt(Trim(line_)) + "'; accepted are the labels X1, Y1, Z1");
      }
    }
    while (lines_.Next(&line_)) {
      Split();
      if (!std::all_of(fields_.begin(), fields_.end(),
                       [](std::string_view f) { return f.empty(); })) {
        ReadRow();
      }
    }
    if (static_cast<int>(rows_.size()) != num_frames_) {
      throw SceneError(path_ + ": has " + std::to_string(rows_.size()) +
                       " rows of data; accepted are the " +
                       std::to_string(num_frames_) + " of NumFrames in line 3");
    }
    if (capture_.samples.empty()) throw SceneError(path_ + ": has no data");
    SetTimes();
    return std::move(capture_);
  }

 private:
  struct Row {
    int frame = 0;
    double time = 0.0;
    size_t num_samples = 0;  // so far, this row included
  };

  [[noreturn]] void Fail(const std::string& what) const {
    FailAtLine(path_, lines_.number(), what);
  }

  void Split() {
    if (line_.find('\t') != std::string_view::npos) {
      SplitFields(line_, '\t', &fields_);
    } else {
      SplitWords(line_, &fields_);
    }
  }

  void NextFields(const std::string& expected) {
    if (!lines_.Next(&line_)) {
      throw SceneError(path_ + ": ends before " + expected);
    }
    Split();
  }

  // The value below `label` of the second line.
  std::string_view Value(const char* label) const {
    const auto found = std::find(labels_.begin(), labels_.end(), label);
    const size_t index = found - labels_.begin();
    if (found == labels_.end() || index >= fields_.size()) {
      Fail(std::string("has no value for ") + label);
    }
    return fields_[index];
  }

  void ReadSizes() {
    NextFields("the line of labels DataRate, CameraRate, NumFrames, ...");
    labels_ = fields_;
    NextFields("the values of DataRate, CameraRate, NumFrames, ...");
    const int line = lines_.number();
    rate_ =
        ParseFinite(Value("DataRate"), "DataRate", "a number > 0 (Hz)", path_, line);
    if (!(rate_ > 0.0)) {
      Fail("DataRate is '" + Excerpt(Value("DataRate")) +
           "'; accepted is a number > 0 (Hz)");
    }
    num_frames_ = ParseIndex(Value("NumFrames"), "NumFrames", kMaxFrame, path_, line);
    num_markers_ =
        ParseIndex(Value("NumMarkers"), "NumMarkers", kMaxFrame, path_, line);
    capture_.length_unit = Value("Units");
  }

  void ReadNames() {
    NextFields("the names of the markers");
    if (fields_.size() < 2 || fields_[0] != "Frame#" || fields_[1] != "Time") {
      Fail("is '" + Excerpt(Trim(line_)) +
           "'; accepted are 'Frame#', 'Time' and the names of the markers");
    }
    std::unordered_map<std::string_view, bool> seen;
    for (size_t i = 2; i < fields_.size(); ++i) {
      if (fields_[i].empty()) continue;
      if (!seen.emplace(fields_[i], true).second) {
        Fail("names marker '" + Excerpt(fields_[i]) + "' twice");
      }
      capture_.marker_names.emplace_back(fields_[i]);
    }
    if (static_cast<int>(capture_.marker_names.size()) != num_markers_ ||
        num_markers_ == 0) {
      Fail("names " + std::to_string(capture_.marker_names.size()) +
           " markers; accepted are the " + std::to_string(num_markers_) +
           " of NumMarkers in line 3, at least 1");
    }
  }

  void ReadRow() {
    const size_t expected = 2 + 3 * static_cast<size_t>(num_markers_);
    // Many writers end their lines with tabs.
    size_t count = fields_.size();
    while (count > expected && fields_[count - 1].empty()) --count;
    if (count != expected) {
      Fail("has " + std::to_string(count) + " fields; accepted are " +
           std::to_string(expected) + ", Frame#, Time and three for each of " +
           std::to_string(num_markers_) + " markers (empty where one was not seen)");
    }
    const int line = lines_.number();
    Row row;
    row.frame = ParseIndex(fields_[0], "Frame#", kMaxFrame, path_, line);
    row.time = ParseFinite(fields_[1], "Time", "a finite number (s)", path_, line);
    if (!rows_.empty() && row.frame <= rows_.back().frame) {
      Fail("Frame# is '" + Excerpt(fields_[0]) + "' after " +
           std::to_string(rows_.back().frame) + "; accepted are increasing numbers");
    }
    if (!rows_.empty() && row.time <= rows_.back().time) {
      Fail("Time is '" + Excerpt(fields_[1]) + "' after " +
           NumberField(rows_.back().time) +
           "; accepted are times that do not go backwards or stand still");
    }
    for (int m = 0; m < num_markers_; ++m) ReadMarker(m, &fields_[2 + 3 * m]);
    row.num_samples = capture_.samples.size();
    rows_.push_back(row);
  }

  void ReadMarker(int marker, const std::string_view* fields) {
    const int line = lines_.number();
    if (fields[0].empty() && fields[1].empty() && fields[2].empty()) return;
    CaptureSample sample;
    sample.marker = marker;
    sample.line = line;
    if (ParsePosition(fields, options_.nan_is_missing, path_, line,
                      sample.position.data())) {
      capture_.samples.push_back(sample);
    }
  }

  // The Time column is usually rounded to milliseconds, which is a fifth of a sample at
  // 200 Hz. Frame numbers are exact, if they and DataRate tell the same story.
  void SetTimes() {
    const Row& first = rows_.front();
    const double tolerance = std::min(1e-3, 0.5 / rate_);
    bool frames_agree = true;
    for (const Row& row : rows_) {
      const double time = (row.frame - first.frame) / rate_;
      frames_agree &= std::abs(row.time - first.time - time) <= tolerance;
    }
    size_t s = 0;
    for (const Row& row : rows_) {
      const double time =
          frames_agree ? first.time + (row.frame - first.frame) / rate_ : row.time;
      for (; s < row.num_samples; ++s) capture_.samples[s].time = time;
    }
  }

  const std::string path_;
  const CaptureOptions options_;
  LineReader lines_;
  Capture capture_;
  std::string_view line_;
  std::vector<std::string_view> fields_, labels_;
  double rate_ = 0.0;
  int num_frames_ = 0, num_markers_ = 0;
  std::vector<Row> rows_;
};

}  // namespace

Capture ReadTrcCapture(const std::string& path, const std::string& content,
                       const CaptureOptions& options) {
  return TrcReader(path, content, options).Read();
}

}  // namespace dpe
