// SPDX-License-Identifier: Apache-2.0
// See ground_look.h.
#include "src/world/light/ground_look.h"

#include <algorithm>
#include <cmath>

#include "kernels_cpu/light/ground.h"
#include "src/base/angles.h"
#include "src/base/number_text.h"
#include "src/base/powers.h"
#include "src/base/reading_limit.h"
#include "src/io/images/image_file.h"
#include "src/scene/read_scene.h"

namespace pileus {
namespace {

// Places and weights of Gauss and Hermite, of a normal distribution: of 7 and of 3.
constexpr float kPlaces7[] = {-3.75043972f, -2.36675941f, -1.15440539f, 0.0f,
                              1.15440539f,  2.36675941f,  3.75043972f};
constexpr float kWeights7[] = {0.000548268859f, 0.0307571240f, 0.240123179f,   0.457142857f,
                               0.240123179f,    0.0307571240f, 0.000548268859f};
constexpr float kPlaces3[] = {-1.73205081f, 0.0f, 1.73205081f};
constexpr float kWeights3[] = {0.166666667f, 0.666666667f, 0.166666667f};

/// Slopes are taken up to so many deviations.
constexpr double kReach = 6;

/// Mean of what the facets that are seen at an angle to the vertical with this cosine reflect.
double average_facets(double slope, double cosine) {
    constexpr int kAlong = 192, kAcross = 48;
    const double level = __builtin_sqrt(1 - cosine * cosine);
    double sum = 0, light = 0;
    for (int i = 0; i < kAlong; ++i) {
        const double x = kReach * ((2 * i + 1.0) / kAlong - 1);
        const double shown = cosine + level * slope * x;
        if (shown <= 0) continue;
        const double px = double(exp_(float(-0.5 * x * x)));
        for (int j = 0; j < kAcross; ++j) {
            const double y = kReach * ((2 * j + 1.0) / kAcross - 1);
            const double p = px * double(exp_(float(-0.5 * y * y)));
            const double steep = __builtin_sqrt(1 + slope * slope * (x * x + y * y));
            sum += p * shown;
            light += p * shown * double(water_reflects(float(shown / steep)));
        }
    }
    return light / sum;
}

/// Mean of max(x + a normal number, 0).
double average_seen(double x) {
    constexpr int kSteps = 4096;
    double sum = 0, all = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double n = kReach * ((2 * i + 1.0) / kSteps - 1);
        const double p = double(exp_(float(-0.5 * n * n)));
        sum += p * (x + n > 0 ? x + n : 0);
        all += p;
    }
    return sum / all;
}

/// Share of the slopes' variance that waves have which are shown one by one.
constexpr double kShownWaves = 0.4;

/// Waves from as long as a wind raises down to some decimetres, alike in slope: the spectrum of
/// slopes is even per octave (Phillips 1958). They run within 55 degrees of the wind, short ones
/// within 80. `at`: as make_paint's affine places have it, x and y of the world.
void make_waves(const GroundSurface& surface, double slope, double time_s, const double (&x_of)[3],
                const double (&y_of)[3], SeaWaves& out) {
    constexpr double kShortest = 0.6, kGravity = 9.81;
    const double wind = surface.wind_m_s;
    const double longest = std::min(std::max(0.8 * wind * wind, 3.0), 200.0);
    // A cosine of largest slope s has the variance s^2 / 2, half of it along each axis.
    const double lean = 2 * slope * __builtin_sqrt(kShownWaves / kSeaWaves);
    const double ratio = power_of(kShortest / longest, 1.0 / (kSeaWaves - 1));
    double length = longest;
    for (int i = 0; i < kSeaWaves; ++i, length *= ratio) {
        const double chance = i * 0.618033988749895, other = i * 0.754877666246693 + 0.37;
        const double spread = (55 + 25.0 * i / kSeaWaves) * (2 * (chance - std::floor(chance)) - 1);
        const SineCosine way = sincos_deg(surface.wind_from_deg + 180 + spread);
        const double k = 1 / length, turns = __builtin_sqrt(kGravity * k / (2 * kPi64)) * time_s;
        const double east = k * way.sine, north = k * way.cosine;
        const double phase = east * x_of[2] + north * y_of[2] - turns + other;
        out.x[i] = float(east * x_of[0] + north * y_of[0]);
        out.y[i] = float(east * x_of[1] + north * y_of[1]);
        out.phase[i] = float(phase - std::floor(phase));
        // Along the wave, in the media's coordinates.
        out.lean_x[i] = float(lean * double(out.x[i]) * length);
        out.lean_y[i] = float(lean * double(out.y[i]) * length);
        out.per_length[i] = float(k);
        // By up to half a turn over five lengths of the longest: a tenth of its slope at most.
        out.bend[i][0] = float(0.5 * (2 * (chance * 3 - std::floor(chance * 3)) - 1));
        out.bend[i][1] = float(0.5 * (2 * (other * 5 - std::floor(other * 5)) - 1));
    }
    for (int i = 0; i < 2; ++i) {
        const SineCosine way = sincos_deg(surface.wind_from_deg + (i == 0 ? 37 : 118));
        const double k = 1 / ((5 + 2.3 * i) * longest);
        const double east = k * way.sine, north = k * way.cosine;
        out.slow_x[i] = float(east * x_of[0] + north * y_of[0]);
        out.slow_y[i] = float(east * x_of[1] + north * y_of[1]);
        const double phase = east * x_of[2] + north * y_of[2];
        out.slow_phase[i] = float(phase - std::floor(phase));
    }
}

/// A number of the map.
Status check_albedo(const std::string& name, float value, int x, int y) {
    if (value >= 0 && value <= 1) return Status::ok();
    return Status::bad_input(name + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                             ") is " + number_text(double(value)) + ", allowed: 0 to 1");
}

/// Levels below the finest one, each number the mean of up to four.
void halve(GroundMapView& map, float* plane) {
    int columns = map.columns, rows = map.rows;
    for (int i = 1; i < map.levels; ++i) {
        const float* from = plane + map.first[i - 1];
        float* to = plane + map.first[i];
        const int wide = (columns + 1) / 2, high = (rows + 1) / 2;
        for (int y = 0; y < high; ++y)
            for (int x = 0; x < wide; ++x) {
                const int x1 = 2 * x + 1 < columns ? 2 * x + 1 : 2 * x;
                const int y1 = 2 * y + 1 < rows ? 2 * y + 1 : 2 * y;
                const auto at = [&](int u, int v) { return from[std::int64_t(v) * columns + u]; };
                to[std::int64_t(y) * wide + x] =
                    0.25f * ((at(2 * x, 2 * y) + at(x1, 2 * y)) + (at(2 * x, y1) + at(x1, y1)));
            }
        columns = wide, rows = high;
    }
}

void lay_out(int width, int height, int planes, GroundMapView& map) {
    map = GroundMapView{};
    map.columns = width, map.rows = height, map.planes = planes;
    int columns = width, rows = height;
    while (map.levels < kGroundLevels) {
        map.first[map.levels++] = map.texels;
        map.texels += columns * rows;
        if (columns == 1 && rows == 1) break;
        columns = (columns + 1) / 2, rows = (rows + 1) / 2;
    }
}

}  // namespace

Status make_ground_map(const std::string& name, const Image& image, const GroundSurface& surface,
                       GroundLook& look) {
    look.surface = surface;
    const Channel* rgb[3];
    PILEUS_TRY(color_channels(image, rgb));
    const int planes = rgb[0] == rgb[1] && rgb[0] == rgb[2] ? 1 : 3;
    lay_out(image.width, image.height, planes, look.map);
    const std::uint64_t all = std::uint64_t(look.map.texels) * std::uint64_t(planes);
    PILEUS_TRY(look.albedo.resize(all, "ground map"));
    for (int c = 0; c < planes; ++c) {
        float* plane = look.albedo.data() + std::int64_t(c) * look.map.texels;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const float v =
                    rgb[c]->pixels[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
                PILEUS_TRY(check_albedo(name, v, x, y));
                plane[std::int64_t(image.height - 1 - y) * image.width + x] = v;
            }
        halve(look.map, plane);
    }
    look.map.albedo = look.albedo.data();
    const double wide = surface.map_size_m[0] / image.width;
    const double high = surface.map_size_m[1] / image.height;
    look.map.repeats = surface.map_repeats ? 1 : 0;
    look.map.texel_m = float(wide > high ? wide : high);
    return Status::ok();
}

Status make_ground_look(const Scene& scene, const Context& context, GroundLook& look) {
    look = GroundLook{};
    const GroundSurface& surface = look.surface = scene.surface;
    if (!scene.ground.present) return Status::ok();
    if (surface.sea) {
        PILEUS_TRY(look.facets.resize(1, "sea"));
        const SeaView& sea = look.facets[0] = make_sea(surface.wind_m_s);
        for (int i = 0; i < kSeaCosines; ++i) {
            const double low = double(i) / kSeaCosines, high = double(i + 1) / kSeaCosines;
            const double mean = 0.5 * (double(sea.reflects[i]) + double(sea.reflects[i + 1]));
            look.even += mean * (high * high - low * low);
        }
    }
    if (surface.map.empty()) return Status::ok();
    const StageClock clock(context, "ground map");
    const ReadingLimit readers(context.limits);
    const std::string path = scene_path(scene.directory, surface.map);
    Image image;
    const Channel* rgb[3];
    PILEUS_TRY(at_key(scene, "ground.map",
                      read_colours(path, context.limits, kMaxGroundTexels, image, rgb)));
    // Its channels decoded, and the file, which is hardly larger than its values.
    look.reading = 2 * sizeof(float) * image.channels.size() * std::uint64_t(image.width) *
                   std::uint64_t(image.height);
    return at_key(scene, "ground.map", make_ground_map(path, image, surface, look));
}

SeaView make_sea(double wind_m_s) {
    SeaView sea{};
    // Of both axes together 0.003 + 0.00512 of the wind.
    sea.slope = float(__builtin_sqrt(0.5 * (0.003 + 0.00512 * wind_m_s)));
    sea.fine = float(__builtin_sqrt(1 - kShownWaves) * double(sea.slope));
    for (int i = 0; i <= kSeaCosines; ++i) {
        sea.reflects[i] = float(average_facets(double(sea.slope), double(i) / kSeaCosines));
        sea.seen[i] = float(average_seen(double(kSeaSeen) * i / kSeaCosines));
    }
    for (int i = 0; i < kSeaAlong; ++i)
        sea.along[i] = kPlaces7[i], sea.along_weight[i] = kWeights7[i];
    for (int i = 0; i < kSeaAcross; ++i)
        sea.across[i] = kPlaces3[i], sea.across_weight[i] = kWeights3[i];
    return sea;
}

namespace {

/// A place of the media, box-local, turned and moved into the world: x and y by x, y and 1.
struct InWorld {
    double x_of[3], y_of[3];
};
InWorld in_world(const GroundStand& stand) {
    const SineCosine yaw = sincos_deg(stand.placement.yaw_deg);
    const Double3 &low = stand.low_m, &offset = stand.placement.offset_m;
    return {{yaw.cosine, -yaw.sine, yaw.cosine * low[0] - yaw.sine * low[1] + offset[0]},
            {yaw.sine, yaw.cosine, yaw.sine * low[0] + yaw.cosine * low[1] + offset[1]}};
}

void place_map(const GroundSurface& surface, const InWorld& world, GroundMapView& map) {
    const double columns = map.columns / surface.map_size_m[0];
    const double rows = map.rows / surface.map_size_m[1];
    for (int i = 0; i < 3; ++i) {
        const double low_x = i == 2 ? surface.map_low_m[0] : 0;
        const double low_y = i == 2 ? surface.map_low_m[1] : 0;
        map.to_column[i] = float((world.x_of[i] - low_x) * columns);
        map.to_row[i] = float((world.y_of[i] - low_y) * rows);
    }
}

/// Mean of albedos below the media and as far around them as they are high, of a grid of places.
double mean_of_map(const GroundLook& look, double own, const GroundStand& stand) {
    constexpr int kSide = 32;
    GroundPaint paint{};
    paint.map = look.map;
    paint.per_albedo = 1;
    for (std::size_t c = 0; c < 3; ++c)
        paint.share[c] = float(double(look.surface.colour[c]) * own);
    place_map(look.surface, in_world(stand), paint.map);
    const double wide = stand.extent_m[0] + 2 * stand.top_m;
    const double deep = stand.extent_m[1] + 2 * stand.top_m;
    const std::int32_t level = map_level(paint, float(std::max(wide, deep) / kSide));
    double sum = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            float share[3];
            const Vec<float> at{float(wide * (x + 0.5) / kSide - stand.top_m),
                                float(deep * (y + 0.5) / kSide - stand.top_m), 0};
            ground_share(paint, at, level, share);
            sum += (double(share[0]) + double(share[1]) + double(share[2])) / 3;
        }
    return sum / (kSide * kSide);
}

}  // namespace

GroundAlbedo ground_albedo(const GroundLook& look, double own, const GroundStand& stand,
                           double sine) {
    if (is_grey_land(look.surface)) return {own, own};
    if (look.map.columns > 0) {
        // Albedos are held over the mean: of a black country over some light.
        constexpr double kLeast = 1e-4;
        const double mean = std::max(mean_of_map(look, own, stand), kLeast);
        return {mean, mean};
    }
    const auto& colour = look.surface.colour;
    const double land = own * (double(colour[0]) + double(colour[1]) + double(colour[2])) / 3;
    if (!look.surface.sea) return {land, land};
    const double water = land * (1 - look.even);
    const double turned = double(sea_reflects(look.facets[0], float(sine > 0 ? sine : 0)));
    return {look.even + water, turned + water};
}

GroundPaint make_paint(const GroundLook& look, double own, const GroundAlbedo& all,
                       const GroundStand& stand, double time_s) {
    GroundPaint paint{};
    if (is_grey_land(look.surface) || !(all.even > 0)) return paint;
    paint.on = 1;
    paint.per_albedo = float(1 / all.even);
    paint.share_sun = all.sun > 0 ? float(all.even / all.sun) : 0;
    for (int c = 0; c < 3; ++c)
        paint.share[c] = float(double(look.surface.colour[std::size_t(c)]) * own / all.even);
    const InWorld world = in_world(stand);
    if (look.surface.sea) {
        paint.sea = look.facets.data();
        make_waves(look.surface, double(look.facets[0].slope), time_s, world.x_of, world.y_of,
                   paint.waves);
    }
    if (look.map.columns == 0) return paint;
    paint.map = look.map;
    place_map(look.surface, world, paint.map);
    return paint;
}

}  // namespace pileus
