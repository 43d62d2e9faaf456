#include "app/session.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "app/key_bindings.h"
#include "app/offscreen_app.h"
#include "app/session_io.h"
#include "dpe/engine/scene_io.h"
#include "support/temp_dir.h"
#include "support/test_scenes.h"

namespace dpe::viewer {
namespace {

class SessionTest : public testing::Test {
 protected:
  SessionTest() : session_(Sources(), {}, {}) {}

  static PlayerSources Sources() {
    PlayerSources sources;
    sources.scene = test::MakeDerivativeScene("side", 4);
    return sources;
  }
  void Press(int key) {
    const KeyBinding binding = BindingOf(key);
    if (binding.color) session_.SetColor(*binding.color);
    session_.Do(binding.action);
    for (int k = 0; k < 10000 && session_.player().IsWaiting(); ++k) {
      session_.Update(0.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  nlohmann::json State() { return nlohmann::json::parse(StateJson(session_, {})); }

  Session session_;
};

TEST_F(SessionTest, KeysDoWhatTheirDescriptionSays) {
  Press(GLFW_KEY_RIGHT);
  Press(GLFW_KEY_RIGHT);
  EXPECT_EQ(State()["frame"], 2);
  Press(GLFW_KEY_LEFT);
  EXPECT_EQ(State()["frame"], 1);
  Press(GLFW_KEY_HOME);
  EXPECT_EQ(State()["frame"], 0);
  EXPECT_EQ(State()["paused"], true);
  Press(GLFW_KEY_SPACE);
  EXPECT_EQ(State()["paused"], false);
  Press(GLFW_KEY_SPACE);
  EXPECT_EQ(State()["paused"], true);
  const char* const colors[] = {"plain",   "stiffness", "mass",
                                "stretch", "speed",     "distance"};
  for (int k = 0; k < 6; ++k) {
    Press(GLFW_KEY_1 + k);
    EXPECT_EQ(State()["color"], colors[k]);
  }
  const double distance = State()["camera"]["distance"];
  Press(GLFW_KEY_W);
  EXPECT_NEAR(State()["camera"]["distance"], 0.9 * distance, 1e-4);
  Press(GLFW_KEY_S);
  EXPECT_NEAR(State()["camera"]["distance"], distance, 1e-4);
  const nlohmann::json home = State()["camera"];
  session_.Orbit(50, 20, 600);
  session_.Pan(50, 20, 600);
  session_.Zoom(2);
  EXPECT_NE(State()["camera"], home);
  Press(GLFW_KEY_R);
  EXPECT_EQ(State()["camera"], home);
  session_.Pan(50, 20, 600);
  Press(GLFW_KEY_F);
  EXPECT_NEAR(State()["camera"]["target"][0], home["target"][0], 1e-4);
  Press(GLFW_KEY_H);
  EXPECT_EQ(State()["help"], true);
  Press(GLFW_KEY_P);
  EXPECT_TRUE(session_.TakePngRequest());
  EXPECT_FALSE(session_.TakePngRequest());
  EXPECT_FALSE(session_.wants_quit());
  Press(GLFW_KEY_ESCAPE);
  EXPECT_TRUE(session_.wants_quit());
}

TEST_F(SessionTest, NothingChangesWhileNothingIsDone) {
  session_.Update(0.0);
  EXPECT_FALSE(session_.Update(1.0));
  EXPECT_FALSE(session_.IsMoving());
  session_.Zoom(1);
  EXPECT_TRUE(session_.Update(2.0));
  EXPECT_FALSE(session_.Update(3.0));
}

// As that of a minimised window on some systems.
TEST_F(SessionTest, APictureWithoutPixelsIsMadeAllTheSame) {
  const Picture picture = session_.MakePicture(0, 0, 306);
  ASSERT_EQ(picture.surfaces.size(), 1);
  for (int k = 0; k < 16; ++k) {
    EXPECT_TRUE(std::isfinite(picture.camera.projection[k / 4][k % 4])) << k;
    EXPECT_TRUE(std::isfinite(picture.camera.view[k / 4][k % 4])) << k;
  }
}

TEST_F(SessionTest, SaysWhatTheColoursLack) {
  Press(GLFW_KEY_6);
  Picture picture = session_.MakePicture(64, 48);
  EXPECT_NE(std::string(State()["missing"]).find("--target"), std::string::npos);
  EXPECT_EQ(picture.surfaces[0].colors[0], kUnknownColor);
  EXPECT_FALSE(session_.maker().scale());  // which would be of nothing
  Press(GLFW_KEY_7);
  picture = session_.MakePicture(64, 48);
  EXPECT_NE(std::string(State()["missing"]).find("--report"), std::string::npos);
  EXPECT_EQ(picture.surfaces[0].colors[0], kUnknownColor);
  Press(GLFW_KEY_4);
  picture = session_.MakePicture(64, 48);
  EXPECT_EQ(State()["missing"], "");
  EXPECT_NE(picture.surfaces[0].colors[0], kUnknownColor);
  EXPECT_TRUE(session_.maker().scale());
}

TEST_F(SessionTest, SavesTheSceneAsItIsTurned) {
  const test::TempDir folder;
  Tuning tuning = session_.player().tuning();
  tuning.objects[0].stiffness_factor = 2.0;
  tuning.objects[0].damping = 0.75;
  tuning.wind = {1.0, 2.0, 3.0};
  session_.player().SetTuning(tuning);
  session_.SaveScene(folder.File("tuned.txt"));
  const Scene saved = LoadScene(folder.File("tuned.txt"));
  const Scene& scene = session_.player().scene();
  EXPECT_EQ(saved.objects[0].stiffness, 2.0 * scene.objects[0].stiffness);
  EXPECT_EQ(saved.objects[0].mass, scene.objects[0].mass);
  EXPECT_EQ(saved.objects[0].damping, 0.75);
  EXPECT_EQ(saved.wind, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(saved.objects[0].positions, scene.objects[0].positions);
  session_.SaveScene(folder.File("no/such/folder.txt"));
  EXPECT_NE(session_.message().find("no/such/folder.txt"), std::string::npos);
}

TEST(NumberedNameTest, PutsTheNumberInItsPlace) {
  EXPECT_EQ(NumberedName("out_%04d.png", 7), "out_0007.png");
  EXPECT_EQ(NumberedName("%d", 123), "123");
  EXPECT_EQ(NumberedName("100%_%2d", 12345), "100%_12345");
  for (const char* bad : {"out.png", "%s.png", "%d_%d.png", "%", "%5"}) {
    EXPECT_THROW(NumberedName(bad, 1), SceneError) << bad;
  }
}

}  // namespace
}  // namespace dpe::viewer
