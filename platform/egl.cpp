// SPDX-License-Identifier: Apache-2.0
// See gl.h.
// in: libEGL.so.1, looked up while the program runs -> out: a context without a surface.
// The only file that touches the library; docs/collectors.md, "Display".
#include "platform/gl.h"

#ifdef PILEUS_WITH_EGL
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#endif

namespace pileus {

#ifdef PILEUS_WITH_EGL
namespace {

// Its threads outlive a context: the library stays once it is there.
constexpr int kKeep = RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE;

template <class Function>
bool find(const GlContext& context, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(context.parts[0], name));
    return function != nullptr;
}

void close_egl(GlContext& context) {
    decltype(&eglMakeCurrent) make_current = nullptr;
    decltype(&eglDestroyContext) destroy = nullptr;
    decltype(&eglTerminate) terminate = nullptr;
    if (context.parts[1] != nullptr && find(context, "eglMakeCurrent", make_current) &&
        find(context, "eglDestroyContext", destroy) && find(context, "eglTerminate", terminate)) {
        make_current(context.parts[1], EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context.parts[2] != nullptr) destroy(context.parts[1], context.parts[2]);
        terminate(context.parts[1]);
    }
    dlclose(context.parts[0]);
}

}  // namespace

const char* open_egl(GlContext& context) {
    context.parts[0] = dlopen("libEGL.so.1", kKeep);
    if (context.parts[0] == nullptr) return "libEGL.so.1 is not installed";
    context.close = close_egl;
    decltype(&eglGetProcAddress) look = nullptr;
    decltype(&eglInitialize) initialize = nullptr;
    decltype(&eglBindAPI) bind = nullptr;
    decltype(&eglCreateContext) create = nullptr;
    decltype(&eglMakeCurrent) make_current = nullptr;
    if (!find(context, "eglGetProcAddress", look) || !find(context, "eglInitialize", initialize) ||
        !find(context, "eglBindAPI", bind) || !find(context, "eglCreateContext", create) ||
        !find(context, "eglMakeCurrent", make_current))
        return "libEGL lacks its functions";
    const auto display_of =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(look("eglGetPlatformDisplayEXT"));
    if (display_of == nullptr) return "EGL has no platforms without a display";
    const EGLDisplay display =
        display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !initialize(display, nullptr, nullptr))
        return "EGL opens nothing without a surface";
    context.parts[1] = display;

    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             3,
                             EGL_CONTEXT_MINOR_VERSION,
                             3,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_NONE};
    if (!bind(EGL_OPENGL_API)) return "EGL has no OpenGL";
    const EGLContext opened = create(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    if (opened == EGL_NO_CONTEXT) return "EGL gives no OpenGL 3.3 core context";
    context.parts[2] = opened;
    if (!make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, opened))
        return "EGL does not make its context current";
    return load_gl(context.gl, look) ? nullptr : "EGL lacks functions of OpenGL 3.3";
}
#else
const char* open_egl(GlContext&) { return "this build has no EGL"; }
#endif

}  // namespace pileus
