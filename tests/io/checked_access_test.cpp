// SPDX-License-Identifier: Apache-2.0
// Checked access to arrays: within it is the element, beyond it ends the process, in every build.
// in: indices -> out: elements, or a child process ended by SIGABRT with one line.
// src/base/span.h
#include <doctest/doctest.h>

#include <csignal>
#include <string>

#include "src/base/buffer.h"

#if defined(__unix__)
#include <sys/wait.h>
#include <unistd.h>
#endif

using namespace pileus;

namespace {

#if defined(__unix__)
/// What a child process that runs `act` writes to its standard error; empty unless SIGABRT ended
/// it.
template <class Act>
std::string last_words(Act act) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        std::signal(SIGABRT, SIG_DFL);
        dup2(ends[1], 2);
        act();
        _exit(0);
    }
    close(ends[1]);
    std::string words;
    char block[512];
    for (ssize_t got = 1; (got = read(ends[0], block, sizeof block)) > 0;)
        words.append(block, std::size_t(got));
    close(ends[0]);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT ? words : "";
}

std::string line(const char* asked, const char* size) {
    return std::string("pileus: defect: ") + asked + " asked of an array of " + size +
           "; stopped before memory is damaged\n";
}
#endif

}  // namespace

TEST_CASE("checked access: within an array it is the element") {
    Buffer<int> array;
    REQUIRE(array.resize(3, "array"));
    for (std::size_t i = 0; i < 3; ++i) array.at(i) = int(i) + 10;
    const Buffer<int>& same = array;
    CHECK(same.at(2) == 12);
    CHECK(array.span().at(1) == 11);
    CHECK(array.span().part(1, 2).size == 2);
    CHECK(array.span().part(1, 2).at(0) == 11);
    CHECK(array.span().part(3, 0).empty());
}

#if defined(__unix__)
TEST_CASE("checked access: beyond an array it ends the process in every build") {
    Buffer<int> array;
    REQUIRE(array.resize(3, "array"));
    const std::size_t all = ~std::size_t{0};
    CHECK(last_words([&] { array.at(3) = 1; }) == line("1 elements from 3 on", "3"));
    CHECK(last_words([&] { array.span().at(all) = 1; }).find("of an array of 3;") !=
          std::string::npos);
    CHECK(last_words([&] { (void)array.span().part(1, 3); }) == line("3 elements from 1 on", "3"));
    // Neither a start beyond the end nor a sum that wraps gets through.
    CHECK_FALSE(last_words([&] { (void)array.span().part(4, 0); }).empty());
    CHECK_FALSE(last_words([&] { (void)array.span().part(2, all); }).empty());
    CHECK(last_words([] {}).empty());
}
#endif
