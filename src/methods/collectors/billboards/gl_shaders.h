// SPDX-License-Identifier: Apache-2.0
// The shaders of gl_billboards.cpp: a rectangle per sphere, the sphere's profile per pixel.
// in: six vectors per sphere -> out: the light and the share that a sphere takes, premultiplied.
// docs/methods.md 3, each image frame, step 5: the formulas of kernels_cpu/display/blend.h. Rows
// count from the top in OpenGL's own first row, so that nothing is turned over.
#pragma once

namespace pileus {

/// Per sphere: ellipse (ex, ey, lean, half_scale), middle (column and row, whole and part), place
/// (x, y, z, R^2), light (R, G, B, extinction), rectangle (x0, y0, x1, y1), kind.
constexpr const char* kGlVertexShader = R"(#version 330 core
layout(location = 0) in vec4 ellipse_in;
layout(location = 1) in vec4 middle_in;
layout(location = 2) in vec4 place_in;
layout(location = 3) in vec4 light_in;
layout(location = 4) in vec4 rectangle;
layout(location = 5) in vec4 kind_in;
uniform vec4 view;
flat out vec4 ellipse, middle, place, light;
flat out float near_by;
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec2 pixel = mix(rectangle.xy, rectangle.zw, corner);
    gl_Position = vec4(pixel * view.zw - 1.0, 0.0, 1.0);
    ellipse = ellipse_in;
    middle = middle_in;
    place = place_in;
    light = light_in;
    near_by = kind_in.x;
}
)";

constexpr const char* kGlPixelShader = R"(#version 330 core
flat in vec4 ellipse, middle, place, light;
flat in float near_by;
uniform vec4 view;      // half width, half height, 2 / columns, 2 / rows
uniform ivec2 choices;  // orthographic, has a solid
uniform sampler2D solid;
out vec4 taken;
void main() {
    vec2 pixel = gl_FragCoord.xy - 0.5;
    vec2 s = vec2(gl_FragCoord.x * view.z - 1.0, 1.0 - gl_FragCoord.y * view.w) * view.xy;
    bool flat_view = choices.x != 0;
    float inverse = flat_view ? 1.0 : 1.0 / sqrt(dot(s, s) + 1.0);
    float centre = flat_view ? place.z : (dot(place.xy, s) + place.z) * inverse;
    float h, low;
    if (near_by == 0.0) {
        float dy = (pixel.y - middle.z) - middle.w;
        float dx = (pixel.x - middle.x) - (middle.y + ellipse.z * dy);
        float q = 1.0 - ellipse.y * dy * dy - ellipse.x * dx * dx;
        if (q <= 0.0) discard;
        h = sqrt(q) * inverse * ellipse.w;
        low = -h;
    } else {
        vec3 d = flat_view ? vec3(place.xy - s, 0.0) : cross(place.xyz, vec3(s, 1.0)) * inverse;
        float h2 = place.w - dot(d, d);
        if (h2 <= 0.0) discard;
        h = sqrt(h2);
        low = max(-h, -centre);
    }
    float high = h;
    if (choices.y != 0) high = min(h, texelFetch(solid, ivec2(pixel), 0).r - centre);
    float depth = light.w * max(high - low, 0.0);
    // A thin layer's share without cancellation; its fourth term is under 4e-9 of it.
    float share = depth < 0.01 ? depth * (1.0 - depth * (0.5 - depth / 6.0)) : 1.0 - exp(-depth);
    taken = vec4(light.rgb * share, share);
}
)";

}  // namespace pileus
