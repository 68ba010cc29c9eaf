// SPDX-License-Identifier: Apache-2.0
// What a flight library has in place of readers and writers of files, of checks of whole scenes,
// and of worlds made of them. in: the name of a file, a value that is not sound for sure -> out:
// one line. docs/flight.md, "Packed scenes"
#include "platform/device.h"
#include "src/base/number_text.h"
#include "src/flight/jump.h"
#include "src/io/volumes/weather_file.h"
#include "src/methods/collectors/billboards/gl_billboards.h"
#include "src/methods/path/path_state.h"
#include "src/methods/scenery.h"
#include "src/scene/read_scene.h"
#include "src/session/run_context.h"
#include "src/world/camera/places.h"
#include "src/world/environment.h"

namespace pileus {
namespace {

Status no_files(const char* what) {
    return Status::bad_input(std::string(what) +
                             ": not in a flight, allowed: what `pileus pack` packed");
}

}  // namespace

Status outline_own_world(const Scene&, WorldUse, const HostMedia&, const Context&,
                         std::shared_ptr<World>&) {
    return no_files("world");
}
Status load_world(const Scene&, const HostMedia&, const Context&, World&) {
    return no_files("world");
}
Status place_camera(Scene&, WeatherFiles*) { return Status::ok(); }
std::shared_ptr<WeatherFiles> make_weather_files() { return nullptr; }
Status check_changed(const char* key, const Scene&, void (*)(const void*, Scene&), const void*) {
    return Status::bad_input(std::string("session: ") + key +
                             ": refused in a flight, allowed: docs/flight.md, \"What may change\"");
}

Status read_sky_map(const Scene& scene, const Context&, const Image* sky, SkyMap& map) {
    if (sky == nullptr) return Status::ok();
    return make_sky_map("sky.map", *sky, scene.sky, scene.ground.present, map);
}
Status read_camera_depth(const Scene& scene, const Context&, CameraDepth&) {
    return scene.view_files.depth.empty() ? Status::ok() : no_files("camera.depth");
}

Status denoise_film(const Context&, const FrameView&, PathState&) {
    return no_files("filter.kind");
}
bool asks_for_importance(const Scene&, const World&) { return false; }
const char* why_no_importance(const FrameView&) { return "in a flight"; }
Status make_importance(const Context&, const FrameView&, const Majorants&, PathImportance&) {
    return no_files("path.importance");
}
Status open_gl_blender(Compositor, GlBlender&) { return no_files("collectors.compositor"); }
Status blend_by_gl(GlBlender&, const BillboardScene&, const CameraParams&, int, BillboardImage&) {
    return no_files("collectors.compositor");
}
bool has_cuda_device(std::string& why) {
    why = "not in a flight";
    return false;
}

bool is_sequence(const std::string&) { return false; }
Status at_key(const Scene&, const std::string& key, Status status) {
    if (!status) status.message = key + ": " + status.message;
    return status;
}
/// Of what faults tell the whole part is enough.
std::string number_text(double number) { return std::to_string(std::int64_t(number)); }
std::string number_text(float number) { return number_text(double(number)); }
std::string number_text(double number, int) { return number_text(number); }

[[noreturn]] void stop_out_of_range(std::size_t, std::size_t, std::size_t) { leave_call(); }

}  // namespace pileus
