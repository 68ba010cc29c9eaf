// SPDX-License-Identifier: Apache-2.0
// A flight through a sky of many clouds: time of frames, and how far level of detail is from clouds
// that are marched in every frame.
// in: frames, clouds, threads, method, what to change -> out: a table; pictures where asked for.
// docs/clouds.md
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "platform/clock.h"
#include "src/clouds/clouds.h"
#include "src/io/images/image_file.h"
#include "src/scene/read_scene.h"

namespace {

using namespace pileus;

constexpr double kStepM = 4;  // of a frame: 120 m/s at 30 frames a second

/// A number in [0, 1) for each place.
double hashed(std::uint32_t i) {
    std::uint32_t h = i * 2654435761u + 12345u;
    h ^= h >> 15, h *= 2246822519u, h ^= h >> 13, h *= 3266489917u, h ^= h >> 16;
    return double(h >> 8) / 16777216;
}

void require(const Status& status) {
    if (status) return;
    std::fprintf(stderr, "%s\n", status.message.c_str());
    std::exit(int(status.code));
}

struct Arguments {
    int frames = 60, clouds = 100, threads = 0, compared = 12, turns = 4;
    std::array<int, 2> size{1280, 720};
    std::string method = "raymarch", pictures;
    CloudDetail detail;
    std::vector<std::string> overrides;
};

Scene scene_of(const char* file, std::vector<std::string> overrides) {
    Scene scene;
    require(read_scene_file(std::string(PILEUS_SCENES "/") + file, overrides, scene));
    return scene;
}

std::vector<std::string> kind_overrides(const Arguments& a, int kind) {
    std::vector<std::string> out{"method.name=\"" + a.method + "\"",
                                 "medium.0.shape_seed=" + std::to_string(kind),
                                 "medium.0.resolution=[96,96,66]", "sky.radiance=[0,0,0]"};
    if (a.method == "raymarch") {
        out.push_back("raymarch.scattering=\"octaves\"");
        out.push_back("raymarch.steps=96");
        out.push_back("raymarch.stop_below=0.003");
    }
    if (a.method == "collectors") {
        out.push_back("collectors.photons=200000");
        out.push_back("collectors.generations=4");
    }
    out.insert(out.end(), a.overrides.begin(), a.overrides.end());
    return out;
}

/// From 1 to 100 km all around, as many in each ring of equal ratio; none over another's middle.
std::vector<CloudPlace> places(const Arguments& a, std::size_t kinds) {
    std::vector<CloudPlace> out;
    for (std::uint32_t i = 0; int(out.size()) < a.clouds; ++i) {
        const auto draw = [&](std::uint32_t n) { return hashed(7 * i + n); };
        CloudPlace p;
        p.kind = std::size_t(draw(0) * double(kinds)) % kinds;
        const double far = 1000 * std::pow(100.0, draw(1)) + 500;
        const Double3 at = towards_deg(360 * draw(2), 0) * far;
        p.offset_m = {at.x, at.y, 900 + 500 * draw(3)};
        p.yaw_deg = std::floor(draw(4) * a.turns) * (360.0 / a.turns);
        p.scale = 0.8 + 0.8 * draw(5);
        bool free = true;
        for (const CloudPlace& other : out)
            free = free && std::hypot(other.offset_m.x - at.x, other.offset_m.y - at.y) >
                               900 * (other.scale + p.scale);
        if (free || i > 40000) out.push_back(p);
    }
    return out;
}

struct Picture {
    std::vector<float> rgba;
    std::vector<unsigned char> shown;
};

/// Its 8-bit pixels, as the library writes them.
void show(const Arguments& a, Picture& picture) {
    Planes planes;
    const std::size_t pixels = picture.rgba.size() / 4;
    require(planes.transmittance.resize(pixels, "picture"));
    require(planes.colour.resize(3 * pixels, "picture"));
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c) planes.colour[c * pixels + i] = picture.rgba[4 * i + c];
    PixelTarget target;
    target.rows = {picture.shown.data(), 4 * a.size[0], false};
    std::uint64_t broken = 0;
    require(write_pixels(planes, a.size[0], a.size[1], target, nullptr, 1, broken));
}

/// A sky, its kinds and places.
struct CloudySky {
    Session session;
    Clouds clouds;

    CloudySky(const Arguments& a, bool detailed) {
        RenderOptions options;
        options.threads = a.threads;
        const Scene scene =
            scene_of("clouds_sky.toml", {"camera.resolution=[" + std::to_string(a.size[0]) + "," +
                                         std::to_string(a.size[1]) + "]"});
        require(session.open(scene, options, true, nullptr));
        require(clouds.open(session));
        CloudDetail detail = a.detail;
        detail.on = detailed;
        require(clouds.set_detail(detail));
        for (int kind = 0; kind < 4; ++kind) {
            const Scene cloud = scene_of("cumulus.toml", kind_overrides(a, kind));
            std::shared_ptr<const World> world;
            require(make_world(cloud, options, world));
            std::size_t number = 0;
            require(clouds.add_kind(cloud, world, number));
        }
        require(clouds.place(places(a, 4)));
    }

    double fly(const Arguments& a, int frame, Picture& picture, bool floats) {
        Camera camera = session.camera();
        const double along = kStepM * frame;
        camera.position_m = {0, along, 1300};
        camera.target_m = camera.position_m + Double3{0.25, 1, 0.02};
        require(session.set_camera(camera));
        require(session.set_frame(frame));
        FrameTarget target;
        target.has_colour = true;
        const std::size_t pixels = std::size_t(a.size[0]) * std::size_t(a.size[1]);
        picture.shown.resize(4 * pixels);
        target.colour.rows = {picture.shown.data(), 4 * a.size[0], false};
        if (floats) {
            picture.rgba.resize(4 * pixels);
            target.colour.format = PixelFormat::kRgba32F;
            target.colour.rows = {reinterpret_cast<unsigned char*>(picture.rgba.data()),
                                  16 * a.size[0], false};
        }
        const double start = wall_seconds();
        require(clouds.render(target));
        const double took = wall_seconds() - start;
        if (floats) show(a, picture);
        return took;
    }
};

double relative_error(const Picture& a, const Picture& b) {
    double sum = 0;
    const std::size_t pixels = a.rgba.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = double(a.rgba[4 * i + c]), y = double(b.rgba[4 * i + c]);
            sum += (x - y) * (x - y) / (y * y + 1e-4);
        }
    return sum / double(3 * pixels);
}

/// Share of pixels that change from frame to frame by more than `slack` codes beyond the other's
/// change.
double popping(const Picture& a0, const Picture& a1, const Picture& b0, const Picture& b1,
               int slack) {
    std::size_t count = 0;
    const std::size_t pixels = a0.shown.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i) {
        bool pops = false;
        for (std::size_t c = 0; c < 3; ++c) {
            const int own = std::abs(int(a1.shown[4 * i + c]) - int(a0.shown[4 * i + c]));
            const int other = std::abs(int(b1.shown[4 * i + c]) - int(b0.shown[4 * i + c]));
            pops = pops || own > other + slack;
        }
        if (pops) ++count;
    }
    return double(count) / double(pixels);
}

void save(const Arguments& a, const char* name, int frame, const Picture& picture) {
    if (a.pictures.empty()) return;
    char path[512];
    std::snprintf(path, sizeof path, "%s/%s_%03d.ppm", a.pictures.c_str(), name, frame);
    std::FILE* file = std::fopen(path, "wb");
    if (file == nullptr) return;
    std::fprintf(file, "P6\n%d %d\n255\n", a.size[0], a.size[1]);
    for (std::size_t i = 0; i < picture.shown.size(); i += 4)
        std::fwrite(&picture.shown[i], 1, 3, file);
    std::fclose(file);
}

double median(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v.empty() ? 0 : v[v.size() / 2];
}

double mean(const std::vector<double>& v) {
    double sum = 0;
    for (const double x : v) sum += x;
    return v.empty() ? 0 : sum / double(v.size());
}

Arguments parse(int argc, char** argv) {
    Arguments a;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string key = argv[i], value = argv[i + 1];
        const auto is = [&](const char* name) { return key == name; };
        if (is("--frames"))
            a.frames = std::atoi(value.c_str());
        else if (is("--compare"))
            a.compared = std::atoi(value.c_str());
        else if (is("--clouds"))
            a.clouds = std::atoi(value.c_str());
        else if (is("--turns"))
            a.turns = std::atoi(value.c_str());
        else if (is("--threads"))
            a.threads = std::atoi(value.c_str());
        else if (is("--method"))
            a.method = value;
        else if (is("--pictures"))
            a.pictures = value;
        else if (is("--set"))
            a.overrides.push_back(value);
        else if (is("--error-px"))
            a.detail.error_px = std::atof(value.c_str());
        else if (is("--near-px"))
            a.detail.near_px = std::atof(value.c_str());
        else if (is("--near-scale"))
            a.detail.near_scale = std::atoi(value.c_str());
        else if (is("--blend"))
            a.detail.blend_frames = std::atoi(value.c_str());
        else if (is("--sharpness"))
            a.detail.sharpness = std::atof(value.c_str());
        else if (is("--pixels"))
            a.detail.frame_pixels = std::atoll(value.c_str());
        else {
            std::fprintf(stderr, "%s: no such option\n", argv[i]);
            std::exit(2);
        }
    }
    return a;
}

}  // namespace

int main(int argc, char** argv) {
    const Arguments a = parse(argc, argv);
    const double start = wall_seconds();
    CloudySky fast(a, true);
    Picture picture;
    std::vector<double> times;
    CloudStats sum;
    const double first = fast.fly(a, 0, picture, false);
    fast.session.report().clocks.stages.clear();
    std::printf("%d clouds, %s, %d x %d; kinds %.2f s, first frame %.2f s, %u groups lit\n",
                a.clouds, a.method.c_str(), a.size[0], a.size[1], wall_seconds() - start - first,
                first, fast.clouds.stats().lit);
    const std::clock_t cpu = std::clock();
    for (int frame = 1; frame < a.frames; ++frame) {
        times.push_back(1000 * fast.fly(a, frame, picture, false));
        const CloudStats& s = fast.clouds.stats();
        sum.visible += s.visible, sum.marched += s.marched, sum.captured += s.captured;
        sum.marched_pixels += s.marched_pixels, sum.captured_pixels += s.captured_pixels;
        sum.worst_px = std::max(sum.worst_px, s.worst_px);
    }
    const double n = double(times.size());
    save(a, "fast", a.frames - 1, picture);
    std::printf(
        "frames: median %.1f ms, slowest %.1f, CPU %.1f ms; a frame: %.0f visible, %.1f marched "
        "(%.0f px), "
        "%.2f new pictures (%.0f px), worst %.2f px\n",
        median(times), *std::max_element(times.begin(), times.end()),
        1000 * double(std::clock() - cpu) / CLOCKS_PER_SEC / n, sum.visible / n, sum.marched / n,
        double(sum.marched_pixels) / n, sum.captured / n, double(sum.captured_pixels) / n,
        sum.worst_px);
    for (const StageTime& stage : fast.session.report().clocks.stages)
        std::printf("  %-18s wall %7.2f CPU %7.2f ms a frame\n", stage.name.c_str(),
                    1000 * stage.wall_s / n, 1000 * stage.cpu_s / n);
    if (a.compared == 0) return 0;
    CloudySky whole(a, false), again(a, true);
    Picture a0, a1, b0, b1;
    std::vector<double> slow, errors, pops;
    for (int frame = 0; frame < a.compared; ++frame) {
        std::swap(a0, a1);
        std::swap(b0, b1);
        again.fly(a, frame, a1, true);
        slow.push_back(1000 * whole.fly(a, frame, b1, true));
        errors.push_back(relative_error(a1, b1));
        if (frame > 0) pops.push_back(popping(a0, a1, b0, b1, 2));
    }
    save(a, "detail", a.compared - 1, a1);
    save(a, "whole", a.compared - 1, b1);
    std::printf(
        "against all marched (%.0f ms): relMSE median %.5f, most %.5f; pixels that change by "
        "more than 2/255 beyond: mean %.5f %%, most %.5f %%\n",
        median(slow), median(errors), *std::max_element(errors.begin(), errors.end()),
        100 * mean(pops), 100 * *std::max_element(pops.begin(), pops.end()));
    return 0;
}
