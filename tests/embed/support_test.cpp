// SPDX-License-Identifier: Apache-2.0
// What the support table calls refused is refused in sessions, in its words; the rest is taken.
// in: a small scene by every method -> out: pass or fail.
// docs/support.md
#include "src/methods/support.h"

#include "src/session/session.h"
#include "tests/embed/clouds_harness.h"
#include "tests/support/air_scene.h"

using namespace host_test;

namespace {

using pileus::Feature;
using pileus::MethodColumn;
using pileus::Support;

constexpr const char* kPlume = R"(
[camera]
position_m = [0, -9, 0.5]
target_m = [0, 0, 0.5]
resolution = [8, 6]
[sun]
elevation_deg = 40
[[medium]]
density = "procedural:plume"
bounds_m = [[0, 0, 0], [1, 1, 1]]
extinction_per_m = 1
)";

/// The method of a column, and its display.
Overrides sets_of(MethodColumn column) {
    const std::string name = pileus::method_column_name(column), boards = "-billboards";
    const std::size_t end = name.find(boards);
    const std::string method = name.substr(0, end);
    Overrides sets = {"method.name=" + method};
    if (end != std::string::npos) sets.push_back(method + ".display=billboards");
    // Where a scene gives no steps or no ring there are none to choose.
    if (method == "optical-depth") sets.push_back("optical_depth.steps=40");
    if (method == "photon-grid") sets.push_back("photon_grid.ring=true");
    return sets;
}

bool shows_balls(MethodColumn column) {
    return column == MethodColumn::kParticles || column == MethodColumn::kParticleBillboards;
}

struct Call {
    Feature feature;
    pileus::Status (*call)(pileus::Session&);
};

pileus::Status set_work(pileus::Session& s, void (*change)(pileus::FrameWork&)) {
    pileus::FrameWork work;
    change(work);
    return s.set_work(work);
}

constexpr Call kCalls[] = {
    {Feature::kSetLights,
     [](pileus::Session& s) {
         std::vector<pileus::LightSettings> lights(1);
         lights[0].position_m = {0, -3, 8000};
         return s.set_lights(lights);
     }},
    {Feature::kOffCentre,
     [](pileus::Session& s) {
         pileus::Camera camera = s.camera();
         camera.has_frustum = true;
         camera.frustum.half_width = camera.frustum.half_height = 0.25;
         camera.frustum.shift_x = 0.5;
         return s.set_camera(camera);
     }},
    {Feature::kThinning,
     [](pileus::Session& s) { return set_work(s, [](pileus::FrameWork& w) { w.scale = 2; }); }},
    {Feature::kLateLight,
     [](pileus::Session& s) {
         return set_work(s, [](pileus::FrameWork& w) { w.light_refresh = 2; });
     }},
    {Feature::kFrameSteps,
     [](pileus::Session& s) { return set_work(s, [](pileus::FrameWork& w) { w.steps = 8; }); }},
    {Feature::kFramePhotons,
     [](pileus::Session& s) { return set_work(s, [](pileus::FrameWork& w) { w.photons = 100; }); }},
    {Feature::kWorstCase,
     [](pileus::Session& s) {
         pileus::FrameUnits units;
         return s.most_units({}, units);
     }},
};

/// Red, green, blue and alpha of all pixels, lit by all of the scene's light.
std::vector<float> picture_of(const pileus::Scene& scene, const pileus::Camera& camera) {
    pileus::FrameState frame = scene;
    frame.camera = camera;
    pileus::Session session;
    REQUIRE(session.open(scene, frame, {}, nullptr));
    std::uint64_t done = 0;
    REQUIRE(session.step(1000, done));
    const std::size_t row = std::size_t(camera.resolution[0]) * 4;
    std::vector<float> pixels(row * std::size_t(camera.resolution[1]));
    pileus::FrameTarget target;
    target.has_colour = true;
    target.colour.format = pileus::PixelFormat::kRgba32F;
    target.colour.rows = {reinterpret_cast<unsigned char*>(pixels.data()),
                          std::int64_t(row * sizeof(float))};
    REQUIRE(session.render(target));
    return pixels;
}

}  // namespace

TEST_CASE("support: a picture off the centre is that part of a wide one") {
    for (std::size_t c = 0; c < std::size_t(MethodColumn::kCloudSkies); ++c) {
        const MethodColumn column = MethodColumn(c);
        // Paths draw other numbers in other pixels.
        if (column == MethodColumn::kPath) continue;
        if (pileus::support(Feature::kOffCentre, column).refused()) continue;
        CAPTURE(std::string(pileus::method_column_name(column)));
        const std::string text = shows_balls(column) ? kPlume : render_test::kSmallCumulus;
        Overrides sets = sets_of(column);
        sets.push_back("output.layers=[\"radiance\",\"alpha\"]");
        const pileus::Scene scene = render_test::scene_from(text, sets);
        pileus::Camera wide = scene.camera, right;
        wide.resolution = {16, 12};
        wide.has_frustum = true;
        wide.frustum.half_width = 0.25, wide.frustum.half_height = 0.1875;
        right = wide;
        right.resolution = {8, 12};
        right.frustum.half_width = right.frustum.shift_x = 0.125;
        const std::vector<float> whole = picture_of(scene, wide), part = picture_of(scene, right);
        float largest = 0, off = 0;
        for (std::size_t y = 0; y < 12; ++y)
            for (std::size_t i = 0; i < 32; ++i) {
                const float a = whole[y * 64 + 32 + i], b = part[y * 32 + i];
                largest = std::max(largest, a), off = std::max(off, std::abs(a - b));
            }
        CHECK(largest > 0);
        // Rounding of a ray's direction.
        CHECK(off <= 1e-4f * largest);
    }
}

TEST_CASE("support: sessions are refused where the table says so, and nowhere else") {
    for (std::size_t c = 0; c < std::size_t(MethodColumn::kCloudSkies); ++c) {
        const MethodColumn column = MethodColumn(c);
        CAPTURE(std::string(pileus::method_column_name(column)));
        const std::string text = shows_balls(column) ? kPlume : render_test::kSmallCumulus;
        Overrides sets = sets_of(column);
        sets.push_back("output.layers=[\"radiance\"]");
        const pileus::Scene scene = render_test::scene_from(text, sets);
        pileus::Session session;
        REQUIRE(session.open(scene, {}, true, nullptr));
        for (const Call& call : kCalls) {
            const pileus::FeatureRow& row = pileus::feature_row(call.feature);
            const Support& entry = row.by[c];
            CAPTURE(std::string(row.name));
            const pileus::Status status = call.call(session);
            CHECK_MESSAGE(bool(status) != entry.refused(), status.message);
            if (status) continue;
            CHECK(status.code == pileus::Code::kBadInput);
            CHECK_MESSAGE(status.message.find(", allowed: ") != std::string::npos, status.message);
            CHECK_MESSAGE(status.message.find(entry.text) != std::string::npos, status.message);
        }
    }
}

TEST_CASE("support: the air has its sky and a sun, whatever a host sets") {
    for (std::size_t c = 0; c < std::size_t(MethodColumn::kCloudSkies); ++c) {
        const MethodColumn column = MethodColumn(c);
        if (shows_balls(column)) continue;
        CAPTURE(std::string(pileus::method_column_name(column)));
        Overrides sets = sets_of(column);
        sets.push_back("output.layers=[\"radiance\"]");
        Hosted host(air_test::in_air(), sets);
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        host.step(1);
        const std::string before = host.hash();
        auto sky = cleared<pileus_environment>();
        for (const std::uint32_t present : {0u, 1u}) {
            sky.present = present;
            CHECK(pileus_session_set_environment(host.session.get(), &sky, &host.out.error) ==
                  PILEUS_ERROR_INPUT);
            CHECK(host.out.line() ==
                  "sky: conflicts with [atmosphere], which has its own, allowed: not set");
        }
        auto sun = cleared<pileus_sun>();
        CHECK(pileus_session_set_sun(host.session.get(), &sun, &host.out.error) ==
              PILEUS_ERROR_INPUT);
        CHECK(host.out.line() ==
              "sun: none under [atmosphere], allowed: one, above the horizon or below it");
        // Nothing has come of it.
        CHECK(host.hash() == before);
    }
}

TEST_CASE("support: the sky of clouds in air, too, and it takes neither lights nor work") {
    clouds_test::CloudySky sky({}, {}, true);
    const auto refused = [&](pileus_code code, Feature feature) {
        const Support& entry = pileus::support(feature, MethodColumn::kCloudSkies);
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(sky.sky.out.line().find(entry.text) != std::string::npos, sky.sky.out.line());
    };
    pileus_session* const s = sky.sky.session.get();
    pileus_error* const e = &sky.sky.out.error;
    auto map = cleared<pileus_environment>();
    map.present = 1;
    refused(pileus_session_set_environment(s, &map, e), Feature::kSetInAir);
    auto lamp = cleared<pileus_lamp>();
    refused(pileus_session_set_lamps(s, &lamp, 1, e), Feature::kSetLights);
    auto work = cleared<pileus_work>();
    work.steps = 8;
    refused(pileus_session_set_work(s, &work, e), Feature::kFrameSteps);
    auto units = cleared<pileus_units>();
    refused(pileus_session_most_units(s, nullptr, &units, e), Feature::kWorstCase);
}
