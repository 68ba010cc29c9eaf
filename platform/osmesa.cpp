// SPDX-License-Identifier: Apache-2.0
// See gl.h.
// in: libOSMesa.so.8, looked up while the program runs -> out: a context with a buffer of its own.
// The only file that touches the library; docs/collectors.md, "Display".
#include "platform/gl.h"

#ifdef PILEUS_WITH_OSMESA
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <cstdlib>
#endif

namespace pileus {

#ifdef PILEUS_WITH_OSMESA
namespace {

// Its threads outlive a context: the library stays once it is there.
constexpr int kKeep = RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE;
constexpr int kSide = 16;  // of the buffer that a context must have; pictures have their own

void* find(void* library, const char* name) { return dlsym(library, name); }

void close_osmesa(GlContext& context) {
    const auto destroy = reinterpret_cast<decltype(&OSMesaDestroyContext)>(
        find(context.parts[0], "OSMesaDestroyContext"));
    if (context.parts[1] != nullptr && destroy != nullptr)
        destroy(static_cast<OSMesaContext>(context.parts[1]));
    std::free(context.parts[2]);
    dlclose(context.parts[0]);
}

}  // namespace

const char* open_osmesa(GlContext& context) {
    context.parts[0] = dlopen("libOSMesa.so.8", kKeep);
    if (context.parts[0] == nullptr) return "libOSMesa.so.8 is not installed";
    context.close = close_osmesa;
    void* library = context.parts[0];
    const auto create = reinterpret_cast<decltype(&OSMesaCreateContextAttribs)>(
        find(library, "OSMesaCreateContextAttribs"));
    const auto make_current =
        reinterpret_cast<decltype(&OSMesaMakeCurrent)>(find(library, "OSMesaMakeCurrent"));
    const auto look =
        reinterpret_cast<decltype(&OSMesaGetProcAddress)>(find(library, "OSMesaGetProcAddress"));
    if (create == nullptr || make_current == nullptr || look == nullptr)
        return "libOSMesa lacks its functions";

    const int wanted[] = {OSMESA_FORMAT,
                          OSMESA_RGBA,
                          OSMESA_PROFILE,
                          OSMESA_CORE_PROFILE,
                          OSMESA_CONTEXT_MAJOR_VERSION,
                          3,
                          OSMESA_CONTEXT_MINOR_VERSION,
                          3,
                          0};
    OSMesaContext opened = create(wanted, nullptr);
    context.parts[1] = opened;
    if (opened == nullptr) return "OSMesa gives no OpenGL 3.3 core context";
    context.parts[2] = std::malloc(kSide * kSide * 4);
    if (context.parts[2] == nullptr) return "out of memory";
    if (!make_current(opened, context.parts[2], 0x1401 /* GL_UNSIGNED_BYTE */, kSide, kSide))
        return "OSMesa does not make its context current";
    return load_gl(context.gl, look) ? nullptr : "OSMesa lacks functions of OpenGL 3.3";
}
#else
const char* open_osmesa(GlContext&) { return "this build has no OSMesa"; }
#endif

}  // namespace pileus
