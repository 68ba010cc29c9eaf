// SPDX-License-Identifier: Apache-2.0
// Child processes through POSIX calls.
// in: a command line -> out: see process.h.
// posix_spawn(3), wait4(2), sigpending(2); docs/study.md, "Runs"
#include "platform/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>

#include "platform/clock.h"
#include "platform/posix/signals.h"

extern char** environ;

namespace pileus {

namespace {

/// Both ends are closed in children that do not take them over.
int open_pipe(int (&ends)[2]) {
#ifdef __APPLE__
    if (::pipe(ends) != 0) return -1;
    for (const int end : ends) (void)::fcntl(end, F_SETFD, FD_CLOEXEC);
    return 0;
#else
    return ::pipe2(ends, O_CLOEXEC);
#endif
}

constexpr std::size_t kMaxErrors = 65536;
constexpr int kLookEveryMs = 50;

double seconds(const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); }

/// The environment without what begins as one of `hidden`.
std::vector<char*> shown_environment(const std::vector<std::string>& hidden) {
    std::vector<char*> out;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        bool shown = true;
        for (const std::string& name : hidden)
            shown = shown && std::strncmp(*variable, name.c_str(), name.size()) != 0;
        if (shown) out.push_back(*variable);
    }
    out.push_back(nullptr);
    return out;
}

/// Starts the program in a process group of its own: Ctrl-C reaches us alone, and we decide.
int start(const std::vector<std::string>& words, const InterruptHold& hold,
          const std::vector<std::string>& hidden, const int (&pipe_)[2], pid_t& child) {
    std::vector<char*> environment = shown_environment(hidden);
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    if (const int error = posix_spawn_file_actions_init(&files)) return error;
    if (const int error = posix_spawnattr_init(&how)) {
        posix_spawn_file_actions_destroy(&files);
        return error;
    }
    int error = posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    if (!error) error = posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
    if (!error) error = posix_spawn_file_actions_adddup2(&files, pipe_[1], 2);
    if (!error)
        error = posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    const sigset_t before = signals_of(hold.before());
    if (!error) error = posix_spawnattr_setsigmask(&how, &before);
    if (!error)
        error = posix_spawn(&child, words[0].c_str(), &files, &how, arguments.data(),
                            environment.data());
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

/// Reads what the child says until it closes its end; ends the child on an interrupt.
void listen(int descriptor, pid_t child, const InterruptHold& hold, ProcessResult& result) {
    char block[4096];
    for (;;) {
        if (!result.interrupted && hold.pending()) {
            result.interrupted = true;
            (void)::kill(child, SIGKILL);
        }
        pollfd waiting{descriptor, POLLIN, 0};
        const int ready = ::poll(&waiting, 1, kLookEveryMs);
        if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
        const ssize_t got = ::read(descriptor, block, sizeof block);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return;
        const std::size_t room = kMaxErrors - result.errors.size();
        result.errors.append(block, std::size_t(got) < room ? std::size_t(got) : room);
    }
}

}  // namespace

InterruptHold::InterruptHold() {
    sigset_t held, before;
    sigemptyset(&held);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&held, number);
    (void)::pthread_sigmask(SIG_BLOCK, &held, &before);
    before_ = mask_of(before);
}

InterruptHold::~InterruptHold() { set_signals(before_); }

bool InterruptHold::pending() const {
    sigset_t waiting;
    if (::sigpending(&waiting) != 0) return false;
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
        if (sigismember(&waiting, number) == 1) return true;
    return false;
}

ProcessResult run_process(const std::vector<std::string>& words, const InterruptHold& hold,
                          const std::vector<std::string>& hidden) {
    ProcessResult result;
    int ends[2];
    if (open_pipe(ends) != 0) {
        result.system_error = errno;
        return result;
    }
    const double began = wall_seconds();
    pid_t child = -1;
    result.system_error = start(words, hold, hidden, ends, child);
    ::close(ends[1]);
    if (result.system_error == 0) {
        listen(ends[0], child, hold, result);
        int status = 0;
        rusage usage{};
        while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) continue;
        result.wall_s = wall_seconds() - began;
        result.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
        result.peak_bytes = static_cast<long long>(usage.ru_maxrss) * 1024;
        if (WIFEXITED(status)) result.exit_status = WEXITSTATUS(status);
        if (WIFSIGNALED(status)) result.exit_status = 128 + WTERMSIG(status);
    }
    ::close(ends[0]);
    return result;
}

char** begin_program(int&, char** words) {
    (void)::signal(SIGPIPE, SIG_IGN);
    return words;
}

std::string own_program(const char* first_word) {
    char path[PATH_MAX];
    const ssize_t length = ::readlink("/proc/self/exe", path, sizeof path);
    if (length > 0 && std::size_t(length) < sizeof path)
        return std::string(path, std::size_t(length));
    return first_word != nullptr ? first_word : "";
}

std::string processor_name() {
    std::string name;
    if (std::FILE* file = std::fopen("/proc/cpuinfo", "r")) {
        char line[512];
        while (name.empty() && std::fgets(line, sizeof line, file) != nullptr) {
            const char* colon = std::strchr(line, ':');
            if (std::strncmp(line, "model name", 10) == 0 && colon != nullptr) name = colon + 1;
        }
        std::fclose(file);
    }
    while (!name.empty() && (name.back() == '\n' || name.back() == ' ')) name.pop_back();
    while (!name.empty() && name.front() == ' ') name.erase(0, 1);
    return name;
}

}  // namespace pileus
