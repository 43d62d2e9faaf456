#include "dpe/estimation/trajectory_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "dpe/engine/simulator.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class TrajectoryCsvTest : public ::testing::Test {
 protected:
  Observations Read(const std::string& text, int num_frames = 0) {
    test::WriteFile(path_, text);
    return ReadTrajectoryCsv(path_, scene_, num_frames);
  }

  // What the reader says of `rows` under a good header.
  std::string ErrorOf(const std::string& rows) {
    return ErrorOfText("frame,vertex,x,y,z\n" + rows);
  }

  std::string ErrorOfText(const std::string& text) {
    try {
      Read(text);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  }

  test::TempDir dir_;
  std::string path_ = dir_.File("target.csv");
  Scene scene_ = test::MakeDerivativeScene("side", 3);  // 9 vertices
};

TEST_F(TrajectoryCsvTest, RoundTripsBitByBit) {
  const Trajectory trajectory = Simulator(scene_).Simulate(20);
  const Observations back = Read(TrajectoryToCsv(trajectory, scene_));
  ASSERT_EQ(back.positions.size(), 1u);
  EXPECT_EQ(back.positions[0], trajectory.positions[0]);
}

TEST_F(TrajectoryCsvTest, VerticesAreCountedThroughTheObjects) {
  scene_ = test::MakeDerivativeScene("two_objects", 3);
  Trajectory trajectory = Simulator(scene_).Simulate(3);
  const Observations both = Read(TrajectoryToCsv(trajectory, scene_));
  EXPECT_EQ(both.positions[1], trajectory.positions[1]);
  // An object that was not simulated keeps its place in the numbering.
  trajectory.positions[0].resize(0, 0);
  const Observations second = Read(TrajectoryToCsv(trajectory, scene_));
  EXPECT_EQ(second.positions[0].size(), 0);
  EXPECT_EQ(second.positions[1], trajectory.positions[1]);
}

TEST_F(TrajectoryCsvTest, MissingRowsAreMissingObservations) {
  const Observations obs =
      Read("frame,vertex,x,y,z\n\n2,1,1,2,3\r\n0, 3 ,-1e-3,+0.5,7\n");
  EXPECT_EQ(obs.num_frames(), 3);
  EXPECT_EQ(obs.NumObserved(0), 2);
  EXPECT_TRUE(obs.IsObserved(0, 1, 2));
  EXPECT_EQ(obs.positions[0](9, 0), -1e-3);
  EXPECT_EQ(obs.positions[0](10, 0), 0.5);
}

TEST_F(TrajectoryCsvTest, LaterFramesAreDroppedButChecked) {
  const std::string header = "frame,vertex,x,y,z\n";
  EXPECT_EQ(Read(header + "0,0,1,2,3\n5,0,1,2,3\n", 2).num_frames(), 2);
  EXPECT_THROW(Read(header + "0,0,1,2,3\n5,0,1,2,x\n", 2), SceneError);
}

TEST_F(TrajectoryCsvTest, FramesThatWereNotReachedAreLeftOut) {
  Trajectory trajectory = Simulator(scene_).Simulate(4);
  trajectory.positions[0].rightCols<2>().setConstant(
      std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(Read(TrajectoryToCsv(trajectory, scene_)).num_frames(), 2);
}

TEST_F(TrajectoryCsvTest, EachErrorNamesFileLineValueAndWhatIsAccepted) {
  EXPECT_THAT(ErrorOf("0,0,1,2\n"),
              AllOf(HasSubstr(path_ + ":2"), HasSubstr("4 fields"), HasSubstr("five")));
  EXPECT_THAT(ErrorOf("0,0,1,2,3,4\n"), HasSubstr("6 fields"));
  EXPECT_THAT(ErrorOf("0,0,1,2,3\n0,1,1,abc,3\n"),
              AllOf(HasSubstr(":3"), HasSubstr("y is 'abc'"), HasSubstr("finite")));
  EXPECT_THAT(ErrorOf("0,0,1,2,nan\n"), HasSubstr("z is 'nan'"));
  EXPECT_THAT(ErrorOf("0,0,inf,2,3\n"), HasSubstr("x is 'inf'"));
  EXPECT_THAT(ErrorOf("0,0,1e999,2,3\n"), HasSubstr("x is '1e999'"));
  EXPECT_THAT(ErrorOf("0,0,1.5x,2,3\n"), HasSubstr("x is '1.5x'"));
  EXPECT_THAT(ErrorOf("0,9,1,2,3\n"),
              AllOf(HasSubstr("vertex is '9'"), HasSubstr("0 to 8")));
  EXPECT_THAT(ErrorOf("0,-1,1,2,3\n"), HasSubstr("vertex is '-1'"));
  EXPECT_THAT(ErrorOf("0.5,0,1,2,3\n"), HasSubstr("frame is '0.5'"));
  EXPECT_THAT(ErrorOf("-1,0,1,2,3\n"), HasSubstr("frame is '-1'"));
  EXPECT_THAT(ErrorOf("99999999999,0,1,2,3\n"), HasSubstr("frame is '99999999999'"));
  EXPECT_THAT(ErrorOf("0,0,1,2,3\n0,0,1,2,3\n"),
              AllOf(HasSubstr(":3"), HasSubstr("given before, in line 2")));
  EXPECT_THAT(ErrorOf("9000000,0,1,2,3\n"), HasSubstr("last frame is 9000000"));
}

TEST_F(TrajectoryCsvTest, FilesWithoutDataAreRefused) {
  EXPECT_THAT(ErrorOfText(""), AllOf(HasSubstr(path_), HasSubstr("no data")));
  EXPECT_THAT(ErrorOf(""), HasSubstr("no data"));
  EXPECT_THAT(ErrorOfText("x,y\n1,2\n"), HasSubstr("the header is 'x,y'"));
  EXPECT_THAT(ErrorOfText(std::string("\x7f"
                                      "ELF\0\1\2\n",
                                      8)),
              HasSubstr("header"));
  EXPECT_THROW(ReadTrajectoryCsv(dir_.File("absent.csv"), scene_, 0), SceneError);
  EXPECT_THROW(ReadTrajectoryCsv(dir_.path(), scene_, 0), SceneError);
}

}  // namespace
}  // namespace dpe
