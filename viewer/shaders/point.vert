#version 450
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

// A square of four corners around a point, one pixel larger than the disc in it, where the
// edge fades.
layout(location = 0) in vec3 position;

layout(location = 0) out vec2 from_center;  // pixels

void main() {
  vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0;
  from_center = corner * (0.5 * scene.pixels + 1.0);
  vec4 clip = scene.view_projection * vec4(position, 1.0);
  clip = Nearer(clip, scene.pixels * MetresPerPixel(clip));
  clip.xy += 2.0 * from_center / scene.viewport * clip.w;
  gl_Position = clip;
}
