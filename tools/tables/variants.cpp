// SPDX-License-Identifier: Apache-2.0
// Bias, noise and time of the collectors' variants against the path tracer.
// in: a scene, two independent pictures of it by method path with path.pixel = "centre", photons
// for the variants -> out: a Markdown table; docs/collectors.md, "Error and time".
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "lab/compare/picture.h"
#include "src/scene/read_scene.h"
#include "src/session/render.h"

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
        out.tracing_cpu_s = report.clocks.tracing_cpu_s;
        out.total_cpu_s = report.clocks.cpu_s;
        out.collectors = report.prepared.collectors;
        return Status::ok();
    });
}

/// Mean over the cloud's pixels and channels of the product of the differences from both halves,
/// relative to the radiance; of what the variant's own standard error says of it; mean difference.
/// The radiance is that of a smooth picture: the noise of the halves would stay in a denominator.
struct Score {
    double relative = 0, noise = 0, mean = 0;
};

Score score(const Image& x, const Image (&half)[2], const Image& smooth) {
    static const char* const kColours[3] = {"R", "G", "B"};
    static const char* const kErrors[3] = {"error.R", "error.G", "error.B"};
    const Channel* alpha = smooth.find("A");
    const std::size_t pixels = alpha->pixels.size();
    double mean = 0, count = 0;
    for (const char* c : kColours)
        for (std::size_t i = 0; i < pixels; ++i)
            if (alpha->pixels[i] > 0.02f) mean += double(smooth.find(c)->pixels[i]), ++count;
    mean /= count;

    Score s;
    for (std::size_t c = 0; c < 3; ++c) {
        const float *a = x.find(kColours[c])->pixels.data(), *e = x.find(kErrors[c])->pixels.data();
        const float* r[2] = {half[0].find(kColours[c])->pixels.data(),
                             half[1].find(kColours[c])->pixels.data()};
        const float* near = smooth.find(kColours[c])->pixels.data();
        for (std::size_t i = 0; i < pixels; ++i) {
            if (alpha->pixels[i] <= 0.02f) continue;
            const double one = double(a[i]) - double(r[0][i]), two = double(a[i]) - double(r[1][i]);
            const double unit = double(near[i]) * double(near[i]) + 1e-4 * mean * mean;
            s.relative += one * two / unit / count;
            s.noise += double(e[i]) * double(e[i]) / unit / count;
            s.mean += 0.5 * (one + two) / (count * mean);
        }
    }
    return s;
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
    std::vector<std::string> cells = common;
    cells.insert(cells.end(), {"collectors.closure=camera", "collectors.cell_voxels=4"});
    Picture smooth;
    Status status = take(argv[1], cells, smooth);
    if (!status) return fail(status);
    if (half[0].width != smooth.image.width || half[0].height != smooth.image.height ||
        half[1].width != smooth.image.width || half[1].height != smooth.image.height)
        return fail(Status::bad_input("the reference's size is not the scene's"));
    fmt::print(
        "| variant | collectors | relMSE | noise | bias² | mean | CPU s tracing | CPU s all |\n"
        "|---|---|---|---|---|---|---|---|\n");
    for (const Variant& v : variants()) {
        Picture p;
        std::vector<std::string> set = v.set;
        set.insert(set.end(), common.begin(), common.end());
        status = take(argv[1], set, p);
        if (!status) return fail(status);
        const Score s = score(p.image, half, smooth.image);
        fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:+.1f} % | {:.1f} | {:.1f} |\n", v.name,
                   p.collectors, s.relative, s.noise, s.relative - s.noise, 100 * s.mean,
                   p.tracing_cpu_s, p.total_cpu_s);
        std::fflush(stdout);
    }
    return 0;
}
