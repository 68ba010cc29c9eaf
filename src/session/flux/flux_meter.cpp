// SPDX-License-Identifier: Apache-2.0
// See flux_meter.h.
// in: planes, places -> out: light on them.
// docs/flux.md
#include "src/session/flux/flux_meter.h"

#include "src/base/number_text.h"
#include "src/methods/path/film_parts.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_grid.h"
#include "src/run/work_share.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

/// Rays to the sun through a plane, at least, along each of its axes.
constexpr int kDirectRays = 256;
/// Pixels along each axis of a level, where only the mean counts: they spread the paths evenly.
constexpr int kLevelPixels = 8;

}  // namespace

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (double v : values) sum += v;
    return values.empty() ? 0 : sum / double(values.size());
}

Status FluxMeter::trace(const CameraParams& camera, MeteredLight& light) {
    in_.camera = camera;
    // Each detector has noise of its own.
    in_.seed = path_.state().seed + (std::uint64_t{1} << 40) * made_++;
    PILEUS_TRY(make_film(in_, film_));
    if (context_.sharing != nullptr) in_.part = context_.sharing->part();
    PILEUS_TRY(trace_paths(in_, samples_, path_.scratch(), film_));
    if (context_.sharing != nullptr) PILEUS_TRY(share_film(*context_.sharing, film_));
    paths_ += std::uint64_t(film_.tally.paths);
    if (film_.samples < samples_)
        return {Code::kCheckFailed, "interrupted before all was measured; nothing written"};
    light = MeteredLight{};
    const double n = double(film_.pixels());
    for (std::size_t p = 0; p < film_.pixels(); ++p)
        for (int c = 0; c < 3; ++c) {
            const double error = film_error(film_, c, p);
            light.mean[c] += film_mean(film_, 0, c, p) / n;
            light.square_error[c] += error * error / (n * n);
        }
    return Status::ok();
}

Status FluxMeter::diffuse(const FluxPlane& plane, int towards, const std::array<int, 2>& pixels,
                          MeteredLight& light) {
    const Medium& m = medium();
    Camera c;
    c.orthographic = c.flux = c.has_frustum = true;
    for (std::size_t a = 0; a < 3; ++a)
        c.position_m[int(a)] = m.low_m[int(a)] + 0.5 * m.extent_m[a];
    c.position_m[plane.axis] = m.low_m[plane.axis] + plane.at_m;
    c.target_m = c.position_m;
    c.target_m[plane.axis] += towards * m.extent_m[plane.axis];
    c.up = plane.axis == 2 ? Double3{0, 1, 0} : Double3{0, 0, 1};
    c.frustum.half_width = 0.5 * m.extent_m[plane.axis == 0 ? 1 : 0];
    c.frustum.half_height = 0.5 * m.extent_m[plane.axis == 2 ? 1 : 2];
    c.resolution = pixels;
    return trace(make_camera(c, 0, m.low_m), light);
}

Status FluxMeter::direct(const FluxPlane& plane, const std::array<int, 2>& pixels,
                         std::vector<double>& share) {
    const Medium& m = medium();
    std::size_t each[2];
    for (std::size_t i = 0; i < 2; ++i)
        each[i] = std::size_t((kDirectRays + pixels[i] - 1) / pixels[i]);
    ShadowParams k{};
    k.medium = make_medium_view(m, path_.state().majorants);
    const std::size_t axis = std::size_t(plane.axis);
    const std::size_t across[2] = {axis == 0 ? 1u : 0u, axis == 2 ? 1u : 2u};
    // Nodes lie at (i + 1/2) / per_metre: one of them on the plane.
    k.nodes.size[axis] = 1;
    k.nodes.per_metre[axis] = plane.at_m > 0 ? float(0.5 / plane.at_m) : 1e20f;
    for (std::size_t i = 0; i < 2; ++i) {
        k.nodes.size[across[i]] = pixels[i] * int(each[i]);
        k.nodes.per_metre[across[i]] = float(k.nodes.size[across[i]] / m.extent_m[across[i]]);
    }
    for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = scenery_.lighting.to_sun[a];
    Buffer<float> depth;
    PILEUS_TRY(depth.resize(node_count(k.nodes), "rays to the sun"));
    PILEUS_TRY(run_rows(context_, context_.kernels->shadow_rows, k, ShadowBuffers{depth.data()},
                        std::uint32_t(k.nodes.size[1] * k.nodes.size[2])));
    share.assign(std::size_t(pixels[0]) * std::size_t(pixels[1]), 0);
    const std::size_t width = std::size_t(k.nodes.size[across[0]]);
    const double one = 1.0 / (double(each[0]) * double(each[1]));
    for (std::size_t i = 0; i < depth.size(); ++i) {
        const std::size_t x = i % width / each[0], y = i / width / each[1];
        share[y * std::size_t(pixels[0]) + x] += one * double(exp_(0.0f - depth[i]));
    }
    return Status::ok();
}

Status FluxMeter::radiance(const Double3& place_m, const Double3& direction, MeteredLight& light) {
    // Parallel rays through a picture of no width: all from one place along one direction.
    CameraParams camera{};
    const Double3 from = place_m - medium().low_m;
    for (int a = 0; a < 3; ++a) {
        camera.origin[a] = float(from[a]);
        camera.forward[a] = float(direction[a]);
    }
    camera.right[0] = camera.up[1] = 1;
    camera.width = camera.height = 1;
    camera.orthographic = 1;
    return trace(camera, light);
}

Status FluxMeter::irradiance(const Double3& place_m, const Double3& normal, MeteredLight& light) {
    Camera c;
    c.orthographic = c.flux = c.has_frustum = true;
    c.position_m = place_m;
    c.target_m = place_m + normal;
    c.up = normal.z > 0.9 || normal.z < -0.9 ? Double3{0, 1, 0} : Double3{0, 0, 1};
    c.frustum.half_width = c.frustum.half_height = 0;
    c.resolution = {1, 1};
    CameraParams camera = make_camera(c, 0, medium().low_m);
    // A unit step from a far place has lost digits.
    for (int a = 0; a < 3; ++a) camera.forward[a] = float(normal[a]);
    return trace(camera, light);
}

namespace {

/// Where the straight way from a place, box-local, to the sun meets the medium's box first; false
/// where it misses it.
bool way_into_box(const Medium& m, const std::array<float, 3>& to_sun, Double3& place) {
    double enter = 0, leave = 1e30;
    for (std::size_t a = m.grid.periodic ? 2 : 0; a < 3; ++a) {
        const double d = double(to_sun[a]), at = place[int(a)], edge = m.extent_m[a];
        if (d == 0) {
            if (at < 0 || at > edge) return false;
            continue;
        }
        const double low = -at / d, high = (edge - at) / d;
        const double first = low < high ? low : high, last = low < high ? high : low;
        enter = first > enter ? first : enter;
        leave = last < leave ? last : leave;
    }
    if (enter >= leave) return false;
    for (std::size_t a = 0; a < 3; ++a) {
        double& at = place[int(a)];
        const double edge = m.extent_m[a];
        at += enter * double(to_sun[a]);
        if (m.grid.periodic && a < 2) at -= __builtin_floor(at / edge) * edge;
        at = at < 0 ? 0 : at > edge ? edge : at;
    }
    return true;
}

}  // namespace

Status FluxMeter::sunlight(const Double3& place_m, double& share) {
    const Medium& m = medium();
    Double3 place = place_m - m.low_m;
    share = 1;
    if (!way_into_box(m, scenery_.lighting.to_sun, place)) return Status::ok();
    ShadowParams k{};
    k.medium = make_medium_view(m, path_.state().majorants);
    for (std::size_t a = 0; a < 3; ++a) {
        // The one node lies at 1/2 / per_metre.
        const double at = place[int(a)];
        k.nodes.size[a] = 1;
        k.nodes.per_metre[a] = at > 1e-18 ? float(0.5 / at) : 1e20f;
        k.to_sun[a] = scenery_.lighting.to_sun[a];
    }
    float depth = 0;
    PILEUS_TRY(run_rows(context_, context_.kernels->shadow_rows, k, ShadowBuffers{&depth}, 1));
    share = double(exp_(0.0f - depth));
    return Status::ok();
}

namespace {

FluxShare share_of(const MeteredLight& light) {
    FluxShare out;
    for (std::size_t c = 0; c < 3; ++c) {
        out.mean[c] = light.mean[c];
        out.standard_error[c] = __builtin_sqrt(light.square_error[c]);
    }
    return out;
}

/// Up and down through a level of the box.
Status read_level(const Sensor& sensor, const Scenery& scenery, FluxMeter& meter,
                  SensorReading& out) {
    const std::array<int, 2> pixels{kLevelPixels, kLevelPixels};
    const FluxPlane plane{2, sensor.height_m - scenery.world->medium.low_m[2]};
    const std::uint64_t each =
        (sensor.samples + kLevelPixels * kLevelPixels - 1) / (kLevelPixels * kLevelPixels);
    meter.set_samples(each);
    out.samples = each * kLevelPixels * kLevelPixels;
    MeteredLight light;
    PILEUS_TRY(meter.diffuse(plane, -1, pixels, light));
    out.up = share_of(light);
    PILEUS_TRY(meter.diffuse(plane, 1, pixels, light));
    out.down = share_of(light);
    const Lighting& lit = scenery.lighting;
    if (!lit.sunlit || !(lit.to_sun[2] > 0)) return Status::ok();
    std::vector<double> share;
    PILEUS_TRY(meter.direct(plane, {1, 1}, share));
    const Double3 sun = sun_at_height(lit, plane.at_m);
    for (std::size_t c = 0; c < 3; ++c) {
        out.direct[c] = mean_of(share) * double(lit.to_sun[2]) * sun[int(c)];
        out.down.mean[c] += out.direct[c];
    }
    return Status::ok();
}

/// Light on a small plane, direct and diffuse.
Status read_plane(const Sensor& sensor, const Scenery& scenery, FluxMeter& meter,
                  SensorReading& out) {
    meter.set_samples(sensor.samples);
    out.samples = sensor.samples;
    MeteredLight light;
    PILEUS_TRY(meter.irradiance(sensor.position_m, sensor.direction, light));
    out.down = share_of(light);
    const Lighting& lit = scenery.lighting;
    double slant = 0;
    for (int a = 0; a < 3; ++a) slant += sensor.direction[a] * double(lit.to_sun[std::size_t(a)]);
    if (!lit.sunlit || !(slant > 0)) return Status::ok();
    double share = 0;
    PILEUS_TRY(meter.sunlight(sensor.position_m, share));
    const Double3 sun = sun_at_height(lit, sensor.position_m[2] - scenery.world->medium.low_m[2]);
    for (std::size_t c = 0; c < 3; ++c) {
        out.direct[c] = share * slant * sun[int(c)];
        out.down.mean[c] += out.direct[c];
    }
    return Status::ok();
}

Status read_look(const Sensor& sensor, FluxMeter& meter, SensorReading& out) {
    MeteredLight light;
    meter.set_samples(sensor.samples);
    out.samples = sensor.samples;
    PILEUS_TRY(meter.radiance(sensor.position_m, sensor.direction, light));
    out.radiance = share_of(light);
    return Status::ok();
}

Status check_place(const FluxSettings& settings, const Sensor& sensor, const Scene& scene,
                   const Medium& m) {
    const std::string where = settings.sensor_file + ": " + quote_text(sensor.name);
    const double low = m.low_m[2], high = low + m.extent_m[2];
    const bool level = sensor.kind == SensorKind::kLevel;
    if (level && !(sensor.height_m >= low && sensor.height_m <= high))
        return Status::bad_input(where + ": height_m: outside of the media's box, " +
                                 number_text(sensor.height_m) + ", allowed: " + number_text(low) +
                                 " to " + number_text(high));
    if (!level && scene.ground.present && sensor.position_m.z < scene.ground.altitude_m)
        return Status::bad_input(
            where + ": position_m: below the ground, " + number_text(sensor.position_m.z) +
            " m, allowed: " + number_text(scene.ground.altitude_m) + " and above");
    return Status::ok();
}

}  // namespace

Status read_flux_sensors(const FluxSettings& settings, const Scene& scene, const Scenery& scenery,
                         FluxMeter& meter, std::vector<SensorReading>& out) {
    for (const Sensor& sensor : settings.sensors)
        PILEUS_TRY(check_place(settings, sensor, scene, scenery.world->medium));
    out.clear();
    for (const Sensor& sensor : settings.sensors) {
        SensorReading reading;
        switch (sensor.kind) {
            case SensorKind::kLook:
                PILEUS_TRY(read_look(sensor, meter, reading));
                break;
            case SensorKind::kPlane:
                PILEUS_TRY(read_plane(sensor, scenery, meter, reading));
                break;
            case SensorKind::kLevel:
                PILEUS_TRY(read_level(sensor, scenery, meter, reading));
                break;
        }
        out.push_back(reading);
    }
    return Status::ok();
}

}  // namespace pileus
