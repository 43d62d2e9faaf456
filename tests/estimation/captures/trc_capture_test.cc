#include "estimation/captures/capture_support.h"

namespace dpe::test {
namespace {

class TrcCapture : public CaptureTest {
 protected:
  // The header of a file of two markers.
  static std::string Header(int frames, const std::string& rate = "60",
                            const std::string& units = "mm") {
    return "PathFileType\t4\t(X/Y/Z)\tcloth.trc\n"
           "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\t"
           "OrigDataStartFrame\tOrigNumFrames\n" +
           rate + "\t60\t" + std::to_string(frames) + "\t2\t" + units +
           "\t60\t1\t2\n"
           "Frame#\tTime\tA\t\t\tB 1\t\t\t\n"
           "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\t\n"
           "\n";
  }
};

TEST_F(TrcCapture, ReadsMarkersAndLeavesGapsOut) {
  const Capture c = Read(Header(2) +
                         "1\t0.000\t1\t2\t3\t\t\t\r\n"
                         "2\t0.017\t4\t5\t6\t7\t8\t9\t\t\n");
  EXPECT_EQ(c.format, "TRC");
  EXPECT_EQ(c.length_unit, "mm");
  EXPECT_THAT(c.marker_names, ElementsAre("A", "B 1"));
  ASSERT_EQ(c.samples.size(), 3u);
  EXPECT_EQ(c.samples[1].line, 8);
  EXPECT_EQ(c.samples[2].marker, 1);
  EXPECT_EQ(c.samples[2].position, Eigen::Vector3d(7, 8, 9));
  // The exact time, which the column rounds.
  EXPECT_DOUBLE_EQ(c.samples[2].time, 1.0 / 60.0);
}

TEST_F(TrcCapture, TimesThatContradictTheRateArePreferred) {
  const Capture c = Read(Header(2) +
                         "1\t0\t1\t2\t3\t1\t2\t3\n"
                         "2\t0.02\t4\t5\t6\t7\t8\t9\n");
  EXPECT_EQ(c.samples.back().time, 0.02);
}

TEST_F(TrcCapture, FramesThatAreNotThereTakeTheirTime) {
  const Capture c = Read(Header(2, "50") +
                         "11\t0.2\t1\t2\t3\t1\t2\t3\n"
                         "14\t0.26\t4\t5\t6\t7\t8\t9\n");
  EXPECT_EQ(c.samples.front().time, 0.2);
  EXPECT_DOUBLE_EQ(c.samples.back().time, 0.26);
}

TEST_F(TrcCapture, SpacesMayStandForTabs) {
  const Capture c = Read(
      "PathFileType 4 (X/Y/Z) cloth.trc\n"
      "DataRate CameraRate NumFrames NumMarkers Units\n60 60 1 1 m\n"
      "Frame# Time A\n X1 Y1 Z1\n1 0 1 2 3\n");
  EXPECT_EQ(c.samples[0].position, Eigen::Vector3d(1, 2, 3));
}

TEST_F(TrcCapture, BadRowsAreRefusedWithTheirLine) {
  const std::string good = "1\t0\t1\t2\t3\t4\t5\t6\n";
  EXPECT_THAT(ErrorOfReading(Header(2) + good + "2\t0.017\t1\t2\t3\t4\t5\n"),
              AllOf(StartsWith(path_ + ":8: "), HasSubstr("7 fields"),
                    HasSubstr("accepted are 8")));
  EXPECT_THAT(ErrorOfReading(Header(2) + good + "2\t0.017\t1\t2\t3\t4\t5\t6\t7\n"),
              HasSubstr("9 fields"));
  EXPECT_THAT(ErrorOfReading(Header(2) + good + "2\t0.017\t1\tx\t3\t4\t5\t6\n"),
              AllOf(StartsWith(path_ + ":8: "), HasSubstr("y is 'x'")));
  // One empty coordinate is no gap.
  EXPECT_THAT(ErrorOfReading(Header(2) + good + "2\t0.017\t1\t\t3\t4\t5\t6\n"),
              AllOf(StartsWith(path_ + ":8: "), HasSubstr("y is ''")));
  EXPECT_THAT(ErrorOfReading(Header(1) + "1\t0\tnan\tnan\tnan\t4\t5\t6\n"),
              AllOf(StartsWith(path_ + ":7: "), HasSubstr("x is 'nan'")));
  EXPECT_THAT(ErrorOfReading(Header(2) + good + "2\t-0.1\t1\t2\t3\t4\t5\t6\n"),
              AllOf(StartsWith(path_ + ":8: "), HasSubstr("Time is '-0.1' after 0"),
                    HasSubstr("backwards")));
  EXPECT_THAT(ErrorOfReading(Header(2) + good + "1\t0.017\t1\t2\t3\t4\t5\t6\n"),
              HasSubstr("Frame# is '1' after 1"));
  EXPECT_THAT(ErrorOfReading(Header(3) + good + "2\t0.017\t1\t2\t3\t4\t5\t6\n"),
              AllOf(StartsWith(path_ + ": "), HasSubstr("has 2 rows"), HasSubstr("3")));
}

TEST_F(TrcCapture, BadHeadersAreRefused) {
  EXPECT_THAT(ErrorOfReading(Header(1, "0")),
              AllOf(StartsWith(path_ + ":3: "), HasSubstr("DataRate is '0'")));
  EXPECT_THAT(ErrorOfReading(Header(1, "fast")), HasSubstr("DataRate is 'fast'"));
  EXPECT_THAT(ErrorOfReading("PathFileType\t4\n"), HasSubstr("ends before"));
  EXPECT_THAT(ErrorOfReading("PathFileType\t4\nDataRate\tUnits\n60\tmm\n"),
              AllOf(StartsWith(path_ + ":3: "), HasSubstr("NumFrames")));
  std::string text = Header(1);
  text.replace(text.find("B 1"), 3, "A");
  EXPECT_THAT(ErrorOfReading(text),
              AllOf(StartsWith(path_ + ":4: "), HasSubstr("'A' twice")));
  text = Header(1);
  text.replace(text.find("B 1"), 3, "");
  EXPECT_THAT(ErrorOfReading(text), AllOf(StartsWith(path_ + ":4: "),
                                          HasSubstr("1 markers"), HasSubstr("2")));
  text = Header(1);
  text.replace(text.find("Frame#"), 6, "Number");
  EXPECT_THAT(ErrorOfReading(text), HasSubstr("Frame#"));
  text = Header(1);
  text.replace(text.find("X1"), 2, "Q1");
  EXPECT_THAT(ErrorOfReading(text), AllOf(StartsWith(path_ + ":5: "), HasSubstr("X1")));
}

}  // namespace
}  // namespace dpe::test
