// SPDX-License-Identifier: Apache-2.0
// Runs the program in a folder of its own and keeps all that it said.
// in: a command line -> out: exit status, standard output, standard error, files left behind.
// The program's path is in the environment variable PILEUS_PROGRAM.
#pragma once
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/io/temp_folder.h"

namespace pileus {
namespace test {

struct Outcome {
    int exit_status = -1;
    std::string output, errors;
};

/// A small scene: a box of even density, 16 x 9 pixels, 1000 photons.
inline const char* small_scene() {
    return "seed = 7\n"
           "[camera]\n"
           "position_m = [0, -300, 50]\n"
           "target_m = [0, 0, 50]\n"
           "resolution = [16, 9]\n"
           "[sun]\n"
           "elevation_deg = 40\n"
           "[[medium]]\n"
           "density = \"uniform:box\"\n"
           "bounds_m = [[-50, -50, 0], [50, 50, 100]]\n"
           "extinction_per_m = 0.05\n"
           "[collectors]\n"
           "photons = 1000\n"
           "generations = 4\n"
           "samples = 500\n";
}

/// A folder that holds s.toml; its other two entries belong to `run`.
class ProgramFolder {
public:
    ProgramFolder() {
        const char* program = std::getenv("PILEUS_PROGRAM");
        REQUIRE_MESSAGE(program != nullptr, "PILEUS_PROGRAM must hold the program's path");
        program_ = program;
        folder_.put("s.toml", small_scene());
    }

    /// Runs `pileus ARGUMENTS` here through the shell; `before` may set limits.
    Outcome run(const std::string& arguments, const std::string& before = "") const {
        const std::string line = "cd '" + folder_.path("") + "' && " + before + " '" + program_ +
                                 "' " + arguments + " >.out 2>.err </dev/null";
        const int status = std::system(line.c_str());
        Outcome outcome;
        if (WIFEXITED(status)) outcome.exit_status = WEXITSTATUS(status);
        outcome.output = folder_.get(".out");
        outcome.errors = folder_.get(".err");
        return outcome;
    }

    /// Names of everything but s.toml and what `run` keeps, at any depth, in order.
    std::vector<std::string> left() const {
        namespace fs = std::filesystem;
        std::vector<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path(""))) {
            const std::string name = fs::relative(entry.path(), folder_.path("")).string();
            if (name != "s.toml" && name != ".out" && name != ".err") names.push_back(name);
        }
        std::sort(names.begin(), names.end());
        return names;
    }

    const TempFolder& files() const { return folder_; }

private:
    TempFolder folder_;
    std::string program_;
};

/// Lines of a text; a text without a final newline has lost part of its last line.
inline long line_count(const std::string& text) {
    return long(std::count(text.begin(), text.end(), '\n'));
}

/// Starts the program by MPI's launcher; Open MPI wants to be asked twice by root.
inline std::string ranks(int count) {
    return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
           "OMPI_MCA_rmaps_base_oversubscribe=1 mpirun -n " +
           std::to_string(count);
}

/// One line, exit 2, no new file.
inline void check_refused(const ProgramFolder& folder, const std::string& arguments,
                          const std::string& said) {
    CAPTURE(arguments);
    const std::vector<std::string> before = folder.left();
    const Outcome outcome = folder.run(arguments);
    CHECK(outcome.exit_status == 2);
    CHECK(outcome.output == "");
    CHECK_MESSAGE(line_count(outcome.errors) == 1, outcome.errors);
    CHECK_MESSAGE(holds(outcome.errors, said), outcome.errors);
    CHECK(folder.left() == before);
}

}  // namespace test
}  // namespace pileus
