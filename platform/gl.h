// SPDX-License-Identifier: Apache-2.0
// The few OpenGL 3.3 functions that the foreign compositors call, and a context that lends them.
// in: a library's way to look up functions -> out: function pointers; no OpenGL header is needed.
// docs/collectors.md, "Display".
#pragma once
#include <cstddef>

namespace pileus {

/// Types and order of arguments as in the OpenGL specification.
#define PILEUS_GL_FUNCTIONS(X)                                                                \
    X(void, GenTextures, (int, unsigned*))                                                    \
    X(void, BindTexture, (unsigned, unsigned))                                                \
    X(void, TexImage2D, (unsigned, int, int, int, int, int, unsigned, unsigned, const void*)) \
    X(void, TexParameteri, (unsigned, unsigned, int))                                         \
    X(void, GenFramebuffers, (int, unsigned*))                                                \
    X(void, BindFramebuffer, (unsigned, unsigned))                                            \
    X(void, FramebufferTexture2D, (unsigned, unsigned, unsigned, unsigned, int))              \
    X(unsigned, CheckFramebufferStatus, (unsigned))                                           \
    X(unsigned, CreateShader, (unsigned))                                                     \
    X(void, ShaderSource, (unsigned, int, const char* const*, const int*))                    \
    X(void, CompileShader, (unsigned))                                                        \
    X(void, GetShaderiv, (unsigned, unsigned, int*))                                          \
    X(void, GetShaderInfoLog, (unsigned, int, int*, char*))                                   \
    X(unsigned, CreateProgram, ())                                                            \
    X(void, AttachShader, (unsigned, unsigned))                                               \
    X(void, LinkProgram, (unsigned))                                                          \
    X(void, GetProgramiv, (unsigned, unsigned, int*))                                         \
    X(void, UseProgram, (unsigned))                                                           \
    X(int, GetUniformLocation, (unsigned, const char*))                                       \
    X(void, Uniform2i, (int, int, int))                                                       \
    X(void, Uniform4f, (int, float, float, float, float))                                     \
    X(void, GenVertexArrays, (int, unsigned*))                                                \
    X(void, BindVertexArray, (unsigned))                                                      \
    X(void, GenBuffers, (int, unsigned*))                                                     \
    X(void, BindBuffer, (unsigned, unsigned))                                                 \
    X(void, BufferData, (unsigned, std::ptrdiff_t, const void*, unsigned))                    \
    X(void, VertexAttribPointer, (unsigned, int, unsigned, unsigned char, int, const void*))  \
    X(void, EnableVertexAttribArray, (unsigned))                                              \
    X(void, VertexAttribDivisor, (unsigned, unsigned))                                        \
    X(void, Viewport, (int, int, int, int))                                                   \
    X(void, ClearColor, (float, float, float, float))                                         \
    X(void, Clear, (unsigned))                                                                \
    X(void, Enable, (unsigned))                                                               \
    X(void, BlendFunc, (unsigned, unsigned))                                                  \
    X(void, DrawArraysInstanced, (unsigned, int, int, int))                                   \
    X(void, ReadPixels, (int, int, int, int, unsigned, unsigned, void*))                      \
    X(unsigned, GetError, ())                                                                 \
    X(const unsigned char*, GetString, (unsigned))

struct GlApi {
#define PILEUS_GL_POINTER(result, name, arguments) result(*name) arguments = nullptr;
    PILEUS_GL_FUNCTIONS(PILEUS_GL_POINTER)
#undef PILEUS_GL_POINTER
};

/// An open context, current in the thread that opened it; closes with its owner.
struct GlContext {
    GlApi gl;
    void* parts[4] = {};
    void (*close)(GlContext&) = nullptr;

    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    ~GlContext() {
        if (close != nullptr) close(*this);
    }
};

using GlFunction = void (*)();

/// Fills `gl` by look(name); false where a function is missing.
template <class Look>
bool load_gl(GlApi& gl, Look look) {
#define PILEUS_GL_LOAD(result, name, arguments)                        \
    gl.name = reinterpret_cast<result(*) arguments>(look("gl" #name)); \
    if (gl.name == nullptr) return false;
    PILEUS_GL_FUNCTIONS(PILEUS_GL_LOAD)
#undef PILEUS_GL_LOAD
    return true;
}

// By EGL without a surface: Mesa's software renderer or a graphics card, no display needed. What
// follows OSMesa, which Mesa has dropped.

/// Opens an OpenGL 3.3 core context. Null when it is open, else the reason in a few words. The
/// library is loaded by the first call, not when the program starts.
const char* open_egl(GlContext& context);

// By OSMesa: Mesa's renderer into memory, without display, window or graphics card. Mesa has
// dropped OSMesa since 25.1.

/// Opens an OpenGL 3.3 core context. Null when it is open, else the reason in a few words. The
/// library is loaded by the first call, not when the program starts.
const char* open_osmesa(GlContext& context);

}  // namespace pileus
