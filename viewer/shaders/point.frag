#version 450
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(location = 0) in vec2 from_center;
layout(location = 0) out vec4 result;

void main() {
  float inside = 0.5 * scene.pixels - length(from_center);
  float coverage = clamp(inside + 0.5, 0.0, 1.0);
  if (coverage == 0.0) discard;
  // A dark rim sets the mark off from a surface of its colour.
  float rim = clamp(inside - 0.5, 0.0, 1.0);
  result = vec4(scene.color.rgb * mix(0.25, 1.0, rim), scene.color.a * coverage);
}
