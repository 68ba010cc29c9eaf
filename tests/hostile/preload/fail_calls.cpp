// SPDX-License-Identifier: Apache-2.0
// A library to load before a program: makes one of its calls to the machine fail, or all from it
// on. in: PILEUS_FAIL = "KIND K once|always", PILEUS_FAIL_COUNT = a file -> out: failures; the
// number of calls of that kind. docs/testing.md, section Failing memory and disks
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

enum Kind {
    kNone,
    kMemory,
    kOpen,
    kWrite,
    kShortWrite,
    kSync,
    kClose,
    kName,
    kRead,
    kEnd,
    kFolder
};
const char* const kNames[] = {"none",  "memory", "open", "write", "short-write", "sync",
                              "close", "name",   "read", "end",   "folder"};

Kind kind = kNone;
long fail_at = 0;
bool fail_always = false;
std::atomic<long> calls{0};
bool counting = false;

/// Counts a call of one kind, and says whether it is to fail. Before main nothing is counted.
bool fails(Kind of) {
    if (!counting || kind != of) return false;
    const long call = ++calls;
    return fail_at > 0 && (fail_always ? call >= fail_at : call == fail_at);
}

template <class Function>
Function next(const char* name) {
    void* found = dlsym(RTLD_NEXT, name);
    Function function;
    memcpy(&function, &found, sizeof function);
    return function;
}

void read_settings() {
    const char* text = getenv("PILEUS_FAIL");
    char name[16] = "", mode[16] = "";
    if (text == nullptr || sscanf(text, "%15s %ld %15s", name, &fail_at, mode) != 3) return;
    for (int k = 0; k <= kFolder; ++k)
        if (strcmp(name, kNames[k]) == 0) kind = Kind(k);
    fail_always = strcmp(mode, "always") == 0;
}

int (*real_main)(int, char**, char**) = nullptr;

int counted_main(int count, char** words, char** environment) {
    read_settings();
    counting = true;
    const int status = real_main(count, words, environment);
    counting = false;
    if (const char* path = getenv("PILEUS_FAIL_COUNT")) {
        if (FILE* file = fopen(path, "w")) {
            fprintf(file, "%ld\n", calls.load());
            fclose(file);
        }
    }
    return status;
}

void* no_memory() {
    errno = ENOMEM;
    return nullptr;
}

int refuse(int error) {
    errno = error;
    return -1;
}

}  // namespace

extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int count, char** words, void (*begin)(),
                      void (*end)(), void (*loader_end)(), void* stack) {
    real_main = main;
    using Start = int (*)(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(),
                          void (*)(), void*);
    return next<Start>("__libc_start_main")(counted_main, count, words, begin, end, loader_end,
                                            stack);
}

void* malloc(size_t bytes) noexcept { return fails(kMemory) ? no_memory() : __libc_malloc(bytes); }
void* calloc(size_t count, size_t bytes) noexcept {
    return fails(kMemory) ? no_memory() : __libc_calloc(count, bytes);
}
void* realloc(void* old, size_t bytes) noexcept {
    return fails(kMemory) ? no_memory() : __libc_realloc(old, bytes);
}
void* aligned_alloc(size_t alignment, size_t bytes) noexcept {
    return fails(kMemory) ? no_memory() : __libc_memalign(alignment, bytes);
}
int posix_memalign(void** to, size_t alignment, size_t bytes) noexcept {
    if (fails(kMemory)) return ENOMEM;
    *to = __libc_memalign(alignment, bytes);
    return *to != nullptr ? 0 : ENOMEM;
}

int open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    if ((flags & O_ACCMODE) != O_RDONLY && fails(kOpen)) return refuse(ENOSPC);
    return next<int (*)(const char*, int, ...)>("open")(path, flags, mode);
}
ssize_t write(int file, const void* from, size_t bytes) {
    if (file > 2 && fails(kWrite)) return refuse(ENOSPC);
    if (file > 2 && bytes > 1 && fails(kShortWrite)) bytes /= 2;
    return next<ssize_t (*)(int, const void*, size_t)>("write")(file, from, bytes);
}
ssize_t read(int file, void* to, size_t bytes) {
    if (file > 2 && fails(kRead)) return refuse(EIO);
    if (file > 2 && fails(kEnd)) return 0;
    return next<ssize_t (*)(int, void*, size_t)>("read")(file, to, bytes);
}
int fsync(int file) {
    if (fails(kSync)) return refuse(EIO);
    return next<int (*)(int)>("fsync")(file);
}
int close(int file) {
    const int result = next<int (*)(int)>("close")(file);
    return fails(kClose) ? refuse(EIO) : result;
}
int linkat(int a, const char* from, int b, const char* to, int flags) noexcept {
    if (fails(kName)) return refuse(ENOSPC);
    return next<int (*)(int, const char*, int, const char*, int)>("linkat")(a, from, b, to, flags);
}
int rename(const char* from, const char* to) noexcept {
    if (fails(kName)) return refuse(ENOSPC);
    return next<int (*)(const char*, const char*)>("rename")(from, to);
}
int renameat2(int a, const char* from, int b, const char* to, unsigned flags) noexcept {
    if (fails(kName)) return refuse(ENOSPC);
    using Rename = int (*)(int, const char*, int, const char*, unsigned);
    return next<Rename>("renameat2")(a, from, b, to, flags);
}
int mkdir(const char* path, mode_t mode) noexcept {
    if (fails(kFolder)) return refuse(ENOSPC);
    return next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}

}  // extern "C"
