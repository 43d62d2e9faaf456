#version 450
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;

layout(location = 0) out vec3 world_position;
layout(location = 1) out vec3 world_normal;
layout(location = 2) out vec4 surface_color;

void main() {
  gl_Position = scene.view_projection * vec4(position, 1.0);
  world_position = position;
  world_normal = normal;
  surface_color = color;
}
