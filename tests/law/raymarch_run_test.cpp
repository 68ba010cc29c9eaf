// SPDX-License-Identifier: Apache-2.0
// Runs of the raymarch: what it refuses, what its plan says, frames alone and together, jitter.
// in: scenes and budgets -> out: one line each; pictures compared.
// docs/raymarch.md
#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/render_harness.h"

namespace raymarch_run_test {

using namespace render_test;

using Keys = std::vector<std::string>;

Scene marched(Keys keys) {
    keys.insert(keys.begin(),
                {"method.name=raymarch", "output.layers=[\"alpha\"]", "raymarch.sky_light=none"});
    return scene_from(kSmallCumulus, keys);
}

std::string fault_of(const Scene& scene, const RenderOptions& options = {}) {
    const Status status = render(scene, options, [](int, Image&, Report&) { return Status::ok(); });
    CHECK(status.code == Code::kBadInput);
    return status.message;
}

TEST_CASE("raymarch: what it cannot do is refused in one line") {
    CHECK(fault_of(marched({"output.layers=[\"error\"]"}))
              .find("test.toml: output.layers: method raymarch has no") == 0);
    CHECK(fault_of(marched({"raymarch.light=buffer", "raymarch.light_path=cone"}))
              .find("test.toml: raymarch.light: ") == 0);
    RenderOptions photons, error;
    photons.budget.photons = 5;
    error.budget.error = 0.1;
    CHECK(fault_of(marched({}), photons) ==
          "--budget photons: not for method raymarch, allowed: steps=N, seconds=S");
    CHECK(fault_of(marched({}), error).find("--budget error: not for method raymarch") == 0);
}

TEST_CASE("raymarch: a time chooses pixels and steps, which make the picture again") {
    for (const Keys& more : {Keys{}, Keys{"animation.frames=3", "raymarch.temporal=2"},
                             Keys{"method.name=optical-depth"}, Keys{"camera.resolution=[1,1]"}}) {
        CAPTURE(more.size());
        // No time at all leaves the least, an hour leaves all.
        const std::string whole = render_one(marched(more)).report.hash;
        RenderOptions options;
        options.budget.seconds = 3600;
        const Picture rich = render_one(marched(more), options);
        CHECK(rich.report.hash == whole);
        options.budget.seconds = 1e-9;
        const Picture poor = render_one(marched(more), options);
        const FrameWork& work = poor.report.frame_work;
        CHECK(work.steps <= 16);
        Keys keys = more;
        if (work.temporal > 0)
            keys.push_back("raymarch.temporal=" + std::to_string(work.temporal));
        else if (poor.report.method == "raymarch")
            keys.push_back("raymarch.scale=" + std::to_string(work.scale));
        keys.push_back("raymarch.light=" + poor.report.light_rule);
        keys.push_back("raymarch.steps=" + std::to_string(work.steps));
        keys.push_back("optical_depth.steps=" + std::to_string(work.steps));
        if (poor.report.method == "raymarch")
            CHECK(render_one(marched(keys)).report.hash == poor.report.hash);
        else
            CHECK(work.scale == 4);
    }
}

bool holds(const std::vector<std::string>& list, const std::string& text) {
    for (const std::string& one : list)
        if (one.find(text) != std::string::npos) return true;
    return false;
}

TEST_CASE("raymarch: plan and report name what is appearance, and what is left out") {
    const Picture plain = render_one(marched({"raymarch.scattering=single"}));
    CHECK_FALSE(holds(plain.report.plan.needed, "appearance"));
    CHECK_FALSE(holds(plain.report.plan.needed, "approximation"));
    const Picture all =
        render_one(marched({"raymarch.powder=powder", "raymarch.ambient=1", "raymarch.phase=peak",
                            "raymarch.scattering=forward", "raymarch.detail=true",
                            "raymarch.steps=8", "raymarch.sky_light=ambient"}));
    for (const char* what :
         {"powder: appearance, not physics", "ambient emission: appearance, not physics",
          "phase functions over their peak: appearance, not physics",
          "forward scattering: approximation", "skylight", "coarser levels of the density"})
        CHECK_MESSAGE(holds(all.report.plan.needed, what), what);
}

TEST_CASE("raymarch: a frame of an animation alone is the frame among the others") {
    const Scene scene = marched({"animation.frames=3", "animation.camera_orbit_deg=[0,40]",
                                 "animation.sun_elevation_deg=[35,10]", "raymarch.jitter=hash"});
    std::vector<std::string> together;
    RenderOptions all;
    all.last_frame = 2;
    Status status = render(scene, all, [&](int, Image&, Report& report) {
        together.push_back(report.hash);
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    REQUIRE(together.size() == 3);
    CHECK(together[0] != together[1]);
    for (int frame = 0; frame < 3; ++frame) {
        RenderOptions options;
        options.first_frame = options.last_frame = frame;
        status = render(scene, options, [&](int, Image&, Report& report) {
            CHECK(report.hash == together[std::size_t(frame)]);
            return Status::ok();
        });
        REQUIRE_MESSAGE(status, status.message);
    }
}

double mean_of(const Picture& p) {
    double sum = 0;
    for (float v : p.image.find("G")->pixels.span()) sum += double(v);
    return sum / double(p.image.find("G")->pixels.size());
}

TEST_CASE("raymarch: jitter is new with each seed, takes nothing off, and can be turned down") {
    const Keys coarse = {"raymarch.steps=12", "camera.resolution=[48,28]"};
    const auto with = [&](Keys more) {
        more.insert(more.begin(), coarse.begin(), coarse.end());
        return render_one(marched(more));
    };
    const Picture plain = with({});
    const double fine =
        mean_of(render_one(marched({"raymarch.steps=2048", "camera.resolution=[48,28]"})));
    for (const char* jitter : {"hash", "blue-noise"}) {
        const std::string key = std::string("raymarch.jitter=") + jitter;
        const Picture one = with({key, "seed=1"}), two = with({key, "seed=2"});
        CHECK(one.report.hash != plain.report.hash);
        CHECK(one.report.hash != two.report.hash);
        CHECK(with({key, "seed=1"}).report.hash == one.report.hash);
        CHECK(with({key, "raymarch.jitter_share=0"}).report.hash == plain.report.hash);
        // 400 cloudy pixels with errors of their own: the mean is as good as that of many steps, to
        // the 2 % that twelve steps of 130 m err by without jitter.
        CHECK(std::fabs(mean_of(one) / fine - 1) < 0.02);
    }
}

TEST_CASE("raymarch: a lattice locked to planes stays while the camera moves along its view") {
    // Cells of exactly 64 m; the camera moves by 32 m and 16 m, the planes are 64 m apart.
    std::string text = kSmallCumulus;
    const std::string view = "fov_deg = 40";
    text.replace(text.find(view), view.size(), "projection = \"orthographic\"\nheight_m = 1500");
    const auto picture = [&](const char* place, const char* lock) {
        return render_one(scene_from(
            text, {"method.name=raymarch", "output.layers=[\"alpha\"]", "raymarch.sky_light=none",
                   std::string("camera.position_m=") + place, "camera.target_m=[0,0,1024]",
                   std::string("raymarch.grid_lock_m=") + lock, "raymarch.spacing=voxel"}));
    };
    // A camera within the medium's box, in front of the cloud: rays begin where it stands.
    const Picture a = picture("[0,-760,1024]", "64"), b = picture("[0,-744,1024]", "64");
    const Picture c = picture("[0,-760,1024]", "0"), d = picture("[0,-744,1024]", "0");
    const auto difference = [](const Picture& p, const Picture& q) {
        double worst = 0;
        for (std::size_t i = 0; i < p.image.channels[1].pixels.size(); ++i)
            worst = std::max(worst, std::fabs(double(p.image.channels[1].pixels[i]) -
                                              double(q.image.channels[1].pixels[i])));
        return worst;
    };
    CAPTURE(difference(a, b));
    CAPTURE(difference(c, d));
    CHECK(difference(c, d) > 1e-4);
    // Places of samples differ by the rounding of their distances.
    CHECK(difference(a, b) < 0.01 * difference(c, d));
}

}  // namespace raymarch_run_test
