// SPDX-License-Identifier: Apache-2.0
// A picture in place of a scene: the same picture again, from its file alone.
// in: PILEUS_PROGRAM, pictures of all kinds of runs, damaged ones -> out: pass or fail.
// docs/program.md, "A picture made again"
#include <map>

#include "tests/cli/remake_checks.h"
#include "tests/io/test_image.h"

using namespace pileus;
using test::check_refused;
using test::holds;
using test::Outcome;
using test::ProgramFolder;
namespace fs = std::filesystem;

namespace {

std::map<std::string, std::string> origin_of(const ProgramFolder& folder, const std::string& name) {
    Image image;
    REQUIRE(read_image(folder.files().path(name), image));
    return {image.origin.begin(), image.origin.end()};
}

/// Renders s.toml, and then the picture `name` from its file alone, whatever the scene is by then.
void check_again(const std::string& options, const std::string& name,
                 const std::string& again = "b.exr") {
    CAPTURE(options);
    const ProgramFolder folder;
    const Outcome first = folder.run("render s.toml -q -o a.exr " + options);
    REQUIRE_MESSAGE(first.exit_status == 0, first.errors);
    folder.files().put("s.toml", "no scene");
    const std::string hash = folder.run("hash " + name).output.substr(0, 16);
    const Outcome same = folder.run("render " + name + " -q");
    CHECK_MESSAGE(same.exit_status == 0, same.errors);
    CHECK(same.output == hash + " " + name + "\n");
    const Outcome outcome = folder.run("render " + name + " -q -o b.exr");
    CHECK_MESSAGE(outcome.exit_status == 0, outcome.errors);
    CHECK(outcome.output == hash + " " + again + "\n");
    // And that one, once more.
    CHECK(folder.run("render " + again + " -q").output == hash + " " + again + "\n");
}

constexpr const char* kFilm = "--set animation.frames=5 --set animation.camera_orbit_deg=[0,40] ";

}  // namespace

TEST_CASE("remake: stills of all methods, whatever chose their numbers") {
    if (test::skips_pictures()) return;
    for (const char* options :
         {"", "--seed 11", "--budget photons=300 --seed 1_000_000",
          "--set medium.0.albedo=[0.9,0.8,0.7] --set output.layers=[error,depth]",
          "--quality draft", "--show density-slice", "--budget seconds=0.001",
          "--set collectors.generations=9 --budget seconds=0.001 --budget photons=90000",
          "--set method.name=path --budget samples=3",
          "--set method.name=path --budget error=0.3 --set output.layers=[error]",
          "--set method.name=path --budget seconds=0.01 --set filter.kind=regression",
          "--set method.name=photon-grid --set photon_grid.photons=5000",
          "--set method.name=photon-grid --budget photons=20000 --budget seconds=0.001",
          "--set method.name=photon-grid --budget photons=800 --budget error=0.2 "
          "--set output.layers=[error]",
          "--set method.name=raymarch --budget steps=9",
          "--set method.name=raymarch --budget seconds=0.001",
          "--set method.name=raymarch --budget seconds=1000",
          "--set method.name=optical-depth --budget seconds=1000",
          "--set method.name=optical-depth --budget steps=7"})
        check_again(options, "a.exr");
}

TEST_CASE("remake: a frame of a film, with those before it that its bits depend on") {
    if (test::skips_pictures()) return;
    const std::string film = kFilm, name = "a.0003.exr", again = "b.0003.exr";
    const std::string sun = "--set animation.sun_elevation_deg=[40,10] ";
    for (const std::string& options :
         {film, film + "--frames 2-3", film + sun + "--seed 5",
          film + "--budget seconds=0.001 --budget photons=400000",
          film + "--budget photons=400000 --budget seconds=0.001 --frames 1-4 "
                 "--set collectors.temporal=2",
          film + "--set method.name=raymarch --set raymarch.temporal=2",
          film + sun +
              "--set method.name=raymarch --set raymarch.light=buffer --set "
              "raymarch.light_refresh=3",
          film + "--set method.name=path --budget samples=2 --frames 3",
          film + "--set method.name=path --budget seconds=0.01",
          film +
              "--set method.name=photon-grid --set photon_grid.photons=3000 --budget seconds=0.001",
          film + "--set method.name=photon-grid --set photon_grid.ring=true "
                 "--budget photons=400000 --budget seconds=0.001"})
        check_again(options, name, again);
}

TEST_CASE("remake: a picture says what its budget came to, also where a clock ended it") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    const auto used = [&](const std::string& options, const std::string& name) {
        REQUIRE(folder.run("render s.toml -q -o a.exr " + options).exit_status == 0);
        return origin_of(folder, name)[std::string("budgetUsed")];
    };
    // A hundred thousand photons take longer than the time there is: one generation of four.
    const std::string cut = "--budget photons=400000 --budget seconds=0.001 ";
    const std::string one = "photons=400000 generations=1";
    CHECK(used("", "a.exr") == "photons=1000 generations=4");
    CHECK(used(cut, "a.exr") == one);
    CHECK(used(cut + kFilm, "a.0003.exr") == one);
    CHECK(used(cut + kFilm + "--frames 2-4", "a.0004.exr") == one);
    CHECK(used("--budget generations=2 " + std::string(kFilm), "a.0003.exr") ==
          "photons=1000 generations=2");
    CHECK(used("--set method.name=path --budget samples=3", "a.exr") == "samples=3");
    CHECK(used("--set method.name=raymarch", "a.exr") == "");
    CHECK(used("--set method.name=raymarch --budget steps=7", "a.exr") == "steps=7");
}

TEST_CASE("remake: options make another picture of it, which is compared with nothing") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    const std::string film = kFilm;
    REQUIRE(folder.run("render s.toml -q -o a.exr --seed 4 --budget photons=500").exit_status == 0);
    REQUIRE(folder.run("render s.toml -q -o f.exr --frames 2 " + film).exit_status == 0);
    const auto hash_of = [&](const std::string& arguments) {
        const Outcome outcome = folder.run("render " + arguments + " -q -o x.exr");
        REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
        return outcome.output.substr(0, 16);
    };
    const std::string more = "--set medium.0.albedo=0.5";
    CHECK(hash_of("a.exr " + more) == hash_of("s.toml --seed 4 --budget photons=500 " + more));
    CHECK(hash_of("a.exr --seed 6") == hash_of("s.toml --seed 6 --budget photons=500"));
    CHECK(hash_of("a.exr --budget photons=900") == hash_of("s.toml --seed 4 --budget photons=900"));
    CHECK(hash_of("a.exr --show tree") ==
          hash_of("s.toml --seed 4 --budget photons=500 --show tree"));
    // Budgets belong to the method that had them.
    CHECK(hash_of("a.exr --set method.name=path") ==
          hash_of("s.toml --seed 4 --set method.name=path"));
    CHECK(hash_of("f.0002.exr --frames 4") == hash_of("s.toml --frames 4 " + film));
    CHECK(origin_of(folder, "x.0004.exr").at("frame") == "4");
    // What is set later wins, and is kept for the next time.
    REQUIRE(folder.run("render a.exr -q -o c.exr --set medium.0.albedo=0.5 --seed 8").exit_status ==
            0);
    const Outcome changed = folder.run("render c.exr -q --set medium.0.albedo=0.9 -o d.exr");
    CHECK(changed.exit_status == 0);
    const auto origin = origin_of(folder, "d.exr");
    CHECK(origin.at("override.0") == "medium.0.albedo=0.5");
    CHECK(origin.at("override.1") == "medium.0.albedo=0.9");
    CHECK(origin.at("seed") == "8");
    // A hash is expected where it is asked for.
    const std::string other = "0123456789abcdef";
    const Outcome wrong = folder.run("render a.exr -q --expect-hash " + other);
    CHECK(wrong.exit_status == 1);
    CHECK(wrong.output == "");
    CHECK(holds(wrong.errors, "a.exr: hash: differs, expected " + other + ", got "));
    check_refused(folder, "render a.exr --seed 5",
                  "a.exr: no output, allowed: -o FILE or --report FILE, or no option that changes");
    CHECK(folder.run("plan a.exr").exit_status == 0);
    CHECK(holds(folder.run("plan f.0002.exr --json").output, "\"f.0002.exr\""));
}

TEST_CASE("remake: the same bytes, and nothing of the user's is lost") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    fs::create_directory(folder.files().path("out"));
    REQUIRE(folder
                .run("render s.toml -q -o out/a.exr --seed 4 --set medium.0.albedo=0.9 "
                     "--set output.files=[out/a.exr,b.pfm] --set output.report=r.json")
                .exit_status == 0);
    const std::string bytes = folder.files().get("out/a.exr");
    check_refused(folder, "render out/a.exr -o out/a.exr",
                  "out/a.exr: output: is the scene itself");
    check_refused(folder, "render out/a.exr -o ./out/../out/a.exr", "output: is the scene itself");
    check_refused(folder, "render out/a.exr --report out/a.exr", "output: is the scene itself");
    fs::create_hard_link(folder.files().path("out/a.exr"), folder.files().path("link.exr"));
    check_refused(folder, "render out/a.exr -o link.exr", "link.exr: output: is the scene itself");
    fs::remove(folder.files().path("link.exr"));
    // The scene's own outputs are those of another time.
    const std::vector<std::string> before = folder.left();
    CHECK(folder.run("render out/a.exr").exit_status == 0);
    CHECK(folder.left() == before);
    REQUIRE(folder.run("render out/a.exr -q -o out/c.exr").exit_status == 0);
    CHECK(folder.files().get("out/c.exr") == bytes);
    CHECK(folder.files().get("out/a.exr") == bytes);
    // A film's frames are numbered in every case.
    REQUIRE(folder.run(std::string("render s.toml -q -o f.exr --frames 2 ") + kFilm).exit_status ==
            0);
    check_refused(folder, "render f.0002.exr -o f.exr", "f.0002.exr: output: is the scene itself");
}

TEST_CASE("remake: a picture that another version or another file made differs, exit 1") {
    if (test::skips_pictures()) return;
    const ProgramFolder folder;
    REQUIRE(folder.run("render s.toml -q -o a.exr").exit_status == 0);
    Image image;
    REQUIRE(read_image(folder.files().path("a.exr"), image));
    const std::string hash = image.pixel_hash;
    image.pixel_hash = "00112233aabbccdd";
    REQUIRE(write_image(image, folder.files().path("b.exr"), {}));
    const Outcome other = folder.run("render b.exr -q -o c.exr");
    // What counts are the pixels, not what the file says of them: those are the same.
    CHECK_MESSAGE(other.exit_status == 0, other.errors);
    CHECK(other.output == hash + " c.exr\n");
    image.pixel_hash = hash;
    float& pixel = image.channels[0].pixels[5];
    pixel += 0.25f;
    const std::string changed = pixel_hash(image);
    REQUIRE(write_image(image, folder.files().path("b.exr"), {}));
    const Outcome edited = folder.run("render b.exr -q -o c.exr");
    CHECK(edited.exit_status == 1);
    CHECK(edited.errors == "b.exr: hash: differs, expected " + changed + ", got " + hash +
                               "; its pixels are not those that it names (pileus.pixelHash)\n");
    image.pixel_hash = changed;
    // The same version of another commit may make other bits, too.
    image.origin.emplace_back("commit", "v0.1.0-9-g1234567");
    for (auto& [name, text] : image.origin)
        if (name == "commit") text = "v0.1.0-9-g1234567";
    REQUIRE(write_image(image, folder.files().path("b.exr"), {}));
    CHECK(holds(folder.run("render b.exr -q").errors, "(v0.1.0-9-g1234567), this is "));
    for (auto& [name, text] : image.origin)
        if (name == "version") text = "0.1.0";
    REQUIRE(write_image(image, folder.files().path("b.exr"), {}));
    CHECK(holds(folder.run("render b.exr -q").errors,
                ", got " + hash + "; it is of version 0.1.0 (v0.1.0-9-g1234567), this is "));
}
