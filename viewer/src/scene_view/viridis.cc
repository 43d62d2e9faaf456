#include "scene_view/viridis.h"

#include <algorithm>
#include <cmath>

namespace dpe::viewer {
namespace {

// sRGB, at equal distances, as printed by
//   python3 -c "import matplotlib as m
//   for i in range(33): print(m.colormaps['viridis'](i / 32))"
constexpr int kLast = 32;
constexpr float kTable[kLast + 1][3] = {
    {0.2670f, 0.0049f, 0.3294f}, {0.2770f, 0.0503f, 0.3757f},
    {0.2823f, 0.0950f, 0.4173f}, {0.2829f, 0.1359f, 0.4534f},
    {0.2788f, 0.1755f, 0.4834f}, {0.2706f, 0.2141f, 0.5071f},
    {0.2590f, 0.2515f, 0.5247f}, {0.2450f, 0.2877f, 0.5373f},
    {0.2297f, 0.3224f, 0.5457f}, {0.2143f, 0.3556f, 0.5512f},
    {0.1994f, 0.3876f, 0.5546f}, {0.1856f, 0.4186f, 0.5568f},
    {0.1727f, 0.4488f, 0.5579f}, {0.1607f, 0.4785f, 0.5581f},
    {0.1490f, 0.5081f, 0.5573f}, {0.1378f, 0.5375f, 0.5549f},
    {0.1276f, 0.5669f, 0.5506f}, {0.1206f, 0.5964f, 0.5436f},
    {0.1206f, 0.6258f, 0.5335f}, {0.1323f, 0.6550f, 0.5197f},
    {0.1579f, 0.6838f, 0.5017f}, {0.1966f, 0.7118f, 0.4792f},
    {0.2461f, 0.7389f, 0.4520f}, {0.3041f, 0.7647f, 0.4199f},
    {0.3692f, 0.7889f, 0.3829f}, {0.4401f, 0.8111f, 0.3410f},
    {0.5160f, 0.8312f, 0.2943f}, {0.5958f, 0.8487f, 0.2433f},
    {0.6785f, 0.8637f, 0.1895f}, {0.7624f, 0.8764f, 0.1371f},
    {0.8456f, 0.8873f, 0.0997f}, {0.9261f, 0.8973f, 0.1041f},
    {0.9932f, 0.9062f, 0.1439f},
};

float ToLinear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

glm::vec3 ViridisSrgb(float t) {
  const float at = std::clamp(t, 0.0f, 1.0f) * kLast;
  const int k = std::min(static_cast<int>(at), kLast - 1);
  const float fraction = at - static_cast<float>(k);
  glm::vec3 color;
  for (int c = 0; c < 3; ++c) {
    color[c] = kTable[k][c] + fraction * (kTable[k + 1][c] - kTable[k][c]);
  }
  return color;
}

glm::vec3 LinearFromSrgb(const glm::vec3& srgb) {
  return {ToLinear(srgb.x), ToLinear(srgb.y), ToLinear(srgb.z)};
}

}  // namespace dpe::viewer
