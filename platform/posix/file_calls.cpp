// SPDX-License-Identifier: Apache-2.0
// See file_calls.h.
#include "platform/file_calls.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace pileus {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 30;  // below every kernel's limit for one call

std::size_t piece_of(std::size_t bytes) { return bytes < kPiece ? bytes : kPiece; }

/// Once more where a signal came between.
template <class Call>
std::int64_t undisturbed(Call call) {
    ssize_t done = 0;
    do {
        done = call();
    } while (done < 0 && errno == EINTR);
    return done;
}

}  // namespace

bool make_folder(const char* path) { return ::mkdir(path, 0777) == 0; }
void remove_folder(const char* path) { (void)!::rmdir(path); }
void remove_file(const char* path) { ::unlink(path); }
bool move_file(const char* from, const char* to) { return ::rename(from, to) == 0; }

int create_file(const char* path) {
    return ::open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

void close_file(int descriptor) { ::close(descriptor); }

std::int64_t write_some(int descriptor, const void* data, std::size_t bytes) {
    return undisturbed([&] { return ::write(descriptor, data, piece_of(bytes)); });
}

std::int64_t write_some_at(int descriptor, std::uint64_t at, const void* data, std::size_t bytes) {
    return undisturbed([&] { return ::pwrite(descriptor, data, piece_of(bytes), off_t(at)); });
}

}  // namespace pileus
