#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "estimation/captures/capture_support.h"

namespace dpe::test {
namespace {

// The bytes of a number, the least significant first or last.
template <typename Number>
std::string Bytes(Number value, bool big_endian = false) {
  const std::uint16_t probe = 1;
  const bool host_is_big = *reinterpret_cast<const char*>(&probe) == 0;
  std::string bytes(sizeof(value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(value));
  if (host_is_big != big_endian) bytes = std::string(bytes.rbegin(), bytes.rend());
  return bytes;
}

std::string NpyHeader(const std::string& dictionary, int version = 1) {
  std::string header = dictionary + "\n";
  std::string bytes = std::string("\x93NUMPY") + char(version) + char(0);
  bytes += version == 1 ? Bytes<std::uint16_t>(header.size())
                        : Bytes<std::uint32_t>(header.size());
  return bytes + header;
}

std::string Dictionary(const std::string& type, const std::string& fortran,
                       const std::string& shape) {
  return "{'descr': '" + type + "', 'fortran_order': " + fortran +
         ", 'shape': " + shape + ", }";
}

// Number c of vertex v at frame f in the arrays below.
double Value(int f, int v, int c) { return 100 * f + 10 * v + c + 0.25; }

// An array of 2 frames and 4 vertices.
template <typename Number>
std::string Array(const std::string& type, bool fortran, int version = 1) {
  std::string bytes =
      NpyHeader(Dictionary(type, fortran ? "True" : "False", "(2, 4, 3)"), version);
  const bool big_endian = type[0] == '>';
  const auto add = [&](int f, int v, int c) {
    bytes += Bytes(static_cast<Number>(Value(f, v, c)), big_endian);
  };
  if (fortran) {
    for (int c = 0; c < 3; ++c) {
      for (int v = 0; v < 4; ++v) {
        for (int f = 0; f < 2; ++f) add(f, v, c);
      }
    }
  } else {
    for (int f = 0; f < 2; ++f) {
      for (int v = 0; v < 4; ++v) {
        for (int c = 0; c < 3; ++c) add(f, v, c);
      }
    }
  }
  return bytes;
}

void ExpectValues(const Capture& c) {
  EXPECT_EQ(c.num_vertices, 4);
  EXPECT_TRUE(c.markers_are_vertices());
  ASSERT_EQ(c.samples.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    const CaptureSample& sample = c.samples[i];
    EXPECT_EQ(sample.time, i / 4);
    EXPECT_EQ(sample.marker, i % 4);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(sample.position[k], Value(i / 4, i % 4, k));
  }
}

using NpyCapture = CaptureTest;

TEST_F(NpyCapture, EveryTypeAndOrder) {
  for (const bool fortran : {false, true}) {
    ExpectValues(Read(Array<double>("<f8", fortran)));
    ExpectValues(Read(Array<double>(">f8", fortran, 2)));
    ExpectValues(Read(Array<float>("<f4", fortran, 3)));
    ExpectValues(Read(Array<float>(">f4", fortran)));
  }
}

TEST_F(NpyCapture, BadHeadersAreRefusedWithTheirByte) {
  const auto error = [&](const std::string& dictionary) {
    return ErrorOfReading(NpyHeader(dictionary));
  };
  EXPECT_THAT(error(Dictionary("<i8", "False", "(2, 4, 3)")),
              AllOf(StartsWith(path_ + ": byte 10: "), HasSubstr("'<i8'"),
                    HasSubstr("float32 and float64")));
  EXPECT_THAT(error(Dictionary("<f2", "False", "(2, 4, 3)")), HasSubstr("'<f2'"));
  for (const char* shape : {"(2, 12)", "(2, 4, 2)", "()", "(24,)", "(0, 4, 3)",
                            "(2, 4, 3, 1)", "(-2, 4, 3)"}) {
    EXPECT_THAT(error(Dictionary("<f8", "False", shape)),
                AllOf(HasSubstr("the shape is " + std::string(shape)),
                      HasSubstr("(frames, vertices, 3)")));
  }
  EXPECT_THAT(error(Dictionary("<f8", "Maybe", "(2, 4, 3)")), HasSubstr("Maybe"));
  EXPECT_THAT(error("{'descr': '<f8', 'fortran_order': False}"), HasSubstr("'shape'"));
  EXPECT_THAT(ErrorOfReading(NpyHeader("{}", 9)),
              AllOf(StartsWith(path_ + ": byte 6: "), HasSubstr("version is 9")));
  const std::string whole = Array<double>("<f8", false);
  for (size_t size : {6, 7, 9, 30}) {
    EXPECT_THAT(ErrorOfReading(whole.substr(0, size)),
                AllOf(StartsWith(path_ + ": byte " + std::to_string(size) + ": "),
                      HasSubstr("within the header")));
  }
}

TEST_F(NpyCapture, TruncatedAndTooLongFilesAreRefused) {
  const std::string whole = Array<double>("<f8", false);
  for (const std::string& bad : {whole.substr(0, whole.size() - 1), whole + "x"}) {
    EXPECT_THAT(ErrorOfReading(bad),
                AllOf(StartsWith(path_ + ": byte " + std::to_string(bad.size())),
                      HasSubstr("at byte " + std::to_string(whole.size())),
                      HasSubstr("2 frames of 4 vertices")));
  }
}

TEST_F(NpyCapture, NanMeansMissingOnlyWhereThatIsSaid) {
  std::string bytes = Array<double>("<f8", false);
  // Vertex 1 of frame 1.
  const size_t place = bytes.size() - 3 * 8 * 3;
  bytes.replace(place + 8, 8, Bytes(std::nan("")));
  const std::string one_nan = bytes;
  bytes.replace(place, 8, Bytes(std::nan("")));
  bytes.replace(place + 16, 8, Bytes(std::nan("")));
  EXPECT_THAT(ErrorOfReading(one_nan),
              AllOf(StartsWith(path_ + ": byte " + std::to_string(place + 8) + ": "),
                    HasSubstr("frame 1, vertex 1: y is nan")));
  EXPECT_THAT(ErrorOfReading(bytes), HasSubstr("frame 1, vertex 1: x is nan"));
  options_.nan_is_missing = true;
  EXPECT_EQ(Read(bytes).samples.size(), 7u);
  EXPECT_THAT(ErrorOfReading(one_nan), HasSubstr("y is nan"));
}

using Pc2Capture = CaptureTest;

std::string PointCache(std::int32_t version, std::int32_t points, float start,
                       float rate, std::int32_t samples) {
  std::string bytes("POINTCACHE2\0", 12);
  bytes += Bytes(version) + Bytes(points) + Bytes(start) + Bytes(rate) + Bytes(samples);
  for (int f = 0; f < 2; ++f) {
    for (int v = 0; v < 4; ++v) {
      for (int c = 0; c < 3; ++c) bytes += Bytes(static_cast<float>(Value(f, v, c)));
    }
  }
  return bytes;
}

TEST_F(Pc2Capture, ReadsPointsAndTimes) {
  ExpectValues(Read(PointCache(1, 4, 0, 1, 2)));
  const Capture c = Read(PointCache(1, 4, 10, 0.5, 2));
  EXPECT_EQ(c.format, "PC2");
  EXPECT_EQ(c.samples.front().time, 10.0);
  EXPECT_EQ(c.samples.back().time, 10.5);
}

TEST_F(Pc2Capture, BadFilesAreRefusedWithTheirByte) {
  EXPECT_THAT(ErrorOfReading(PointCache(2, 4, 0, 1, 2)),
              AllOf(StartsWith(path_ + ": byte 12: "), HasSubstr("version is 2")));
  EXPECT_THAT(ErrorOfReading(PointCache(1, 0, 0, 1, 2)),
              AllOf(StartsWith(path_ + ": byte 16: "), HasSubstr("is 0")));
  EXPECT_THAT(ErrorOfReading(PointCache(1, 4, std::nanf(""), 1, 2)),
              StartsWith(path_ + ": byte 20: "));
  EXPECT_THAT(ErrorOfReading(PointCache(1, 4, 0, 0, 2)),
              StartsWith(path_ + ": byte 24: "));
  EXPECT_THAT(ErrorOfReading(PointCache(1, 4, 0, 1, -2)),
              AllOf(StartsWith(path_ + ": byte 28: "), HasSubstr("is -2")));
  // More bytes than a whole number holds.
  EXPECT_THAT(
      ErrorOfReading(PointCache(1, 2147483647, 0, 1, 2147483647)),
      HasSubstr(
          "is the end of the file; accepted is an end at byte 55340232169589047296"));
  const std::string whole = PointCache(1, 4, 0, 1, 2);
  EXPECT_THAT(ErrorOfReading(whole.substr(0, 20)),
              AllOf(StartsWith(path_ + ": byte 20: "), HasSubstr("32 bytes")));
  for (const std::string& bad : {whole.substr(0, whole.size() - 5), whole + "x"}) {
    EXPECT_THAT(ErrorOfReading(bad),
                AllOf(StartsWith(path_ + ": byte " + std::to_string(bad.size())),
                      HasSubstr("at byte 128"), HasSubstr("2 samples of 4 points")));
  }
  std::string bad = whole;
  bad.replace(32 + 4 * 17, 4, Bytes(INFINITY));
  EXPECT_THAT(ErrorOfReading(bad), AllOf(StartsWith(path_ + ": byte 100: "),
                                         HasSubstr("frame 1, vertex 1: z is inf")));
}

}  // namespace
}  // namespace dpe::test
