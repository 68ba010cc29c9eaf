// SPDX-License-Identifier: Apache-2.0
// Laws of upsampling and reprojection: marched pixels keep their bits, nothing stays nothing, rest
// becomes exact. in: a small cumulus marched in full and thinned out -> out: equal pixels, bounded
// errors. docs/upsampling.md
#include <algorithm>
#include <cmath>

#include "src/session/session.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

using Overrides = std::vector<std::string>;

Overrides marched(const Overrides& more) {
    Overrides all{"method.name = \"raymarch\"", "camera.resolution = [45, 27]",
                  "output.layers = [\"radiance\", \"alpha\", \"depth\", \"cloud\"]"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

Overrides moving(const char* orbit, const char* sun, int frames) {
    return {"animation.frames = " + std::to_string(frames),
            std::string("animation.camera_orbit_deg = ") + orbit,
            std::string("animation.sun_elevation_deg = ") + sun};
}

Picture picture(const Overrides& more) {
    return render_one(scene_from(kSmallCumulus, marched(more)));
}

/// Mean of (ours - theirs)^2 / (theirs^2 + 0.01^2) over the cloud's pixels, by green.
double rel_mse(const Picture& ours, const Picture& theirs) {
    const Channel* a = ours.image.find("G");
    const Channel* b = theirs.image.find("G");
    const Channel* alpha = theirs.image.find("A");
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < b->pixels.size(); ++i) {
        if (alpha->pixels[i] < 0.02f) continue;
        const double off = double(a->pixels[i]) - double(b->pixels[i]), is = double(b->pixels[i]);
        sum += off * off / (is * is + 1e-4);
        count += 1;
    }
    REQUIRE(count > 100);
    return sum / count;
}

}  // namespace

TEST_CASE("Marched pixels of a thinned picture have the bits of the whole one") {
    const Picture whole = picture({});
    for (int scale : {2, 4})
        for (const char* rule : {"depth", "linear", "nearest"}) {
            const Picture thin = picture({"raymarch.scale = " + std::to_string(scale),
                                          std::string("raymarch.upsample = \"") + rule + "\""});
            for (int y = scale / 2; y < 27; y += scale)
                for (int x = scale / 2; x < 45; x += scale)
                    for (const char* channel : {"R", "G", "B", "A", "Z", "cloud.R"})
                        CHECK(thin.at(channel, x, y) == whole.at(channel, x, y));
        }
}

TEST_CASE("Where no marched pixel sees cloud the background is exact") {
    const Picture whole = picture({});
    const Picture thin = picture({"raymarch.scale = 4"});
    int clear = 0;
    for (int y = 0; y < 27; ++y)
        for (int x = 0; x < 45; ++x) {
            if (thin.at("A", x, y) != 0 || whole.at("A", x, y) != 0) continue;
            ++clear;
            for (const char* channel : {"R", "G", "B"})
                CHECK(thin.at(channel, x, y) == whole.at(channel, x, y));
        }
    CHECK(clear > 200);
}

TEST_CASE("A view at rest becomes the whole picture, to the bit, whatever was there before") {
    for (int cell : {2, 4}) {
        const Scene scene =
            scene_from(kSmallCumulus, marched({"raymarch.temporal = " + std::to_string(cell)}));
        std::uint64_t hash = 0;
        FrameTarget target;
        target.hash = &hash;
        Session whole;
        REQUIRE(whole.open(scene, {}, true, nullptr));
        REQUIRE(whole.render(target));
        const std::uint64_t expected = hash;
        // Another view leaves its pixels to this one.
        Session moved;
        REQUIRE(moved.open(scene, {}, true, nullptr));
        Camera aside = scene.camera;
        aside.position_m[0] += 700;
        REQUIRE(moved.set_camera(aside));
        REQUIRE(moved.render(target));
        REQUIRE(moved.set_camera(scene.camera));
        for (int frame = 1; frame <= cell * cell; ++frame) {
            REQUIRE(moved.set_frame(frame));
            REQUIRE(moved.render(target));
            if (frame == 1) CHECK(hash != expected);  // not before every pixel had its turn
        }
        CHECK(hash == expected);
    }
}

TEST_CASE("What upsampling and reprojection err while the camera and the sun move") {
    Overrides all = moving("[0, 4]", "[33, 35]", 9);
    all.push_back("camera.resolution = [120, 72]");
    RenderOptions options;
    options.last_frame = 8;
    const auto last = [&](const char* setting) {
        Overrides own = all;
        own.push_back(setting);
        return render_one(scene_from(kSmallCumulus, marched(own)), options);
    };
    const Picture whole = last("raymarch.scale = 1");
    const auto error_of = [&](const char* setting) {
        const double error = rel_mse(last(setting), whole);
        MESSAGE(std::string(setting) << ": relMSE " << error);
        CHECK(error > 1e-7);  // something was left out
        return error;
    };
    // A picture so small has few pixels inside the cloud: larger ones err less
    // (docs/upsampling.md).
    const double half = error_of("raymarch.scale = 2"), quarter = error_of("raymarch.scale = 4");
    const double two = error_of("raymarch.temporal = 2"), four = error_of("raymarch.temporal = 4");
    CHECK(half < 0.02);
    CHECK(quarter < 0.3);
    CHECK(two < 0.5 * half);
    CHECK(four < 0.5 * quarter);
}

TEST_CASE("Any lanes and threads give the same thinned animation") {
    for (const char* setting : {"raymarch.scale = 2", "raymarch.temporal = 2"}) {
        Overrides all = moving("[0, 6]", "[30, 33]", 4);
        all.push_back(setting);
        const Scene scene = scene_from(kSmallCumulus, marched(all));
        std::string first;
        for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i)
            for (int threads : {1, 3}) {
                RenderOptions options;
                options.isa = table->name;
                options.threads = threads;
                options.last_frame = 3;
                const std::string hash = render_one(scene, options).report.hash;
                if (first.empty()) first = hash;
                CHECK(hash == first);
            }
    }
}

TEST_CASE("Scales that are none are faults of one line") {
    for (const Overrides& wrong :
         {Overrides{"raymarch.scale = 3"}, Overrides{"raymarch.temporal = 1"},
          Overrides{"raymarch.temporal = 3"},
          Overrides{"raymarch.temporal = 2", "raymarch.scale = 2"}}) {
        Session session;
        const Scene scene = scene_from(kSmallCumulus, marched(wrong));
        const Status status = session.open_film(scene, scene, {}, false, nullptr);
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.find("allowed: ") != std::string::npos);
        CHECK(status.message.find('\n') == std::string::npos);
    }
}

TEST_CASE("Photons' light, marched for few pixels: these have the bits of the whole picture") {
    for (const char* method : {"collectors", "photon-grid"}) {
        CAPTURE(method);
        const std::string key = std::string(method) == "collectors" ? "collectors" : "photon_grid";
        const auto shown = [&](const std::string& setting) {
            return render_one(
                scene_from(kSmallCumulus,
                           {"method.name = \"" + std::string(method) + "\"",
                            "camera.resolution = [45, 27]", key + "." + setting,
                            "output.layers = [\"radiance\", \"alpha\", \"depth\", \"cloud\"]"}));
        };
        const Picture whole = shown("scale = 1");
        for (int scale : {2, 4}) {
            const Picture thin = shown("scale = " + std::to_string(scale));
            int other = 0;
            for (int y = 0; y < 27; ++y)
                for (int x = 0; x < 45; ++x)
                    for (const char* channel : {"R", "G", "B", "A", "Z", "cloud.R"}) {
                        const bool same = thin.at(channel, x, y) == whole.at(channel, x, y);
                        const bool marched = x % scale == scale / 2 && y % scale == scale / 2;
                        CHECK((same || !marched));
                        other += same ? 0 : 1;
                    }
            CHECK(other > 100);
        }
    }
}

TEST_CASE("Photons' light, thinned: what has every pixel marched is refused in one line") {
    const auto told = [](const Overrides& overrides) {
        Report report;
        Overrides all{"method.name = \"collectors\""};
        all.insert(all.end(), overrides.begin(), overrides.end());
        return render(scene_from(kSmallCumulus, all), {},
                      [](int, Image&, Report&) { return Status::ok(); })
            .message;
    };
    CHECK(told({"collectors.scale = 2"}).find("the layer \"error\" has every pixel marched") !=
          std::string::npos);
    CHECK(told({"collectors.temporal = 3"}).find("allowed: 0, 2, 4") != std::string::npos);
    CHECK(told({"collectors.scale = 2", "collectors.temporal = 2"})
              .find("1 where collectors.temporal thins out pixels already") != std::string::npos);
    CHECK(told({"collectors.scale = 2", "collectors.display = \"billboards\"",
                "output.layers = [\"radiance\"]"})
              .find("\"billboards\" has no marched pixels") != std::string::npos);
}
