// A small scene file as text, to be edited into wrong ones.
#ifndef DPE_TESTS_SUPPORT_SCENE_TEXT_H_
#define DPE_TESTS_SUPPORT_SCENE_TEXT_H_

#include <string>

namespace dpe::test {

// One triangle with two springs, vertex 0 fixed, and a sphere; all keys of the legacy
// format and none of the added ones.
std::string SmallSceneText();

// SmallSceneText with the one occurrence of `from` replaced by `to`.
// @throws std::runtime_error if there is none or more than one
std::string EditedSceneText(const std::string& from, const std::string& to);

// What ParseScene says of `text` under the name "scene.txt"; empty if it is accepted.
std::string SceneErrorOf(const std::string& text);

}  // namespace dpe::test

#endif  // DPE_TESTS_SUPPORT_SCENE_TEXT_H_
