#include <ctime>

#include "estimation/captures/capture_support.h"

namespace dpe::test {
namespace {

using CsvCapture = CaptureTest;

TEST_F(CsvCapture, FramesAndVertices) {
  const Capture c = Read(
      "\xEF\xBB\xBF"
      "frame,vertex,x,y,z\r\n\r\n3,7, 1,+2,-3e-1\r\n");
  EXPECT_EQ(c.format, "CSV");
  EXPECT_TRUE(c.markers_are_vertices());
  EXPECT_EQ(c.num_vertices, 0);
  EXPECT_EQ(c.time_unit, Capture::TimeUnit::kFrames);
  ASSERT_EQ(c.samples.size(), 1u);
  EXPECT_EQ(c.samples[0].marker, 7);
  EXPECT_EQ(c.samples[0].time, 3.0);
  EXPECT_EQ(c.samples[0].line, 3);
  EXPECT_EQ(c.samples[0].position, Eigen::Vector3d(1.0, 2.0, -0.3));
  EXPECT_EQ(c.samples[0].sigma, 0.0);
}

TEST_F(CsvCapture, TimesMarkersAndSigmas) {
  const Capture c = Read(
      "time,marker,x,y,z,sigma\n"
      "0.5,left top,1,2,3,0.01\n0.5,B,4,5,6,\n0.75,B,7,8,9,2\n1,left top,1,1,1,\n");
  EXPECT_THAT(c.marker_names, ElementsAre("left top", "B"));
  EXPECT_EQ(c.time_unit, Capture::TimeUnit::kSeconds);
  ASSERT_EQ(c.samples.size(), 4u);
  EXPECT_EQ(c.samples[0].sigma, 0.01);
  EXPECT_EQ(c.samples[1].sigma, 0.0);
  EXPECT_EQ(c.samples[2].marker, 1);
  EXPECT_EQ(c.samples[2].time, 0.75);
  EXPECT_EQ(c.samples[3].marker, 0);
}

TEST_F(CsvCapture, LineBreaksOfAnySystem) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text =
        "frame,vertex,x,y,z" + end + end + "0,0,1,2,3" + end + "1,0,1,2,3" + end;
    for (const size_t cut : {size_t(0), end.size()}) {  // with and without the last
      const Capture c = Read(text.substr(0, text.size() - cut));
      ASSERT_EQ(c.samples.size(), 2u);
      EXPECT_EQ(c.samples[1].line, 4);
      EXPECT_EQ(c.samples[1].position.z(), 3.0);
    }
  }
}

TEST_F(CsvCapture, OtherPairsOfColumns) {
  EXPECT_THAT(Read("frame,marker,x,y,z\n0,A,1,2,3\n").marker_names, ElementsAre("A"));
  const Capture c = Read("time,vertex,x,y,z\n0.1,3,1,2,3\n");
  EXPECT_TRUE(c.markers_are_vertices());
  EXPECT_EQ(c.samples[0].time, 0.1);
}

TEST_F(CsvCapture, MarkersMayFollowEachOtherInsteadOfTimes) {
  const Capture c = Read(
      "time,marker,x,y,z\n0,A,0,0,0\n1,A,0,0,0\n0,B,0,0,0\n0.5,B,0,0,0\n2,B,0,0,0\n");
  EXPECT_EQ(c.samples.size(), 5u);
}

TEST_F(CsvCapture, BadRowsAreRefusedWithTheirLine) {
  const std::string head = "time,marker,x,y,z\n";
  EXPECT_THAT(ErrorOfReading(head + "0,A,1,2\n"),
              AllOf(StartsWith(path_ + ":2: "), HasSubstr("4 fields"),
                    HasSubstr("the five of 'time,marker,x,y,z'")));
  EXPECT_THAT(ErrorOfReading("time,marker,x,y,z,sigma\n0,A,1,2,3\n"),
              AllOf(HasSubstr("5 fields"), HasSubstr("the six of")));
  EXPECT_THAT(ErrorOfReading(head + "0,A,1,2,3\n1,A,1,two,3\n"),
              AllOf(StartsWith(path_ + ":3: "), HasSubstr("y is 'two'"),
                    HasSubstr("a finite number")));
  EXPECT_THAT(ErrorOfReading(head + "0,,1,2,3\n"), HasSubstr("marker is ''"));
  EXPECT_THAT(ErrorOfReading(head + "now,A,1,2,3\n"), HasSubstr("time is 'now'"));
  EXPECT_THAT(ErrorOfReading(head + "nan,A,1,2,3\n"), HasSubstr("time is 'nan'"));
  EXPECT_THAT(ErrorOfReading(head), HasSubstr("no data"));
  EXPECT_THAT(ErrorOfReading("x,y,z\n1,2,3\n"),
              AllOf(StartsWith(path_ + ":1: "), HasSubstr("the header is 'x,y,z'"),
                    HasSubstr("frame,vertex,x,y,z")));
}

TEST_F(CsvCapture, SigmasAreAboveZero) {
  const std::string head = "frame,vertex,x,y,z,sigma\n";
  for (const char* sigma : {"-0.01", "0", "inf", "nan", "1mm"}) {
    EXPECT_THAT(
        ErrorOfReading(head + "0,0,1,2,3,0.1\n1,0,1,2,3," + sigma + "\n"),
        AllOf(StartsWith(path_ + ":3: "),
              HasSubstr("sigma is '" + std::string(sigma) + "'"), HasSubstr("> 0")));
  }
}

TEST_F(CsvCapture, TimesThatGoBackwardsAreRefused) {
  const std::string head = "time,marker,x,y,z\n";
  EXPECT_THAT(ErrorOfReading(head + "0,A,0,0,0\n0.5,A,0,0,0\n0.4,A,0,0,0\n"),
              AllOf(StartsWith(path_ + ":4: "), HasSubstr("'0.4' after 0.5 in line 3"),
                    HasSubstr("backwards")));
  // Each marker by itself goes forwards here.
  EXPECT_THAT(
      ErrorOfReading(head + "0,A,0,0,0\n0,B,0,0,0\n0.5,A,0,0,0\n0.4,B,0,0,0\n"),
      AllOf(StartsWith(path_ + ":5: "), HasSubstr("'0.4' after 0.5 in line 4")));
  EXPECT_THAT(ErrorOfReading(head + "0,A,0,0,0\n0.5,A,0,0,0\n0,B,0,0,0\n0.4,A,0,0,0\n"),
              AllOf(StartsWith(path_ + ":5: "), HasSubstr("after 0.5 in line 3")));
  EXPECT_THAT(ErrorOfReading(head + "0.5,A,0,0,0\n0.5,B,0,0,0\n0.5,A,0,0,0\n"),
              AllOf(StartsWith(path_ + ":4: "),
                    HasSubstr("time 0.5, marker A was given before, in line 2")));
}

TEST_F(CsvCapture, NanMeansMissingOnlyWhereThatIsSaid) {
  const std::string text = "frame,vertex,x,y,z\n0,0,1,2,3\n1,0,nan,nan,NaN\n";
  EXPECT_THAT(ErrorOfReading(text),
              AllOf(StartsWith(path_ + ":3: "), HasSubstr("x is 'nan'"),
                    HasSubstr("leave the row out")));
  options_.nan_is_missing = true;
  EXPECT_EQ(Read(text).samples.size(), 1u);
  EXPECT_THAT(ErrorOfReading("frame,vertex,x,y,z\n0,0,1,nan,3\n"),
              HasSubstr("y is 'nan'"));
  EXPECT_THAT(ErrorOfReading("frame,vertex,x,y,z\n0,0,nan,nan,nan\n"),
              HasSubstr("no data"));
}

// One pass: twice the rows take about twice the time, not four times.
TEST_F(CsvCapture, TimeGrowsWithTheRowsOnly) {
  const auto seconds = [&](int rows) {
    std::string text = "time,marker,x,y,z,sigma\n";
    for (int i = 0; i < rows; ++i) {
      text += std::to_string(i / 100) + ",marker" + std::to_string(i % 100) +
              ",0.12345678901234567,-1.2345678901234567,3.2109876543210987,0.005\n";
    }
    WriteFile(path_, text);
    double least = 1e9;
    for (int repetition = 0; repetition < 3; ++repetition) {
      const std::clock_t start = std::clock();
      EXPECT_EQ(ReadCapture(path_).samples.size(), static_cast<size_t>(rows));
      least = std::min(least, double(std::clock() - start) / CLOCKS_PER_SEC);
    }
    RecordProperty("seconds_" + std::to_string(rows), std::to_string(least));
    return least;
  };
  EXPECT_LT(seconds(200000), 10.0 * seconds(50000));
}

}  // namespace
}  // namespace dpe::test
