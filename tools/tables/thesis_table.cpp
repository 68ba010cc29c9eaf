// SPDX-License-Identifier: Apache-2.0
// The eleven rows of Elek's thesis, section 6.3, beside the same settings on this machine.
// in: assets/scenes/thesis.toml, threads -> out: Markdown tables for docs/thesis-table.md.
// docs/thesis-table.md says what the columns are and what can be compared.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "platform/threads.h"
#include "src/scene/read_scene.h"
#include "src/session/render.h"

namespace {

using namespace pileus;

/// A row of the thesis's table: settings, then its figures in milliseconds.
struct Row {
    const char* name;
    int samples, photons, generations, bands;
    const char* tracking;
    int collectors;
    double t1b, t1c_sort, t1c_build, t1d, t_sum, t2a, t2a_million;
};

constexpr Row kRows[] = {
    {"Ref", 20'000, 5'730'000, 50, 4, "global", 8668, 92, 24, 265, 35, 421, 132, 1152},
    {"A1", 5'000, 5'730'000, 50, 4, "global", 2787, 35, 5, 68, 47, 160, 120, 1047},
    {"A2", 50'000, 5'730'000, 50, 4, "global", 17729, 205, 74, 674, 37, 995, 135, 1178},
    {"B1", 20'000, 1'640'000, 50, 4, "global", 8668, 92, 25, 268, 34, 424, 60, 1829},
    {"B2", 20'000, 10'600'000, 50, 4, "global", 8668, 93, 25, 270, 35, 428, 212, 995},
    {"C1", 20'000, 5'240'000, 20, 4, "global", 8668, 92, 24, 267, 34, 423, 251, 958},
    {"C2", 20'000, 6'550'000, 200, 4, "global", 8668, 92, 25, 269, 34, 425, 60, 1832},
    {"D1", 20'000, 5'730'000, 50, 2, "global", 8668, 94, 24, 268, 35, 426, 87, 759},
    {"D2", 20'000, 5'730'000, 50, 6, "global", 8668, 92, 25, 268, 34, 425, 221, 1928},
    {"E1", 20'000, 5'730'000, 50, 4, "local", 8668, 94, 25, 267, 35, 427, 174, 1518},
    {"E2", 100'000, 5'730'000, 50, 4, "local", 28448, 404, 168, 1362, 39, 1978, 214, 1867},
};

double stage_ms(const Report& report, const char* name) {
    for (const StageTime& s : report.clocks.stages)
        if (s.name == name) return 1000 * s.wall_s;
    return 0;
}

/// This program's figures for one row, milliseconds of wall time where no unit is named.
struct Measured {
    std::uint64_t collectors = 0;
    double t1a = 0, t1b = 0, t1c = 0, t1d = 0, t_sum = 0, t2a = 0, t2a_million = 0;
    double scatterings_per_photon = 0, tentative_per_scattering = 0, cpu_ns_per_scattering = 0;
    double picture = 0;
};

Status measure(const char* scene_file, const Row& row, const std::vector<std::string>& more,
               int threads, Measured& m) {
    std::vector<std::string> set = {fmt::format("collectors.samples={}", row.samples),
                                    fmt::format("collectors.photons={}", row.photons),
                                    fmt::format("collectors.generations={}", row.generations),
                                    fmt::format("collectors.bands={}", row.bands),
                                    fmt::format("collectors.tracking={}", row.tracking)};
    set.insert(set.end(), more.begin(), more.end());
    Scene scene;
    PILEUS_TRY(read_scene_file(scene_file, set, scene));
    RenderOptions options;
    options.threads = threads;
    return render(scene, options, [&](int, Image&, Report& report) {
        m.collectors = report.prepared.collectors;
        m.t1a = stage_ms(report, "gradient");
        m.t1b = stage_ms(report, "samples");
        m.t1c = stage_ms(report, "tree");
        m.t1d = stage_ms(report, "majorants");
        m.t_sum = m.t1a + m.t1b + m.t1c + m.t1d;
        m.t2a = 1000 * report.clocks.tracing_wall_s / double(row.generations);
        const double photons = double(report.photons.traced),
                     scatterings = double(report.events.scatterings);
        m.t2a_million = 1000 * report.clocks.tracing_wall_s * 1e6 / photons;
        m.scatterings_per_photon = scatterings / photons;
        m.tentative_per_scattering = double(report.events.tentative) / scatterings;
        m.cpu_ns_per_scattering = 1e9 * report.clocks.tracing_cpu_s / scatterings;
        m.picture = stage_ms(report, "reconstruct") + stage_ms(report, "background") +
                    stage_ms(report, "blend");
        return Status::ok();
    });
}

void print_preparation(const std::vector<Measured>& measured) {
    fmt::print(
        "| row | samples | collectors | | t1b ms | | t1c ms | | t1d ms | | sum ms | | times as "
        "fast |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const Row& r = kRows[i];
        const Measured& m = measured[i];
        fmt::print(
            "| {} | {}k | {} | **{}** | {:.0f} | **{:.1f}** | {:.0f} | **{:.1f}** | {:.0f} | "
            "**{:.1f}** | {:.0f} | **{:.1f}** | {:.1f} |\n",
            r.name, r.samples / 1000, r.collectors, m.collectors, r.t1b, m.t1b,
            r.t1c_sort + r.t1c_build, m.t1c, r.t1d, m.t1d, r.t_sum, m.t_sum, r.t_sum / m.t_sum);
    }
}

void print_tracing(const std::vector<Measured>& measured) {
    fmt::print(
        "| row | N_T | p | Λ | tracking | t2a ms | | t'2a ms | | ns a scattering | | tentative a "
        "scattering | CPU ns a scattering | times as fast |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const Row& r = kRows[i];
        const Measured& m = measured[i];
        const double s = m.scatterings_per_photon;
        fmt::print(
            "| {} | {:.2f}M | {} | {} | {} | {:.0f} | **{:.1f}** | {:.0f} | **{:.0f}** | {:.0f} | "
            "**{:.0f}** | {:.2f} | {:.0f} | {:.2f} |\n",
            r.name, 1e-6 * r.photons, r.generations, r.bands, r.tracking, r.t2a, m.t2a,
            r.t2a_million, m.t2a_million, r.t2a_million / s, m.t2a_million / s,
            m.tentative_per_scattering, m.cpu_ns_per_scattering, r.t2a_million / m.t2a_million);
    }
}

int run(const char* scene, int threads, const std::vector<std::string>& more) {
    std::vector<Measured> measured;
    for (const Row& row : kRows) {
        Measured m;
        const Status status = measure(scene, row, more, threads, m);
        if (!status) {
            fmt::print(stderr, "{}\n", status.message);
            return int(status.code);
        }
        measured.push_back(m);
        std::fprintf(stderr, "%s done\n", row.name);
    }
    fmt::print("Preparation, {} threads; the thesis first, this program in bold:\n\n", threads);
    print_preparation(measured);
    fmt::print("\nPhotons:\n\n");
    print_tracing(measured);
    double picture = 0;
    for (const Measured& m : measured) picture += m.picture / double(measured.size());
    fmt::print("\n{:.2f} scatterings a photon; one 1920x1080 picture of the map: {:.0f} ms.\n",
               measured[0].scatterings_per_photon, picture);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: pileus_thesis_table SCENE [key=value ...]\n");
        return 2;
    }
    return run(argv[1], hardware_threads(), {argv + 2, argv + argc});
}
