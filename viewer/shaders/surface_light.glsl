// Cloth is seen from both sides: the normal is turned to the viewer's side, and the back
// is darker and bluer, so that one sees which is which. Light comes from the sky (more)
// and the ground (less), from one direction, and is reflected a little.
layout(location = 0) in vec3 world_position;
layout(location = 1) in vec3 world_normal;
layout(location = 2) in vec4 surface_color;
layout(location = 3) in float has_normal;

const vec3 kBackTint = vec3(0.50, 0.58, 0.72);

// The light that a point of the surface sends to the eye, and its opacity.
vec4 Lit() {
  vec3 albedo = surface_color.rgb;
  if (!gl_FrontFacing) albedo *= kBackTint;
  // Where there is no normal nothing reflects light.
  float size = max(length(world_normal), 1e-6);
  vec3 normal = world_normal / (gl_FrontFacing ? size : -size);
  vec3 to_eye = normalize(scene.eye - world_position);
  vec3 half_way = normalize(to_eye + scene.to_light);
  float sky = 0.5 + 0.5 * normal.y;
  float ambient = mix(0.16, 0.34, sky);
  // Light that is scattered in the cloth reaches a little beyond the edge of shadow.
  float diffuse = max(0.0, (dot(normal, scene.to_light) + 0.2) / 1.2);
  float shine = 0.06 * pow(max(0.0, dot(normal, half_way)), 32.0);
  vec3 lit = albedo * (ambient + 0.72 * diffuse) + shine;
  return vec4(lit * has_normal, surface_color.a);
}
