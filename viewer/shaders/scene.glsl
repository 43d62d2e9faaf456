// What every shader is told; SceneConstants in viewer/src/render/pipelines.h says the same.
layout(push_constant) uniform Scene {
  mat4 view_projection;
  vec3 to_light;
  float clip_z_per_z;
  vec3 eye;
  float clip_w_per_z;
  vec2 viewport;
  float pixels;
  float vertical_scale;
  vec4 color;
} scene;

// The position `toward` metres nearer to the viewer in depth, at the same place on the
// screen.
vec4 Nearer(vec4 clip, float toward) {
  float z = clip.z + scene.clip_z_per_z * toward;
  float w = clip.w + scene.clip_w_per_z * toward;
  return vec4(clip.xy, w > 0.0 ? z / w * clip.w : clip.z, clip.w);
}

// Metres that a pixel measures at a position.
float MetresPerPixel(vec4 clip) {
  return 2.0 * clip.w / (scene.viewport.y * scene.vertical_scale);
}
