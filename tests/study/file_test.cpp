// SPDX-License-Identifier: Apache-2.0
// Study files: what they set, and one line for every fault.
// in: TOML texts -> out: a Study, or lines with their places.
// docs/study.md, "The file"
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "tests/io/temp_folder.h"
#include "tools/study/study_file.h"

using namespace pileus;
using test::holds;

namespace {

const char* const kSound =
    "title = \"T\"\nseeds = 4\nfirst_seed = 9\ntargets = [0.02, 0.002]\n"
    "[reference]\nset = [\"a=1\"]\nbudget = \"samples=16\"\nfirst_seed = 77\n"
    "[[scene]]\nname = \"one\"\nfile = \"s.toml\"\n"
    "[[scene]]\nname = \"two\"\ntitle = \"Two\"\nfile = \"/t.toml\"\nset = [\"seed=3\"]\n"
    "reference_budget = \"samples=4\"\n"
    "[[method]]\nname = \"m\"\ntitle = \"M\"\nset = [\"x=1\"]\nscenes = [\"two\"]\n"
    "budgets = [\"photons=10\", \"photons=1e2\"]\n"
    "[[method.setting]]\nname = \"p\"\ntitle = \"P\"\nset = [\"y=2\"]\n"
    "[[method.setting]]\nname = \"q\"\n"
    "[[method]]\nname = \"n\"\nbudgets = [\"error=0.1\", \"error=0.01\"]\n";

Status read(const std::string& text, Study& study) {
    return read_study_text(text, "study.toml", "dir", study);
}

/// The faults of kSound with the first `from` replaced by `to`.
std::string faults(const std::string& from, const std::string& to) {
    std::string text = kSound;
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    Study study;
    const Status status = read(text, study);
    CHECK(status.code == Code::kBadInput);
    return status.message;
}

}  // namespace

TEST_CASE("a study says what it says") {
    Study study;
    const Status status = read(kSound, study);
    INFO(status.message);
    REQUIRE(status);
    CHECK(study.title == "T");
    CHECK(study.seeds == 4);
    CHECK(study.first_seed == 9);
    CHECK(study.targets[1] == 0.002);
    CHECK(study.reference.budget == "samples=16");
    CHECK(study.reference.first_seed == 77);
    REQUIRE(study.scenes.size() == 2);
    CHECK(study.scenes[0].file == "dir/s.toml");
    CHECK(study.scenes[0].title == "one");
    CHECK(study.scenes[0].reference_budget == "samples=16");
    CHECK(study.scenes[1].file == "/t.toml");
    CHECK(study.scenes[1].reference_budget == "samples=4");
    REQUIRE(study.curves.size() == 3);
    CHECK(study.curves[0].name == "m.p");
    CHECK(study.curves[0].title == "M, P");
    CHECK(study.curves[0].sets == std::vector<std::string>{"x=1", "y=2"});
    CHECK(study.curves[1].name == "m.q");
    CHECK(study.curves[1].sets == std::vector<std::string>{"x=1"});
    CHECK(study.curves[2].name == "n");
    CHECK(study.curves[2].scenes.empty());
}

TEST_CASE("each fault is a line with its place, key, value and what is allowed") {
    CHECK(faults("seeds = 4", "seeds = 0") ==
          "study.toml:2:9: seeds: out of range, 0, allowed: whole number in [1, 64]");
    CHECK(holds(faults("seeds = 4", "sedes = 4"), "study.toml:2:1: unknown key, \"sedes\""));
    CHECK(holds(faults("seeds = 4", "sedes = 4"), "did you mean seeds?"));
    CHECK(holds(faults("targets = [0.02, 0.002]", "targets = [0.02]"), "targets: "));
    CHECK(holds(faults("budget = \"samples=16\"\n", ""),
                "study.toml:5:1: reference.budget: missing, nothing, allowed: text"));
    CHECK(holds(faults("\"samples=16\"", "\"samples=x\""),
                "study.toml:7:10: reference.budget: not a budget, \"samples=x\""));
    CHECK(holds(faults("\"samples=16\"", "\"hours=1\""), "not a budget"));
    CHECK(holds(faults("name = \"two\"", "name = \"one\""), "scene.1.name: given twice, \"one\""));
    CHECK(holds(faults("name = \"two\"", "name = \"T w\""), "scene.1.name: not a name, \"T w\""));
    CHECK(holds(faults("file = \"s.toml\"\n", ""), "scene.0.file: missing"));
    CHECK(holds(faults("scenes = [\"two\"]", "scenes = [\"three\"]"),
                "method.0.scenes: no such scene, \"three\""));
    CHECK(holds(faults("\"photons=1e2\"", "\"photons=5\""),
                "method.0.budgets: not more work than the one before, \"photons=5\""));
    CHECK(holds(faults("\"photons=1e2\"", "\"samples=50\""),
                "method.0.budgets: another kind, \"samples=50\", allowed: photons=N"));
    CHECK(holds(faults("\"error=0.01\"", "\"error=0.2\""), "not more work"));
    CHECK(holds(faults("[\"photons=10\", \"photons=1e2\"]", "[]"), "method.0.budgets: empty"));
    CHECK(holds(faults("name = \"q\"", "name = \"p\""), "method.0.setting.1.name: given twice"));
    CHECK(holds(faults("name = \"q\"", "title = 7"), "method.0.setting.1.title: wrong type, 7"));
    CHECK(holds(faults("[reference]", "reference = 3\n[other]"), "reference: wrong type"));
    CHECK(holds(faults("title = \"T\"", "title = "), "study.toml:1"));
}

TEST_CASE("numbers that no integer holds are refused and left alone") {
    for (const char* wild : {"1e300", "-1e300", "inf", "nan", "-1", "9223372036854775807"}) {
        const std::string seeds = std::string("seeds = ") + wild;
        const std::string first = std::string("first_seed = ") + wild;
        CHECK(holds(faults("seeds = 4", seeds), "study.toml:2:9: seeds: "));
        CHECK(holds(faults("first_seed = 9", first), "study.toml:3:14: first_seed: "));
        CHECK(holds(faults("first_seed = 77", first), "reference.first_seed: "));
    }
}

TEST_CASE("a study without scenes, methods and reference lacks all three") {
    Study study;
    const Status status = read("", study);
    CHECK(status.code == Code::kBadInput);
    CHECK(holds(status.message, "reference.budget: missing"));
    CHECK(holds(status.message, "allowed: 1 to 64 tables, each headed [[scene]]"));
    CHECK(holds(status.message, "allowed: 1 to 64 tables, each headed [[method]]"));
}

TEST_CASE("budgets") {
    std::string kind;
    double amount = 0;
    CHECK(split_budget("photons=1000000", kind, amount));
    CHECK(kind == "photons");
    CHECK(amount == 1e6);
    CHECK(split_budget("seconds=0.5", kind, amount));
    for (const char* text : {"", "photons", "photons=", "photons=-1", "photons=0", "photons=nan",
                             "photons=1x", "=3", "weeks=2"})
        CHECK_FALSE(split_budget(text, kind, amount));
}

TEST_CASE("faults of the scenes come at once, each line once") {
    const test::TempFolder folder;
    folder.put("s.toml", "seed = 1\n[camera]\nposition_m = [0, 0, 0]\n");
    const std::string path = folder.put(
        "study.toml",
        "[reference]\nbudget = \"photons=9\"\n[[scene]]\nname = \"s\"\nfile = \"s.toml\"\n"
        "[[method]]\nname = \"m\"\nset = [\"collectors.bands=99\"]\nbudgets = [\"photons=1\"]\n");
    Study study;
    const Status status = read_study_file(path, study);
    CHECK(status.code == Code::kBadInput);
    CHECK(holds(status.message, "--set collectors.bands=99: collectors.bands: out of range"));
    const std::string missing = "camera.target_m: missing";
    const std::size_t first = status.message.find(missing);
    REQUIRE(first != std::string::npos);
    CHECK(status.message.find(missing, first + 1) == std::string::npos);
    CHECK(read_study_file(folder.path("none.toml"), study).code == Code::kBadInput);
}

TEST_CASE("the page about studies holds the keys") {
    std::ostringstream page;
    page << std::ifstream("docs/study.md").rdbuf();
    CHECK(holds(page.str(), describe_study_keys_markdown()));
}

TEST_CASE("the studies that come with the program are sound") {
    for (const char* name : {"default", "quick"}) {
        Study study;
        const Status status =
            read_study_file(std::string("assets/studies/") + name + ".toml", study);
        INFO(status.message);
        CHECK(status);
        CHECK(study.scenes.size() >= 2);
    }
}
