#include <string_view>
#include <unordered_map>

#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/scene.h"

namespace dpe {
namespace {

constexpr char kAccepted[] =
    "'frame,vertex,x,y,z' or 'time,marker,x,y,z', with ',sigma' at the end or not";

class CsvReader {
 public:
  CsvReader(const std::string& path, const CaptureOptions& options)
      : path_(path), options_(options) {
    capture_.path = path;
    capture_.format = "CSV";
  }

  Capture Read(const std::string& content) {
    LineReader lines(content);
    // A line of a trajectory has some 50 characters.
    capture_.samples.reserve(content.size() / 50);
    std::string_view line;
    bool header_seen = false;
    while (lines.Next(&line)) {
      line_ = lines.number();
      if (line_ == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
      if (Trim(line).empty()) continue;
      SplitFields(line, ',', &fields_);
      if (header_seen) {
        ReadRow();
      } else {
        ReadHeader(line);
        header_seen = true;
      }
    }
    if (capture_.samples.empty()) {
      throw SceneError(path_ + ": has no data; accepted is a line " + kAccepted +
                       " and one line per observed point");
    }
    return std::move(capture_);
  }

 private:
  void ReadHeader(std::string_view line) {
    const size_t n = fields_.size();
    const bool ok = (n == 5 || (n == 6 && fields_[5] == "sigma")) &&
                    (fields_[0] == "frame" || fields_[0] == "time") &&
                    (fields_[1] == "vertex" || fields_[1] == "marker") &&
                    fields_[2] == "x" && fields_[3] == "y" && fields_[4] == "z";
    if (!ok) {
      FailAtLine(
          path_, line_,
          "the header is '" + Excerpt(Trim(line)) + "'; accepted is " + kAccepted);
    }
    for (const std::string_view field : fields_) {
      header_ += (header_.empty() ? "" : ",") + std::string(field);
    }
    num_fields_ = n;
    has_times_ = fields_[0] == "time";
    has_names_ = fields_[1] == "marker";
    capture_.time_unit =
        has_times_ ? Capture::TimeUnit::kSeconds : Capture::TimeUnit::kFrames;
    capture_.frame_zero_is_initial = !has_times_;
  }

  void ReadRow() {
    if (fields_.size() != num_fields_) {
      FailAtLine(path_, line_,
                 "has " + std::to_string(fields_.size()) +
                     " fields; accepted are the " +
                     (num_fields_ == 5 ? "five" : "six") + " of '" + header_ + "'");
    }
    CaptureSample sample;
    sample.line = line_;
    if (has_times_) {
      sample.time =
          ParseFinite(fields_[0], "time", "a finite number (s)", path_, line_);
    } else {
      sample.time = ParseIndex(fields_[0], "frame", kMaxFrame, path_, line_);
    }
    sample.marker = has_names_
                        ? MarkerOf(fields_[1])
                        : ParseIndex(fields_[1], "vertex", kMaxFrame, path_, line_);
    if (has_times_) CheckOrder(sample);
    if (!ParsePosition(&fields_[2], options_.nan_is_missing, path_, line_,
                       sample.position.data())) {
      return;
    }
    if (num_fields_ == 6 && !fields_[5].empty()) sample.sigma = ParseSigma(fields_[5]);
    capture_.samples.push_back(sample);
  }

  double ParseSigma(std::string_view field) const {
    constexpr char kSigma[] = "a finite number > 0, or nothing where it is not known";
    const double sigma = ParseFinite(field, "sigma", kSigma, path_, line_);
    if (!(sigma > 0.0)) {
      FailAtLine(path_, line_,
                 "sigma is '" + Excerpt(field) + "'; accepted is " + kSigma);
    }
    return sigma;
  }

  int MarkerOf(std::string_view name) {
    if (name.empty()) {
      FailAtLine(path_, line_, "marker is ''; accepted is the name of a marker");
    }
    // Rows of one moment name the markers in the same order each time: the next one is
    // usually the guess.
    std::vector<std::string>& names = capture_.marker_names;
    if (++guess_ >= static_cast<int>(names.size())) guess_ = 0;
    if (!names.empty() && names[guess_] == name) return guess_;
    const auto [entry, is_new] =
        markers_.emplace(std::string(name), static_cast<int>(names.size()));
    if (is_new) names.emplace_back(name);
    return guess_ = entry->second;
  }

  // Rows may go through the moments, or through the markers, each from its start: a
  // time may be smaller than that of the row before only where a marker begins.
  void CheckOrder(const CaptureSample& sample) {
    if (sample.marker >= static_cast<int>(last_of_.size())) {
      last_of_.resize(sample.marker + 1);
    }
    Last& own = last_of_[sample.marker];
    if (own.line > 0 && sample.time == own.time) {
      FailAtLine(path_, line_,
                 "time " + Excerpt(fields_[0]) + ", " + NameOf(sample.marker) +
                     " was given before, in line " + std::to_string(own.line));
    }
    const Last& latest = own.line > 0 && own.time > sample.time ? own : previous_;
    if (own.line > 0 && latest.time > sample.time) {
      FailAtLine(path_, line_,
                 "time is '" + Excerpt(fields_[0]) + "' after " +
                     NumberField(latest.time) + " in line " +
                     std::to_string(latest.line) +
                     "; accepted are times that do not go backwards");
    }
    own = previous_ = {sample.time, line_};
  }

  std::string NameOf(int marker) const {
    return has_names_ ? "marker " + capture_.marker_names[marker]
                      : "vertex " + std::to_string(marker);
  }

  struct Last {
    double time = 0.0;
    int line = 0;  // 0: none yet
  };

  const std::string path_;
  const CaptureOptions options_;
  Capture capture_;
  std::vector<std::string_view> fields_;
  std::string header_;
  size_t num_fields_ = 0;
  bool has_times_ = false, has_names_ = false;
  int line_ = 0;
  int guess_ = -1;
  std::unordered_map<std::string, int> markers_;
  std::vector<Last> last_of_;  // one per marker
  Last previous_;              // row
};

}  // namespace

Capture ReadCsvCapture(const std::string& path, const std::string& content,
                       const CaptureOptions& options) {
  return CsvReader(path, options).Read(content);
}

}  // namespace dpe
