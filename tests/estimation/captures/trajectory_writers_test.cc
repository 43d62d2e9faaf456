#include <filesystem>
#include <limits>

#include "dpe/engine/simulator.h"
#include "dpe/estimation/attach.h"
#include "dpe/estimation/trajectory_io.h"
#include "estimation/captures/capture_support.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

class TrajectoryWriters : public ::testing::Test {
 protected:
  std::vector<std::string> Write(const std::string& name,
                                 TrajectoryFormat format = TrajectoryFormat::kAuto) {
    return WriteTrajectory(dir_.File(name), format, trajectory_, scene_);
  }
  Observations Read(const std::string& name, const AttachOptions& options = {}) {
    Capture capture = ReadCapture(dir_.File(name));
    format_ = capture.format;
    ToSceneUnits({}, scene_.delta, &capture);
    return AttachCapture(capture, scene_, options);
  }

  const TempDir dir_;
  Scene scene_ = MakeDerivativeScene("two_objects", 4);
  Trajectory trajectory_ = Simulator(scene_).Simulate(12);
  std::string format_;  // of the last file read
};

TEST_F(TrajectoryWriters, EveryFormatComesBack) {
  for (const char* name : {"a.csv", "a.txt", "a.npy", "new/folder/a_*.obj"}) {
    Write(name);
    const Observations back = Read(name);
    EXPECT_EQ(back.positions[0], trajectory_.positions[0]) << name;
    EXPECT_EQ(back.positions[1], trajectory_.positions[1]) << name;
  }
  EXPECT_EQ(format_, "OBJ");
  Write("a.pc2");
  const Observations back = Read("a.pc2");
  for (int o = 0; o < 2; ++o) {
    // 24 bits.
    EXPECT_LT((back.positions[o] - trajectory_.positions[o]).cwiseAbs().maxCoeff(),
              7.0 * std::numeric_limits<float>::epsilon());
    EXPECT_EQ(back.positions[o], trajectory_.positions[o].cast<float>().cast<double>());
  }
}

TEST_F(TrajectoryWriters, TheFormatMayBeNamed) {
  const struct {
    const char *name, *format;
  } kCases[] = {{"npy", "NPY"}, {"pc2", "PC2"}, {"csv", "CSV"}};
  for (const auto& c : kCases) {
    EXPECT_THAT(Write("a.obj", TrajectoryFormatFromName(c.name)),
                ElementsAre(dir_.File("a.obj")));
    Read("a.obj");
    EXPECT_EQ(format_, c.format);
  }
  EXPECT_EQ(TrajectoryFormatFromName("obj"), TrajectoryFormat::kObj);
  EXPECT_EQ(TrajectoryFormatFromName("auto"), TrajectoryFormat::kAuto);
  EXPECT_THAT(ErrorOf([] { TrajectoryFormatFromName("abc"); }),
              AllOf(HasSubstr("\"abc\""), HasSubstr("csv, obj, pc2 or npy")));
}

TEST_F(TrajectoryWriters, ObjectsThatWereNotSimulatedAreLeftOut) {
  trajectory_.positions[0].resize(0, 0);
  AttachOptions second;
  second.object = 1;
  for (const char* name : {"a.npy", "a_*.obj"}) {
    Write(name);
    const Observations back = Read(name, second);
    EXPECT_EQ(back.positions[0].size(), 0);
    EXPECT_EQ(back.positions[1], trajectory_.positions[1]);
  }
}

TEST_F(TrajectoryWriters, ObjFilesHoldTheMesh) {
  const std::vector<std::string> files = Write("a_*.obj");
  ASSERT_EQ(files.size(), 12u);
  EXPECT_EQ(files[11], dir_.File("a_0011.obj"));
  const Capture capture = ReadCapture(dir_.File("a_*.obj"));
  const auto& first = scene_.objects[0].triangles;
  const auto& second = scene_.objects[1].triangles;
  ASSERT_EQ(capture.mesh.triangles.size(), first.size() + second.size());
  EXPECT_EQ(capture.mesh.triangles[2], first[2]);
  EXPECT_EQ(capture.mesh.triangles.back()[0], 16 + second.back()[0]);
}

TEST_F(TrajectoryWriters, FramesFromAFailureOnAreLeftOut) {
  trajectory_.positions[1](4, 7) = std::numeric_limits<double>::quiet_NaN();
  Write("a.npy");
  EXPECT_EQ(Read("a.npy").num_frames(), 7);
  WriteFile(dir_.File("a_0011.obj"), "of an earlier run");
  EXPECT_EQ(Write("a_*.obj").size(), 7u);
  EXPECT_EQ(Read("a_*.obj").num_frames(), 7);
  trajectory_.positions[1](4, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(ErrorOf([&] { Write("b.pc2"); }), HasSubstr("no whole frame"));
  EXPECT_FALSE(std::filesystem::exists(dir_.File("b.pc2")));
}

// What the format's definition asks for, and readers that map files into memory need.
TEST_F(TrajectoryWriters, NumbersOfAnArrayAreAligned) {
  Write("a.npy");
  const std::string bytes = ReadFile(dir_.File("a.npy"));
  const size_t begin = bytes.find('\n') + 1;
  EXPECT_EQ(begin % 64, 0u);
  EXPECT_EQ(static_cast<unsigned char>(bytes[8]) + 10u, begin);
  EXPECT_EQ(bytes.size(), begin + 12 * 28 * 3 * 8);
}

TEST_F(TrajectoryWriters, FilesOfALongerRunAreNotMixedIn) {
  Write("a_*.obj");
  Write("a_*.obj");
  const std::string pattern = dir_.File("a_*.obj");
  EXPECT_THAT(
      ErrorOf([&] { CheckTrajectoryOutput(pattern, TrajectoryFormat::kAuto, 11); }),
      AllOf(StartsWith(pattern), HasSubstr("a_0011.obj"), HasSubstr("11 frames")));
  CheckTrajectoryOutput(pattern, TrajectoryFormat::kAuto, 12);
  for (Eigen::MatrixXd& p : trajectory_.positions) p = p.leftCols(3).eval();
  EXPECT_THAT(ErrorOf([&] { Write("a_*.obj"); }), HasSubstr("3 frames"));
}

TEST_F(TrajectoryWriters, PatternsHaveOneStar) {
  for (const char* name : {"a.obj", "a_*_*.obj", "folder_*/a.obj"}) {
    EXPECT_THAT(ErrorOf([&] { Write(name); }),
                AllOf(HasSubstr(name), HasSubstr("one '*'")));
  }
  EXPECT_THAT(ErrorOf([&] { Write("no/folder/a.npy"); }), HasSubstr("no/folder/a.npy"));
}

}  // namespace
}  // namespace dpe::test
