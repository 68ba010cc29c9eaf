// SPDX-License-Identifier: Apache-2.0
// See march_sea.h.
#include "src/methods/march/march_sea.h"

#include <algorithm>

#include "src/methods/march/march_parts.h"
#include "src/picture/background.h"
#include "src/world/world.h"

namespace pileus {
namespace {

constexpr int kColumns = kMirrorColumns, kRows = kMirrorRows;
/// Times that texels are mixed with those beside them: a sea is rougher than that.
constexpr int kBlurs = 3;

/// Where the picture's middle meets the ground, m, box-local; without such a place below the
/// camera.
std::array<double, 2> middle_on_ground(const CameraParams& camera, double height) {
    std::array<double, 2> at{double(camera.origin[0]), double(camera.origin[1])};
    const double down = -double(camera.forward[2]);
    if (!(down > 1e-6)) return at;
    for (std::size_t a = 0; a < 2; ++a) at[a] += double(camera.forward[a]) * height / down;
    return at;
}

/// The camera below the ground that sees by straight rays what the picture's middle sees mirrored;
/// no deeper than a few heights of the media, so that these are seen in some detail.
CameraParams mirror_camera(const CameraParams& camera, const Lighting& light, double top) {
    CameraParams dome{};
    dome.dome = 1;
    dome.width = kColumns, dome.height = kRows;
    dome.half_width = float(kPi64), dome.half_height = float(0.25 * kPi64);
    dome.right[0] = dome.up[1] = dome.forward[2] = 1;
    const double ground = light.ground.z, height = double(camera.origin[2]) - ground;
    const double most = 4 * std::max(top - ground, 1.0);
    const bool far = camera.orthographic != 0 || height > most;
    const std::array<double, 2> middle = middle_on_ground(camera, height);
    const double share = height > 0 ? std::min(most, height) / height : 0;
    for (std::size_t a = 0; a < 2; ++a) {
        const double own = double(camera.origin[a]);
        dome.origin[a] = float(far ? middle[a] + (own - middle[a]) * share : own);
    }
    dome.origin[2] = float(ground - (far ? most : height));
    return dome;
}

/// Whether any ray of the whole picture goes down: one through a corner does then.
bool sees_ground(const CameraParams& camera) {
    const float right = float(whole_width(camera)), low = float(whole_height(camera));
    for (const float x : {-0.5f, right - 0.5f})
        for (const float y : {-0.5f, low - 0.5f})
            if (picture_ray(camera, x, y).direction.z < 0) return true;
    return false;
}

/// The sky behind the media, in place of what lets it through.
void add_sky(const Lighting& light, Planes& planes, Buffer<float>& texels) {
    constexpr std::size_t kAll = std::size_t(kColumns) * kRows;
    CameraParams dome{};
    dome.dome = 1, dome.width = kColumns, dome.height = kRows;
    for (std::size_t i = 0; i < kAll; ++i) {
        float sky[3] = {float(light.sky[0]), float(light.sky[1]), float(light.sky[2])};
        if (light.map.columns > 0) {
            const Ray<float> ray =
                dome_ray(dome, float(i % std::size_t(kColumns)), float(i / std::size_t(kColumns)));
            const Vec<float> seen = map_radiance(light.map, ray.direction);
            sky[0] = seen.x, sky[1] = seen.y, sky[2] = seen.z;
        }
        for (std::size_t c = 0; c < 3; ++c)
            texels[c * kAll + i] = planes.colour[c * kAll + i] + planes.transmittance[i] * sky[c];
    }
}

/// One mixing of neighbours, (1, 2, 1) / 4 along rows and then along columns.
void blur(float* plane, Buffer<float>& row) {
    for (int y = 0; y < kRows; ++y) {
        float* line = plane + y * kColumns;
        for (int x = 0; x < kColumns; ++x) {
            const float west = line[(x + kColumns - 1) % kColumns], east = line[(x + 1) % kColumns];
            row[std::size_t(x)] = 0.5f * line[x] + 0.25f * (west + east);
        }
        std::copy_n(row.data(), kColumns, line);
    }
    for (int x = 0; x < kColumns; ++x) {
        for (int y = 0; y < kRows; ++y) {
            const float above = plane[(y > 0 ? y - 1 : 0) * kColumns + x];
            const float below = plane[(y + 1 < kRows ? y + 1 : y) * kColumns + x];
            row[std::size_t(y)] = 0.5f * plane[y * kColumns + x] + 0.25f * (above + below);
        }
        for (int y = 0; y < kRows; ++y) plane[y * kColumns + x] = row[std::size_t(y)];
    }
}

SkyMapView map_of(const Buffer<float>& texels) {
    SkyMapView map{};
    map.rows = kRows, map.columns = kColumns, map.planes = 3;
    map.foot = float(kRows);
    map.rows_per_turn = float(4 * kRows);
    map.radiance = texels.data();
    return map;
}

}  // namespace

Status mirror_sky(const Context& context, const FrameView& view, const RaymarchInput& whole,
                  const Lighting& light, MarchState& state) {
    SeaMirror& out = state.picture.mirror;
    out.map = SkyMapView{};
    if (light.ground.paint.sea == nullptr || !sees_ground(view.camera)) return Status::ok();
    const StageClock clock(context, "mirrored sky");
    const Medium& medium = marched_medium(view, state);
    const double top = medium.sigma > 0 ? medium.extent_m[2] : 0;
    const CameraParams dome = mirror_camera(view.camera, light, top);
    for (int a = 0; a < 3; ++a) out.from[a] = dome.origin[a];
    PILEUS_TRY(allocate_planes(kColumns, kRows, 3, false, false, out.planes));
    PILEUS_TRY(out.texels.resize(std::uint64_t(3) * kColumns * kRows, "mirrored sky"));
    // Light of ordinates is turned towards the camera that looks.
    OrdinateNodes& nodes = state.light.ordinates.nodes;
    const bool turns = state.choice.settings.scattering.ordinates && !nodes.density.empty();
    if (turns) PILEUS_TRY(turn_ordinates(context, medium, dome, true, nodes));
    RaymarchInput in = whole;
    in.camera = dome;
    in.lattice = PixelLattice{};
    in.nodes.surfaces = nullptr;
    RaymarchTally counted;  // of the picture's own march alone
    PILEUS_TRY(raymarch_picture(context, in, out.planes, counted));
    if (turns) PILEUS_TRY(turn_ordinates(context, medium, view.camera, true, nodes));
    add_sky(light, out.planes, out.texels);
    Buffer<float> row;
    PILEUS_TRY(row.resize(std::uint64_t(kColumns), "mirrored sky"));
    for (int i = 0; i < 3 * kBlurs; ++i)
        blur(out.texels.data() + std::int64_t(i % 3) * kColumns * kRows, row);
    out.map = map_of(out.texels);
    return Status::ok();
}

}  // namespace pileus
