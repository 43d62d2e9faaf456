#version 450
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"
#include "surface_light.glsl"

// A surface with the edges of its triangles. Barycentric coordinate i falls from 1 at
// corner i to 0 at the edge across, so that in pixels that edge is b_i / |grad b_i| away and
// corner i lies 1 / |grad b_i| from it. A pixel is covered by as much of the line, `pixels`
// wide, as a box as wide as a pixel.
layout(location = 4) in vec3 barycentric;

layout(location = 0) out vec4 result;

// Edges fade where triangles become smaller than so many widths of a line: from here ...
const float kClear = 6.0;
// ... to here. They would hide the surface, and show patterns that are none of the cloth's.
const float kGone = 2.0;

void main() {
  vec3 dx = dFdx(barycentric), dy = dFdy(barycentric);
  vec3 height = inversesqrt(max(dx * dx + dy * dy, vec3(1e-12)));  // pixels
  vec3 away = abs(barycentric) * height;
  vec3 coverage = clamp(0.5 * scene.pixels + 0.5 - away, 0.0, min(scene.pixels, 1.0));
  coverage *= clamp((height / scene.pixels - kGone) / (kClear - kGone), 0.0, 1.0);
  float edge = max(max(coverage.x, coverage.y), coverage.z);
  vec4 lit = Lit();
  result = mix(lit, vec4(scene.color.rgb, 1.0), edge * scene.color.a);
}
