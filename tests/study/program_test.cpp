// SPDX-License-Identifier: Apache-2.0
// pileus study from end to end: runs, an interrupt, what goes on after it, what is written.
// in: the program, a tiny study -> out: checks of exit statuses, files and their contents.
// docs/study.md
#include <doctest/doctest.h>
#include <signal.h>

#include <cerrno>
#include <cstdio>

#include "platform/process.h"
#include "src/base/file.h"
#include "src/io/images/image_file.h"
#include "tests/cli/run_program.h"
#include "tests/io/test_image.h"

using namespace pileus;
using namespace pileus::test;

namespace {

constexpr const char* kStudy =
    "title = \"Tiny\"\nseeds = 3\n"
    "[reference]\nset = [\"collectors.closure=camera\"]\nbudget = \"photons=40000\"\n"
    "[[scene]]\nname = \"box\"\ntitle = \"A <box>\"\nfile = \"s.toml\"\n"
    "[[scene]]\nname = \"data\"\nfile = \"data.toml\"\n"
    "[[method]]\nname = \"marched\"\nbudgets = [\"photons=500\", \"photons=2000\"]\n"
    "[[method]]\nname = \"lobe\"\nset = [\"collectors.closure=lobe\"]\n"
    "budgets = [\"photons=500\", \"photons=2000\"]\n";
constexpr long kRuns = 2 + 3 * 4;

void put_study(const ProgramFolder& folder) {
    folder.files().put("study.toml", kStudy);
    folder.files().put("data.toml",
                       "[camera]\nposition_m = [0, 0, 0]\ntarget_m = [1, 0, 0]\n"
                       "[[medium]]\ndensity = \"${PILEUS_DATA_DIR}/x.pbrt\"\n"
                       "extinction_per_m = 1\n");
}

long count_of(const std::string& text, const std::string& part) {
    long count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

constexpr const char* kNoData = "unset PILEUS_DATA_DIR;";

}  // namespace

TEST_CASE("a study is made, is made again from what is there, and mends what is lost") {
    const ProgramFolder folder;
    put_study(folder);
    const Outcome first = folder.run("study study.toml -o out --threads 1", kNoData);
    INFO(first.errors);
    REQUIRE(first.exit_status == 0);
    CHECK(count_of(first.errors, " left\n") == kRuns);
    CHECK(holds(first.output, "out/index.html"));
    CHECK(holds(first.output, "scene data left out: environment variable PILEUS_DATA_DIR"));
    const TempFolder& files = folder.files();
    const std::string json = files.get("out/study.json");
    for (const char* key : {"\"bias_squared\"", "\"figure_of_merit\"", "\"floor\"", "\"noise\"",
                            "\"pareto\"", "\"time_to\"", "\"reference\"", "\"processor\""})
        CHECK(holds(json, key));
    CHECK(holds(files.get("out/study.md"), "| marched | photons=2000 |"));
    CHECK(holds(files.get("out/plots/box.svg"), "A &lt;box&gt;"));
    // The page asks for nothing outside itself.
    const std::string page = files.get("out/index.html");
    CHECK(holds(page, "<svg"));
    CHECK(holds(page, "A &lt;box&gt;"));
    CHECK_FALSE(holds(page, "<box>"));
    CHECK_FALSE(holds(page, "src=\"http"));
    CHECK_FALSE(holds(page, "<script"));
    if (can_write_image("x.png")) CHECK(count_of(page, "data:image/png;base64,") == 8);

    // All is there: nothing runs, and the same numbers come out.
    const Outcome again = folder.run("study study.toml -o out --threads 1", kNoData);
    CHECK(again.exit_status == 0);
    CHECK(again.errors == "14 of 14 runs are there already\n");
    // Only what an earlier run cost is remembered, so that the page says it was made earlier.
    CHECK(count_of(files.get("out/study.json"), "\"earlier\": true") == 1);

    // A lost picture, and a damaged record, are made again; no other.
    const Outcome list = folder.run("study study.toml -o out --threads 1 --list", kNoData);
    CHECK(line_count(list.output) == kRuns);
    const std::size_t line = list.output.find('\n', list.output.find('\n') + 1) + 1;
    const std::string third = list.output.substr(line, 16);
    const std::string fourth = list.output.substr(list.output.find('\n', line) + 1, 16);
    CHECK(std::remove(files.path("out/runs/" + third + ".exr").c_str()) == 0);
    files.put("out/runs/" + fourth + ".json", "{\"digest\": 7}");
    const Outcome mended = folder.run("study study.toml -o out --threads 1", kNoData);
    CHECK(mended.exit_status == 0);
    CHECK(count_of(mended.errors, " left\n") == 2);
}

TEST_CASE("a study in parts, and by ranks, makes each run once") {
    const ProgramFolder folder;
    put_study(folder);
    const TempFolder& files = folder.files();
    long made = 0;
    for (int i = 1; i <= 3; ++i) {
        const Outcome part = folder.run(
            "study study.toml -o out --threads 1 --part " + std::to_string(i) + "/3", kNoData);
        INFO(part.errors);
        REQUIRE(part.exit_status == 0);
        const long own = count_of(part.errors, " left\n");
        const std::string text = std::to_string(own);
        CHECK(part.output == text + " of " + text + " runs of this part are in out\n");
        made += own;
    }
    CHECK(made == kRuns);
    for (const std::string& file : folder.left()) CHECK_FALSE(holds(file, "index.html"));
    const Outcome all = folder.run("study study.toml -o out --threads 1", kNoData);
    CHECK(all.exit_status == 0);
    CHECK(all.errors == "14 of 14 runs are there already\n");
    const std::string page = files.get("out/study.md");
    check_refused(folder, "study study.toml -o out --part 4/3", "--part I: ");
    check_refused(folder, "study study.toml -o out --part x", "--part: \"x\", allowed: I/N");

    if (!holds(folder.run("info").output, "mpi            yes")) return;
    const Outcome ranked =
        folder.run("study study.toml -o mpi --threads 1", std::string(kNoData) + ranks(3));
    INFO(ranked.errors);
    REQUIRE(ranked.exit_status == 0);
    CHECK(count_of(ranked.errors, " left\n") == kRuns);
    CHECK(count_of(files.get("mpi/study.json"), "\"earlier\": true") == 0);
    CHECK(holds(ranked.output, "mpi/index.html"));
    // The pictures are the same, whoever made them.
    const auto hashes = [&](const std::string& json) {
        std::string out;
        for (std::size_t at = json.find("\"hash\": \""); at != std::string::npos;
             at = json.find("\"hash\": \"", at + 1))
            out += json.substr(at + 9, 16) + '\n';
        return out;
    };
    CHECK(hashes(files.get("mpi/study.json")) == hashes(files.get("out/study.json")));
}

TEST_CASE("a run's name changes with every file that it reads") {
    const ProgramFolder folder;
    const TempFolder& files = folder.files();
    Image image = make_image(16, 9);
    const auto put_image = [&](const std::string& name, float value) {
        for (std::size_t c = 0; c < 3; ++c)
            for (float& v : image.channels[c].pixels.span()) v = value;
        REQUIRE(write_image(image, files.path(name), {}));
    };
    const auto put_mesh = [&](const std::string& name, const char* corner) {
        files.put(name, std::string("v 0 0 0\nv 1 0 0\nv ") + corner + "\nf 1 2 3\n");
    };
    put_image("depth.pfm", 400);
    put_image("sky.pfm", 1);
    put_mesh("mesh.obj", "0 1 0");
    files.put("phase.txt", "0 1\n180 1\n");
    files.put("other.txt", "0 1\n180 1\n");
    files.put("s.toml", std::string(small_scene()) +
                            "[sky]\nmap = \"sky.pfm\"\n[[solid]]\nfile = "
                            "\"mesh.obj\"\n");
    files.put("files.toml",
              "seeds = 1\n[reference]\nbudget = \"photons=2000\"\n[[scene]]\nname = \"box\"\n"
              "file = \"s.toml\"\nset = [\"camera.depth=depth.pfm\", "
              "\"medium.0.phase={type='table',file='phase.txt'}\"]\n"
              "[[method]]\nname = \"m\"\nbudgets = [\"photons=500\"]\n"
              "[[method]]\nname = \"o\"\nset = [\"medium.0.phase.file=other.txt\"]\n"
              "budgets = [\"photons=500\"]\n");
    const auto digests = [&] {
        const Outcome list = folder.run("study files.toml --list --threads 1");
        REQUIRE_MESSAGE(list.exit_status == 0, list.errors);
        std::vector<std::string> names;
        for (std::size_t at = 0; at < list.output.size(); at = list.output.find('\n', at) + 1)
            names.push_back(list.output.substr(at, 16));
        return names;
    };
    std::vector<std::string> before = digests();
    REQUIRE(before.size() == 4);  // two halves, m, o
    CHECK(digests() == before);
    // `changed`: how many of the four runs read the file.
    const auto expect = [&](const char* file, int changed) {
        CAPTURE(file);
        const std::vector<std::string> after = digests();
        int others = 0;
        for (std::size_t i = 0; i < 4; ++i) others += after[i] != before[i] ? 1 : 0;
        CHECK(others == changed);
        before = after;
    };
    put_mesh("mesh.obj", "0 2 0");
    expect("mesh.obj", 4);
    put_image("depth.pfm", 500);
    expect("depth.pfm", 4);
    put_image("sky.pfm", 2);
    expect("sky.pfm", 4);
    files.put("phase.txt", "0 2\n180 1\n");
    expect("phase.txt", 3);
    files.put("other.txt", "0 2\n180 1\n");
    expect("other.txt", 1);
}

TEST_CASE("an interrupt leaves whole runs, and the same command goes on") {
    const ProgramFolder folder;
    put_study(folder);
    // Send the signal to the study alone, as soon as the first run is on the disk.
    const std::string line =
        "study study.toml -o out --threads 1 2>.err & pid=$!; n=0; "
        "while [ $n -lt 600 ] && ! ls out/runs/*.json >/dev/null 2>&1; do sleep 0.05; "
        "n=$((n+1)); done; kill -TERM $pid; wait $pid; exit $?;";
    const Outcome cut = folder.run(line + " true", kNoData);
    INFO(cut.errors);
    CHECK(cut.exit_status == 128 + SIGTERM);
    CHECK(holds(cut.errors, "interrupted: "));
    // No report, no half picture: each run has both of its files.
    long pictures = 0, records = 0;
    for (const std::string& name : folder.left()) {
        pictures += name.rfind("out/runs/", 0) == 0 && file_extension(name) == ".exr" ? 1 : 0;
        records += name.rfind("out/runs/", 0) == 0 && file_extension(name) == ".json" ? 1 : 0;
        CHECK_FALSE(holds(name, ".report"));
        CHECK(name != "out/index.html");
    }
    CHECK(records == pictures);
    CHECK(records >= 1);
    const Outcome rest = folder.run("study study.toml -o out --threads 1", kNoData);
    CHECK(rest.exit_status == 0);
    CHECK(count_of(rest.errors, " left\n") == kRuns - 2 - records);
}

TEST_CASE("a run that fails is named, the others go on, and the exit status is 1") {
    const ProgramFolder folder;
    put_study(folder);
    folder.files().put("limited.toml",
                       "seeds = 1\n[reference]\nbudget = \"photons=2000\"\n"
                       "[[scene]]\nname = \"box\"\nfile = \"s.toml\"\n"
                       "[[method]]\nname = \"fine\"\nbudgets = [\"photons=500\"]\n"
                       "[[method]]\nname = \"wrong\"\nbudgets = [\"photons=0.5\"]\n");
    const Outcome outcome = folder.run("study limited.toml -o out --threads 1 -q");
    CHECK(outcome.exit_status == 1);
    CHECK(holds(outcome.errors, "pileus study: 1 runs failed"));
    CHECK(holds(outcome.output, "run failed, exit status 2: --budget photons"));
    CHECK(holds(folder.files().get("out/study.md"), "run failed"));
}

TEST_CASE("wrong usage ends before the first run") {
    const ProgramFolder folder;
    put_study(folder);
    const std::pair<const char*, const char*> rows[] = {
        {"study none.toml", "none.toml: cannot read: no such file"},
        {"study study.toml --threads 0", "--threads: no such whole number"},
        {"study study.toml --scene moon", "--scene: no such scene, \"moon\""},
        {"study study.toml --method moon", "--method: no such method, \"moon\""},
        {"study study.toml --isa moon", "--isa: no such instruction set here"},
        {"study", "study is required"},
    };
    for (const auto& row : rows) {
        const Outcome outcome = folder.run(row.first, kNoData);
        INFO(outcome.errors);
        CHECK(outcome.exit_status == 2);
        CHECK(holds(outcome.errors, row.second));
    }
    folder.files().put("s.toml", std::string(small_scene()) + "[animation]\nframes = 3\n");
    const Outcome film = folder.run("study study.toml", kNoData);
    CHECK(film.exit_status == 2);
    CHECK(holds(film.errors, "animation.frames"));
    CHECK(folder.left() == std::vector<std::string>{"data.toml", "study.toml"});
}

TEST_CASE("a process tells how it ended and what it cost") {
    const InterruptHold hold;
    const ProcessResult good =
        run_process({"/bin/sh", "-c", "echo no >/dev/null; echo words >&2; exit 7"}, hold);
    CHECK(good.system_error == 0);
    CHECK(good.exit_status == 7);
    CHECK(good.errors == "words\n");
    CHECK_FALSE(good.interrupted);
    const ProcessResult killed = run_process({"/bin/sh", "-c", "kill -KILL $$"}, hold);
    CHECK(killed.exit_status == 128 + SIGKILL);
    const std::vector<std::string> ask{"/bin/sh", "-c", "echo \"$HOME${PMI_X-none}\" >&2"};
    REQUIRE(setenv("PMI_X", "seen", 1) == 0);
    const std::string home = std::getenv("HOME");
    CHECK(run_process(ask, hold).errors == home + "seen\n");
    CHECK(run_process(ask, hold, {"PMI_"}).errors == home + "none\n");
    unsetenv("PMI_X");
    const ProcessResult missing = run_process({"/no/such/program"}, hold);
    CHECK(missing.system_error == ENOENT);
    // A busy loop of known length: more CPU time than a sleep of the same wall time.
    const ProcessResult busy =
        run_process({"/bin/sh", "-c", "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done"}, hold);
    const ProcessResult asleep = run_process({"/bin/sh", "-c", "sleep 0.3"}, hold);
    CHECK(busy.cpu_s > asleep.cpu_s);
    CHECK(asleep.wall_s >= 0.3);
    CHECK(asleep.peak_bytes > 0);
    // Much of what is said is cut, and the child still ends.
    const ProcessResult loud =
        run_process({"/bin/sh", "-c",
                     "i=0; while [ $i -lt 3000 ]; do echo 0123456789012345678901234567890 >&2;"
                     " i=$((i+1)); done"},
                    hold);
    CHECK(loud.exit_status == 0);
    CHECK(loud.errors.size() == 65536);
}
