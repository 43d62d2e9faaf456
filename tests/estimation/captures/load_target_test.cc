#include "dpe/estimation/load_target.h"

#include <cmath>
#include <sstream>

#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_io.h"
#include "estimation/captures/capture_support.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

// One motion, written by different laboratories.
class LoadTargetTest : public ::testing::Test {
 protected:
  LoadTargetTest() { scene_.delta = 0.02; }

  static constexpr int kSamples = 13;  // at 60 Hz

  Eigen::Vector3d At(int v, double seconds) const {
    const Eigen::Vector3d rest = scene_.objects[0].positions.segment<3>(3 * v);
    return rest + Eigen::Vector3d(std::sin(seconds + v), seconds * seconds, -seconds);
  }

  // The plain file: m, y up, s.
  std::string Plain() const {
    std::ostringstream text;
    text.precision(17);
    text << "time,vertex,x,y,z\n";
    for (int i = 0; i < kSamples; ++i) {
      for (int v = 0; v < 9; ++v) {
        const Eigen::Vector3d p = At(v, i / 60.0);
        text << i / 60.0 << ',' << v << ',' << p[0] << ',' << p[1] << ',' << p[2]
             << '\n';
      }
    }
    return text.str();
  }

  // The same by a program that counts frames, in mm, with z up.
  std::string Millimetres() const {
    std::ostringstream text;
    text.precision(17);
    text << "frame,vertex,x,y,z\n";
    for (int i = 0; i < kSamples; ++i) {
      for (int v = 0; v < 9; ++v) {
        const Eigen::Vector3d p = 1000.0 * At(v, i / 60.0);
        text << i << ',' << v << ',' << p[0] << ',' << -p[2] << ',' << p[1] << '\n';
      }
    }
    return text.str();
  }

  Observations Load(const std::string& name, const TargetOptions& options = {}) {
    return LoadTarget(dir_.File(name), options, &scene_, &warnings_);
  }

  const TempDir dir_;
  Scene scene_ = MakeDerivativeScene("side", 3);
  std::vector<std::string> warnings_;
};

TEST_F(LoadTargetTest, MillimetresZUpAt60HzAreTheSameObservations) {
  WriteFile(dir_.File("plain"), Plain());
  WriteFile(dir_.File("mm"), Millimetres());
  TargetOptions options;
  options.capture.scale = 0.001;
  options.capture.up = UpAxis::kZ;
  options.capture.rate = 60.0;
  const Observations a = Load("plain"), b = Load("mm", options);
  // 60 Hz meets 50 Hz every tenth of a second.
  ASSERT_EQ(a.NumObserved(0), 3 * 9);
  ASSERT_EQ(b.NumObserved(0), 3 * 9);
  for (const int frame : {0, 5, 10}) {
    const Eigen::VectorXd expected = a.positions[0].col(frame);
    EXPECT_LT((b.positions[0].col(frame) - expected).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((expected.segment<3>(3) - At(1, 0.02 * frame)).norm(), 1e-14);
  }
  ASSERT_EQ(a.samples.size(), 10u * 9u);
  ASSERT_EQ(b.samples.size(), a.samples.size());
  for (size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_NEAR(b.samples[i].time, a.samples[i].time, 1e-13);
    EXPECT_EQ(b.markers[b.samples[i].marker].vertices,
              a.markers[a.samples[i].marker].vertices);
    EXPECT_LT((b.samples[i].position - a.samples[i].position).norm(), 1e-14);
  }
}

TEST_F(LoadTargetTest, TheSceneTakesOverWhatTheOptionsSay) {
  const Trajectory later = Simulator(scene_).Simulate(30);
  Trajectory seen = later;
  seen.positions[0] = later.positions[0].rightCols(10).eval();
  WriteTrajectory(dir_.File("a.npy"), TrajectoryFormat::kNpy, seen, scene_);
  const Scene before = scene_;
  Load("a.npy");
  EXPECT_EQ(scene_.objects[0].positions, before.objects[0].positions);
  TargetOptions options;
  options.start_from_target = true;
  options.follow_pins = true;
  Load("a.npy", options);
  EXPECT_EQ(scene_.objects[0].positions, seen.positions[0].col(0));
  EXPECT_EQ(scene_.objects[0].prescribed_paths.size(), 3u);
  EXPECT_EQ(scene_.objects[0].rest_length, RestLengths(before.objects[0]));
}

TEST_F(LoadTargetTest, TheRestShapeMayBeTheTexture) {
  // A sheet that hangs and whose texture is the flat one, twice as large.
  const ClothObject flat = scene_.objects[0];
  const Trajectory seen = Simulator(scene_).Simulate(20);
  for (int f = 0; f < 10; ++f) {
    std::ostringstream text;
    text.precision(17);
    for (int v = 0; v < 9; ++v) {
      const auto p = seen.positions[0].col(f + 10).segment<3>(3 * v);
      text << "v " << 100.0 * p.transpose() << "\nvt " << 0.5 * flat.positions[3 * v]
           << ' ' << 0.5 * flat.positions[3 * v + 2] << '\n';
    }
    for (const auto& [a, b, c] : flat.triangles) {
      for (int k = 0; k < 3; ++k) {
        const int v = 1 + (k == 0 ? a : k == 1 ? b : c);
        text << (k == 0 ? "f " : " ") << v << '/' << v;
      }
      text << '\n';
    }
    WriteFile(dir_.File("cm_" + std::to_string(f) + ".obj"), text.str());
  }
  TargetOptions options;
  options.capture.scale = 0.01;
  options.start_from_target = true;
  options.rest_shape = "uv:2";
  const Observations obs = Load("cm_*.obj", options);
  EXPECT_EQ(obs.num_frames(), 10);
  EXPECT_TRUE(scene_.objects[0].positions.isApprox(seen.positions[0].col(10), 1e-14));
  EXPECT_TRUE(scene_.objects[0].rest_length.isApprox(RestLengths(flat), 1e-13));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(LoadTargetTest, MarkersAreFoundByTheMap) {
  WriteFile(dir_.File("a"), "time,marker,x,y,z\n0,A,1,2,3\n");
  WriteFile(dir_.File("map"), "marker,vertex\nA,4\n");
  TargetOptions options;
  options.marker_map = dir_.File("map");
  EXPECT_TRUE(Load("a", options).IsObserved(0, 4, 0));
  EXPECT_THAT(ErrorOf([&] { Load("a"); }), HasSubstr("from the cloth"));
}

TEST_F(LoadTargetTest, AnInvalidSceneIsNotReturned) {
  std::string text = "frame,vertex,x,y,z\n";
  for (int v = 0; v < 9; ++v) text += "0," + std::to_string(v) + ",1,1,1\n";
  WriteFile(dir_.File("a"), text);
  TargetOptions options;
  options.start_from_target = true;
  EXPECT_THAT(ErrorOf([&] { Load("a", options); }), HasSubstr(dir_.File("a")));
}

TEST_F(LoadTargetTest, Names) {
  EXPECT_EQ(UpAxisFromName("z"), UpAxis::kZ);
  EXPECT_EQ(TimeOriginFromName("file"), TimeOrigin::kFile);
  EXPECT_EQ(AttachMethodFromName("position"), AttachMethod::kPosition);
  EXPECT_THAT(ErrorOf([] { UpAxisFromName("x"); }), HasSubstr("y or z"));
  EXPECT_THAT(ErrorOf([] { TimeOriginFromName("x"); }), HasSubstr("auto, first"));
  EXPECT_THAT(ErrorOf([] { AttachMethodFromName("x"); }), HasSubstr("auto, vertex"));
}

}  // namespace
}  // namespace dpe::test
