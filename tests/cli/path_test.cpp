// SPDX-License-Identifier: Apache-2.0
// Method path by the program: budgets, a state file that outlives interrupts, what it refuses.
// in: PILEUS_PROGRAM -> out: pass or fail.
// docs/program.md, "Budgets of a path tracing", "Interrupting"
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/run_program.h"
#include "tests/support/sanitized.h"

using namespace pileus;
using nlohmann::json;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;

namespace {

using Names = std::vector<std::string>;

const char* const kPath = " --set method.name=path --set 'output.layers=[\"error\"]' ";

std::string first_word(const std::string& text) { return text.substr(0, text.find(' ')); }

/// The pixel hash of a rendering that must work.
std::string hash_of(const ProgramFolder& folder, const std::string& options) {
    const Outcome outcome = folder.run("render s.toml -o a.pfm" + (kPath + options));
    REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
    return first_word(outcome.output);
}

json report_of(const ProgramFolder& folder) { return json::parse(folder.files().get("r.json")); }

std::string samples_option(const json& report) {
    return "--budget samples=" + std::to_string(report["samples_per_pixel"].get<std::uint64_t>());
}

/// Starts the program, waits until it has written its state anew, and sends it a signal: from then
/// on it is caught.
Outcome run_and_signal(const ProgramFolder& folder, const std::string& arguments, int number) {
    const std::string folder_path = folder.files().path("");
    const char* program = std::getenv("PILEUS_PROGRAM");
    const auto written = [&] {
        std::error_code missing;
        return std::filesystem::last_write_time(folder_path + "x.state", missing);
    };
    const auto before = written();
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const std::string line =
            "exec '" + std::string(program) + "' " + arguments + " >.out 2>.err </dev/null";
        (void)signal(number, SIG_DFL);
        if (chdir(folder_path.c_str()) != 0) _exit(99);
        execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
        _exit(99);
    }
    int status = 0;
    bool ended = false;
    while (!ended && written() == before) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ended = waitpid(child, &status, WNOHANG) == child;
    }
    Outcome outcome;
    if (!ended) {
        REQUIRE(kill(child, number) == 0);
        REQUIRE(waitpid(child, &status, 0) == child);
    }
    if (WIFEXITED(status)) outcome.exit_status = WEXITSTATUS(status);
    outcome.output = folder.files().get(".out");
    outcome.errors = folder.files().get(".err");
    return outcome;
}

}  // namespace

TEST_CASE("path: samples make a picture, whoever counts them") {
    const ProgramFolder folder;
    const std::string nine = hash_of(folder, "--budget samples=9 --report r.json");
    const json report = report_of(folder);
    CHECK(report["method"] == "path");
    CHECK(report["samples_per_pixel"] == 9);
    CHECK(report["paths"] == 9 * 16 * 9);
    CHECK(report["scatterings"].get<std::uint64_t>() > 0);
    CHECK(report["shadow_rays"].get<std::uint64_t>() > 0);
    CHECK(report["interrupted"] == false);
    CHECK(report["error"]["mean_relative"].get<double>() > 0);
    for (const auto& counter : report["counters"]) CHECK(counter == 0);
    CHECK(hash_of(folder, "--set path.samples_per_pixel=9 --threads 1 --isa scalar") == nine);
    CHECK(hash_of(folder, "--budget samples=10") != nine);
    CHECK(hash_of(folder, "--budget samples=9 --seed 8") != nine);
    CHECK(hash_of(folder, "--budget samples=9 --set path.pixel=centre") != nine);
    CHECK(hash_of(folder, "--budget samples=9 --set path.max_depth=1") != nine);
    // What no layer asks for changes no pixel.
    CHECK(hash_of(folder, "--budget samples=9 --set 'output.layers=[\"order\",\"light\"]'") ==
          nine);
}

TEST_CASE("path: an error or a time only chooses a number of samples") {
    const ProgramFolder folder;
    const std::string error = hash_of(folder, "--budget error=0.1 --report r.json");
    const json by_error = report_of(folder);
    CHECK(by_error["error"]["mean_relative"].get<double>() <= 0.1);
    CHECK(hash_of(folder, samples_option(by_error) + " --report r.json") == error);
    CHECK(hash_of(folder, "--set path.target_error=0.1") == error);
    // One step of the ladder earlier it was not reached yet.
    const std::uint64_t n = by_error["samples_per_pixel"];
    REQUIRE(n > 16);
    hash_of(folder, "--budget samples=" + std::to_string(n * 3 / 4) + " --report r.json");
    CHECK(report_of(folder)["error"]["mean_relative"].get<double>() > 0.1);

    // The report tells the error without its layer, too.
    hash_of(folder, samples_option(by_error) + " --set output.layers=[] --report r.json");
    CHECK(report_of(folder)["error"] == by_error["error"]);

    const std::string time = hash_of(folder, "--budget seconds=0.02 --report r.json");
    CHECK(hash_of(folder, samples_option(report_of(folder))) == time);
    hash_of(folder, "--budget error=1e-6 --set path.max_samples_per_pixel=21 --report r.json");
    CHECK(report_of(folder)["samples_per_pixel"] == 21);
}

TEST_CASE("path: interrupted, it writes what there is, and goes on to the same bits") {
    const ProgramFolder folder;
    const std::string state = "--state x.state --state-every 0.001 --report r.json ";
    const std::string render = "render s.toml -o a.pfm" + (kPath + state);
    std::uint64_t samples = 0;
    for (int number : {SIGINT, SIGTERM}) {
        const Outcome outcome =
            run_and_signal(folder, render + "--budget samples=100000000", number);
        REQUIRE_MESSAGE(outcome.exit_status == 0, outcome.errors);
        const json report = report_of(folder);
        CHECK(report["interrupted"] == true);
        CHECK(report["samples_per_pixel"].get<std::uint64_t>() > samples);
        samples = report["samples_per_pixel"];
        CHECK(holds(outcome.errors,
                    "interrupted: " + std::to_string(samples) + " samples per pixel"));
        CHECK(line_count(outcome.errors) == 1);
        // A pass that took longer than a second was ended within.
        if (report["ahead"].is_null())
            CHECK(first_word(outcome.output) ==
                  hash_of(folder, "--budget samples=" + std::to_string(samples)));
    }
    REQUIRE(samples > 0);
    const std::string more = "--budget samples=" + std::to_string(samples + 5);
    CHECK(hash_of(folder, more + " --state x.state --report r.json") == hash_of(folder, more));
    CHECK(report_of(folder)["interrupted"] == false);
    CHECK(report_of(folder)["paths"] == 16 * 9 * (samples + 5));
    CHECK(folder.left() == Names{"a.pfm", "r.json", "x.state"});
}

TEST_CASE("path: a state that does not fit is refused, and left as it is") {
    const ProgramFolder folder;
    hash_of(folder, "--budget samples=6 --state x.state");
    const std::string good = folder.files().get("x.state");
    std::filesystem::remove(folder.files().path("a.pfm"));
    const auto refused = [&](const std::string& bytes, const std::string& options,
                             const char* line) {
        CAPTURE(line);
        folder.files().put("x.state", bytes);
        const Outcome outcome = folder.run("render s.toml -o a.pfm --state x.state" +
                                           (kPath + ("--budget samples=8 " + options)));
        CHECK(outcome.exit_status == 2);
        CHECK_MESSAGE(holds(outcome.errors, line), outcome.errors);
        CHECK(line_count(outcome.errors) == 1);
        CHECK(outcome.output.empty());
        CHECK(folder.files().get("x.state") == bytes);
        CHECK(folder.left() == Names{"x.state"});
    };
    const char* const foreign = "of another scene, seed, layers or version";
    refused(good, "--seed 8", foreign);
    refused(good, "--set medium.0.extinction_per_m=0.051", foreign);
    refused(good, "--set medium.0.albedo=0.9", foreign);
    refused(good, "--set sun.elevation_deg=41", foreign);
    refused(good, "--set camera.resolution=[9,16]", foreign);
    refused(good, "--set path.max_depth=3", foreign);
    refused(good, "--set 'medium.0.phase={type=\"henyey-greenstein\",g=0.2}'", foreign);
    refused(good, "--set 'output.layers=[\"light\"]'", foreign);
    refused(good, "--budget samples=5", "holds 6 samples per pixel, 5 asked for");
    refused(good.substr(0, good.size() - 8), "", "cut or damaged");
    refused(good + "more", "", "cut or damaged");
    refused("", "", "cut or damaged");
    refused("a note, no state", "", "not a file of this kind");
    std::string damaged = good;
    damaged[good.size() / 2] = char(damaged[good.size() / 2] ^ 1);
    refused(damaged, "", "its digest does not fit");
    std::string later = good;
    later[8] = 5;
    refused(later, "", "written in form 5, this version reads 4");
    later[8] = 3;  // up to 0.10.0
    refused(later, "", "written in form 3, this version reads 4");
    folder.files().put("x.state", good);
    CHECK(hash_of(folder, "--budget samples=8 --state x.state") ==
          hash_of(folder, "--budget samples=8"));
}

TEST_CASE("path: what belongs to other methods is one line") {
    const ProgramFolder folder;
    const auto fault = [&](const std::string& arguments, const char* line) {
        const Outcome outcome = folder.run(arguments);
        CHECK(outcome.exit_status == 2);
        CHECK_MESSAGE(holds(outcome.errors, line), outcome.errors);
        CHECK(line_count(outcome.errors) == 1);
        CHECK(folder.left().empty());
    };
    fault("render s.toml -o a.pfm --budget photons=9" + std::string(kPath),
          "--budget photons: not for method path, allowed: samples=N, error=E, seconds=S");
    fault("render s.toml -o a.pfm --budget steps=9" + std::string(kPath),
          "--budget steps: not for method path, allowed: samples=N, error=E, seconds=S");
    fault("render s.toml -o a.pfm --show tree" + std::string(kPath), "--show: not for method path");
    fault("follow s.toml" + std::string(" --set method.name=path"), "follow: not for method path");
    fault("render s.toml -o a.pfm --state s.toml" + std::string(kPath), "is the scene itself");
    fault("render s.toml -o a.pfm --state a.pfm" + std::string(kPath), "named twice");
}

TEST_CASE("path: a filter that is not there, and what no filter does, are one line each") {
    const ProgramFolder folder;
    const auto fault = [&](const std::string& arguments, const char* line) {
        // Wherever the library may be installed, here it is looked for in vain.
        const Outcome outcome = folder.run(
            "render s.toml -o a.pfm --set method.name=path --set filter.kind=oidn" + arguments,
            "PILEUS_OIDN=./no_such_library.so.2");
        CHECK(outcome.exit_status == 2);
        CHECK_MESSAGE(holds(outcome.errors, line), outcome.errors);
        CHECK(line_count(outcome.errors) == 1);
        CHECK(folder.left().empty());
    };
    fault("", "s.toml: filter.kind: ");
    fault("", "Open Image Denoise");
    fault("", "PILEUS_OIDN");
    fault(
        " --set output.layers=[radiance,error]",
        "s.toml: filter.kind: a filtered picture has no layer \"error\", \"oidn\", allowed: none, "
        "or other layers");
    fault(
        " --set output.layers=[radiance,cloud]",
        "s.toml: filter.kind: a filtered picture has no layer \"cloud\", \"oidn\", allowed: none");
    for (const char* layer : {"light", "order"}) {
        const Outcome parts = folder.run(
            "render s.toml -o a.pfm --set method.name=path --set filter.kind=regression --set "
            "output.layers=[radiance," +
            std::string(layer) + "]");
        CHECK(parts.exit_status == 2);
        CHECK_MESSAGE(holds(parts.errors, "a filtered picture has no layer \"" +
                                              std::string(layer) + "\", \"regression\""),
                      parts.errors);
    }
    fault(" --set camera.projection=flux", "s.toml: filter.kind: a flat detector");
    fault(" --set method.name=raymarch",
          "filter.kind: filters pictures of method path alone, \"oidn\"");
}

TEST_CASE("path: the plan names what runs, what is left out, and every array") {
    const ProgramFolder folder;
    const Outcome lines = folder.run("plan s.toml" + std::string(kPath));
    REQUIRE_MESSAGE(lines.exit_status == 0, lines.errors);
    for (const char* part :
         {"flights towards the sun", "flights towards the sky: no sky", "absorption: albedo 1",
          "film ", "path samples ", "paths                        9216", "majorants to paths"})
        CHECK_MESSAGE(holds(lines.output, part), lines.output);
    for (const char* part : {"photon map", "tree", "collectors", "bounds of the sums"})
        CHECK_MESSAGE(!holds(lines.output, part), part, "\n", lines.output);
    const Outcome error = folder.run("plan s.toml --budget error=0.1" + std::string(kPath));
    CHECK(holds(error.output, "as the error or the time decides"));
    hash_of(folder, "--budget samples=4 --report r.json");
    const json report = report_of(folder);
    CHECK(report["plan"]["exact"] == true);
    CHECK(report["plan"]["work"]["of"] == "paths");
    // The process has little beyond its arrays: docs/report.md, "Memory".
    if (test::kSanitized) return;
    CHECK(report["memory"]["peak_bytes"].get<double>() <
          1.05 * report["plan"]["total_bytes"].get<double>() + 16 * 1048576);
}
