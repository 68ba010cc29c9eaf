// SPDX-License-Identifier: Apache-2.0
// See flux.h.
// in: faces of a box -> out: light that leaves and enters through each.
// docs/flux.md
#include "src/session/flux.h"

#include "src/methods/path/path.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_grid.h"
#include "src/session/run_context.h"

namespace pileus {
namespace {

/// Pixels of a side's detector, where only the mean counts.
constexpr int kSidePixels = 8;
/// Rays to the sun through a face, at least.
constexpr int kDirectRays = 256;

struct Face {
    int axis;   ///< 0..2
    bool high;  ///< of the two faces across it
    double sign() const { return high ? 1 : -1; }
};
constexpr Face kTop{2, true}, kBottom{2, false};

/// Irradiance on one side of a face: per pixel in the film, here its mean.
struct FaceLight {
    double mean[3] = {}, square_error[3] = {};
};

class Meter {
public:
    Meter(const Context& context, PathRun& run, std::uint64_t samples)
        : context_(context), run_(run), in_(path_input(context, run)), samples_(samples) {
        in_.parts = false;
        in_.ended = context.interrupted;
    }

    /// Diffuse light that leaves (`out`) or enters the box through a face; the film keeps its
    /// pixels.
    Status diffuse(const Face& face, bool out, const std::array<int, 2>& pixels, FaceLight& light);
    /// Share of the sun's rays that reach points of a face through the medium, [pixel], rows along
    /// the face's first axis.
    Status direct(const Face& face, const std::array<int, 2>& pixels, std::vector<double>& share);

    const Film& film() const { return film_; }
    std::uint64_t paths() const { return paths_; }
    const Medium& medium() const { return *in_.medium; }

private:
    Camera detector(const Face& face, bool out, const std::array<int, 2>& pixels) const;

    const Context& context_;
    PathRun& run_;
    PathInput in_;
    std::uint64_t samples_, paths_ = 0, made_ = 0;
    Film film_;
};

Camera Meter::detector(const Face& face, bool out, const std::array<int, 2>& pixels) const {
    const Medium& m = medium();
    Camera c;
    c.orthographic = c.flux = c.has_frustum = true;
    for (std::size_t a = 0; a < 3; ++a) c.position_m[a] = m.low_m[a] + 0.5 * m.extent_m[a];
    const std::size_t axis = std::size_t(face.axis);
    c.position_m[axis] = m.low_m[axis] + (face.high ? m.extent_m[axis] : 0);
    c.target_m = c.position_m;
    // What leaves the box is seen by looking into it.
    c.target_m[axis] += face.sign() * (out ? -1 : 1) * m.extent_m[axis];
    c.up = face.axis == 2 ? Double3{0, 1, 0} : Double3{0, 0, 1};
    c.frustum.half_width = 0.5 * m.extent_m[face.axis == 0 ? 1 : 0];
    c.frustum.half_height = 0.5 * m.extent_m[face.axis == 2 ? 1 : 2];
    c.resolution = pixels;
    return c;
}

Status Meter::diffuse(const Face& face, bool out, const std::array<int, 2>& pixels,
                      FaceLight& light) {
    in_.camera = make_camera(detector(face, out, pixels), 0, medium().low_m);
    // Each detector has noise of its own.
    in_.seed = run_.seed + (std::uint64_t{1} << 40) * made_++;
    PILEUS_TRY(make_film(in_, film_));
    PILEUS_TRY(trace_paths(in_, samples_, run_.scratch, film_));
    paths_ += std::uint64_t(film_.tally.paths);
    if (film_.samples < samples_)
        return {Code::kCheckFailed,
                "interrupted before all columns were measured; nothing written"};
    light = FaceLight{};
    const double n = double(film_.pixels());
    for (std::size_t p = 0; p < film_.pixels(); ++p)
        for (int c = 0; c < 3; ++c) {
            const double error = film_error(film_, c, p);
            light.mean[c] += film_mean(film_, 0, c, p) / n;
            light.square_error[c] += error * error / (n * n);
        }
    return Status::ok();
}

Status Meter::direct(const Face& face, const std::array<int, 2>& pixels,
                     std::vector<double>& share) {
    const Medium& m = medium();
    int each = 1;
    while (each * (pixels[0] < pixels[1] ? pixels[0] : pixels[1]) < kDirectRays) ++each;
    ShadowParams k{};
    k.medium = make_medium_view(m, run_.majorants);
    const std::size_t axis = std::size_t(face.axis);
    const std::size_t across[2] = {axis == 0 ? 1u : 0u, axis == 2 ? 1u : 2u};
    // Nodes lie at (i + 1/2) / per_metre: one of them on the face.
    k.nodes.size[axis] = 1;
    k.nodes.per_metre[axis] = face.high ? float(0.5 / m.extent_m[axis]) : 1e20f;
    for (std::size_t i = 0; i < 2; ++i) {
        k.nodes.size[across[i]] = pixels[i] * each;
        k.nodes.per_metre[across[i]] = float(pixels[i] * each / m.extent_m[across[i]]);
    }
    for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = run_.lighting.to_sun[a];
    Buffer<float> depth;
    PILEUS_TRY(depth.resize(node_count(k.nodes), "rays to the sun"));
    PILEUS_TRY(run_rows(context_, context_.kernels->shadow_rows, k, ShadowBuffers{depth.data()},
                        std::uint32_t(k.nodes.size[1] * k.nodes.size[2])));
    share.assign(std::size_t(pixels[0]) * std::size_t(pixels[1]), 0);
    const std::size_t width = std::size_t(k.nodes.size[across[0]]);
    const double one = 1.0 / (double(each) * double(each));
    for (std::size_t i = 0; i < depth.size(); ++i) {
        const std::size_t x = i % width / std::size_t(each), y = i / width / std::size_t(each);
        share[y * std::size_t(pixels[0]) + x] += one * double(exp_(0.0f - depth[i]));
    }
    return Status::ok();
}

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (double v : values) sum += v;
    return sum / double(values.size());
}

/// What a measurement is made of.
struct Sums {
    FaceLight up, down, into_top, into_bottom;  ///< diffuse
    std::vector<double> direct;                 ///< [column]
    FaceLight sides;                            ///< net into the box, of its level area
};

bool shines(const Lighting& light) {
    return light.map.columns > 0 || light.ground || light.sky[0] > 0 || light.sky[1] > 0 ||
           light.sky[2] > 0;
}

/// Net light into the box through one side, added as a share of its level area.
Status add_side(Meter& meter, const Face& face, const Lighting& light, FaceLight& sum) {
    const Medium& m = meter.medium();
    const std::array<int, 2> pixels{kSidePixels, kSidePixels};
    const std::size_t axis = std::size_t(face.axis);
    const double area = m.extent_m[2] / m.extent_m[axis];  // of the side over the level area
    FaceLight out, in;
    PILEUS_TRY(meter.diffuse(face, true, pixels, out));
    if (shines(light)) PILEUS_TRY(meter.diffuse(face, false, pixels, in));
    const double slant = face.sign() * double(light.to_sun[axis]);
    double direct = slant;
    if (slant < 0) {
        std::vector<double> share;
        PILEUS_TRY(meter.direct(face, pixels, share));
        direct *= mean_of(share);
    }
    for (std::size_t c = 0; c < 3; ++c) {
        sum.mean[c] += area * (in.mean[c] - out.mean[c] + direct * light.sun_irradiance[c]);
        sum.square_error[c] += area * area * (in.square_error[c] + out.square_error[c]);
    }
    return Status::ok();
}

Status measure_sides(Meter& meter, const Lighting& light, Sums& sums) {
    if (shines(light)) {
        const std::array<int, 2> pixels{kSidePixels, kSidePixels};
        PILEUS_TRY(meter.diffuse(kTop, false, pixels, sums.into_top));
        PILEUS_TRY(meter.diffuse(kBottom, false, pixels, sums.into_bottom));
    }
    if (meter.medium().grid.periodic) return Status::ok();
    for (int axis = 0; axis < 2; ++axis)
        for (const bool high : {false, true})
            PILEUS_TRY(add_side(meter, {axis, high}, light, sums.sides));
    return Status::ok();
}

/// One channel of the result.
void take_shares(const Sums& s, double level, double direct, bool absorbs, std::size_t c,
                 FluxResult& out) {
    const auto put = [&](FluxShare& share, double mean, double square) {
        share.mean[c] = level > 0 ? mean / level : 0;
        share.standard_error[c] = level > 0 ? __builtin_sqrt(square) / level : 0;
    };
    const double straight = direct * level;
    put(out.reflectance, s.up.mean[c], s.up.square_error[c]);
    put(out.transmittance, s.down.mean[c] + straight, s.down.square_error[c]);
    put(out.transmittance_direct, straight, 0);
    if (!absorbs) return;
    double net = level - straight + s.sides.mean[c] + s.into_top.mean[c] + s.into_bottom.mean[c];
    double square = s.sides.square_error[c];
    for (const FaceLight* light : {&s.up, &s.down, &s.into_top, &s.into_bottom})
        square += light->square_error[c];
    net -= s.up.mean[c] + s.down.mean[c];
    put(out.absorptance, net, square);
}

Status add_planes(const char* const (&names)[3], std::size_t pixels, Image& maps) {
    for (const char* name : names) {
        maps.channels.emplace_back();
        maps.channels.back().name = name;
        PILEUS_TRY(maps.channels.back().pixels.resize(pixels, "flux maps"));
    }
    return Status::ok();
}

/// Where pixel (x, y) of a map, north at the top, lies in a film that looks up: mirrored.
std::size_t mirrored(std::size_t pixel, const std::array<int, 2>& columns) {
    const std::size_t width = std::size_t(columns[0]);
    return pixel / width * width + (width - 1 - pixel % width);
}

Status make_maps(const std::array<int, 2>& columns, Image& maps) {
    const std::size_t n = std::size_t(columns[0]) * std::size_t(columns[1]);
    maps = Image{};
    maps.width = columns[0];
    maps.height = columns[1];
    PILEUS_TRY(add_planes({"R", "G", "B"}, n, maps));
    PILEUS_TRY(add_planes({"error.R", "error.G", "error.B"}, n, maps));
    PILEUS_TRY(add_planes({"transmittance.R", "transmittance.G", "transmittance.B"}, n, maps));
    return add_planes({"direct.R", "direct.G", "direct.B"}, n, maps);
}

Status check_flux(const Scene& scene, const Context& context, const PathRun& run) {
    const auto fault = [&](const char* what) {
        return Status::bad_input(scene.file + ": " + what);
    };
    if (scene.media.empty()) return fault("medium: none, allowed: at least one, to measure");
    if (context.kernels->device != nullptr)
        return fault("--isa: a device, allowed: an instruction set of the host");
    if (!scene.solids.empty())
        return fault("solid: fluxes are those of media alone, allowed: a scene without solids");
    if (!run.lighting.sunlit || !(run.lighting.to_sun[2] > 0))
        return fault("sun: not above the horizon, or dark, allowed: what fluxes are shares of");
    return Status::ok();
}

}  // namespace

Status measure_flux(const Scene& scene, const RenderOptions& options, const FluxSettings& settings,
                    FluxResult& out, Image& maps, Report& report) {
    Scene own = scene;
    own.method = "path";
    own.output = OutputSettings{};
    own.camera = Camera{};
    Context context;
    PILEUS_TRY(make_context(own, options, context, report));
    const Method& method = path_method();
    Budget budget = budget_of(options);
    PILEUS_TRY(method.check(own, budget));
    if (budget.error > 0 || budget.seconds > 0)
        return unknown_budget(budget.error > 0 ? "--budget error" : "--budget seconds", "flux",
                              "samples=N");
    PathRun run;
    // The first plan weighs the largest film: a pixel a column.
    PILEUS_TRY(open_run(method, own, budget, context, true, nullptr, run));
    path_aim(0, run);
    PILEUS_TRY(check_flux(own, context, run));
    out = FluxResult{};
    for (std::size_t a = 0; a < 2; ++a)
        out.columns[a] =
            settings.columns[a] > 0 ? settings.columns[a] : run.world->medium.grid.size[a];
    PILEUS_TRY(check_limit(context.limits, LimitId::kPixels,
                           std::uint64_t(out.columns[0]) * std::uint64_t(out.columns[1]),
                           "--columns"));
    out.samples = std::uint64_t(budget.samples > 0 ? budget.samples : own.path.samples_per_pixel);
    out.mu0 = double(run.lighting.to_sun[2]);

    const StageClock clock(context, "paths");
    Meter meter(context, run, out.samples);
    Sums sums;
    PILEUS_TRY(make_maps(out.columns, maps));
    const std::size_t columns = std::size_t(out.columns[0]) * std::size_t(out.columns[1]);
    double level[3];
    for (std::size_t c = 0; c < 3; ++c) {
        out.irradiance[c] = float(run.lighting.sun_irradiance[c]);
        level[c] = run.lighting.sun_irradiance[c] * out.mu0;
    }
    const auto share = [&](double light, std::size_t c) {
        return float(level[c] > 0 ? light / level[c] : 0);
    };
    PILEUS_TRY(meter.diffuse(kTop, true, out.columns, sums.up));
    for (std::size_t p = 0; p < columns; ++p)
        for (std::size_t c = 0; c < 3; ++c) {
            maps.channels[c].pixels[p] = share(film_mean(meter.film(), 0, int(c), p), c);
            maps.channels[3 + c].pixels[p] = share(film_error(meter.film(), int(c), p), c);
        }
    PILEUS_TRY(meter.direct(kBottom, out.columns, sums.direct));
    PILEUS_TRY(meter.diffuse(kBottom, true, out.columns, sums.down));
    for (std::size_t p = 0; p < columns; ++p) {
        // Rows of rays begin in the south, those of a map in the north.
        const std::size_t width = std::size_t(out.columns[0]);
        const std::size_t row = std::size_t(out.columns[1]) - 1 - p / width;
        const double straight = sums.direct[row * width + p % width];
        for (std::size_t c = 0; c < 3; ++c) {
            const double diffuse = film_mean(meter.film(), 0, int(c), mirrored(p, out.columns));
            maps.channels[6 + c].pixels[p] = float(double(share(diffuse, c)) + straight);
            maps.channels[9 + c].pixels[p] = float(level[c] > 0 ? straight : 0);
        }
    }
    const bool absorbs = !is_white(run.world->medium);
    if (absorbs) PILEUS_TRY(measure_sides(meter, run.lighting, sums));
    for (std::size_t c = 0; c < 3; ++c)
        take_shares(sums, level[c], mean_of(sums.direct), absorbs, c, out);
    out.paths = meter.paths();
    take_clocks(report);
    return Status::ok();
}

}  // namespace pileus
