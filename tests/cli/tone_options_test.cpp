// SPDX-License-Identifier: Apache-2.0
// --exposure, --tone, --white-balance and --glare: what they show, and where they are refused.
// in: PILEUS_PROGRAM, a small scene -> out: pass or fail.
// docs/exposure.md
#include "src/io/images/image_file.h"
#include "tests/cli/run_program.h"

using namespace pileus;
using test::check_refused;
using test::holds;
using test::Outcome;
using test::ProgramFolder;

TEST_CASE("tone options: each changes what a display shows, and no radiance") {
    const ProgramFolder folder;
    REQUIRE(folder.run("render s.toml -q -o a.ppm a.pfm").exit_status == 0);
    const std::string shown = folder.files().get("a.ppm"), light = folder.files().get("a.pfm");
    std::vector<std::string> all{shown};
    for (const char* option :
         {"--exposure 1", "--exposure auto", "--tone hable", "--tone agx", "--tone agx-punchy",
          "--tone linear", "--white-balance 3200", "--white-balance 9e3", "--glare 0.3"}) {
        CAPTURE(option);
        REQUIRE(folder.run("render s.toml -q -o b.ppm b.pfm " + std::string(option)).exit_status ==
                0);
        CHECK(folder.files().get("b.pfm") == light);
        all.push_back(folder.files().get("b.ppm"));
        for (std::size_t i = 0; i + 1 < all.size(); ++i) CHECK(all[i] != all.back());
    }
    REQUIRE(folder.run("render s.toml -q -o b.ppm --exposure 0 --tone standard --glare 0")
                .exit_status == 0);
    CHECK(folder.files().get("b.ppm") == shown);
    // What was measured can be given again.
    const Outcome measured = folder.run("render s.toml -o b.ppm --exposure auto");
    CHECK_MESSAGE(holds(measured.errors, "exposure b.ppm: "), measured.errors);
    CHECK_MESSAGE(holds(measured.errors, " stops\n"), measured.errors);
    CHECK(folder.run("render s.toml -q -o b.ppm --exposure auto").errors == "");
}

TEST_CASE("tone options: wrong values are a line each") {
    const ProgramFolder folder;
    check_refused(
        folder, "render s.toml -o a.ppm --tone AgX",
        "--tone: no such curve, \"AgX\", allowed: standard, hable, agx, agx-punchy, linear");
    for (const char* value : {"1999", "25001", "nan", "warm", "''"})
        check_refused(folder, "render s.toml -o a.ppm --white-balance " + std::string(value),
                      "allowed: 2000 to 25000");
    for (const char* value : {"-0.1", "1.5", "much"})
        check_refused(folder, "render s.toml -o a.ppm --glare=" + std::string(value),
                      "allowed: 0 to 1");
    check_refused(folder, "merge a.part -o a.ppm --tone x", "a.part: ");
}

TEST_CASE("tone options: refused where nothing shows them") {
    const ProgramFolder folder;
    for (const char* option :
         {"--exposure 1", "--tone agx", "--white-balance 5000", "--glare 0.1"}) {
        const std::string line =
            std::string(option).substr(0, std::string(option).find(' ')) + ": ";
        const std::string where = "no file shows it, radiance is written as it is, allowed: ";
        for (const char* files :
             {"-o a.pfm", "-o a.part --part 1/2", "--report r.json", "--blocks b.blocks"})
            check_refused(folder, "render s.toml " + std::string(files) + ' ' + option,
                          line + where);
        check_refused(folder, "render s.toml -o a.ppm --show tree " + std::string(option),
                      line + "a view's colours are no light");
    }
    REQUIRE(folder.run("render s.toml -q -o a.pfm").exit_status == 0);
    for (const char* option : {"--tone agx", "--white-balance 5000", "--glare 0.1"})
        check_refused(folder, "compare a.pfm a.pfm " + std::string(option),
                      ": without --exposure, allowed: together with it");
}

TEST_CASE("tone options: merge and compare show what render does") {
    const ProgramFolder folder;
    const std::string options = " --exposure auto --tone agx --white-balance 4500 --glare 0.1";
    REQUIRE(folder.run("render s.toml -q -o a.ppm" + options).exit_status == 0);
    for (const char* part : {"1", "2"})
        REQUIRE(
            folder.run(std::string("render s.toml -q --part ") + part + "/2 -o p" + part + ".part")
                .exit_status == 0);
    const Outcome merged = folder.run("merge p1.part p2.part -q -o b.ppm" + options);
    REQUIRE_MESSAGE(merged.exit_status == 0, merged.errors);
    CHECK(folder.files().get("b.ppm") == folder.files().get("a.ppm"));
    check_refused(folder, "merge p1.part p2.part -o b.pfm --tone agx", "--tone: no file shows it");
    if (!can_write_image("a.png")) return;
    REQUIRE(folder.run("render s.toml -q -o a.png a.pfm" + options).exit_status == 0);
    const Outcome same = folder.run("compare a.pfm a.png" + options);
    CHECK_MESSAGE(same.exit_status == 0, same.errors);
    CHECK_MESSAGE(holds(same.output, "relMSE         0  (the counted pixels are the same"),
                  same.output);
    CHECK_MESSAGE(
        holds(same.output, "shown at exposure auto, tone agx, white balance 4500, glare 0.1"),
        same.output);
}
