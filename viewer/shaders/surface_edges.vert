#version 450
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"
#include "surface_vertex.glsl"

layout(location = 3) in uint corner;  // 0, 1 or 2: another one at each corner of a triangle

layout(location = 4) out vec3 barycentric;  // interpolated over the triangle

void main() {
  Place();
  barycentric = vec3(corner == 0, corner == 1, corner == 2);
}
