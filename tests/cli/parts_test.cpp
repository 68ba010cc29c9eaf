// SPDX-License-Identifier: Apache-2.0
// render --part, merge, --crop, --tiles and ranks of MPI, as a user types them.
// in: PILEUS_PROGRAM; mpirun where the program was built with MPI -> out: equal hashes, one line
// for each fault. docs/farm.md
#include "tests/cli/run_program.h"

using namespace pileus;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;
using test::ranks;

namespace {

std::string hash_of(const Outcome& outcome) {
    CAPTURE(outcome.errors);
    REQUIRE(outcome.exit_status == 0);
    return outcome.output.substr(0, 16);
}

std::string part(int index, int count, const std::string& more = "") {
    return "render s.toml -q " + more + " --part " + std::to_string(index) + "/" +
           std::to_string(count) + " -o p." + std::to_string(index) + ".part";
}

}  // namespace

TEST_CASE("parts: four files in any order are the picture of one run") {
    const ProgramFolder folder;
    for (const char* more : {"", "--set method.name=path --budget samples=3",
                             "--set method.name=raymarch --set camera.crop=[1,1,15,8]",
                             "--set method.name=photon-grid --seed 11"}) {
        CAPTURE(more);
        const std::string whole =
            hash_of(folder.run(std::string("render s.toml -q -o w.exr ") + more));
        for (int i = 1; i <= 4; ++i) {
            const Outcome made = folder.run(part(i, 4, more));
            CAPTURE(made.errors);
            CHECK(made.exit_status == 0);
        }
        CHECK(hash_of(folder.run("merge p.3.part p.1.part p.4.part p.2.part -o m.exr")) == whole);
        CHECK(hash_of(folder.run("render m.exr")) == whole);
    }
}

TEST_CASE("parts: what is wrong with them is one line, and nothing is written") {
    const ProgramFolder folder;
    for (int i = 1; i <= 3; ++i) REQUIRE(folder.run(part(i, 3)).exit_status == 0);
    check_refused(folder, "merge p.1.part p.3.part -o m.exr", "merge: part 2 of 3 is missing");
    check_refused(folder, "merge p.1.part p.2.part p.3.part p.2.part -o m.exr", "is there twice");
    check_refused(folder, "merge p.1.part p.2.part p.3.part", "merge: no output");
    check_refused(folder, "merge p.1.part p.2.part p.3.part -o p.2.part.exr p.1.part", "is a part");
    check_refused(folder, "merge p.1.part s.toml p.3.part -o m.exr", "s.toml: part: not a file");
    check_refused(folder, "merge p.1.part none.part -o m.exr", "none.part");
    check_refused(folder, "merge -o m.exr", "FILE.part: missing");
    const std::string bytes = folder.files().get("p.2.part");
    folder.files().put("cut.part", bytes.substr(0, bytes.size() / 2));
    check_refused(folder, "merge p.1.part cut.part p.3.part -o m.exr", "cut.part: part: damaged");
    check_refused(folder, "render s.toml --part 4/3 -o a.part", "--part I");
    check_refused(folder, "render s.toml --part 1/2 -o a.exr", "allowed: -o FILE.part");
    check_refused(folder, "render s.toml --part 1/2 -o a.part --verify 9", "--part: together with");
    check_refused(folder, "render s.toml --crop 3,3,3,9 -o a.exr", "camera.crop: no part");
    check_refused(folder, "render s.toml --tiles 4 -o a.exr", "--tiles");
    check_refused(folder, "render s.toml --tiles 16 -o a.png", "allowed: -o FILE.exr");
    check_refused(folder, "pack s.toml -o a.pack --set camera.crop=[0,0,2,2]", "camera.crop");
    folder.files().put("s.toml", std::string(test::small_scene()) + "\n# another\n");
    REQUIRE(folder.run("render s.toml -q --part 2/3 -o q.part").exit_status == 0);
    check_refused(folder, "merge p.1.part q.part p.3.part -o m.exr", "another scene");
}

TEST_CASE("parts: of a film they are frames, written as pictures") {
    const ProgramFolder folder;
    const std::string film =
        "render s.toml -q --set animation.frames=5 "
        "--set animation.camera_orbit_deg=[0,90] --set method.name=raymarch ";
    const std::string whole = folder.run(film + "-o a.pfm").output;
    std::string parts;
    for (int i = 1; i <= 3; ++i)
        parts += folder.run(film + "--part " + std::to_string(i) + "/3 -o a.pfm").output;
    CHECK(parts == whole);
}

TEST_CASE("crop and tiles: the same hashes as the pictures that they are of") {
    const ProgramFolder folder;
    const std::string whole = hash_of(folder.run("render s.toml -q -o w.exr"));
    CHECK(hash_of(folder.run("render s.toml -q --tiles 8 -o t.exr --report t.json")) == whole);
    CHECK(hash_of(folder.run("hash t.exr")) == whole);
    // The last band is below the cloud, which is no reason for a warning.
    const Outcome high = folder.run(
        "render s.toml -q --tiles 8 -o t.exr --set method.name=raymarch "
        "--set camera.resolution=[32,64]");
    CHECK(high.exit_status == 0);
    CHECK(!holds(high.errors, "no ray meets"));
    const Outcome cut = folder.run("render s.toml -q --crop 4,2,9,7 -o c.exr");
    CHECK(hash_of(folder.run("hash c.exr")) == hash_of(cut));
    const Outcome same = folder.run("compare c.exr w.exr --all-pixels --max-abs 0");
    CAPTURE(same.output);
    CHECK(same.exit_status == 0);
    CHECK(holds(same.output, "5 x 5"));
    CHECK(hash_of(folder.run("render c.exr")) == hash_of(cut));
}

TEST_CASE("flux: parts and ranks measure what one process does") {
    const ProgramFolder folder;
    const bool mpi = holds(folder.run("info").output, "mpi            yes");
    folder.files().put(
        "sensors.toml",
        "[[sensor]]\nname = \"a\"\nheight_m = 60\n"
        "[[sensor]]\nname = \"b\"\nposition_m = [0, 0, 150]\ndirection = [0, 0, -1]\n");
    for (const char* more :
         {"--budget samples=16 --columns 5 3",
          "--budget samples=8 --set medium.0.albedo=0.9 --json",
          "--method photons --budget photons=20000", "--budget samples=8 --sensors sensors.toml",
          "--budget photons=20000 --absorbed heat.raw --cells 2"}) {
        CAPTURE(more);
        const std::string run = std::string("flux s.toml -q ") + more;
        const Outcome whole = folder.run(run);
        CAPTURE(whole.errors);
        REQUIRE(whole.exit_status == 0);
        for (int i = 1; i <= 3; ++i) {
            const Outcome made = folder.run(run + " --part " + std::to_string(i) + "/3 -o f." +
                                            std::to_string(i) + ".part");
            CAPTURE(made.errors);
            REQUIRE(made.exit_status == 0);
        }
        const Outcome merged = folder.run(run + " --merge f.3.part f.1.part f.2.part");
        CAPTURE(merged.errors);
        CHECK(merged.exit_status == 0);
        CHECK(merged.output == whole.output);
        check_refused(folder, run + " --merge f.3.part f.1.part", "part 2 of 3 is missing");
        check_refused(folder, run + " --seed 99 --merge f.1.part f.2.part f.3.part",
                      "another seed");
        check_refused(folder,
                      run + " --set sun.elevation_deg=39 --merge f.1.part f.2.part f.3.part",
                      "f.1.part");
        if (mpi) CHECK(folder.run(run, ranks(3)).output == whole.output);
    }
    check_refused(folder, "flux s.toml --part 1/2 -o a.part", "allowed: --budget samples=N");
    check_refused(folder, "flux s.toml --part 1/2 --budget samples=4 -o a.exr", "-o FILE.part");
    check_refused(folder, "merge f.1.part f.2.part f.3.part -o m.exr", "allowed: pileus flux");
    // Without a budget ranks go on to the same error.
    if (mpi)
        CHECK(folder.run("flux s.toml -q", ranks(2)).output == folder.run("flux s.toml -q").output);
}

TEST_CASE("ranks: the hash of one process, whatever their number") {
    const ProgramFolder folder;
    if (!holds(folder.run("info").output, "mpi            yes")) {
        MESSAGE("left out: the program was built without MPI");
        return;
    }
    for (const char* more : {"", "--set method.name=path --budget samples=3",
                             "--set method.name=raymarch", "--set method.name=photon-grid"}) {
        CAPTURE(more);
        const std::string run = std::string("render s.toml -q -o w.exr ") + more;
        const std::string whole = hash_of(folder.run(run));
        // All numbers once; starting ranks takes longer than their work.
        const bool first = *more == 0;
        for (const int count : first ? std::vector<int>{1, 2, 3, 5, 8} : std::vector<int>{3}) {
            CAPTURE(count);
            CHECK(hash_of(folder.run(run, ranks(count))) == whole);
        }
    }
    // One band of eight rows, of which most ranks have none.
    for (const char* method : {"path --budget samples=2", "raymarch"}) {
        const std::string run =
            std::string("render s.toml -q -o w.exr --set camera.resolution=[12,7] ") +
            "--set method.name=" + method;
        CHECK(hash_of(folder.run(run, ranks(5))) == hash_of(folder.run(run)));
    }
    // What all ranks have to know on the way.
    for (const char* more : {"--set method.name=path --budget error=0.2",
                             "--set method.name=path --budget samples=2 --verify 20",
                             "--set method.name=photon-grid --set photon_grid.ring=false "
                             "--set output.layers=[\\\"error\\\"] --budget error=0.05"}) {
        CAPTURE(more);
        const std::string run = std::string("render s.toml -q -o w.exr ") + more;
        const std::string whole = hash_of(folder.run(run));
        for (const int count : {2, 3}) CHECK(hash_of(folder.run(run, ranks(count))) == whole);
    }
    // A state goes on with another number of ranks.
    const std::string path = "render s.toml -q -o w.exr --set method.name=path --budget samples=";
    const std::string five = hash_of(folder.run(path + "5"));
    hash_of(folder.run(path + "2 --state st", ranks(2)));
    hash_of(folder.run(path + "3 --state st", ranks(3)));
    CHECK(hash_of(folder.run(path + "5 --state st")) == five);
    CHECK(folder.run(path + "1000000 --budget seconds=0.2", ranks(2)).exit_status == 0);
    const std::string film =
        "render s.toml -q -o f.pfm --set animation.frames=3 "
        "--set animation.sun_elevation_deg=[20,60] ";
    const auto sorted = [](std::string text) {
        std::vector<std::string> lines;
        for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
            lines.push_back(text.substr(at, text.find('\n', at) - at));
        std::sort(lines.begin(), lines.end());
        return lines;
    };
    CHECK(sorted(folder.run(film, ranks(2)).output) == sorted(folder.run(film).output));
    const std::vector<std::string> before = folder.left();
    for (const char* bad :
         {"render none.toml -o a.exr",
          "render s.toml -o a.pfm --set animation.frames=2 --set "
          "animation.sun_elevation_deg=[20,60]",
          "render s.toml -o a.exr --part 1/2",
          "render s.toml -o a.exr --set method.name=raymarch --budget seconds=1"}) {
        CAPTURE(bad);
        const Outcome outcome = folder.run(bad, ranks(3) + " -q");
        CAPTURE(outcome.errors);
        CHECK(outcome.exit_status == 2);
        CHECK(line_count(outcome.errors) == 1);
    }
    CHECK(folder.left() == before);
}

TEST_CASE("ranks: files that rank 0 alone reads") {
    const ProgramFolder folder;
    if (!holds(folder.run("info").output, "mpi            yes")) {
        MESSAGE("left out: the program was built without MPI");
        return;
    }
    std::string density(4 * 4 * 4, '\0');
    for (std::size_t i = 0; i < density.size(); ++i) density[i] = char(i * 37 % 251);
    folder.files().put("v.raw", density);
    folder.files().put("places.toml", "[[sensor]]\nposition_m = [2, 2, 0]\n");
    const std::string own = test::small_scene();
    const std::size_t medium = own.find("density = ");
    const std::string rest = own.substr(own.find('\n', medium));
    const auto scene = [&](const std::string& name) {
        return own.substr(0, medium) + "density = { file = \"" + name +
               "\", type = \"uint8\", size = [4, 4, 4] }" + rest;
    };
    std::filesystem::create_directories(folder.files().path("deep/er"));
    std::filesystem::create_directories(folder.files().path("copies"));
    folder.files().put("deep/er/t.toml", scene("../../v.raw"));
    const std::string render = "render deep/er/t.toml -q -o a.pfm --set method.name=raymarch ";
    const std::string whole = hash_of(folder.run(render));
    const std::vector<std::string> before = folder.left();
    CHECK(hash_of(folder.run(render + "--stage copies", ranks(3))) == whole);
    CHECK(hash_of(folder.run(render + "--stage copies --set method.name=collectors "
                                      "--set collectors.photons=5000",
                             ranks(2))) ==
          hash_of(folder.run(render + "--set method.name=collectors "
                                      "--set collectors.photons=5000")));
    const std::string flux = "flux deep/er/t.toml --budget samples=16 ";
    CHECK(folder.run(flux + "--stage copies", ranks(2)).output == folder.run(flux).output);
    // Names that step back, a folder with its slash, the folder one stands in.
    folder.files().put("deep/er/back.toml", scene("../er/../../v.raw"));
    for (const char* where : {"copies/", "."})
        CHECK(hash_of(folder.run("render deep/er/back.toml -q -o a.pfm "
                                 "--set method.name=raymarch --stage " +
                                     std::string(where),
                                 ranks(2))) == whole);
    std::filesystem::remove(folder.files().path("deep/er/back.toml"));
    // Copies go with those who had them.
    CHECK(folder.left() == before);
    // One rank alone that cannot read its file ends both.
    folder.files().put("short.raw", "x");
    folder.files().put("deep/er/short.toml", scene("../../short.raw"));
    const std::string first = ranks(1) + " -q " + std::getenv("PILEUS_PROGRAM");
    for (const char* run : {"flux deep/er/%.toml --budget samples=4",
                            "render deep/er/%.toml -o b.pfm --set method.name=path "
                            "--budget error=0.5"}) {
        CAPTURE(run);
        const auto with = [&](const char* name) {
            std::string text = run;
            return text.replace(text.find('%'), 1, name);
        };
        const Outcome outcome = folder.run(with("short"), first + " " + with("t") + " : -n 1 ");
        CAPTURE(outcome.errors);
        CHECK(outcome.exit_status == 2);
        CHECK(line_count(outcome.errors) == 1);
        CHECK(holds(outcome.errors, "short.raw"));
    }

    folder.files().put("deep/er/root.toml", scene(folder.files().path("v.raw")));
    const struct {
        std::string arguments, said;
        int count;
    } rows[] = {{"render deep/er/root.toml -q -o b.pfm --stage copies", "a name that leads out", 2},
                {render + "--stage ''", "--stage: no name", 2},
                {render + "--stage no/copies", "--stage: no/copies: cannot make a folder", 2},
                {render + "--stage copies --state st", "--stage: of a film or with --state", 2},
                {"render deep/er/none.toml -o b.pfm --stage copies", "none.toml: no such file", 2},
                {render + "--stage copies", "--stage: one process, allowed: among ranks", 1}};
    for (const auto& row : rows) {
        CAPTURE(row.arguments);
        const Outcome outcome = row.count == 1 ? folder.run(row.arguments)
                                               : folder.run(row.arguments, ranks(2) + " -q");
        CAPTURE(outcome.errors);
        CHECK(outcome.exit_status == 2);
        CHECK(line_count(outcome.errors) == 1);
        CHECK(holds(outcome.errors, row.said));
    }
}
