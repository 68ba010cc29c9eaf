// SPDX-License-Identifier: Apache-2.0
// pileus._core.Sky: a whole sky, whose session's setters are those of pileus._core.Session.
// in: numbers and arrays of Python -> out: pixels in those arrays, arrays of light. docs/python.md
#include "tools/python/handles.h"

namespace pileus_python {
namespace {

/// A session that its sky frees; what it was made of outlives it.
struct Sky : Session {
    std::vector<std::shared_ptr<World>> worlds;
    std::unique_ptr<pileus_sky, Freed> sky;

    Sky() = default;
    Sky(const Sky&) = delete;
    Sky& operator=(const Sky&) = delete;
    ~Sky() { (void)session.release(); }
};

std::unique_ptr<Sky> make_sky(const Scene& scene, std::uint32_t threads, const std::string& isa,
                              std::uint64_t memory_limit) {
    auto sky = std::make_unique<Sky>();
    sky->host = std::make_unique<Host>(threads, isa, memory_limit);
    pileus_sky* made = nullptr;
    call([&](pileus_error* error) {
        return pileus_sky_create(scene.scene.get(), sky->host->given(), &made, error);
    });
    sky->sky.reset(made);
    sky->session.reset(pileus_sky_session(made));
    return sky;
}

void add_layer(Sky& sky, const std::shared_ptr<World>& world, const Scene& scene) {
    const Turn turn(sky);
    sky.worlds.push_back(world);
    call([&](pileus_error* error) {
        return pileus_sky_add_layer(sky.sky.get(), world->world.get(), scene.scene.get(), error);
    });
}

std::uint32_t add_kind(Sky& sky, const std::shared_ptr<World>& world, const Scene& scene) {
    const Turn turn(sky);
    sky.worlds.push_back(world);
    std::uint32_t kind = 0;
    call([&](pileus_error* error) {
        return pileus_clouds_add_kind(pileus_sky_clouds(sky.sky.get()), world->world.get(),
                                      scene.scene.get(), &kind, error);
    });
    return kind;
}

/// Kind; offset, turn, size, presence.
using Place = std::pair<std::uint32_t, std::array<double, 6>>;

void place(Sky& sky, const std::vector<Place>& numbers) {
    const Turn turn(sky);
    std::vector<pileus_cloud> places;
    for (const auto& [kind, n] : numbers) {
        auto cloud = cleared<pileus_cloud>();
        cloud.kind = kind;
        for (std::size_t a = 0; a < 3; ++a) cloud.offset_m[a] = n[a];
        cloud.yaw_deg = n[3], cloud.scale = n[4], cloud.presence = n[5];
        places.push_back(cloud);
    }
    call([&](pileus_error* error) {
        return pileus_clouds_place(pileus_sky_clouds(sky.sky.get()), places.data(),
                                   std::uint32_t(places.size()), error);
    });
}

void set_weather(Sky& sky, const std::string& metar, std::uint32_t seed, double elevation) {
    if (metar.find('\0') != std::string::npos) bad_input("metar: a zero byte, allowed: a report");
    const Turn turn(sky);
    call([&](pileus_error* error) {
        return pileus_sky_set_weather(sky.sky.get(), metar.c_str(), seed, elevation, error);
    });
}

void set_time(Sky& sky, double hours) {
    const Turn turn(sky);
    call([&](pileus_error* error) { return pileus_sky_set_time(sky.sky.get(), hours, error); });
}

void move(Sky& sky, const Three& offset) {
    const Turn turn(sky);
    call([&](pileus_error* error) { return pileus_sky_move(sky.sky.get(), offset.data(), error); });
}

/// What the host has drawn: an array, its kind, whether its first row is the lowest.
using HostDepth = std::tuple<py::array, std::uint32_t, bool>;

std::optional<std::uint64_t> render(Sky& sky, const std::optional<py::array>& colour,
                                    std::uint32_t format, std::uint32_t blend, float exposure,
                                    const std::optional<py::array>& depth, std::uint32_t depth_kind,
                                    bool wants_hash, bool bottom_up,
                                    const std::optional<HostDepth>& solid) {
    const Turn turn(sky);
    const Size size = size_of(sky);
    pileus_frame frame =
        frame_of({colour, format, blend, exposure, depth, depth_kind, bottom_up}, size);
    std::uint64_t hash = 0;
    if (wants_hash) frame.hash = &hash;
    auto image = cleared<pileus_depth_image>();
    if (solid) {
        const auto& [values, kind, up] = *solid;
        image = depth_of(values, kind, up, size, "host_depth");
    }
    call([&](pileus_error* error) {
        return pileus_sky_render(sky.sky.get(), solid ? &image : nullptr, &frame, error);
    });
    if (!wants_hash) return std::nullopt;
    return hash;
}

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A dict of arrays, a row for each of the points [n][3].
py::dict light_at(Sky& sky, const Doubles& points) {
    if (points.ndim() != 2 || points.shape(1) != 3)
        bad_input("points: shape " + text_of(points.attr("shape")) + ", allowed: (n, 3)");
    const Turn turn(sky);
    const py::ssize_t count = points.shape(0);
    if (count > 1 << 24) bad_input("points: more than 16777216, allowed: fewer at a time");
    std::vector<pileus_sky_light> places(std::size_t(count), cleared<pileus_sky_light>());
    for (py::ssize_t i = 0; i < count; ++i)
        for (py::ssize_t a = 0; a < 3; ++a) places[std::size_t(i)].position_m[a] = points.at(i, a);
    call([&](pileus_error* error) {
        return pileus_sky_light_at(sky.sky.get(), places.data(), std::uint32_t(count), error);
    });
    py::array_t<float> share(count), sun({count, py::ssize_t(3)}), level({count, py::ssize_t(3)});
    py::array_t<float> around({count, py::ssize_t(3), py::ssize_t(9)});
    py::array_t<double> extinction(count);
    for (py::ssize_t i = 0; i < count; ++i) {
        const pileus_sky_light& place = places[std::size_t(i)];
        share.mutable_at(i) = place.sun_share;
        extinction.mutable_at(i) = place.extinction_per_m;
        for (py::ssize_t c = 0; c < 3; ++c) {
            sun.mutable_at(i, c) = place.sun[c];
            level.mutable_at(i, c) = place.level[c];
            for (py::ssize_t k = 0; k < 9; ++k) around.mutable_at(i, c, k) = place.around[c][k];
        }
    }
    py::dict out;
    out["sun_share"] = share;
    out["sun"] = sun;
    out["level"] = level;
    out["extinction_per_m"] = extinction;
    out["around"] = around;
    return out;
}

using Two = std::array<double, 2>;
using Heights = py::array_t<float, py::array::c_style | py::array::forcecast>;

/// Rows of `texels` [rows][columns], RGBA8 with four channels. `heights` has the same rows.
void shadow(Sky& sky, const Two& low, const Two& extent, const py::array& texels,
            std::uint32_t format, double altitude, const std::optional<Heights>& heights,
            bool bottom_up, std::uint32_t first_row, std::uint32_t rows) {
    const Turn turn(sky);
    const std::uint32_t channels = format == PILEUS_SHADOW_RGBA8 ? 4 : 0;
    if (texels.ndim() != (channels > 0 ? 3 : 2))
        bad_input("out: shape " + text_of(texels.attr("shape")) +
                  ", allowed: " + (channels > 0 ? "(rows, columns, 4)" : "(rows, columns)"));
    constexpr py::ssize_t kMost = 65536;
    const auto height = std::uint32_t(std::min(texels.shape(0), kMost));
    const auto width = std::uint32_t(std::min(texels.shape(1), kMost));
    const char* kinds[] = {"uint8", "uint8", "float16", "float32"};
    const ArrayRows own = rows_of("out", texels, py::dtype(kinds[std::min(format, 3u)]), width,
                                  height, channels, true, "as it is");
    if (own.flipped)
        bad_input("out: rows from the last in memory on, allowed: the first, with bottom_up");
    auto map = cleared<pileus_shadow_map>();
    map.width = width, map.height = height;
    map.format = format;
    for (std::size_t a = 0; a < 2; ++a) map.low_m[a] = low[a], map.size_m[a] = extent[a];
    map.altitude_m = altitude;
    if (heights) {
        if (heights->ndim() != 2 || heights->shape(0) != texels.shape(0) ||
            heights->shape(1) != texels.shape(1))
            bad_input("altitude: shape " + text_of(heights->attr("shape")) + ", allowed: (" +
                      std::to_string(height) + ", " + std::to_string(width) +
                      "), as the map, or a number");
        map.heights = heights->data();
    }
    map.texels = own.first;
    map.stride = own.stride;
    map.bottom_up = bottom_up ? 1 : 0;
    map.first_row = first_row, map.rows = rows;
    call([&](pileus_error* error) { return pileus_sky_shadow(sky.sky.get(), &map, error); });
}

py::tuple air(Sky& sky, const Three& direction, double metres) {
    const Turn turn(sky);
    py::array_t<float> left(3), light(3);
    float* const to[2] = {left.mutable_data(), light.mutable_data()};
    call([&](pileus_error* error) {
        return pileus_sky_air(sky.sky.get(), direction.data(), metres, to[0], to[1], error);
    });
    return py::make_tuple(left, light);
}

}  // namespace

void add_sky(py::module_& module) {
    py::class_<Sky, Session>(module, "Sky")
        .def(py::init(&make_sky))
        .def("add_layer", &add_layer)
        .def("add_kind", &add_kind)
        .def("place", &place)
        .def("set_weather", &set_weather)
        .def("set_time", &set_time)
        .def("move", &move)
        .def("render", &render)
        .def("light_at", &light_at)
        .def("shadow", &shadow)
        .def("air", &air);
}

}  // namespace pileus_python
