// SPDX-License-Identifier: Apache-2.0
// Bias, noise and time of the collectors' variants against the path tracer.
// in: a scene, two independent pictures of it by method path with path.pixel = "centre", photons
// for the variants -> out: a Markdown table; docs/collectors.md, "Error and time".
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "src/api/render.h"
#include "src/io/picture.h"
#include "src/scene/read_scene.h"
#include "src/study/metrics.h"

namespace {

using namespace pileus;

struct Picture {
    Image image;
    double tracing_cpu_s = 0, total_cpu_s = 0;
    std::uint64_t collectors = 0;
};

Status take(const std::string& file, std::vector<std::string> set, Picture& out) {
    Scene scene;
    set.emplace_back("output.layers=[\"radiance\", \"alpha\", \"error\"]");
    PILEUS_TRY(read_scene_file(file, set, scene));
    return render(scene, {}, [&](int, Image& image, Report& report) {
        out.image = std::move(image);
        out.tracing_cpu_s = report.tracing_cpu_s;
        out.total_cpu_s = report.cpu_s;
        out.collectors = report.collectors;
        return Status::ok();
    });
}

struct Variant {
    const char* name;
    std::vector<std::string> set;
};

const std::vector<Variant>& variants() {
    static const std::vector<Variant> all = {
        {"`variant = \"paper\"`", {"collectors.variant=paper"}},
        {"billboards, 4 bands", {"collectors.display=billboards"}},
        {"billboards, 100k samples",
         {"collectors.display=billboards", "collectors.samples=100000"}},
        {"march, 4 bands (default)", {}},
        {"march, no first-order split", {"collectors.first_order_split=false"}},
        {"march, window", {"collectors.window=true"}},
        {"march, lobe", {"collectors.closure=lobe"}},
        {"march, bands alone", {"collectors.axis_degrees=0"}},
        {"march, 12 degrees about the sun", {"collectors.axis_degrees=12"}},
        {"march, 2 bands", {"collectors.bands=2"}},
        {"march, 5 bands", {"collectors.bands=5"}},
        {"march, 6 bands", {"collectors.bands=6"}},
        {"march, 5k samples", {"collectors.samples=5000"}},
        {"march, 100k samples", {"collectors.samples=100000"}},
        {"march, camera cells of 4 voxels",
         {"collectors.closure=camera", "collectors.cell_voxels=4"}},
        {"march, camera cells of 2 voxels", {"collectors.closure=camera"}},
    };
    return all;
}

int fail(const Status& status) {
    fmt::print(stderr, "{}\n", status.message);
    return int(status.code);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 5) {
        fmt::print(stderr, "usage: pileus_variants SCENE HALF1 HALF2 PHOTONS [key=value ...]\n");
        return 2;
    }
    std::vector<std::string> common(argv + 5, argv + argc);
    common.push_back(std::string("collectors.photons=") + argv[4]);
    Image half[2];
    for (int i = 0; i < 2; ++i) {
        std::string said;
        const Status status = read_picture(argv[2 + i], "", half[i], said);
        if (!status) return fail(status);
    }
    fmt::print(
        "| variant | collectors | relMSE | noise | bias² | mean | CPU s tracing | CPU s all |\n"
        "|---|---|---|---|---|---|---|---|\n");
    for (const Variant& v : variants()) {
        Picture p;
        std::vector<std::string> set = v.set;
        set.insert(set.end(), common.begin(), common.end());
        Metrics m;
        Status status = take(argv[1], set, p);
        if (status) status = compare_with_halves(p.image, half[0], half[1], {}, m);
        if (!status) return fail(status);
        fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:+.1f} % | {:.1f} | {:.1f} |\n", v.name,
                   p.collectors, m.relmse, m.relmse_own_noise, m.relmse - m.relmse_own_noise,
                   100 * m.bias / m.mean_reference, p.tracing_cpu_s, p.total_cpu_s);
        std::fflush(stdout);
    }
    return 0;
}
