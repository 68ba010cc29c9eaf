// SPDX-License-Identifier: Apache-2.0
// The program: finds the subcommand, runs it, turns its Status into lines and an exit status.
// in: the command line -> out: results on stdout, faults on stderr, exit 0 to 4.
// docs/program.md
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
// Known after any header of the C library.
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "platform/fp_mode.h"
#include "platform/process.h"
#include "platform/team/teams.h"
#include "platform/threads.h"
#include "src/scene/toml/toml_tree.h"
#include "tools/pileus/command.h"
#include "tools/pileus/ranks.h"
#include "tools/pileus/version_text.h"

namespace pileus {

Status print(const std::string& text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0) return Status::io("standard output: cannot write");
    return Status::ok();
}

namespace {

/// The subcommands in the order of help and messages.
constexpr struct {
    const char* name;
    void (*add)(CLI::App&, Chosen&);
} kCommands[] = {{"render", add_render},   {"plan", add_plan},       {"view", add_view},
                 {"follow", add_follow},   {"flux", add_flux},       {"compare", add_compare},
                 {"study", add_study},     {"hash", add_hash},       {"info", add_info},
                 {"methods", add_methods}, {"convert", add_convert}, {"pack", add_pack},
                 {"merge", add_merge},     {"new", add_new}};

std::string command_names() {
    std::string out;
    for (const auto& command : kCommands)
        out += (out.empty() ? "" : ", ") + std::string(command.name);
    return out;
}

/// Says nothing for Code::kOk without a message.
int finish(const Status& status) {
    if (!status.message.empty()) std::fprintf(stderr, "%s\n", status.message.c_str());
    return int(status.code);
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    return text;
}

/// Names the subcommand of a wrong command line, so that the hint leads to the right help.
Status usage_fault(const CLI::App& app, const CLI::ParseError& error) {
    std::string name = "pileus";
    for (const CLI::App* sub : app.get_subcommands()) name += ' ' + sub->get_name();
    return Status::bad_input(name + ": " + one_line(error.what()) + ", allowed: see " + name +
                             " --help");
}

/// Refuses words that are no subcommand before the options behind them are looked at.
Status check_command(int count, char** words) {
    if (count < 2)
        return Status::bad_input("pileus: no subcommand, allowed: " + command_names() +
                                 "; see pileus --help");
    const std::string word = words[1];
    for (const char* option : {"-h", "--help", "--version"})
        if (word == option) return Status::ok();
    if (!word.empty() && word[0] == '-')
        return Status::bad_input("pileus: unknown option before the subcommand, " +
                                 quote_text(word) + ", allowed: --help, --version");
    for (const auto& command : kCommands)
        if (word == command.name) return Status::ok();
    return Status::bad_input("pileus: unknown subcommand, " + quote_text(word) +
                             ", allowed: " + command_names());
}

/// Ends the program at once where memory is asked for in vain: no line of ours can be made without
/// memory either, and a file that is not complete has no name yet (platform/file.h).
[[noreturn]] void on_no_memory() {
    constexpr char line[] = "pileus: out of memory\n";
    (void)!::write(STDERR_FILENO, line, sizeof line - 1);
    ::_exit(int(Code::kLimit));
}

/// Set once the exit status is ours.
bool finished = false;

/// A library that ends the program itself has said why; its status would read as that of a failed
/// check.
void on_exit() {
    if (!finished) ::_exit(int(Code::kLimit));
}

int run(int count, char** words, const TeamChoice& team) {
    // What the parent left of rounding, flushing and traps must not reach our own times and texts.
    const FpModeGuard guard;
    if (team.fault != nullptr)
        return finish(Status::bad_input(std::string(kTeamVariable) + ": " + team.fault + ", " +
                                        quote_text(std::getenv(kTeamVariable)) +
                                        ", allowed: " + team.allowed));
    ThreadPool threads(team.kind);
    const PoolGuard lent(threads);
    CLI::App app("Renders clouds, the same bits on every machine.", "pileus");
    Chosen chosen;
    // A slash begins a path, on Windows, too.
    app.allow_windows_style_options(false);
    app.set_version_flag("--version", "pileus " + version_text());
    app.require_subcommand(1);
    app.footer(help_example("pileus render cloud.toml -o cloud.png"));
    for (const auto& command : kCommands) command.add(app, chosen);

    const Status known = check_command(count, words);
    if (!known) return finish(known);
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
        return finish(usage_fault(app, error));
    }
    return end_ranks(finish(chosen()));
}

}  // namespace
}  // namespace pileus

int main(int count, char** words) {
    std::set_new_handler(pileus::on_no_memory);
    words = pileus::begin_program(count, words);
    // May begin the program anew, as if it had not begun.
    const pileus::TeamChoice team = pileus::start_team(words);
#ifdef M_MMAP_THRESHOLD
    // Large arrays go back to the system when they are freed; by default glibc learns to keep them,
    // and finds no place for the next among the gaps.
    (void)mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
    (void)std::atexit(pileus::on_exit);
    int status = int(pileus::Code::kLimit);
    // Whatever escapes is as final as a lack of memory.
    try {
        status = pileus::run(count, words, team);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "pileus: cannot go on: %s\n", error.what());
    } catch (...) {
        std::fputs("pileus: cannot go on\n", stderr);
    }
    pileus::finished = true;
    return status;
}
