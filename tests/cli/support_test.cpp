// SPDX-License-Identifier: Apache-2.0
// What the support table calls refused is refused in files, in its words; the rest is planned.
// in: small scenes, a feature each, by every method -> out: pass or fail.
// docs/support.md
#include "src/methods/support.h"

#include <doctest/doctest.h>

#include "src/scene/read_scene.h"
#include "src/session/render.h"

namespace {

using namespace pileus;
using Overrides = std::vector<std::string>;

constexpr const char* kHead = R"(
[camera]
position_m = [0, -9, 0.5]
target_m = [0, 0, 0.5]
resolution = [8, 6]
[sun]
elevation_deg = 40
)";
constexpr const char* kBox = R"(
[[medium]]
density = "uniform:box"
bounds_m = [[0, 0, 0], [1, 1, 1]]
resolution = [4, 4, 4]
)";
constexpr const char* kBalls = R"(
[[medium]]
density = "procedural:plume"
bounds_m = [[0, 0, 0], [1, 1, 1]]
plume = { particles = 200 }
)";
constexpr const char* kSky = R"(
[[medium]]
density = "procedural:sky"
sky = { type = "cumulus", size = 32 }
bounds_m = [[0, 0, 500], [4000, 4000, 2000]]
resolution = [4, 4, 4]
)";
const std::string kPoint = "[[light]]\ntype = \"point\"\nposition_m = [3, 0, 3]\n";

/// The method of a column, and its display.
Overrides sets_of(MethodColumn column) {
    const std::string name = method_column_name(column), boards = "-billboards";
    const std::size_t end = name.find(boards);
    const std::string method = name.substr(0, end);
    Overrides sets = {"method.name=" + method};
    if (end != std::string::npos) sets.push_back(method + ".display=billboards");
    return sets;
}

bool shows_balls(MethodColumn column) {
    return column == MethodColumn::kParticles || column == MethodColumn::kParticleBillboards;
}

struct Case {
    Feature feature;
    std::string text;  ///< behind the medium
    Overrides sets;
    const char* medium = nullptr;  ///< null: what the method shows
    void (*ask)(RenderOptions&) = nullptr;
};

/// METHOD in a key is the method's table.
std::string of_table(std::string set, const std::string& method) {
    const std::size_t at = set.find("METHOD");
    if (at == std::string::npos) return set;
    std::string table = method;
    for (char& c : table)
        if (c == '-') c = '_';
    return set.replace(at, 6, table);
}

Status tried(const Case& c, MethodColumn column) {
    Overrides sets = sets_of(column);
    const std::string method = sets[0].substr(sets[0].find('=') + 1);
    std::string text = kHead;
    text += c.medium != nullptr ? c.medium : shows_balls(column) ? kBalls : kBox;
    const bool given = c.medium == kSky || c.feature == Feature::kTransferRows;
    if (!given) text += "extinction_per_m = 1\n";
    for (const std::string& set : c.sets) sets.push_back(of_table(set, method));
    Scene scene;
    PILEUS_TRY(read_scene_text(text + c.text, "s.toml", "", sets, scene));
    RenderOptions options;
    if (c.ask != nullptr) c.ask(options);
    Report report;
    return plan_scene(scene, options, false, report);
}

const std::vector<Case>& all_cases() {
    const auto layers = [](const char* name) {
        return Overrides{std::string("output.layers=[\"radiance\",\"") + name + "\"]"};
    };
    static const std::vector<Case> all = {
        {Feature::kSun, "", {}},
        {Feature::kSunDisc, "", {"sun.angular_radius_deg=0.5"}},
        {Feature::kSkyConstant, "[sky]\nradiance = [1, 1, 1]\n", {}},
        {Feature::kAir, "[atmosphere]\n", {}},
        {Feature::kLampParallel, "[[light]]\ntype = \"directional\"\nelevation_deg = 30\n", {}},
        {Feature::kLampPoint, kPoint, {}},
        {Feature::kLampSpot,
         "[[light]]\ntype = \"spot\"\nposition_m = [3, 0, 3]\ntarget_m = [0, 0, 0]\n",
         {}},
        {Feature::kLampSphere, kPoint + "radius_m = 1\nshadow_samples = 4\n", {}},
        {Feature::kEmission, "", {"medium.0.emission=0.1"}},
        {Feature::kGround, "[ground]\n", {}},
        {Feature::kOrthographic, "", {"camera.projection=orthographic", "camera.height_m=2"}},
        {Feature::kFlux, "", {"camera.projection=flux", "camera.height_m=2"}},
        {Feature::kLens, "", {"camera.aperture_radius_m=0.1"}},
        {Feature::kSeveral, std::string(kBox) + "extinction_per_m = 1\n", {}},
        {Feature::kColoured, "", {"medium.0.albedo=[0.5,0.75,1]"}},
        {Feature::kPeriodic, "", {"medium.0.boundary=periodic"}},
        {Feature::kConstantCells, "", {"medium.0.interpolation=constant"}},
        {Feature::kTransferRows,
         "transfer = [{ value = 0, extinction_per_m = 0, albedo = 1 }, "
         "{ value = 1, extinction_per_m = 1, albedo = 1 }]\n",
         {},
         kBox},
        {Feature::kDetailBaked, "", {"medium.0.detail={tile_m=1,refine=2}"}},
        {Feature::kDetailMarched, "", {"medium.0.detail={tile_m=1,refine=0}"}},
        {Feature::kSkyInPlace, "", {"medium.0.sky.evaluate=direct"}, kSky},
        {Feature::kSkyOnGrid, "", {"medium.0.sky.evaluate=grid"}, kSky},
        {Feature::kParticlesOnGrid, "", {}, kBalls},
        {Feature::kPhaseSmooth, "", {"medium.0.phase={type=\"rayleigh\"}"}},
        {Feature::kPhaseNarrow, "", {"medium.0.phase={type=\"cloud\",effective_radius_um=10}"}},
        {Feature::kLayerDepth, "", layers("depth")},
        {Feature::kLayerError, "", layers("error")},
        {Feature::kLayerCloud, "", layers("cloud")},
        {Feature::kLayerTau, "", layers("transmittance")},
        {Feature::kLayerLight, "", layers("light")},
        {Feature::kLayerOrder, "", layers("order")},
        {Feature::kLayerShadow, "[ground]\n", layers("shadow")},
        {Feature::kLayerOcclusion, "[ground]\n", layers("occlusion")},
        {Feature::kFilter, "", {"filter.kind=regression"}},
        {Feature::kThinning, "", {"METHOD.scale=2"}},
        {Feature::kLateLight, "", {"METHOD.light_refresh=2"}},
        {Feature::kBudgetPhotons,
         "",
         {},
         nullptr,
         [](RenderOptions& o) { o.budget.photons = 100; }},
        {Feature::kBudgetPhotons,
         "",
         {},
         nullptr,
         [](RenderOptions& o) { o.budget.generations = 1; }},
        {Feature::kBudgetSamples, "", {}, nullptr, [](RenderOptions& o) { o.budget.samples = 1; }},
        {Feature::kState, "", {}, nullptr, [](RenderOptions& o) { o.budget.state = "s.state"; }},
        {Feature::kBudgetSteps, "", {}, nullptr, [](RenderOptions& o) { o.budget.steps = 8; }},
        {Feature::kBudgetError,
         "",
         {"output.layers=[\"radiance\",\"error\"]"},
         nullptr,
         [](RenderOptions& o) { o.budget.error = 0.5; }},
        {Feature::kBudgetSeconds, "", {}, nullptr, [](RenderOptions& o) { o.budget.seconds = 1; }},
    };
    return all;
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("support: files are refused where the table says so, in its words, and nowhere else") {
    for (const Case& c : all_cases())
        for (std::size_t i = 0; i < std::size_t(MethodColumn::kCloudSkies); ++i) {
            const MethodColumn column = MethodColumn(i);
            const FeatureRow& row = feature_row(c.feature);
            const Support& entry = row.by[i];
            CAPTURE(std::string(row.name));
            CAPTURE(std::string(method_column_name(column)));
            const Status status = tried(c, column);
            CHECK_MESSAGE(bool(status) != entry.refused(), status.message);
            // A march that has no noise has no error to budget by either; its layer is refused.
            if (status || c.feature == Feature::kBudgetError) continue;
            CHECK(status.code == Code::kBadInput);
            CHECK_MESSAGE(holds(status.message, entry.text), status.message);
            CHECK_MESSAGE(holds(status.message, entry.allowed), status.message);
            CHECK(status.message.find('\n') == std::string::npos);
        }
}

TEST_CASE("support: skies of clouds refuse what the table says, in its words") {
    const std::string kind = "[[clouds.kind]]\nname = \"a\"\nscene = \"kind.toml\"\n";
    const auto read = [&](const std::string& text, const Overrides& sets) {
        Scene scene;
        return read_scene_text(kHead + kind + text, "s.toml", "", sets, scene);
    };
    REQUIRE(read("", {}));
    const Case cases[] = {
        {Feature::kSkyMap, "[sky]\nmap = \"a.pfm\"\n", {}},
        {Feature::kLampPoint, kPoint, {}},
        {Feature::kLampSphere, kPoint + "radius_m = 1\n", {}},
        {Feature::kFlux, "", {"camera.projection=flux", "camera.height_m=2"}},
        {Feature::kLens, "", {"camera.aperture_radius_m=0.1"}},
        {Feature::kLayerError, "", {"output.layers=[\"error\"]"}},
        {Feature::kLayerLight, "", {"output.layers=[\"light\"]"}},
        {Feature::kLayerTau, "", {"output.layers=[\"optical_depth\"]"}},
        {Feature::kLayerShadow, "", {"output.layers=[\"shadow\"]"}},
        {Feature::kLayerOcclusion, "", {"output.layers=[\"occlusion\"]"}},
        {Feature::kFilter, "", {"filter.kind=regression"}},
    };
    for (const Case& c : cases) {
        const Support& entry = support(c.feature, MethodColumn::kCloudSkies);
        CAPTURE(std::string(feature_row(c.feature).name));
        CHECK(entry.refused());
        const Status status = read(c.text, c.sets);
        CHECK(status.code == Code::kBadInput);
        CHECK_MESSAGE(holds(status.message, entry.text), status.message);
        CHECK_MESSAGE(holds(status.message, entry.allowed), status.message);
    }
}
