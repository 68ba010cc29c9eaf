// SPDX-License-Identifier: Apache-2.0
// pileus flux and render --verify: exit statuses, lines, JSON, files left behind.
// in: small scenes and command lines -> out: pass or fail.
// docs/flux.md; docs/report.md, "Verify"
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

TEST_CASE("flux: a scene without a camera is measured") {
    const ProgramFolder folder;
    std::string text = test::small_scene();
    const std::size_t from = text.find("[camera]"), to = text.find("[sun]");
    text.erase(from, to - from);
    folder.files().put("none.toml", text);
    const Outcome out = folder.run("flux none.toml --columns 2");
    CHECK_MESSAGE(out.exit_status == 0, out.errors);
}

TEST_CASE("flux and verify: wrong use is one line and leaves nothing") {
    const ProgramFolder folder;
    const std::pair<const char*, const char*> faults[] = {
        {"flux s.toml --columns 0", "--columns: no such whole number"},
        {"flux s.toml --budget photons=9", "--budget photons: not for method path"},
        {"flux s.toml --budget seconds=9", "--budget seconds: not for method flux"},
        {"flux s.toml -o s.toml", "s.toml: output: is the scene itself"},
        {"flux none.toml", "none.toml: no such file"},
        {"flux s.toml --set sun.elevation_deg=-1", "s.toml: sun: not above the horizon"},
        {"render s.toml -o a.pfm --verify 0", "--verify: no such whole number"},
        {"render s.toml -o a.pfm --verify 3 --show samples", "--verify: a view is no picture"},
    };
    for (const auto& [line, fault] : faults) {
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
