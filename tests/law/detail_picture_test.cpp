// SPDX-License-Identifier: Apache-2.0
// Pictures of media with detail: none without strength, alike by all kernels, near a finer grid's.
// in: a small cumulus, a uniform box -> out: pass or fail.
// docs/detail.md
#include <algorithm>

#include "tests/support/render_harness.h"

namespace detail_picture_test {

using namespace render_test;

std::vector<std::string> with(std::vector<std::string> list, const std::vector<std::string>& more) {
    list.insert(list.end(), more.begin(), more.end());
    return list;
}

const std::vector<std::string> kDetail = {"medium.0.detail.tile_m=256",
                                          "medium.0.detail.strength=1"};

std::string fault_of(const std::vector<std::string>& overrides) {
    Scene scene;
    return read_scene_text(kSmallCumulus, "test.toml", "", overrides, scene).message;
}

std::string digest_of(const Picture& p, const char* stage) {
    for (const auto& d : p.report.digests)
        if (d.first == stage) return d.second;
    return {};
}

TEST_CASE("detail: without strength pictures and densities have the bits of none") {
    for (const char* method : {"raymarch", "optical-depth", "collectors", "photon-grid", "path"}) {
        CAPTURE(method);
        std::vector<std::string> own{std::string("method.name=") + method,
                                     "path.samples_per_pixel=1"};
        if (std::string(method) == "raymarch" || std::string(method) == "optical-depth")
            own.push_back("output.layers=[\"alpha\",\"depth\"]");
        const Picture without = render_one(scene_from(kSmallCumulus, own));
        const Picture none = render_one(
            scene_from(kSmallCumulus,
                       with(own, {"medium.0.detail.tile_m=256", "medium.0.detail.strength=0"})));
        CHECK(digest_of(without, "image") == digest_of(none, "image"));
        CHECK(digest_of(without, "density") == digest_of(none, "density"));
        const bool marches = std::string(method) != "path";
        const Picture detailed = render_one(scene_from(
            kSmallCumulus,
            with(with(own, kDetail), {marches ? "seed=4" : "medium.0.detail.refine=2"})));
        CHECK(digest_of(without, "image") != digest_of(detailed, "image"));
        CHECK(digest_of(without, "density") != digest_of(detailed, "density"));
    }
}

TEST_CASE("detail: every marching method has the same bits by all kernels and threads") {
    for (const char* method : {"raymarch", "optical-depth", "collectors", "photon-grid"})
        for (const char* more : {"seed=4", "medium.0.boundary=periodic"}) {
            CAPTURE(method);
            CAPTURE(more);
            std::vector<std::string> own =
                with(kDetail, {std::string("method.name=") + method, more,
                               "camera.resolution=[13,9]", "output.layers=[\"alpha\",\"depth\"]"});
            const Scene scene = scene_from(kSmallCumulus, own);
            std::string first;
            int threads = 1;
            for (int i = 0; kernel_table_at(i) != nullptr; ++i) {
                if (kernel_table_at(i)->device != nullptr) continue;
                RenderOptions options;
                options.kernels = kernel_table_at(i);
                options.threads = threads++;
                const std::string image = digest_of(render_one(scene, options), "image");
                if (first.empty()) first = image;
                CHECK(image == first);
            }
            CHECK_FALSE(first.empty());
        }
}

TEST_CASE("detail: marched it is what a finer grid shows, which the coarse grid is not") {
    const std::vector<std::string> own = {"method.name=raymarch",      "raymarch.light=march",
                                          "raymarch.spacing=voxel",    "raymarch.sky_light=none",
                                          "output.layers=[\"alpha\"]", "camera.resolution=[48,28]"};
    // Lumps of 32 m on cells of 64 m; on the finer grid cells of 8 m.
    const std::vector<std::string> detail = {
        "medium.0.detail.tile_m=128", "medium.0.detail.octaves=1", "medium.0.detail.strength=1"};
    const Picture coarse = render_one(scene_from(kSmallCumulus, own));
    const Picture marched = render_one(scene_from(kSmallCumulus, with(own, detail)));
    const Picture fine = render_one(
        scene_from(kSmallCumulus, with(with(own, detail), {"medium.0.detail.refine=8"})));
    const auto off = [&](const Picture& p) {
        double sum = 0;
        for (const char* c : {"A", "G"})
            for (int y = 0; y < 28; ++y)
                for (int x = 0; x < 48; ++x) {
                    const double d = double(p.at(c, x, y)) - double(fine.at(c, x, y));
                    sum += d * d;
                }
        return std::sqrt(sum);
    };
    CHECK(off(coarse) > 0.1);
    CHECK(off(marched) < 0.25 * off(coarse));
}

TEST_CASE("detail: a march keeps the mean optical depth of a uniform medium") {
    // Pixels and steps lie evenly over whole tiles, so that they mean the tile.
    constexpr const char* kBox = R"(
[camera]
position_m = [32, 32, 300]
target_m = [32, 32, 0]
up = [0, 1, 0]
projection = "orthographic"
height_m = 64
resolution = [32, 32]
[[medium]]
density = "uniform:box"
bounds_m = [[0, 0, 0], [64, 64, 64]]
resolution = [2, 2, 2]
extinction_per_m = 0.015625
phase = { type = "isotropic" }
detail = { tile_m = 64, strength = 1, dense = 1, cells = 16 }
[method]
name = "raymarch"
[raymarch]
steps = 32
[output]
layers = ["optical_depth"]
)";
    const Picture p = render_one(scene_from(kBox));
    double least = 9, most = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double tau = double(p.at("tau", x, y));
            least = std::min(least, tau), most = std::max(most, tau);
        }
    // Sums of 32 rounded steps.
    CHECK(sum_of(p, "tau").value / 1024 == doctest::Approx(1).epsilon(1e-5));
    CHECK(most - least > 0.1);
}

TEST_CASE("detail: what cannot be is refused in one line") {
    struct Row {
        std::vector<std::string> overrides;
        const char* line;
    };
    const std::vector<std::string>& d = kDetail;
    const Row rows[] = {
        {{"medium.0.detail.strength=0.5"},
         "medium.0.detail.tile_m: missing, nothing, allowed: number in [1e-09, 1e+09], metres"},
        {with(d, {"medium.0.detail.strength=1.5"}), "medium.0.detail.strength: out of range"},
        {with(d, {"medium.0.detail.tile_m=0"}), "medium.0.detail.tile_m: out of range"},
        {with(d, {"medium.0.detail.cells=48"}),
         "medium.0.detail.cells: not a power of two, 48, allowed: 16, 32, 64, 128"},
        {with(d, {"medium.0.detail.cells=256"}), "medium.0.detail.cells: out of range"},
        {with(d, {"medium.0.detail.cells=16", "medium.0.detail.octaves=3"}),
         "medium.0.detail.octaves: too fine for the cells, 3, allowed: 0, or such that 4 * "
         "2^octaves is at most cells, 16"},
        {with(d, {"medium.0.detail.noise=white"}), "medium.0.detail.noise: unknown value"},
        {with(d, {"medium.0.detail.refine=17"}), "medium.0.detail.refine: out of range"},
        {with(d, {"method.name=path"}),
         "medium.0.detail.refine: method path does not march, 0, allowed: 1 to 16"},
        {with(d, {"method.name=particles"}), "medium.0.detail.tile_m: particles have no grid, 256"},
        {with(d, {"collectors.display=billboards"}),
         "medium.0.detail.refine: billboards are not marched, 0, allowed: 1 to 16"},
        {with(d, {"medium.0.interpolation=constant"}),
         "medium.0.detail.refine: cells of constant density are not marched with detail, 0"},
    };
    for (const Row& row : rows) {
        const std::string fault = fault_of(row.overrides);
        CHECK_MESSAGE(fault.find(row.line) != std::string::npos, fault, " | ", row.line);
        CHECK(fault.find('\n') == std::string::npos);
    }
    // Of a struct, whose numbers no text has checked.
    Scene scene = scene_from(kSmallCumulus, d);
    scene.media[0].detail.octaves = 1 << 30;
    CHECK(check_scene(scene).message.find("detail.octaves: out of range") != std::string::npos);
    CHECK(fault_of(with(d, {"method.name=path", "medium.0.detail.refine=1"})).empty());
    CHECK(fault_of(with(d, {"method.name=path", "medium.0.detail.strength=0"})).empty());
}

TEST_CASE("detail: paths that verify a picture are not without it unasked") {
    RenderOptions options;
    options.verify = 4;
    const Scene scene = scene_from(kSmallCumulus, kDetail);
    const Status status = render(scene, options, [](int, Image&, Report&) { return Status::ok(); });
    CHECK(status.message ==
          "test.toml: medium.0.detail.refine: --verify knows detail on a grid alone, 0, allowed: "
          "1 to 16");
}

}  // namespace detail_picture_test
