// SPDX-License-Identifier: Apache-2.0
// pileus._core.Session: a session's functions, each under a turn of its own.
// in: numbers and arrays of Python -> out: pixels in those arrays. docs/python.md
#include "tools/python/handles.h"

namespace pileus_python {
namespace {

using Map = py::array_t<float, py::array::c_style | py::array::forcecast>;

template <class To>
void copy3(const Three& from, To (&to)[3]) {
    for (std::size_t i = 0; i < 3; ++i) to[i] = To(from[i]);
}

std::unique_ptr<Session> make_session(const std::shared_ptr<World>& world, const Scene& scene,
                                      std::uint32_t threads, const std::string& isa,
                                      std::uint64_t memory_limit, bool layers) {
    auto session = std::make_unique<Session>();
    session->world = world;
    session->host = std::make_unique<Host>(threads, isa, memory_limit, layers);
    pileus_session* made = nullptr;
    call([&](pileus_error* error) {
        return pileus_session_create(world->world.get(), scene.scene.get(), session->host->given(),
                                     &made, error);
    });
    session->session.reset(made);
    return session;
}

/// A call that hands a struct to the session.
template <class Given>
void set(Session& session, pileus_code (*setter)(pileus_session*, const Given*, pileus_error*),
         const Given& given) {
    const Turn turn(session);
    call([&](pileus_error* error) { return setter(session.session.get(), &given, error); });
}

Size size(Session& session) {
    const Turn turn(session);
    return size_of(session);
}

void set_camera(Session& session, const Three& position, const Three& target, const Three& up,
                double fov_deg, double height, const Size& size, double near, double far) {
    auto camera = cleared<pileus_camera>();
    camera.width = size[0];
    camera.height = size[1];
    copy3(position, camera.position_m);
    copy3(target, camera.target_m);
    copy3(up, camera.up);
    camera.fov_deg = fov_deg;
    camera.height_m = height;
    camera.near_m = near;
    camera.far_m = far;
    set(session, pileus_session_set_camera, camera);
}

void set_matrices(Session& session, const std::array<double, 16>& view,
                  const std::array<double, 16>& projection, int clip, const Size& size) {
    const Turn turn(session);
    call([&](pileus_error* error) {
        return pileus_session_set_matrices(session.session.get(), view.data(), projection.data(),
                                           pileus_clip(clip), size[0], size[1], error);
    });
}

void set_sun(Session& session, bool present, double azimuth_deg, double elevation_deg,
             const Three& irradiance) {
    auto sun = cleared<pileus_sun>();
    sun.present = present ? 1 : 0;
    sun.azimuth_deg = azimuth_deg;
    sun.elevation_deg = elevation_deg;
    copy3(irradiance, sun.irradiance);
    set(session, pileus_session_set_sun, sun);
}

void set_environment(Session& session, bool present, const Three& radiance,
                     const std::optional<Map>& map, double scale, double rotation_deg) {
    auto sky = cleared<pileus_environment>();
    sky.present = present ? 1 : 0;
    copy3(radiance, sky.radiance);
    sky.map_scale = scale;
    sky.map_rotation_deg = rotation_deg;
    if (map) {
        if (map->ndim() != 3 || map->shape(2) != 3)
            bad_input("sky: shape " + text_of(map->attr("shape")) +
                      ", allowed: (rows, columns, 3)");
        for (int axis = 0; axis < 2; ++axis)
            sky.map_size[1 - axis] =
                std::uint32_t(map->shape(axis) < 65536 ? map->shape(axis) : 65536);
        if (map->size() == 0) bad_input("sky: an empty map, allowed: rows and columns");
        sky.map = map->data();
    }
    set(session, pileus_session_set_environment, sky);
}

void set_ground(Session& session, bool present, double altitude, double albedo) {
    auto ground = cleared<pileus_ground>();
    ground.present = present ? 1 : 0;
    ground.altitude_m = altitude;
    ground.albedo = albedo;
    set(session, pileus_session_set_ground, ground);
}

/// Each: type; position, direction; light; cone, penumbra, radius; azimuth, elevation; samples of
/// its shadow.
using LightNumbers = std::array<double, 16>;

void set_lamps(Session& session, const std::vector<LightNumbers>& numbers) {
    const Turn turn(session);
    std::vector<pileus_lamp> lights;
    for (const LightNumbers& n : numbers) {
        lights.push_back(cleared<pileus_lamp>());
        pileus_lamp& light = lights.back();
        light.type = std::uint32_t(n[0]);
        for (std::size_t a = 0; a < 3; ++a) {
            light.position_m[a] = n[1 + a];
            light.direction[a] = n[4 + a];
            light.light[a] = float(n[7 + a]);
        }
        light.cone_deg = n[10], light.penumbra_deg = n[11], light.radius_m = n[12];
        light.azimuth_deg = n[13], light.elevation_deg = n[14];
        light.shadow_samples = std::uint32_t(n[15] >= 0 && n[15] <= 64 ? n[15] : 65);
    }
    call([&](pileus_error* error) {
        return pileus_session_set_lamps(session.session.get(), lights.data(),
                                        std::uint32_t(lights.size()), error);
    });
}

void set_placement(Session& session, const Three& offset, double yaw_deg) {
    auto placement = cleared<pileus_placement>();
    copy3(offset, placement.offset_m);
    placement.yaw_deg = yaw_deg;
    set(session, pileus_session_set_placement, placement);
}

void set_media(Session& session, const Scene& scene) {
    const Turn turn(session);
    call([&](pileus_error* error) {
        return pileus_session_set_media(session.session.get(), scene.scene.get(), error);
    });
}

void set_depth(Session& session, const std::optional<py::array>& values, std::uint32_t kind,
               bool bottom_up) {
    const Turn turn(session);
    const pileus_depth_image depth = depth_of(values, kind, bottom_up, size_of(session));
    call([&](pileus_error* error) {
        return pileus_session_set_depth(session.session.get(), &depth, error);
    });
}

void set_frame(Session& session, std::int32_t number) {
    const Turn turn(session);
    call([&](pileus_error* error) {
        return pileus_session_set_frame(session.session.get(), number, error);
    });
}

py::tuple progress(Session& session) {
    const Turn turn(session);
    auto info = cleared<pileus_progress>();
    call([&](pileus_error* error) {
        return pileus_session_progress(session.session.get(), &info, error);
    });
    return py::make_tuple(info.whole, info.unit_photons, info.units, info.unit);
}

std::uint32_t step(Session& session, std::uint32_t units) {
    const Turn turn(session);
    std::uint32_t done = 0;
    call([&](pileus_error* error) {
        return pileus_session_step(session.session.get(), units, &done, error);
    });
    return done;
}

py::dtype dtype_of(std::uint32_t format) {
    return format == PILEUS_FORMAT_RGBA8_SRGB
               ? py::dtype("uint8")
               : py::dtype(format == PILEUS_FORMAT_RGBA16F ? "float16" : "float32");
}

using NamedArrays = std::vector<std::pair<std::string, py::array_t<float>>>;

/// Into arrays of the caller, layers into new ones; the picture's hash where it is asked for.
std::optional<std::uint64_t> render(Session& session, const std::optional<py::array>& colour,
                                    std::uint32_t format, std::uint32_t blend, float exposure,
                                    const std::optional<py::array>& depth, std::uint32_t depth_kind,
                                    bool wants_hash, bool bottom_up, const NamedArrays& named) {
    const Turn turn(session);
    const Size size = size_of(session);
    pileus_frame frame =
        frame_of({colour, format, blend, exposure, depth, depth_kind, bottom_up}, size);
    std::vector<pileus_layer> layers;
    for (const auto& layer : named) {
        const ArrayRows rows =
            rows_of("layers", layer.second, py::dtype::of<float>(), size[0], size[1], 0, true);
        layers.push_back(cleared<pileus_layer>());
        layers.back().name = layer.first.c_str();
        layers.back().values = static_cast<float*>(rows.first);
        layers.back().stride = rows.stride;
    }
    if (!layers.empty() && (frame.bottom_up != 0) != bottom_up)
        bad_input("layers: rows run the other way than those of colour, allowed: the same way");
    frame.layers = layers.data();
    frame.layer_count = std::uint32_t(layers.size());
    std::uint64_t hash = 0;
    if (wants_hash) frame.hash = &hash;
    call([&](pileus_error* error) {
        return pileus_session_render(session.session.get(), &frame, error);
    });
    if (!wants_hash) return std::nullopt;
    return hash;
}

py::tuple stats(Session& session) {
    const Turn turn(session);
    auto s = cleared<pileus_stats>();
    call([&](pileus_error* error) {
        return pileus_session_stats(session.session.get(), &s, error);
    });
    return py::make_tuple(s.prepared, s.pictures, s.units, s.shared_bytes, s.own_bytes, s.render_s,
                          s.stages_s);
}

py::bytes report(Session& session) {
    const Turn turn(session);
    const pileus_session* handle = session.session.get();
    std::size_t needed = 0;
    call([&](pileus_error* error) {
        return pileus_session_report(handle, nullptr, 0, &needed, error);
    });
    // Times may take more digits the second time.
    std::string text(needed + 4096, '\0');
    call([&](pileus_error* error) {
        return pileus_session_report(handle, text.data(), text.size(), &needed, error);
    });
    return py::bytes(text.data(), needed - 1);
}

}  // namespace

Size size_of(const Session& session) {
    Size size{};
    call([&](pileus_error* error) {
        return pileus_session_size(session.session.get(), &size[0], &size[1], error);
    });
    return size;
}

pileus_frame frame_of(const FrameArrays& arrays, const Size& size) {
    auto frame = cleared<pileus_frame>();
    frame.format = arrays.format;
    frame.blend = arrays.blend;
    frame.exposure_stops = arrays.exposure;
    frame.depth_kind = arrays.depth_kind;
    frame.bottom_up = arrays.bottom_up ? 1 : 0;
    if (arrays.colour) {
        const ArrayRows rows =
            rows_of("colour", *arrays.colour, dtype_of(arrays.format), size[0], size[1], 4, true);
        frame.colour = rows.first;
        frame.colour_stride = rows.stride;
        frame.bottom_up = rows.flipped != arrays.bottom_up ? 1 : 0;
    }
    if (arrays.depth) {
        const ArrayRows rows =
            rows_of("depth", *arrays.depth, py::dtype::of<float>(), size[0], size[1], 0, true);
        frame.depth = static_cast<float*>(rows.first);
        frame.depth_stride = rows.stride;
        const std::int32_t up = rows.flipped != arrays.bottom_up ? 1 : 0;
        if (arrays.colour && up != frame.bottom_up)
            bad_input("depth: rows run the other way than those of colour, allowed: the same way");
        frame.bottom_up = up;
    }
    return frame;
}

pileus_depth_image depth_of(const std::optional<py::array>& values, std::uint32_t kind,
                            bool bottom_up, const Size& size, const char* name) {
    auto depth = cleared<pileus_depth_image>();
    depth.kind = kind;
    if (!values) return depth;
    const ArrayRows rows =
        rows_of(name, *values, py::dtype::of<float>(), size[0], size[1], 0, false);
    depth.values = static_cast<const float*>(rows.first);
    depth.stride = rows.stride;
    depth.bottom_up = rows.flipped != bottom_up ? 1 : 0;
    return depth;
}

void add_session(py::module_& module) {
    py::class_<Session>(module, "Session")
        .def(py::init(&make_session))
        .def("size", &size)
        .def("set_camera", &set_camera)
        .def("set_matrices", &set_matrices)
        .def("set_sun", &set_sun)
        .def("set_environment", &set_environment)
        .def("set_ground", &set_ground)
        .def("set_lamps", &set_lamps)
        .def("set_media", &set_media)
        .def("set_placement", &set_placement)
        .def("set_depth", &set_depth)
        .def("set_frame", &set_frame)
        .def("progress", &progress)
        .def("step", &step)
        .def("render", &render)
        .def("stats", &stats)
        .def("report", &report)
        .def("take_lines", [](Session& session) {
            const Turn turn(session);
            return session.host->take_lines();
        });
}

}  // namespace pileus_python
