// SPDX-License-Identifier: Apache-2.0
// See background.h.
#include "src/picture/background.h"

#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/world/camera/view.h"
#include "src/world/solids/camera_depth.h"
#include "src/world/solids/solids.h"

namespace pileus {

void add_around(const double (&w)[3], double power, double (&k)[kAroundTerms]) {
    const double flat = power / (4 * kPi64), bent = 5 * power / (16 * kPi64);
    k[0] += flat;
    for (int a = 0; a < 3; ++a) k[1 + a] += 2 * flat * w[a];
    k[4] += bent * 3 * w[0] * w[1];
    k[5] += bent * 3 * w[1] * w[2];
    k[6] += bent * 3 * w[2] * w[0];
    k[7] += bent * 0.75 * (w[0] * w[0] - w[1] * w[1]);
    k[8] += bent * 0.25 * (3 * w[2] * w[2] - 1);
}

namespace {

/// Parts of a texel that wide, of four degrees at most: light from a wide one comes from all of it.
int parts_of(double degrees) {
    const int whole = int(degrees / 4);
    return 4 * whole < degrees ? whole + 1 : whole;
}

/// A ring of a sky map, `high_deg` to `low_deg` from the zenith, with the texels of a row.
void add_ring(const SkyMapView& map, int row, double high_deg, double low_deg,
              double (&k)[3][kAroundTerms]) {
    const SineCosine high = sincos_deg(high_deg), low = sincos_deg(low_deg);
    const SineCosine middle = sincos_deg(0.5 * (high_deg + low_deg));
    const int parts = parts_of(360.0 / map.columns), all = map.columns * parts;
    const double angle = (high.cosine - low.cosine) * 2 * kPi64 / double(all);
    for (int i = 0; i < all; ++i) {
        const double turns = (i + 0.5) / double(all) + double(map.turn_of_first);
        const SineCosine north = sincos_deg(360.0 * turns);
        const double w[3] = {middle.sine * north.sine, middle.sine * north.cosine, middle.cosine};
        for (int c = 0; c < 3; ++c) {
            const std::int64_t line = std::int64_t(map.planes == 1 ? 0 : c) * map.rows + row;
            add_around(w, double(map.radiance[line * map.columns + i / parts]) * angle, k[c]);
        }
    }
}

/// The texels of a sky map, one after the other.
void add_map(const SkyMapView& map, double (&k)[3][kAroundTerms]) {
    const double degrees = 360.0 / double(map.rows_per_turn);
    for (int row = 0; row < map.rows; ++row) {
        const double foot = double(map.foot) < row + 1.0 ? double(map.foot) : row + 1.0;
        const int parts = parts_of((foot - row) * degrees);
        const auto edge = [&](int part) { return (row + (foot - row) * part / parts) * degrees; };
        for (int part = 0; part < parts; ++part) add_ring(map, row, edge(part), edge(part + 1), k);
    }
}

}  // namespace

void light_around(const Lighting& light, double (&sums)[3][kAroundTerms]) {
    for (auto& sum : sums)
        for (double& term : sum) term = 0;
    if (light.map.columns > 0) add_map(light.map, sums);
    for (int c = 0; c < 3; ++c) {
        const std::size_t s = std::size_t(c);
        double(&sum)[kAroundTerms] = sums[c];
        const double below = light.ground.radiance()[c];
        if (light.map.columns == 0) {
            sum[0] = light.ground.present ? 0.5 * light.sky[s] : light.sky[s];
            sum[3] = light.ground.present ? 0.5 * light.sky[s] : 0;
        }
        if (light.ground.present) sum[0] += 0.5 * below, sum[3] -= 0.5 * below;
    }
}

namespace {

/// Light around a surface: the sky, and below it the ground as the sun and the sky light it.
void set_around(const Lighting& light, SolidRowsParams& k) {
    double sums[3][kAroundTerms];
    light_around(light, sums);
    for (int c = 0; c < 3; ++c) {
        const std::size_t s = std::size_t(c);
        const double(&sum)[kAroundTerms] = sums[c];
        for (int i = 0; i < kAroundTerms; ++i) k.around[c][i] = float(sum[i]);
        k.sun[c] = float(light.sun_irradiance[s] / kPi64);
    }
    // Parts of the light without the sun have none at any height.
    if (light.sun_irradiance == Double3{}) return;
    k.sun_heights = light.sun_heights;
    for (float& above : k.sun_heights.above) above = float(double(above) / kPi64);
}

/// Where the image has something nearer, that hides what was found: black, for its owner draws it.
/// A picture of another size reads the image where its pixels' corners lie.
void hide(const CameraDepth& from, const CameraParams& camera, int threads,
          const BackgroundBuffers& b) {
    const std::size_t width = std::size_t(camera.width), height = std::size_t(camera.height);
    const std::size_t columns = from.columns;
    const std::size_t rows = from.metres.size() / columns;
    parallel_for(threads, camera.height, [&](std::int64_t row, int) {
        const std::size_t y = std::size_t(row);
        const float* const line = from.metres.data() + y * rows / height * columns;
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t i = y * width + x;
            const float depth = line[columns == width ? x : x * columns / width];
            const float other = b.opaque_depth != nullptr ? b.opaque_depth[i] : __builtin_inff();
            if (!(depth < __builtin_inff()) || depth > other) continue;
            if (b.opaque_depth != nullptr) b.opaque_depth[i] = depth;
            for (std::size_t c = 0; c < 3 && b.colour != nullptr; ++c)
                b.colour[c * width * height + i] = 0;
        }
    });
}

Status show_solid_rows(const Context& context, const SolidRowsParams& k,
                       const BackgroundBuffers& b) {
    return run_rows(context, context.kernels->solid_rows, k, b,
                    std::uint32_t(k.back.camera.height));
}

}  // namespace

BackgroundParams background_params(const MediumView& medium, const CameraParams& camera,
                                   const Lighting& light) {
    BackgroundParams k{};
    k.medium = medium;
    k.camera = camera;
    k.ground = light.ground.present ? 1 : 0;
    k.ground_z = float(light.ground.z);
    for (std::size_t c = 0; c < 3; ++c) {
        k.sky[c] = float(light.sky[c]);
        k.ground_diffuse[c] = float(light.ground.diffuse[c]);
        k.ground_sun[c] = float(light.ground.sun[c]);
        k.to_sun[c] = light.to_sun[c];
        k.sun_rest[c] = 1;
    }
    k.paint = light.ground.paint;
    if (k.paint.sea != nullptr) {
        const Double3 sun = sun_at_height(light, light.ground.z);
        for (int c = 0; c < 3; ++c) {
            k.paint.sun[c] = light.ground.sun == Double3{} ? 0.0f : float(sun[c]);
            k.paint.even[c] = float(light.sky[c]);
        }
        k.paint.sky = light.map;
        k.paint.mirror_m = 0;  // of the sky alone
    }
    // Of pixels' rays; parallel ones lie as far apart as pixels.
    k.paint.texel_turn = pixel_step(camera);
    // The sky before air is the air's own (air_view.h).
    if (light.air)
        for (float& c : k.sky) c = 0;
    else
        k.sky_map = light.map;
    return k;
}

bool has_meshes(const Lighting& light) { return light.solids != nullptr && !light.solids->empty(); }

namespace {

bool has_image(const Lighting& light) {
    return light.depth != nullptr && !light.depth->metres.empty();
}

}  // namespace

Status show_nothing_behind(const Lighting& light, const CameraParams& camera, int threads,
                           Planes& planes) {
    for (float& metres : planes.opaque_depth.span()) metres = __builtin_inff();
    for (float& radiance : planes.background.span()) radiance = 0;
    if (has_image(light) && !planes.opaque_depth.empty())
        hide(*light.depth, camera, threads, {nullptr, nullptr, planes.opaque_depth.data()});
    return Status::ok();
}

bool has_surfaces(const Lighting& light) { return has_meshes(light) || has_image(light); }

Status show_background(const Context& context, const Lighting& light, const BackgroundParams& k,
                       const BackgroundBuffers& b) {
    const std::uint32_t rows = std::uint32_t(k.camera.height);
    if (!has_meshes(light)) {
        PILEUS_TRY(run_rows(context, context.kernels->background_rows, k, b, rows));
    } else {
        SolidRowsParams params{};
        params.back = k;
        params.solids = light.solids->view();
        if (b.colour != nullptr) set_around(light, params);
        PILEUS_TRY(show_solid_rows(context, params, b));
    }
    if (has_image(light)) hide(*light.depth, k.camera, context.threads, b);
    return Status::ok();
}

Status add_shadow(const Context& context, const MediumView& medium, const CameraParams& camera,
                  const Lighting& light, Image& image) {
    const StageClock clock(context, "shadow layer");
    const std::uint64_t pixels = std::uint64_t(camera.width) * std::uint64_t(camera.height);
    Buffer<float> depth, shadow;
    PILEUS_TRY(shadow.resize(pixels, "shadow"));
    for (float& v : shadow.span()) v = 0;
    if (light.sunlit && light.opaque()) {
        PILEUS_TRY(depth.resize(pixels, "shadow"));
        SolidRowsParams k{};
        k.back = background_params(medium, camera, light);
        if (light.solids != nullptr) k.solids = light.solids->view();
        BackgroundBuffers b{nullptr, nullptr, depth.data()};
        PILEUS_TRY(show_background(context, light, k.back, b));
        b.shadow = shadow.data();
        PILEUS_TRY(show_solid_rows(context, k, b));
    }
    image.channels.push_back({"shadow", std::move(shadow)});
    return Status::ok();
}

}  // namespace pileus
