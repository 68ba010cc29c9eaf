// SPDX-License-Identifier: Apache-2.0
// See sky_probe.h.
#include "src/clouds/sky_probe.h"

#include <algorithm>
#include <cstring>

#include "platform/fp_mode.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/picture/air_view.h"
#include "src/picture/background.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

/// A sun lower than this throws shadows that reach farther than any map.
constexpr double kLowestSine = 1e-3;

/// The pixels of a row that a source may shade, [x0, x1).
struct Reach {
    double low = 0, high = 0;  ///< of the rows, in y
    double west = 0, east = 0;
};

/// Where the square of a source falls, on places between two altitudes.
Reach reach_of(const ShadowSource& source, const SunPlane& plane, double lowest, double highest) {
    if (source.plane != nullptr) return {-1e300, 1e300, -1e300, 1e300};
    const Double3& s = plane.to_sun;
    const double way = source.radius / s.z;
    Reach out{1e300, -1e300, 1e300, -1e300};
    for (const double z : {lowest, highest}) {
        const double t = (source.middle.z - z) / s.z;
        const double x = source.middle.x - s.x * t, y = source.middle.y - s.y * t;
        out.low = std::min(out.low, y - way), out.high = std::max(out.high, y + way);
        out.west = std::min(out.west, x - way), out.east = std::max(out.east, x + way);
    }
    return out;
}

void store(ShadowFormat format, float share, unsigned char* to) {
    const auto code = static_cast<unsigned char>(share * 255.0f + 0.5f);
    switch (format) {
        case ShadowFormat::kR8:
            *to = code;
            return;
        case ShadowFormat::kRgba8:
            to[0] = to[1] = to[2] = code;
            to[3] = 255;
            return;
        case ShadowFormat::kR16F: {
            const std::uint16_t half = half_of(share);
            std::memcpy(to, &half, sizeof half);
            return;
        }
        case ShadowFormat::kR32F:
            std::memcpy(to, &share, sizeof share);
            return;
    }
}

/// As sunlight_left, but for sources that a row cannot reach.
class RowShadow {
public:
    RowShadow(const Clouds& clouds, double lowest, double highest)
        : plane_(clouds.sun_plane()), sources_(clouds.shadows()) {
        for (const ShadowSource& source : sources_)
            if (source.shadow != nullptr)
                parts_.push_back({&source, reach_of(source, plane_, lowest, highest)});
    }
    void darken(const ShadowMapTarget& t, int row, double y, float* share) const {
        const double step = t.size_m[0] / t.width;
        for (const Part& part : parts_) {
            if (y < part.reach.low || y > part.reach.high) continue;
            const double west = std::max((part.reach.west - t.low_m[0]) / step - 1, 0.0);
            if (!(west < t.width)) continue;
            const double east =
                std::min((part.reach.east - t.low_m[0]) / step + 1, double(t.width));
            for (int x = int(west); x < east; ++x) {
                const double z = altitude(t, row, x);
                const Double3 at{t.low_m[0] + (x + 0.5) * step, y, z};
                if (is_sunward(*part.source, plane_, at))
                    share[x] *= left_by(*part.source, plane_, at);
            }
        }
    }

private:
    struct Part {
        const ShadowSource* source;
        Reach reach;
    };
    static double altitude(const ShadowMapTarget& t, int row, int x) {
        if (t.heights == nullptr) return t.altitude_m;
        return double(t.heights[std::size_t(row) * std::size_t(t.width) + std::size_t(x)]);
    }

    const SunPlane& plane_;
    const std::vector<ShadowSource>& sources_;
    std::vector<Part> parts_;
};

}  // namespace

std::size_t texel_bytes(ShadowFormat format) {
    return format == ShadowFormat::kR8 ? 1 : format == ShadowFormat::kR16F ? 2 : 4;
}

Status light_at(Session& sky, Clouds& clouds, Span<const Double3> places, Span<PlaceLight> out) {
    const FpModeGuard guard;
    Scenery* around = nullptr;
    PILEUS_TRY(sky.lit(around));
    PILEUS_TRY(clouds.prepare());
    const Lighting& lighting = around->lighting;
    const Medium& medium = around->world->medium;
    const SkyMap& map = around->environment.sky_map;
    double sums[3][kAroundTerms];
    light_around(lighting, sums);
    for (std::size_t p = 0; p < places.size; ++p) {
        const Double3& at = places[p];
        PlaceLight& light = out[p];
        light = PlaceLight{};
        if (lighting.sunlit) {
            light.sun_share = sunlight_left(clouds.sun_plane(), clouds.shadows(), at);
            const Double3 sun = sun_at_height(lighting, at.z - medium.low_m.z);
            for (std::size_t c = 0; c < 3; ++c) light.sun[c] = float(sun[int(c)]) * light.sun_share;
        }
        const double sky_left = double(clouds.sky_left(at.z));
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < kAroundTerms; ++i)
                light.around[c][i] = float(sums[c][i] * sky_left);
            const double level =
                map.present() ? map.ground_irradiance[int(c)] : kPi64 * lighting.sky[c];
            light.level[c] = float(level * sky_left);
        }
        PILEUS_TRY(clouds.extinction_at(at, light.extinction_per_m));
    }
    return Status::ok();
}

Status draw_shadow_map(Session& sky, Clouds& clouds, const ShadowMapTarget& t) {
    const FpModeGuard guard;
    Scenery* around = nullptr;
    PILEUS_TRY(sky.lit(around));
    PILEUS_TRY(clouds.prepare());
    const bool lit = around->lighting.sunlit && clouds.sun_plane().to_sun.z > kLowestSine;
    double lowest = t.altitude_m, highest = t.altitude_m;
    if (t.heights != nullptr) {
        const float* const first = t.heights + std::size_t(t.first) * std::size_t(t.width);
        const std::size_t texels = std::size_t(t.count) * std::size_t(t.width);
        for (std::size_t i = 0; i < texels; ++i)
            if (!(first[i] >= -1e6f && first[i] <= 1e6f))
                return Status::bad_input(
                    "shadow.heights: a number out of range, allowed: -1e6 to "
                    "1e6 m");
        const auto ends = std::minmax_element(first, first + texels);
        lowest = double(*ends.first), highest = double(*ends.second);
    }
    const RowShadow shadow(clouds, lowest, highest);
    const std::size_t bytes = texel_bytes(t.format);
    Buffer<float> shares;
    PILEUS_TRY(shares.resize(std::uint64_t(t.count) * std::uint64_t(t.width), "shadow map"));
    parallel_for(sky.context().threads, t.count, [&](std::int64_t i, int) {
        const int row = t.first + int(i);
        float* const share = shares.data() + std::size_t(i) * std::size_t(t.width);
        for (int x = 0; x < t.width; ++x) share[x] = lit ? 1.0f : 0.0f;
        // Rows from the north, but where memory begins in the south.
        const int from_south = t.rows.bottom_up ? row : t.height - 1 - row;
        const double y = t.low_m[1] + (from_south + 0.5) * t.size_m[1] / t.height;
        if (lit) shadow.darken(t, row, y, share);
        unsigned char* const to = t.rows.first + t.rows.stride * row;
        for (int x = 0; x < t.width; ++x) store(t.format, share[x], to + std::size_t(x) * bytes);
    });
    return Status::ok();
}

Status air_along(Session& sky, const Double3& direction, double metres, AirWay& out) {
    const FpModeGuard guard;
    out = AirWay{};
    Scenery* around = nullptr;
    PILEUS_TRY(sky.lit(around));
    if (!around->environment.air.present()) return Status::ok();
    // A picture of one pixel that looks there.
    Camera camera = around->scene->camera;
    camera.target_m = camera.position_m + direction;
    const bool steep = direction.x == 0 && direction.y == 0;
    camera.up = steep ? Double3{0, 1, 0} : Double3{0, 0, 1};
    camera.has_frustum = true;
    camera.frustum = {1e-4, 1e-4, 0, 0};
    camera.resolution = {1, 1};
    Planes planes;
    PILEUS_TRY(allocate_planes(1, 1, 3, true, true, planes));
    planes.transmittance[0] = 1;
    planes.half_depth[0] = __builtin_inff();
    planes.opaque_depth[0] = float(metres);
    float light[3] = {}, behind[3] = {}, kept[3] = {};
    AirPlanes on{light, behind};
    on.kept = kept;
    const Medium& medium = around->world->medium;
    const CameraParams seen = make_camera(camera, 0, medium.low_m);
    on.bodies = false;
    PILEUS_TRY(run_air(sky.context(), *around->scene, medium, around->lighting, seen,
                       around->environment, planes, on));
    for (std::size_t c = 0; c < 3; ++c) out.left[c] = kept[c], out.light[c] = behind[c];
    return Status::ok();
}

}  // namespace pileus
