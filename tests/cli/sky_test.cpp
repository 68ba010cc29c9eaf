// SPDX-License-Identifier: Apache-2.0
// Sky maps through the program: pictures, the plan, faults and exit statuses.
// in: scenes with small maps -> out: exit status, lines, files left behind.
// docs/scene.md "Sky map".
#include "src/io/images/image_file.h"
#include "tests/cli/run_program.h"
#include "tests/support/sky_images.h"

using namespace pileus;
using test::holds;
using test::ProgramFolder;

namespace {

void put_map(const ProgramFolder& folder, const char* name, double least) {
    const auto value = [&](int row, int column, int c) { return least + row + column * c; };
    REQUIRE(write_image(sky_test::sky_image(8, 4, value), folder.files().path(name), {}));
}

const char* const kMap = " --set sky.map=sky.pfm ";

}  // namespace

TEST_CASE("program: a sky map is planned, lights the medium and is written about") {
    const ProgramFolder folder;
    put_map(folder, "sky.pfm", 0.5);
    const test::Outcome plan = folder.run(std::string("plan s.toml") + kMap);
    CHECK(plan.exit_status == 0);
    CHECK(holds(plan.output, "photons from the sky"));
    CHECK(holds(plan.output, "coefficients per colour channel: coloured sky map"));
    CHECK(holds(plan.output, "sky map  "));
    CHECK(holds(folder.run("plan s.toml --set sky.radiance=1").output, "sky map: constant sky"));
    const test::Outcome outcome =
        folder.run(std::string("render s.toml --quiet -o a.pfm --report r.json") + kMap);
    CHECK_MESSAGE(outcome.exit_status == 0, outcome.errors);
    CHECK(holds(folder.files().get("r.json"), "\"light\": \"sky\""));
    // Twice the light, by either way, is twice the picture, bit for bit.
    CHECK(folder
              .run(std::string("render s.toml --quiet -o b.pfm --set sky.map_scale=2 --set "
                               "sun.irradiance=2") +
                   kMap)
              .exit_status == 0);
    Image once, twice;
    REQUIRE(read_image(folder.files().path("a.pfm"), once));
    REQUIRE(read_image(folder.files().path("b.pfm"), twice));
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < once.channels[c].pixels.size(); ++i)
            CHECK(twice.channels[c].pixels[i] == 2 * once.channels[c].pixels[i]);
}

TEST_CASE("program: without a medium the map itself is the picture") {
    const ProgramFolder folder;
    put_map(folder, "sky.pfm", 0);
    folder.files().put("v.toml",
                       "[camera]\nposition_m = [0, 0, 5]\ntarget_m = [0, 1, 5]\n"
                       "projection = \"orthographic\"\nresolution = [2, 2]\n"
                       "[sky]\nmap = \"sky.pfm\"\n");
    const test::Outcome outcome = folder.run("render v.toml --quiet -o v.pfm");
    CHECK_MESSAGE(outcome.exit_status == 0, outcome.errors);
    Image seen;
    REQUIRE(read_image(folder.files().path("v.pfm"), seen));
    // Level and to the north: between rows 1 and 2 and columns 3 and 4; a few ulp of rounding.
    for (std::size_t c = 0; c < 3; ++c)
        for (float v : seen.channels[c].pixels.span())
            CHECK(v == doctest::Approx(1.5 + 3.5 * double(c)).epsilon(1e-5));
}

TEST_CASE("program: a map that cannot be used ends it with status 2 or 3 and leaves nothing") {
    const ProgramFolder folder;
    put_map(folder, "low.pfm", -1);
    folder.files().put("wide.pfm", "PF\n32768 4096\n-1\n");
    const std::vector<std::string> before = folder.left();
    const struct {
        const char* map;
        int status;
        const char* line;
    } rows[] = {{"none.pfm", 2, "none.pfm: "},
                {"low.pfm", 2, "low.pfm: pixel 0 0: R: no radiance, -1, allowed: 0 to 1e30"},
                {"wide.pfm", 3, "wide.pfm: size: too large, 32768 x 4096, allowed: "}};
    for (const auto& row : rows) {
        const test::Outcome outcome = folder.run(
            std::string("render s.toml --quiet -o a.pfm --report r.json --set sky.map=") + row.map);
        CHECK(outcome.exit_status == row.status);
        CHECK_MESSAGE(holds(outcome.errors, row.line), outcome.errors);
        CHECK(std::count(outcome.errors.begin(), outcome.errors.end(), '\n') == 1);
        CHECK(folder.left() == before);
    }
}
