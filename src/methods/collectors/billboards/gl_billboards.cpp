// SPDX-License-Identifier: Apache-2.0
// See gl_billboards.h.
// in: spheres projected and ordered as for the built-in blender -> out: one draw per three colours.
// docs/collectors.md, "Display". Blending (1 - A, 1) adds what lies behind to what lies before.
#include "src/methods/collectors/billboards/gl_billboards.h"

#include "platform/fp_mode.h"
#include "platform/gl.h"
#include "platform/threads.h"
#include "src/methods/collectors/billboards/billboard_spheres.h"
#include "src/methods/collectors/billboards/gl_shaders.h"

namespace pileus {
namespace {

// Numbers of the OpenGL specification.
constexpr unsigned kTexture2D = 0x0DE1, kRgba = 0x1908, kRed = 0x1903, kFloat = 0x1406;
constexpr int kRgba32f = 0x8814, kR32f = 0x822E, kNearest = 0x2600;
constexpr unsigned kMinFilter = 0x2801, kMagFilter = 0x2800;
constexpr unsigned kFramebuffer = 0x8D40, kColour0 = 0x8CE0, kComplete = 0x8CD5;
constexpr unsigned kVertexShader = 0x8B31, kPixelShader = 0x8B30, kCompiled = 0x8B81,
                   kLinked = 0x8B82;
constexpr unsigned kArrayBuffer = 0x8892, kStreamDraw = 0x88E0, kTriangleStrip = 0x0005;
constexpr unsigned kBlend = 0x0BE2, kOneMinusTargetAlpha = 0x0305, kOne = 1, kColourBit = 0x4000;
constexpr int kMaxSide = 16384;
constexpr int kVectors = 6, kFloats = 4 * kVectors;  // per sphere

bool compile(const GlApi& gl, unsigned program, unsigned kind, const char* text) {
    const unsigned shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    int good = 0;
    gl.GetShaderiv(shader, kCompiled, &good);
    gl.AttachShader(program, shader);
    return good != 0;
}

unsigned make_texture(const GlApi& gl) {
    unsigned name = 0;
    gl.GenTextures(1, &name);
    gl.BindTexture(kTexture2D, name);
    gl.TexParameteri(kTexture2D, kMinFilter, kNearest);
    gl.TexParameteri(kTexture2D, kMagFilter, kNearest);
    return name;
}

/// The numbers of one sphere in the order of the vertex shader.
void fill_sphere(const BlendSphere& s, const float* colour, float* to) {
    const float numbers[kFloats] = {s.ex,
                                    s.ey,
                                    s.lean,
                                    s.half_scale,
                                    float(s.column),
                                    s.column_part,
                                    float(s.row),
                                    s.row_part,
                                    s.x,
                                    s.y,
                                    s.z,
                                    s.radius_squared,
                                    colour[0],
                                    colour[1],
                                    colour[2],
                                    s.extinction,
                                    float(s.x0),
                                    float(s.y0),
                                    float(s.x1),
                                    float(s.y1),
                                    float(s.kind),
                                    0,
                                    0,
                                    0};
    for (int i = 0; i < kFloats; ++i) to[i] = numbers[i];
}

/// All spheres front to back, with the colours of three channels from `first` on.
void fill_spheres(const BillboardScene& scene, const BillboardLists& lists, int first,
                  Buffer<float>& instances) {
    for (std::size_t i = 0; i < lists.order.size(); ++i) {
        const BlendSphere& s = lists.spheres[lists.order[i]];
        float colour[3] = {};
        for (int k = 0; k < 3 && first + k < scene.channels; ++k)
            colour[k] = scene.colour[std::size_t(first + k) * scene.count + s.index];
        fill_sphere(s, colour, instances.data() + i * kFloats);
    }
}

void set_view(const GlApi& gl, unsigned program, const CameraParams& c, bool solid) {
    gl.UseProgram(program);
    gl.Uniform4f(gl.GetUniformLocation(program, "view"), c.half_width, c.half_height,
                 2.0f / float(c.width), 2.0f / float(c.height));
    gl.Uniform2i(gl.GetUniformLocation(program, "choices"), c.orthographic, solid ? 1 : 0);
}

/// Empties the picture and draws all spheres into it.
void draw(const GlApi& gl, const CameraParams& c, const Buffer<float>& instances) {
    gl.BufferData(kArrayBuffer, std::ptrdiff_t(instances.bytes()), instances.data(), kStreamDraw);
    for (unsigned i = 0; i < unsigned(kVectors); ++i) {
        gl.EnableVertexAttribArray(i);
        gl.VertexAttribPointer(
            i, 4, kFloat, 0, kFloats * int(sizeof(float)),
            reinterpret_cast<const void*>(std::uintptr_t{i} * 4 * sizeof(float)));
        gl.VertexAttribDivisor(i, 1);
    }
    gl.Viewport(0, 0, c.width, c.height);
    gl.ClearColor(0, 0, 0, 0);
    gl.Clear(kColourBit);
    gl.Enable(kBlend);
    gl.BlendFunc(kOneMinusTargetAlpha, kOne);
    gl.DrawArraysInstanced(kTriangleStrip, 0, 4, int(instances.size() / kFloats));
}

/// Takes the picture apart into planes.
void store(const Buffer<float>& pixels, int first, int threads, BillboardImage& out) {
    const std::size_t count = out.transmittance.size(), row = std::size_t(out.width);
    parallel_for(threads, out.height, [&](std::int64_t y, int) {
        for (std::size_t i = std::size_t(y) * row; i < std::size_t(y + 1) * row; ++i) {
            const float left = 1.0f - pixels[4 * i + 3];
            out.transmittance[i] = left > 0.0f ? left : 0.0f;
            for (std::size_t k = 0; k < 3 && int(k) + first < out.channels; ++k)
                out.colour[(std::size_t(first) + k) * count + i] = pixels[4 * i + k];
        }
    });
}

Status check(const GlApi& gl, const char* what) {
    if (gl.GetError() == 0) return Status::ok();
    return Status::limit(std::string("OpenGL: ") + what + ": out of memory, or not supported");
}

Status fit_image(const BillboardScene& scene, const CameraParams& c, BillboardImage& out) {
    const std::uint64_t pixels = std::uint64_t(c.width) * std::uint64_t(c.height);
    const std::uint64_t colours = pixels * std::uint64_t(scene.channels);
    out.width = c.width, out.height = c.height, out.channels = scene.channels;
    if (out.transmittance.size() != pixels)
        PILEUS_TRY(out.transmittance.resize(pixels, "transmittance"));
    if (out.colour.size() != colours) PILEUS_TRY(out.colour.resize(colours, "colour of the media"));
    return Status::ok();
}

}  // namespace

Status open_gl_blender(Compositor compositor, GlBlender& blender) {
    const FpModeGuard guard;
    const bool osmesa = compositor == Compositor::kOsmesa;
    const char* why = osmesa ? open_osmesa(blender.context) : open_egl(blender.context);
    const std::string name = osmesa ? "osmesa" : "egl";
    if (why != nullptr)
        return Status::bad_input("collectors.compositor: not available here, \"" + name + "\", " +
                                 why + ", allowed: builtin");
    const GlApi& gl = blender.context.gl;
    blender.program = gl.CreateProgram();
    int good = 0;
    if (compile(gl, blender.program, kVertexShader, kGlVertexShader) &&
        compile(gl, blender.program, kPixelShader, kGlPixelShader)) {
        gl.LinkProgram(blender.program);
        gl.GetProgramiv(blender.program, kLinked, &good);
    }
    unsigned array = 0, framebuffer = 0;
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.GenBuffers(1, &blender.vertices);
    gl.BindBuffer(kArrayBuffer, blender.vertices);
    blender.solid = make_texture(gl);
    blender.picture = make_texture(gl);
    gl.TexImage2D(kTexture2D, 0, kRgba32f, 16, 16, 0, kRgba, kFloat, nullptr);
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(kFramebuffer, framebuffer);
    gl.FramebufferTexture2D(kFramebuffer, kColour0, kTexture2D, blender.picture, 0);
    if (good == 0 || gl.CheckFramebufferStatus(kFramebuffer) != kComplete || gl.GetError() != 0)
        return Status::bad_input(
            "collectors.compositor: its OpenGL draws no pictures of floats, \"" + name +
            "\", allowed: builtin");
    return Status::ok();
}

Status blend_by_gl(GlBlender& blender, const BillboardScene& scene, const CameraParams& camera,
                   int threads, BillboardImage& out) {
    PILEUS_TRY(check_billboards(scene, camera));
    if (scene.half_depth)
        return Status::bad_input("collectors.compositor: knows no half depth, allowed: builtin");
    if (camera.width > kMaxSide || camera.height > kMaxSide)
        return Status::limit("OpenGL: more than 16384 pixels a side");
    if (threads < 1) threads = hardware_threads();
    BillboardLists lists;
    PILEUS_TRY(project_billboards(scene, camera, threads, lists));
    PILEUS_TRY(fit_image(scene, camera, out));
    Buffer<float> instances, pixels;
    PILEUS_TRY(instances.resize(std::uint64_t(scene.count) * kFloats, "spheres for OpenGL"));
    PILEUS_TRY(pixels.resize(4 * out.transmittance.size(), "picture from OpenGL"));

    // A driver may change the floating-point mode and leave it so.
    const FpModeGuard guard;
    const GlApi& gl = blender.context.gl;
    const bool solid = scene.opaque_depth != nullptr;
    gl.BindTexture(kTexture2D, blender.picture);
    gl.TexImage2D(kTexture2D, 0, kRgba32f, camera.width, camera.height, 0, kRgba, kFloat, nullptr);
    gl.BindTexture(kTexture2D, blender.solid);
    if (solid)
        gl.TexImage2D(kTexture2D, 0, kR32f, camera.width, camera.height, 0, kRed, kFloat,
                      scene.opaque_depth);
    PILEUS_TRY(check(gl, "pictures"));
    set_view(gl, blender.program, camera, solid);
    for (int first = 0; first < scene.channels; first += 3) {
        fill_spheres(scene, lists, first, instances);
        draw(gl, camera, instances);
        gl.ReadPixels(0, 0, camera.width, camera.height, kRgba, kFloat, pixels.data());
        PILEUS_TRY(check(gl, "drawing"));
        store(pixels, first, threads, out);
    }
    return Status::ok();
}

}  // namespace pileus
