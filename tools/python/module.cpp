// SPDX-License-Identifier: Apache-2.0
// pileus._core: scenes, worlds and comparisons; their manners in Python are in tools/python/src.
// in: pileus.h -> out: handles, dicts; pileus.Error for every code but 0.
// docs/python.md
#include "tools/python/handles.h"

namespace pileus_python {
namespace {

constexpr std::chrono::milliseconds kBetweenQuestions{100};

using Overrides = std::vector<std::string>;

std::vector<const char*> pointers(const Overrides& overrides) {
    std::vector<const char*> out;
    for (const std::string& text : overrides) out.push_back(text.c_str());
    return out;
}

std::unique_ptr<Scene> read_scene(const std::string& path, const Overrides& overrides) {
    const auto texts = pointers(overrides);
    pileus_scene* made = nullptr;
    call([&](pileus_error* error) {
        return pileus_scene_read(path.c_str(), texts.data(), std::uint32_t(texts.size()), &made,
                                 error);
    });
    return std::unique_ptr<Scene>(new Scene{std::unique_ptr<pileus_scene, Freed>(made)});
}

std::unique_ptr<Scene> parse_scene(const std::string& text, const std::string& directory,
                                   const Overrides& overrides) {
    if (text.find('\0') != std::string::npos) bad_input("scene: a zero byte, allowed: text");
    const auto texts = pointers(overrides);
    pileus_scene* made = nullptr;
    call([&](pileus_error* error) {
        return pileus_scene_parse(text.c_str(), directory.c_str(), texts.data(),
                                  std::uint32_t(texts.size()), &made, error);
    });
    return std::unique_ptr<Scene>(new Scene{std::unique_ptr<pileus_scene, Freed>(made)});
}

py::dict plan_scene(const Scene& scene, std::uint32_t threads) {
    const Host host(threads, "", 0);
    auto plan = cleared<pileus_plan>();
    call([&](pileus_error* error) {
        return pileus_plan_scene(scene.scene.get(), host.given(), &plan, error);
    });
    py::dict out;
    out["cells"] = py::make_tuple(plan.cells[0], plan.cells[1], plan.cells[2]);
    out["low"] = py::make_tuple(plan.low_m[0], plan.low_m[1], plan.low_m[2]);
    out["high"] = py::make_tuple(plan.high_m[0], plan.high_m[1], plan.high_m[2]);
    out["peak_bytes"] = plan.peak_bytes;
    out["world_bytes"] = plan.world_bytes;
    return out;
}

/// Numbers that lie close and aligned: forcecast copies where they do not.
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

std::shared_ptr<World> make_world(const Scene& scene, std::uint32_t threads, const std::string& isa,
                                  std::uint64_t memory_limit,
                                  const std::vector<std::pair<std::uint32_t, Floats>>& given) {
    std::vector<pileus_density> densities;
    for (const auto& [medium, values] : given) {
        if (values.ndim() != 3)
            bad_input("density[" + std::to_string(medium) + "]: " + std::to_string(values.ndim()) +
                      " axes, allowed: 3, [z, y, x]");
        auto density = cleared<pileus_density>();
        density.medium = medium;
        for (int a = 0; a < 3; ++a) {
            const py::ssize_t cells = values.shape(2 - a);
            density.size[a] = std::uint32_t(cells < 65536 ? cells : 65536);
        }
        density.values = values.data();
        densities.push_back(density);
    }
    auto world = std::make_shared<World>();
    world->host = std::make_shared<Host>(threads, isa, memory_limit);
    pileus_world* made = nullptr;
    call([&](pileus_error* error) {
        return pileus_world_create(scene.scene.get(), world->host->given(), densities.data(),
                                   std::uint32_t(densities.size()), &made, error);
    });
    world->world.reset(made);
    return world;
}

pileus_picture picture_of(const char* name, const Floats& pixels) {
    if (pixels.ndim() != 3)
        bad_input(std::string(name) + ": " + std::to_string(pixels.ndim()) +
                  " axes, allowed: 3, [row, column, channel]");
    auto picture = cleared<pileus_picture>();
    const auto size = [&](int axis) {
        return std::uint32_t(pixels.shape(axis) < 65536 ? pixels.shape(axis) : 65536);
    };
    picture.height = size(0);
    picture.width = size(1);
    picture.channels = size(2);
    picture.values = pixels.data();
    return picture;
}

py::dict compare(const Floats& a, const Floats& reference, double alpha_least, bool flip,
                 std::uint32_t threads) {
    const Host host(threads, "", 0);
    const pileus_picture pictures[2] = {picture_of("a", a), picture_of("reference", reference)};
    auto f = cleared<pileus_figures>();
    call([&](pileus_error* error) {
        return pileus_compare(&pictures[0], &pictures[1], alpha_least, flip ? 1 : 0, host.given(),
                              &f, error);
    });
    py::dict out;
    out["identical"] = f.identical != 0;
    out["pixels"] = f.pixels;
    out["cloud_pixels"] = f.cloud_pixels;
    out["not_finite"] = f.not_finite;
    out["mean"] = f.mean;
    out["mean_reference"] = f.mean_reference;
    out["rmse"] = f.rmse;
    out["relmse"] = f.relmse;
    out["relmse_trimmed"] = f.relmse_trimmed;
    out["bias"] = f.bias;
    out["largest"] = f.largest;
    out["largest_at"] = py::make_tuple(f.largest_at[0], f.largest_at[1]);
    out["percentile_999"] = f.percentile_999;
    out["relative_percentile_999"] = f.relative_percentile_999;
    out["flip"] = f.flip;
    out["flip_percentile_99"] = f.flip_percentile_99;
    out["flip_largest"] = f.flip_largest;
    return out;
}

std::array<double, 3> orbit(const std::array<double, 3>& position,
                            const std::array<double, 3>& target, double degrees) {
    std::array<double, 3> turned{};
    pileus_orbit(position.data(), target.data(), degrees, turned.data());
    return turned;
}

/// The class that _errors.py keeps for a code.
void raise_failure(const Failure& failure) {
    const py::object classes = py::module_::import("pileus._errors").attr("CLASSES");
    const py::object chosen = classes[py::int_(failure.code)];
    PyErr_SetObject(chosen.ptr(), py::str(failure.text).ptr());
}

}  // namespace

Host::Host(std::uint32_t threads, const std::string& isa, std::uint64_t memory_limit, bool layers)
    : isa_(isa) {
    host_.threads = threads;
    host_.layers = layers ? 1 : 0;
    host_.isa = isa_.empty() ? nullptr : isa_.c_str();
    host_.memory_limit = memory_limit;
    host_.user = this;
    host_.stop = stop;
    host_.log = log;
}

/// Python asks for signals in its main thread alone, and the lock is dear: ten times a second is
/// enough.
std::int32_t Host::stop(void* user) {
    Host& host = *static_cast<Host*>(user);
    const auto now = std::chrono::steady_clock::now();
    if (now - host.asked_ < kBetweenQuestions) return 0;
    host.asked_ = now;
    const PyGILState_STATE state = PyGILState_Ensure();
    const bool ends = PyErr_Occurred() != nullptr || PyErr_CheckSignals() != 0;
    PyGILState_Release(state);
    return ends ? 1 : 0;
}

void Host::log(void* user, const char* line) { static_cast<Host*>(user)->lines_.push_back(line); }

ArrayRows rows_of(const char* name, const py::array& array, const py::dtype& dtype,
                  std::uint32_t width, std::uint32_t height, std::uint32_t channels, bool writes,
                  const char* whose) {
    const std::string who(name);
    const py::ssize_t wanted[3] = {py::ssize_t(height), py::ssize_t(width), py::ssize_t(channels)};
    const py::ssize_t axes = channels > 0 ? 3 : 2;
    bool fits = array.ndim() == axes;
    for (py::ssize_t i = 0; fits && i < axes; ++i) fits = array.shape(i) == wanted[i];
    std::string shape = std::to_string(height) + ", " + std::to_string(width);
    if (channels > 0) shape += ", " + std::to_string(channels);
    if (!fits)
        bad_input(who + ": shape " + text_of(array.attr("shape")) + ", allowed: (" + shape + "), " +
                  whose);
    if (!array.dtype().equal(dtype))
        bad_input(who + ": " + text_of(array.dtype()) + ", allowed: " + text_of(dtype));
    if (writes && !array.writeable()) bad_input(who + ": read only, allowed: writeable");
    const py::ssize_t item = array.itemsize(), pixel = item * (channels > 0 ? channels : 1);
    if ((channels > 1 && array.strides(2) != item) || (width > 1 && array.strides(1) != pixel))
        bad_input(who + ": pixels that do not lie close, allowed: gaps between rows alone");
    ArrayRows rows;
    auto* first = static_cast<unsigned char*>(const_cast<void*>(array.data()));
    rows.stride = height > 1 ? array.strides(0) : pixel * py::ssize_t(width);
    rows.flipped = rows.stride < 0;
    if (rows.flipped) {
        first += rows.stride * (py::ssize_t(height) - 1);
        rows.stride = -rows.stride;
    }
    if (rows.stride < pixel * py::ssize_t(width))
        bad_input(who + ": rows that overlap, allowed: rows of their own");
    rows.first = first;
    return rows;
}

namespace {

/// pybind11 before 2.12 reads arrays of NumPy 2 as those of NumPy 1, whose layout is another.
void check_numpy() {
#if PYBIND11_VERSION_HEX < 0x020C0000
    const std::string version = text_of(py::module_::import("numpy").attr("__version__"));
    const std::string ours =
        std::to_string(PYBIND11_VERSION_MAJOR) + "." + std::to_string(PYBIND11_VERSION_MINOR);
    if (version.substr(0, version.find('.')).size() > 1 || version[0] > '1')
        throw py::import_error("pileus: NumPy " + version + " with a module that pybind11 " + ours +
                               " has built, allowed: pybind11 2.12 or newer, or NumPy 1");
#endif
}

}  // namespace

}  // namespace pileus_python

PYBIND11_MODULE(_core, module) {
    using namespace pileus_python;
    using namespace py::literals;
    py::register_local_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Failure& failure) {
            raise_failure(failure);
        }
    });
    check_numpy();
    module.attr("version") = pileus_version();
    module.attr("pybind11") = py::make_tuple(PYBIND11_VERSION_MAJOR, PYBIND11_VERSION_MINOR);
    py::class_<Scene>(module, "Scene");
    py::class_<World, std::shared_ptr<World>>(module, "World").def(py::init(&make_world));
    module.def("read_scene", &read_scene);
    module.def("parse_scene", &parse_scene);
    module.def("plan_scene", &plan_scene);
    module.def("compare", &compare);
    module.def("orbit", &orbit, "position"_a, "target"_a, "degrees"_a,
               "Turns `position` about the vertical axis through `target`, counter-clockwise seen "
               "from above, by the bits of animation.camera_orbit_deg.");
    add_session(module);
    add_sky(module);
}
