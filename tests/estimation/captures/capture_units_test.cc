#include <Eigen/LU>

#include "estimation/captures/capture_support.h"

namespace dpe::test {
namespace {

Capture TwoSamples(Capture::TimeUnit unit, double first, double second) {
  Capture capture;
  capture.path = "target";
  capture.time_unit = unit;
  for (const double time : {second, first}) {
    CaptureSample sample;
    sample.time = time;
    sample.position = {1.0, 2.0, 3.0};
    sample.sigma = 0.5;
    sample.line = 7;
    capture.samples.push_back(sample);
  }
  return capture;
}

constexpr Capture::TimeUnit kFrames = Capture::TimeUnit::kFrames;
constexpr Capture::TimeUnit kSeconds = Capture::TimeUnit::kSeconds;

TEST(CaptureUnits, LengthsAndAxes) {
  Capture capture = TwoSamples(kFrames, 0, 1);
  CaptureOptions options;
  options.scale = 0.001;
  options.up = UpAxis::kZ;
  ToSceneUnits(options, 0.02, &capture);
  EXPECT_EQ(capture.samples[0].position, Eigen::Vector3d(0.001, 0.003, -0.002));
  EXPECT_EQ(capture.samples[0].sigma, 0.0005);
}

TEST(CaptureUnits, TurningTheAxesKeepsHandedness) {
  // x cross y is z, before and after.
  Eigen::Matrix3d turned;
  for (int k = 0; k < 3; ++k) {
    Capture capture = TwoSamples(kFrames, 0, 1);
    capture.samples[0].position = Eigen::Vector3d::Unit(k);
    CaptureOptions options;
    options.up = UpAxis::kZ;
    ToSceneUnits(options, 0.02, &capture);
    turned.col(k) = capture.samples[0].position;
  }
  EXPECT_EQ(turned.determinant(), 1.0);
  EXPECT_EQ(turned.col(2), Eigen::Vector3d::UnitY());
}

TEST(CaptureUnits, AFileKnowsItsUnitUnlessTold) {
  for (const auto& [unit, metres] :
       {std::pair("mm", 1e-3), {"cm", 1e-2}, {"m", 1.0}, {"", 1.0}}) {
    Capture capture = TwoSamples(kFrames, 0, 1);
    capture.length_unit = unit;
    ToSceneUnits({}, 0.02, &capture);
    EXPECT_EQ(capture.samples[0].position.x(), metres) << unit;
  }
  Capture capture = TwoSamples(kFrames, 0, 1);
  capture.length_unit = "furlongs";
  EXPECT_THAT(ErrorOf([&] { ToSceneUnits({}, 0.02, &capture); }),
              AllOf(StartsWith("target: "), HasSubstr("'furlongs'"), HasSubstr("mm")));
  CaptureOptions options;
  options.scale = 201.168;
  ToSceneUnits(options, 0.02, &capture);
  EXPECT_EQ(capture.samples[0].position.x(), 201.168);
}

TEST(CaptureUnits, TimesBecomeFramesOfTheScene) {
  Capture capture = TwoSamples(kSeconds, 3.0, 3.1);
  ToSceneUnits({}, 0.02, &capture);
  EXPECT_NEAR(capture.samples[0].time, 5.0, 1e-12);
  EXPECT_EQ(capture.samples[1].time, 0.0);
  CaptureOptions options;
  options.origin = TimeOrigin::kFile;
  capture = TwoSamples(kSeconds, 3.0, 3.1);
  ToSceneUnits(options, 0.02, &capture);
  EXPECT_NEAR(capture.samples[1].time, 150.0, 1e-12);
}

TEST(CaptureUnits, FrameNumbersTakeTheRate) {
  Capture capture = TwoSamples(kFrames, 2, 8);
  ToSceneUnits({}, 0.02, &capture);
  EXPECT_EQ(capture.samples[0].time, 6.0);
  CaptureOptions options;
  options.rate = 60.0;
  capture = TwoSamples(kFrames, 2, 8);
  ToSceneUnits(options, 0.02, &capture);
  EXPECT_NEAR(capture.samples[0].time, 5.0, 1e-12);
  capture = TwoSamples(kFrames, 2, 8);
  capture.frame_zero_is_initial = true;
  ToSceneUnits({}, 0.02, &capture);
  EXPECT_EQ(capture.samples[0].time, 8.0);
  options.origin = TimeOrigin::kFirstSample;
  options.rate = 0.0;
  capture = TwoSamples(kFrames, 2, 8);
  capture.frame_zero_is_initial = true;
  ToSceneUnits(options, 0.02, &capture);
  EXPECT_EQ(capture.samples[0].time, 6.0);
}

TEST(CaptureUnits, OptionsThatDoNotFitAreRefused) {
  const auto error = [](Capture capture, const CaptureOptions& options) {
    return ErrorOf([&] { ToSceneUnits(options, 0.02, &capture); });
  };
  CaptureOptions options;
  options.rate = 60.0;
  EXPECT_THAT(error(TwoSamples(kSeconds, 0, 1), options), HasSubstr("rate"));
  options.rate = -60.0;
  EXPECT_THAT(error(TwoSamples(kFrames, 0, 1), options), HasSubstr("-60"));
  options = {};
  options.scale = -1.0;
  EXPECT_THAT(error(TwoSamples(kFrames, 0, 1), options), HasSubstr("scale -1"));
  options = {};
  options.origin = TimeOrigin::kFile;
  EXPECT_THAT(error(TwoSamples(kSeconds, -0.5, 1), options),
              AllOf(StartsWith("target:7: "), HasSubstr("-0.5")));
}

}  // namespace
}  // namespace dpe::test
