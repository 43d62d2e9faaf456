// Where a vertex of a surface is and what its light depends on.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;

layout(location = 0) out vec3 world_position;
layout(location = 1) out vec3 world_normal;
layout(location = 2) out vec4 surface_color;
// 1 where there is a normal. Interpolated, it shows the one vertex that has none, which
// the interpolated normal does not: its neighbours' normals take over.
layout(location = 3) out float has_normal;

void Place() {
  gl_Position = scene.view_projection * vec4(position, 1.0);
  world_position = position;
  world_normal = normal;
  surface_color = color;
  has_normal = min(length(normal), 1.0);
}
