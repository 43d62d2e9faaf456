#include "dpe/estimation/attach.h"

#include "dpe/engine/simulator.h"
#include "estimation/captures/capture_support.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

class AttachTest : public ::testing::Test {
 protected:
  static CaptureSample Sample(int marker, double time, const Eigen::Vector3d& position,
                              int line = 0, double sigma = 0.0) {
    CaptureSample sample;
    sample.marker = marker;
    sample.time = time;
    sample.position = position;
    sample.line = line;
    sample.sigma = sigma;
    return sample;
  }
  std::string Error() {
    return ErrorOf([&] { Attach(); });
  }
  Observations Attach() {
    warnings_.clear();
    return AttachCapture(capture_, scene_, options_, &warnings_);
  }
  Eigen::Vector3d Vertex(int object, int v) const {
    return scene_.objects[object].positions.segment<3>(3 * v);
  }

  AttachTest() { capture_.path = "target"; }

  Scene scene_ = MakeDerivativeScene("two_objects", 3);  // 9 and 6 vertices
  Capture capture_;
  AttachOptions options_;
  std::vector<std::string> warnings_;
};

TEST_F(AttachTest, VerticesAtFramesArePositions) {
  capture_.samples = {Sample(10, 2.0 + 5e-10, {1, 2, 3}, 2, 0.01),
                      Sample(3, 0.0, {4, 5, 6}, 3)};
  const Observations obs = Attach();
  EXPECT_TRUE(obs.samples.empty());
  EXPECT_EQ(obs.num_frames(), 3);
  EXPECT_EQ(obs.NumObserved(0), 1);
  EXPECT_EQ(obs.NumObserved(1), 1);
  EXPECT_EQ(obs.positions[1].col(2).segment<3>(3), Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(obs.sigmas.size(), 2u);
  EXPECT_EQ(obs.sigmas[0].size(), 0);
  EXPECT_EQ(obs.sigmas[1](1, 2), 0.01);
  EXPECT_TRUE(std::isnan(obs.sigmas[1](1, 1)));
}

TEST_F(AttachTest, VerticesBetweenFramesAreSamples) {
  capture_.samples = {Sample(10, 1.5, {1, 2, 3}, 2, 0.01), Sample(10, 0.5, {0, 1, 0}),
                      Sample(10, 1.0 + 1e-8, {7, 7, 7}), Sample(10, 1.0, {5, 5, 5})};
  const Observations obs = Attach();
  ASSERT_EQ(obs.markers.size(), 1u);
  EXPECT_EQ(obs.markers[0].object, 1);
  EXPECT_THAT(obs.markers[0].vertices, ElementsAre(1));
  EXPECT_THAT(obs.markers[0].weights, ElementsAre(1.0));
  ASSERT_EQ(obs.samples.size(), 3u);
  EXPECT_EQ(obs.samples[0].time, 0.5);
  EXPECT_EQ(obs.samples[1].time, 1.0 + 1e-8);
  EXPECT_EQ(obs.samples[2].sigma, 0.01);
  EXPECT_EQ(obs.NumObserved(1), 1);
}

TEST_F(AttachTest, ANamedObjectHasItsOwnNumbers) {
  options_.object = 1;
  capture_.samples = {Sample(5, 0.0, {1, 2, 3})};
  EXPECT_EQ(Attach().positions[1].col(0).tail<3>(), Eigen::Vector3d(1, 2, 3));
  capture_.samples = {Sample(6, 0.0, {1, 2, 3}, 12)};
  EXPECT_THAT(Error(), AllOf(StartsWith("target:12: "), HasSubstr("vertex is '6'"),
                             HasSubstr("0 to 5")));
  options_.object = 2;
  EXPECT_THAT(Error(), AllOf(HasSubstr("object 2"), HasSubstr("0 to 1")));
}

TEST_F(AttachTest, TheNumberOfVerticesMustBeTheScenes) {
  capture_.num_vertices = 14;
  capture_.samples = {Sample(0, 0.0, {1, 2, 3})};
  EXPECT_THAT(Error(), AllOf(StartsWith("target: "), HasSubstr("14 vertices"),
                             HasSubstr("the 15 of the scene")));
  options_.object = 0;
  EXPECT_THAT(Error(), HasSubstr("the 9 of object 0"));
  // Vertices of no face do not count if the cloth was built without them.
  capture_.num_vertices = 11;
  capture_.mesh.in_a_face.assign(11, 1);
  capture_.mesh.in_a_face[0] = capture_.mesh.in_a_face[4] = 0;
  capture_.samples = {Sample(0, 0.0, {9, 9, 9}), Sample(5, 0.0, {1, 2, 3})};
  const Observations obs = Attach();
  EXPECT_EQ(obs.NumObserved(0), 1);
  EXPECT_TRUE(obs.IsObserved(0, 3, 0));
}

TEST_F(AttachTest, GivenTwiceIsRefused) {
  capture_.samples = {Sample(1, 4.0, {1, 2, 3}, 5), Sample(1, 4.0, {1, 2, 3}, 9)};
  EXPECT_THAT(Error(),
              AllOf(StartsWith("target:9: "),
                    HasSubstr("frame 4, vertex 1 was given before, in line 5")));
  capture_.samples = {Sample(1, 0.5, {1, 2, 3}, 5), Sample(1, 0.5, {1, 2, 3}, 9)};
  EXPECT_THAT(Error(), AllOf(StartsWith("target:9: "), HasSubstr("frame 0.5, vertex 1"),
                             HasSubstr("in line 5")));
  capture_.samples = {Sample(1, 1e9, {1, 2, 3}, 5)};
  EXPECT_THAT(Error(), AllOf(StartsWith("target:5: "), HasSubstr("1e+09")));
  capture_.samples = {Sample(1, 9e6 + 0.5, {1, 2, 3}, 5)};
  EXPECT_THAT(Error(), HasSubstr("only 1 rows"));
}

TEST_F(AttachTest, ByName) {
  capture_.marker_names = {"A", "B"};
  options_.vertex_of = {{"A", 2}, {"B", 9}, {"C", 4}};
  capture_.samples = {Sample(0, 0.0, {1, 2, 3}, 2), Sample(1, 0.5, {4, 5, 6}, 3)};
  const Observations obs = Attach();
  EXPECT_TRUE(obs.IsObserved(0, 2, 0));
  ASSERT_EQ(obs.markers.size(), 1u);
  EXPECT_EQ(obs.markers[0].name, "B");
  EXPECT_EQ(obs.markers[0].object, 1);
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("'C'")));
  options_.vertex_of.erase("B");
  EXPECT_THAT(Error(), AllOf(StartsWith("target:3: "), HasSubstr("marker is 'B'"),
                             HasSubstr("A, C")));
  options_.vertex_of["B"] = 15;
  EXPECT_THAT(Error(), AllOf(HasSubstr("vertex 15"), HasSubstr("0 to 14")));
  options_.vertex_of["B"] = 2;
  capture_.samples[1].time = 0.0;
  EXPECT_THAT(Error(), AllOf(StartsWith("target:3: "), HasSubstr("marker B"),
                             HasSubstr("before as marker A, in line 2")));
}

TEST_F(AttachTest, ByPosition) {
  // On the middle of an edge of the first cloth, 1 cm above a corner of the second.
  const auto triangle = scene_.objects[0].triangles[3];
  const Eigen::Vector3d middle =
      0.5 * (Vertex(0, triangle[0]) + Vertex(0, triangle[1]));
  scene_.objects[1].positions.array() += 20.0;
  capture_.marker_names = {"never", "edge", "corner"};
  capture_.samples = {Sample(2, 3.0, {0, 50, 0}),
                      Sample(2, 0.0, Vertex(1, 5) + Eigen::Vector3d(0, 0.01, 0)),
                      Sample(1, 0.0, middle)};
  const Observations obs = Attach();
  EXPECT_TRUE(warnings_.empty());
  ASSERT_EQ(obs.markers.size(), 2u);
  const Marker &edge = obs.markers[0], &corner = obs.markers[1];
  EXPECT_EQ(edge.name, "edge");
  EXPECT_EQ(edge.object, 0);
  EXPECT_NEAR(edge.distance, 0.0, 1e-14);
  EXPECT_EQ(corner.object, 1);
  EXPECT_NEAR(corner.distance, 0.01, 1e-14);
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    at += edge.weights[k] * Vertex(0, edge.vertices[k]);
    EXPECT_EQ(corner.weights[k], corner.vertices[k] == 5 ? 1.0 : 0.0);
  }
  EXPECT_TRUE(at.isApprox(middle, 1e-14));
  // Even at frames: these are no vertices.
  ASSERT_EQ(obs.samples.size(), 3u);
  EXPECT_EQ(obs.samples[2].time, 3.0);
  EXPECT_EQ(obs.samples[2].marker, 1);
  EXPECT_EQ(obs.NumObserved(0) + obs.NumObserved(1), 0);
}

TEST_F(AttachTest, FarMarkersAreRefused) {
  capture_.marker_names = {"A"};
  // The default is half the mean length of the edges: of 3.5 m and their diagonals.
  const double limit = 0.5 * 3.5 * (2.0 + std::sqrt(2.0)) / 3.0;
  scene_.objects.resize(1);
  capture_.samples = {
      Sample(0, 0.0, Vertex(0, 4) + Eigen::Vector3d(0, limit - 1e-6, 0))};
  EXPECT_EQ(Attach().markers.size(), 1u);
  capture_.samples = {
      Sample(0, 0.0, Vertex(0, 4) + Eigen::Vector3d(0, limit + 1e-6, 0), 8)};
  EXPECT_THAT(Error(), AllOf(StartsWith("target:8: "), HasSubstr("marker A is 1.99"),
                             HasSubstr("half the mean length")));
  options_.max_distance = 2.0;
  EXPECT_EQ(Attach().markers.size(), 1u);
  options_.max_distance = 1.5;
  EXPECT_THAT(Error(), HasSubstr("at most 1.5 m"));
  options_.max_distance = -1.0;
  EXPECT_THAT(Error(), HasSubstr("-1"));
}

TEST_F(AttachTest, LateMarkersAreReported) {
  capture_.marker_names = {"A"};
  capture_.samples = {Sample(0, 2.5, Vertex(0, 4))};
  Attach();
  EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr("marker A"), HasSubstr("2.5"))));
}

TEST_F(AttachTest, ByPositionOnRequest) {
  options_.method = AttachMethod::kPosition;
  options_.object = 0;
  capture_.num_vertices = 70;  // another mesh
  capture_.samples = {Sample(69, 0.0, Vertex(0, 4))};
  const Observations obs = Attach();
  ASSERT_EQ(obs.markers.size(), 1u);
  EXPECT_EQ(obs.markers[0].name, "69");
  scene_.objects[0].triangles.clear();
  EXPECT_THAT(Error(), HasSubstr("no triangles"));
}

TEST(MarkerMapTest, ReadsAndRefuses) {
  const TempDir dir;
  const std::string path = dir.File("map.csv");
  const auto read = [&](const std::string& text) {
    WriteFile(path, text);
    return ReadMarkerMap(path);
  };
  const auto error = [&](const std::string& text) {
    return ErrorOf([&] { read(text); });
  };
  const auto map = read("marker,vertex\nleft top, 3\n\nB,0\n");
  EXPECT_EQ(map.size(), 2u);
  EXPECT_EQ(map.at("left top"), 3);
  EXPECT_THAT(error("name,vertex\n"),
              AllOf(StartsWith(path + ":1: "), HasSubstr("marker,vertex")));
  EXPECT_THAT(error("marker,vertex\nA\n"),
              AllOf(StartsWith(path + ":2: "), HasSubstr("1 fields")));
  EXPECT_THAT(error("marker,vertex\nA,-1\n"), HasSubstr("vertex is '-1'"));
  EXPECT_THAT(error("marker,vertex\nA,1\nA,2\n"),
              AllOf(StartsWith(path + ":3: "), HasSubstr("'A'")));
  EXPECT_THAT(error("marker,vertex\nA,1\nB,1\n"),
              AllOf(StartsWith(path + ":3: "), HasSubstr("'A'")));
  EXPECT_THAT(error("marker,vertex\n"), HasSubstr("no data"));
}

}  // namespace
}  // namespace dpe::test
