#version 450
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

// A segment as a strip of four corners, `pixels` wide on the screen: devices need not
// draw lines wider than one pixel.
layout(location = 0) in vec3 position_a;
layout(location = 1) in vec3 position_b;
layout(location = 2) in vec4 color_a;
layout(location = 3) in vec4 color_b;

layout(location = 0) out vec4 color;

void main() {
  vec4 a = scene.view_projection * vec4(position_a, 1.0);
  vec4 b = scene.view_projection * vec4(position_b, 1.0);
  if (a.z < 0.0 && b.z < 0.0) {  // before the near plane: a corner that is clipped
    gl_Position = vec4(0.0, 0.0, -1.0, 1.0);
    color = color_a;
    return;
  }
  // What is behind the camera has no place on the screen; cut it off at the near plane.
  float begin = a.z < 0.0 ? a.z / (a.z - b.z) : 0.0;
  float end = b.z < 0.0 ? a.z / (a.z - b.z) : 1.0;
  vec4 from = mix(a, b, begin);
  vec4 to = mix(a, b, end);
  vec2 along = (to.xy / to.w - from.xy / from.w) * scene.viewport;
  float size = length(along);
  along = size > 1e-6 ? along / size : vec2(1.0, 0.0);

  bool at_end = gl_VertexIndex >= 2;
  float side = (gl_VertexIndex & 1) == 0 ? -0.5 : 0.5;
  vec4 here = at_end ? to : from;
  color = mix(color_a, color_b, at_end ? end : begin);
  vec2 across = vec2(-along.y, along.x) * side * scene.pixels;
  here.xy += 2.0 * across / scene.viewport * here.w;
  gl_Position = Nearer(here, scene.pixels * MetresPerPixel(here));
}
