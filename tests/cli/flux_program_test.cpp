// SPDX-License-Identifier: Apache-2.0
// pileus flux and render --verify: exit statuses, lines, JSON, files left behind.
// in: small scenes and command lines -> out: pass or fail.
// docs/flux.md; docs/report.md, "Verify"
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/cli/run_program.h"
#include "tests/io/test_image.h"

using namespace pileus;
using nlohmann::json;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;
using Names = std::vector<std::string>;

TEST_CASE("flux: shares as JSON and lines, maps beside them, whatever the camera") {
    const ProgramFolder folder;
    const Outcome lines = folder.run("flux s.toml --columns 3 2 -o maps.pfm --quiet");
    REQUIRE_MESSAGE(lines.exit_status == 0, lines.errors);
    CHECK(lines.output.find("reflectance") == 0);
    CHECK(line_count(lines.output) == 6);
    CHECK(folder.left() == Names{"maps.pfm"});
    // A view from above has an up that the detector must not trip over; none is needed at all.
    for (const char* camera : {"--set camera.position_m=[0,0,900] --set camera.up=[0,1,0]",
                               "--set camera.projection=orthographic"}) {
        CAPTURE(camera);
        const Outcome out = folder.run("flux s.toml --columns 1 --json " + std::string(camera));
        REQUIRE_MESSAGE(out.exit_status == 0, out.errors);
        const json flux = json::parse(out.output);
        for (const char* key : {"reflectance", "transmittance", "transmittance_direct",
                                "transmittance_diffuse", "absorptance"}) {
            CHECK(flux[key]["mean"].is_number());
            CHECK(flux[key]["standard_error"].is_number());
        }
        CHECK(flux["absorptance"]["mean"] == 0);
        CHECK(flux["columns"] == json::array({1, 1}));
    }
}

TEST_CASE(
    "flux: without a budget errors are half a per cent, as a budget of the same number says") {
    const ProgramFolder folder;
    for (const char* method : {"path", "photons"}) {
        CAPTURE(method);
        const std::string run = "flux s.toml --columns 1 --json --method " + std::string(method);
        const Outcome out = folder.run(run);
        REQUIRE_MESSAGE(out.exit_status == 0, out.errors);
        const json flux = json::parse(out.output);
        for (const char* key : {"reflectance", "transmittance"})
            CHECK(flux[key]["standard_error"].get<double>() <=
                  0.00501 * flux[key]["mean"].get<double>());
        const bool paths = *method == 'p' && method[1] == 'a' && method[2] == 't';
        const std::uint64_t count = flux[paths ? "samples_per_column" : "photons"];
        CHECK(count > (paths ? 64 : 1 << 19));
        const Outcome same = folder.run(
            run + (paths ? " --budget samples=" : " --budget photons=") + std::to_string(count));
        REQUIRE_MESSAGE(same.exit_status == 0, same.errors);
        CHECK(json::parse(same.output)["reflectance"] == flux["reflectance"]);
    }
}

TEST_CASE("flux: a scene without a camera is measured") {
    const ProgramFolder folder;
    std::string text = test::small_scene();
    const std::size_t from = text.find("[camera]"), to = text.find("[sun]");
    text.erase(from, to - from);
    folder.files().put("none.toml", text);
    const Outcome out = folder.run("flux none.toml --columns 2");
    CHECK_MESSAGE(out.exit_status == 0, out.errors);
    // Nor does a high ground hide the one that is thought up.
    const Outcome high = folder.run(
        "flux none.toml --columns 2 --set ground.altitude_m=4000 --set "
        "medium.0.bounds_m=[[0,0,4100],[100,100,4200]]");
    CHECK_MESSAGE(high.exit_status == 0, high.errors);
}

TEST_CASE("flux: absorbed power as a volume beside its description, heating in kelvins a day") {
    const ProgramFolder folder;
    const Outcome out = folder.run(
        "flux s.toml --absorbed heat.raw --cells 4 2 5 --columns 1 --density 0.5 --heat-capacity "
        "1004 --budget photons=20_000 --set medium.0.resolution=[8,4,10] --set "
        "medium.0.albedo=0.9 --set sun.irradiance=1000 --json");
    REQUIRE_MESSAGE(out.exit_status == 0, out.errors);
    CHECK(folder.left() == Names{"heat.raw", "heat.raw.json"});
    const json flux = json::parse(out.output);
    CHECK(flux["method"] == "photons");
    CHECK(flux["absorbed"]["layers"].size() == 5);
    CHECK(flux["absorbed"]["layers"][0]["height_m"] == 10);
    const double power = flux["absorbed"]["box"]["channels"][1];
    CHECK(power > 0.1);
    CHECK(double(flux["heating"]["box"]["channels"][1]) ==
          doctest::Approx(power * 86400 / 502).epsilon(1e-9));
    const json head = json::parse(folder.files().get("heat.raw.json"));
    CHECK(head["size"] == json::array({4, 2, 5}));
    CHECK(head["planes"] == json::array({"power", "error"}));
    CHECK(head["bounds_m"] == json::array({{-50, -50, 0}, {50, 50, 100}}));
    const std::string bytes = folder.files().get("heat.raw");
    REQUIRE(bytes.size() == 2 * 40 * 4);
    double sum = 0;
    for (std::size_t i = 0; i < 40; ++i) {
        float value;
        std::memcpy(&value, bytes.data() + 4 * i, 4);
        sum += double(value) / 40;
    }
    CHECK(sum == doctest::Approx(power).epsilon(1e-5));
    const Outcome coloured = folder.run(
        "flux s.toml --absorbed heat.raw --columns 1 --budget photons=2000 --set "
        "medium.0.albedo=[1,0.9,0.5] --set medium.0.resolution=[2,2,2]");
    REQUIRE_MESSAGE(coloured.exit_status == 0, coloured.errors);
    CHECK(folder.files().get("heat.raw").size() == 6 * 8 * 4);
    CHECK(coloured.output.find("absorbed, W/m3           0 ") != std::string::npos);
    CHECK(line_count(coloured.output) == 8);
}

TEST_CASE("flux: sensors and light from below, as lines and JSON") {
    const ProgramFolder folder;
    folder.files().put("q.toml",
                       "[[sensor]]\nname = \"zenith\"\nposition_m = [0, 0, 1]\n"
                       "direction = [0, 0, 1]\nsamples = 256\n"
                       "[[sensor]]\nname = \"middle\"\nheight_m = 50\nsamples = 256\n");
    const Outcome out = folder.run("flux s.toml --columns 1 --sensors q.toml --json");
    REQUIRE_MESSAGE(out.exit_status == 0, out.errors);
    const json flux = json::parse(out.output);
    CHECK(flux["sensors"].size() == 2);
    CHECK(flux["sensors"][0]["name"] == "zenith");
    CHECK(flux["sensors"][0]["radiance"]["channels"][0] > 0);
    CHECK(flux["sensors"][1]["down"]["channels"][0] >
          flux["sensors"][1]["down_direct"]["channels"][0]);
    const Outcome below = folder.run(
        "flux s.toml --columns 1 --sensors q.toml --from-below 1 2 3 --set sun.elevation_deg=-5");
    REQUIRE_MESSAGE(below.exit_status == 0, below.errors);
    CHECK(below.output.find("of the flux from below; 1 x 1 columns") != std::string::npos);
    CHECK(below.output.find("middle, up") != std::string::npos);
    CHECK(line_count(below.output) == 9);
}

TEST_CASE("flux and verify: wrong use is one line and leaves nothing") {
    const ProgramFolder folder;
    const std::pair<const char*, const char*> faults[] = {
        {"flux s.toml --columns 0", "--columns: no such whole number"},
        {"flux s.toml --budget photons=9", "--budget photons: not for method path"},
        {"flux s.toml --budget seconds=9", "--budget seconds: not for method flux"},
        {"flux s.toml -o s.toml", "s.toml: output: is the scene itself"},
        {"flux none.toml", "none.toml: no such file"},
        {"flux s.toml --set medium=[]", "s.toml: medium: none, allowed: at least one"},
        {"flux s.toml --method rays", "--method: unknown, \"rays\", allowed: path, photons"},
        {"flux s.toml --method path --absorbed a.raw", "--absorbed: by photons alone"},
        {"flux s.toml --method photons --budget samples=9", "--budget samples: not for method ph"},
        {"flux s.toml --absorbed a.vdb", "a.vdb: extension: unknown, \".vdb\", allowed: .raw"},
        {"flux s.toml --absorbed a.raw -o a.raw", "a.raw: output: "},
        {"flux s.toml --absorbed a.raw --density 1", "--heat-capacity: missing"},
        {"flux s.toml --density 1 --heat-capacity 1", "--density: heats by what --absorbed"},
        {"flux s.toml --absorbed a.raw --density 0 --heat-capacity 1", "--density: "},
        {"flux s.toml --cells 3", "--cells: of what --absorbed measures"},
        {"flux s.toml --from-below 1 2", "--from-below: two numbers"},
        {"flux s.toml --from-below 0", "--from-below: dark"},
        {"flux s.toml --from-below nan", "--from-below: "},
        {"flux s.toml --sensors no.toml", "no.toml: cannot read: no such file"},
        {"flux s.toml --sensors s.toml", "s.toml:2:2: \"camera\": unknown table"},
        {"flux s.toml --set sun.elevation_deg=-1", "s.toml: sun: not above the horizon"},
        {"render s.toml -o a.pfm --verify 0", "--verify: no such whole number"},
        {"render s.toml -o a.pfm --verify 3 --show samples", "--verify: a view is no picture"},
    };
    for (const auto& one : faults) {
        const char *const line = one.first, *const fault = one.second;
        CAPTURE(line);
        const Outcome out = folder.run(line);
        CHECK(out.exit_status == 2);
        CHECK_MESSAGE(out.errors.find(fault) == 0, out.errors);
        CHECK(line_count(out.errors) == 1);
        CHECK(folder.left().empty());
    }
    const Outcome told = folder.run("render s.toml -o a.pfm --verify 9");
    CHECK(told.exit_status == 0);
    CHECK_MESSAGE(told.output.find("verify           bias ") != std::string::npos, told.output);
}
