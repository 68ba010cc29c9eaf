// SPDX-License-Identifier: Apache-2.0
// Tables 5.1.5 and 5.2.4 of Maerkl's thesis, beside the same settings on this machine.
// in: a scene, a folder for pictures -> out: Markdown tables for docs/weather-table.md, PNG files.
// docs/weather-table.md says what the columns are and what can be compared.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "platform/threads.h"
#include "src/io/images/image_file.h"
#include "src/scene/read_scene.h"
#include "src/session/render.h"

namespace {

using namespace pileus;
using Settings = std::vector<std::string>;

struct Size {
    int x, y, z;
    double buffer_ms;  ///< his: the buffer of optical depths
};
constexpr Size kBuffers[] = {{32, 16, 16, 0.20},      {64, 32, 32, 1.53},
                             {128, 64, 64, 9.50},     {256, 128, 128, 72.86},
                             {512, 256, 256, 568.06}, {1024, 512, 512, 4515.85}};

constexpr int kGrids[][3] = {{16, 8, 8}, {32, 16, 16}, {64, 32, 32}, {128, 64, 64}};
struct Photons {
    long long count;
    double s[4];  ///< his, by grid
};
constexpr Photons kPhotons[] = {
    {100, {0.086, 0.085, 0.085, 0.086}},         {1000, {0.127, 0.126, 0.127, 0.126}},
    {10000, {0.692, 0.690, 0.694, 0.692}},       {100000, {4.383, 4.382, 4.386, 4.393}},
    {1000000, {42.266, 42.409, 42.601, 42.718}}, {10000000, {425.378, 426.363, 426.839, 427.696}}};

/// What one picture took: seconds of wall time.
struct Measured {
    double light_s = 0, cpu_s = 0, show_s = 0;
    unsigned long long overflows = 0;
};

double stage_s(const Report& report, const char* name) {
    for (const StageTime& s : report.clocks.stages)
        if (s.name == name) return s.wall_s;
    return 0;
}

Status measure(const char* file, const Settings& set, int threads, const std::string& picture,
               Measured& m) {
    Scene scene;
    PILEUS_TRY(read_scene_file(file, set, scene));
    RenderOptions options;
    options.threads = threads;
    return render(scene, options, [&](int, Image& image, Report& report) {
        const bool photons = scene.method == "photon-grid";
        m.light_s = photons ? report.clocks.tracing_wall_s : stage_s(report, "shadow");
        m.cpu_s = report.clocks.tracing_cpu_s;
        m.show_s = stage_s(report, "reconstruct") + stage_s(report, "march");
        return write_image(image, picture, {});
    });
}

std::string text_of(const int (&n)[3]) { return fmt::format("[{}, {}, {}]", n[0], n[1], n[2]); }

Status print_buffers(const char* file, const std::string& folder, int threads,
                     const Settings& more) {
    fmt::print(
        "| cells | Märkl, ms | swept, ms | exact, ms | times as fast |\n|---|---|---|---|---|\n");
    for (const Size& size : kBuffers) {
        const int n[3] = {size.x, size.y, size.z};
        double ms[2] = {0, 0};
        for (int exact = 0; exact < 2; ++exact) {
            Settings set = {"method.name=optical-depth", "optical_depth.resolution=" + text_of(n),
                            std::string("optical_depth.buffer=") + (exact ? "exact" : "swept")};
            set.insert(set.end(), more.begin(), more.end());
            Measured m;
            const std::string picture = fmt::format("{}/buffer_{}x{}x{}{}.png", folder, n[0], n[1],
                                                    n[2], exact ? "_exact" : "");
            PILEUS_TRY(measure(file, set, threads, picture, m));
            ms[exact] = 1000 * m.light_s;
        }
        const std::string by_rays = ms[1] > 0 ? fmt::format("**{:.2f}**", ms[1]) : "not run";
        fmt::print("| {}×{}×{} | {:.2f} | **{:.2f}** | {} | {:.0f} |\n", n[0], n[1], n[2],
                   size.buffer_ms, ms[0], by_rays, size.buffer_ms / ms[0]);
        std::fflush(stdout);
    }
    return Status::ok();
}

Status print_photons(const char* file, const std::string& folder, const char* closure, int threads,
                     const Settings& more) {
    fmt::print("| photons | 16×8×8 | 32×16×16 | 64×32×32 | 128×64×64 |\n|---|---|---|---|---|\n");
    for (const Photons& row : kPhotons) {
        fmt::print("| {} |", row.count);
        for (int i = 0; i < 4; ++i) {
            Settings set = {fmt::format("photon_grid.photons={}", row.count),
                            "photon_grid.cells=" + text_of(kGrids[i]),
                            std::string("photon_grid.closure=") + closure};
            set.insert(set.end(), more.begin(), more.end());
            Measured m;
            const std::string picture =
                fmt::format("{}/{}_{}x{}x{}_{}.png", folder, closure, kGrids[i][0], kGrids[i][1],
                            kGrids[i][2], row.count);
            PILEUS_TRY(measure(file, set, threads, picture, m));
            fmt::print(" {:.3f} · **{:.3f}** |", row.s[i], m.light_s);
            std::fflush(stdout);
        }
        fmt::print("\n");
    }
    return Status::ok();
}

Status run(const char* file, const std::string& folder, int threads, const Settings& more) {
    fmt::print("Buffer of optical depths, {} threads:\n\n", threads);
    PILEUS_TRY(print_buffers(file, folder, threads, more));
    fmt::print("\nPhotons into flux and mean cosine (`published`), seconds, Märkl · here:\n\n");
    PILEUS_TRY(print_photons(file, folder, "published", threads, more));
    fmt::print("\nPhotons into 4 bands of harmonics (`sh`), seconds, Märkl's flux · here:\n\n");
    return print_photons(file, folder, "sh", threads, more);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        fmt::print(stderr, "usage: pileus_weather_table SCENE FOLDER [key=value ...]\n");
        return 2;
    }
    const Status status =
        run(argv[1], argv[2], hardware_threads(), Settings(argv + 3, argv + argc));
    if (!status) fmt::print(stderr, "{}\n", status.message);
    return int(status.code);
}
