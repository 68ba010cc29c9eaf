// SPDX-License-Identifier: Apache-2.0
// Bias, noise and time of the collectors' variants against a long camera-directed estimate.
// in: a scene, photons for the reference and for the variants -> out: a Markdown table.
// docs/methods.md 3; fills the table in docs/collectors.md.
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "src/api/render.h"
#include "src/scene/read_scene.h"

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

/// Mean over the cloud's pixels and channels of squared differences relative to the reference,
/// and of what the standard errors of both say that noise contributes to it.
struct Score {
    double relative = 0, noise = 0, reference_noise = 0, mean = 0;
    double bias_squared() const { return relative - noise - reference_noise; }
};

Score score(const Image& x, const Image& reference) {
    static const char* const kColours[3] = {"R", "G", "B"};
    static const char* const kErrors[3] = {"error.R", "error.G", "error.B"};
    const Channel* alpha = reference.find("A");
    const std::size_t pixels = alpha->pixels.size();
    double mean = 0, count = 0;
    for (const char* c : kColours)
        for (std::size_t i = 0; i < pixels; ++i)
            if (alpha->pixels[i] > 0.02f) mean += double(reference.find(c)->pixels[i]), ++count;
    mean /= count;

    Score s;
    for (std::size_t c = 0; c < 3; ++c) {
        const Channel &r = *reference.find(kColours[c]), &a = *x.find(kColours[c]);
        const Channel &re = *reference.find(kErrors[c]), &ae = *x.find(kErrors[c]);
        for (std::size_t i = 0; i < pixels; ++i) {
            if (alpha->pixels[i] <= 0.02f) continue;
            const double d = double(a.pixels[i]) - double(r.pixels[i]);
            const double unit = double(r.pixels[i]) * double(r.pixels[i]) + 1e-4 * mean * mean;
            s.relative += d * d / unit;
            s.noise += double(ae.pixels[i]) * double(ae.pixels[i]) / unit;
            s.reference_noise += double(re.pixels[i]) * double(re.pixels[i]) / unit;
            s.mean += d;
        }
    }
    s.relative /= count;
    s.noise /= count;
    s.reference_noise /= count;
    s.mean /= count * mean;
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
        {"march, 4 bands (default)", {}},
        {"march, no first-order split", {"collectors.first_order_split=false"}},
        {"march, window", {"collectors.window=true"}},
        {"march, lobe", {"collectors.closure=lobe"}},
        {"march, 2 bands", {"collectors.bands=2"}},
        {"march, 6 bands", {"collectors.bands=6"}},
        {"march, 5k samples", {"collectors.samples=5000"}},
        {"march, 100k samples", {"collectors.samples=100000"}},
        {"march, camera cells of 4 voxels",
         {"collectors.closure=camera", "collectors.cell_voxels=4"}},
    };
    return all;
}

int fail(const Status& status) {
    fmt::print(stderr, "{}\n", status.message);
    return int(status.code);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        fmt::print(stderr,
                   "usage: pileus_variants SCENE REFERENCE_PHOTONS PHOTONS [key=value ...]\n");
        return 2;
    }
    const std::vector<std::string> common(argv + 4, argv + argc);
    const auto with = [&](std::vector<std::string> set, const char* photons) {
        set.insert(set.end(), common.begin(), common.end());
        set.push_back(std::string("collectors.photons=") + photons);
        return set;
    };
    Picture reference;
    Status status = take(argv[1], with({"collectors.closure=camera"}, argv[2]), reference);
    if (!status) return fail(status);
    fmt::print(
        "| variant | collectors | relMSE | noise | bias² | mean | CPU s tracing | CPU s all |\n"
        "|---|---|---|---|---|---|---|---|\n");
    for (const Variant& v : variants()) {
        Picture p;
        status = take(argv[1], with(v.set, argv[3]), p);
        if (!status) return fail(status);
        const Score s = score(p.image, reference.image);
        fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:+.1f} % | {:.1f} | {:.1f} |\n", v.name,
                   p.collectors, s.relative, s.noise, s.bias_squared(), 100 * s.mean,
                   p.tracing_cpu_s, p.total_cpu_s);
        std::fflush(stdout);
    }
    const Score self = score(reference.image, reference.image);
    fmt::print(
        "\nReference: camera-directed, cells of 2 voxels, {} photons; its own noise {:.5f}.\n",
        argv[2], self.reference_noise);
    return 0;
}
