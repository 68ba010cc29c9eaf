// SPDX-License-Identifier: Apache-2.0
// See follow.h.
#include "lab/views/follow.h"

#include "lab/views/views.h"
#include "platform/fp_mode.h"
#include "src/io/volumes/weather_file.h"
#include "src/methods/scenery.h"
#include "src/session/run_context.h"
#include "src/world/place_scene.h"

namespace pileus {

namespace {

/// Of a method whose light is chosen and whose majorants are made.
Status follow(const Context& context, const FrameView& view, const CollectorsMethod& method,
              int light, std::uint32_t number, PhotonWay& way) {
    const std::vector<Light>& lights = method.state().lights.lighting.lights;
    if (light < 0 || std::size_t(light) >= lights.size())
        return Status::bad_input("--light: no such light, " + std::to_string(light) +
                                 ", allowed: less than " + std::to_string(lights.size()));
    const Light& chosen = lights[std::size_t(light)];
    if (number >= chosen.photons)
        return Status::bad_input("--photon: not in the first generation of the " + chosen.name +
                                 ", " + std::to_string(number) + ", allowed: less than " +
                                 std::to_string(chosen.photons));
    way.light = chosen.name;
    follow_photon(method.trace_input(context, view), chosen, number, kMaxWayPoints, way.points);
    for (PathPoint& p : way.points)
        for (std::size_t a = 0; a < 3; ++a)
            p.at_m[a] = float(double(p.at_m[a]) + view.world.medium.low_m[a]);
    return Status::ok();
}

}  // namespace

Status follow(const Scene& scene, const RenderOptions& options, int light, std::uint32_t number,
              PhotonWay& way) {
    const FpModeGuard guard;
    Scene placed = scene;
    const std::shared_ptr<WeatherFiles> files = make_weather_files();
    PILEUS_TRY(place_scene(placed, files.get()));
    Report report;
    Context context;
    if (scene.method != kCollectorsName)
        return Status::bad_input("follow: not for method " + scene.method +
                                 ", allowed: method.name = \"collectors\"");
    PILEUS_TRY(make_context(scene, options, context, report));
    MethodRow row;
    PILEUS_TRY(find_view(scene.method, "photons", row));
    auto method =
        std::make_unique<ViewMethod>(View::kPhotons, MethodInputs{placed, options.budget, false});
    const CollectorsMethod& prepared = *method;
    MadeMethod made;
    made.report = view_report(*method);
    made.method = std::move(method);
    Scenery scenery(placed);
    scenery.weather = files;
    Plan plan;
    PILEUS_TRY(open_method(row, made, context, true, nullptr, nullptr, scenery, plan));
    return follow(context, scenery.view(0), prepared, light, number, way);
}

}  // namespace pileus
