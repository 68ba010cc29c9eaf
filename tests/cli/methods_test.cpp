// SPDX-License-Identifier: Apache-2.0
// The support table as the program prints it, and as docs/support.md has it.
// in: PILEUS_PROGRAM, the page -> out: pass or fail; PILEUS_WRITE_DOCS=1 writes the page anew.
// docs/program.md, "methods"
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "src/methods/registry.h"
#include "src/methods/support.h"
#include "tests/cli/run_program.h"

using namespace pileus;
using nlohmann::json;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;

TEST_CASE("methods: docs/support.md is what the program prints") {
    const ProgramFolder folder;
    const Outcome outcome = folder.run("methods --markdown");
    REQUIRE(outcome.exit_status == 0);
    std::stringstream read;
    read << std::ifstream("docs/support.md", std::ios::binary).rdbuf();
    std::string text = read.str();
    const std::string begin = "<!-- support: begin -->\n", end = "<!-- support: end -->";
    const std::size_t from = text.find(begin) + begin.size(), to = text.find(end);
    REQUIRE(text.find(begin) != std::string::npos);
    REQUIRE(to != std::string::npos);
    if (std::getenv("PILEUS_WRITE_DOCS") != nullptr) {
        text.replace(from, to - from, outcome.output);
        std::ofstream("docs/support.md", std::ios::binary) << text;
    } else {
        CHECK_MESSAGE(text.substr(from, to - from) == outcome.output,
                      "PILEUS_WRITE_DOCS=1 ctest -R cli.methods_test writes it anew");
    }
}

TEST_CASE("methods: a row for each feature, a column for each method's display") {
    const ProgramFolder folder;
    const Outcome table = folder.run("methods");
    CHECK(table.exit_status == 0);
    CHECK(table.errors == "");
    const json all = json::parse(folder.run("methods --json").output);
    REQUIRE(all["features"].size() == kSupportFeatures);
    REQUIRE(all["columns"].size() == kMethodColumns);
    std::set<std::string> names;
    for (const json& row : all["features"]) {
        const std::string name = row["feature"];
        CHECK_MESSAGE(names.insert(name).second, name);
        CHECK_MESSAGE(holds(table.output, "\n  " + name.substr(0, 40)), name);
        CHECK(row["by"].size() == kMethodColumns);
        for (const auto& by : row["by"].items()) {
            const std::string column = by.key();
            const json& entry = by.value();
            CAPTURE(column);
            CAPTURE(name);
            // What is off says by how much, what does nothing says why.
            const bool bare = entry["level"] == "bounded";
            if (bare) CHECK(entry.contains("text"));
        }
    }
    // Each method has its column.
    for (const ListedMethod& listed : listed_methods()) {
        const Outcome one = folder.run(std::string("methods ") + listed.row.name);
        CHECK(one.exit_status == 0);
        CHECK(line_count(one.output) > long(kSupportFeatures));
        CHECK(holds(one.output, "exact"));
    }
}

TEST_CASE("methods: wrong usage is one line") {
    const ProgramFolder folder;
    const Outcome none = folder.run("methods radiosity");
    CHECK(none.exit_status == 2);
    CHECK(line_count(none.errors) == 1);
    CHECK(holds(none.errors, "no such method, \"radiosity\", allowed: collectors, "));
    for (const char* both : {"methods path --json", "methods --json --markdown"}) {
        const Outcome outcome = folder.run(both);
        CHECK(outcome.exit_status == 2);
        CHECK(line_count(outcome.errors) == 1);
        CHECK(outcome.output == "");
    }
}
