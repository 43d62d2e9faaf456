#version 450
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"
#include "surface_vertex.glsl"

void main() { Place(); }
