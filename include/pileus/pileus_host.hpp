// SPDX-License-Identifier: Apache-2.0
// Part of pileus.hpp: how calls end, and what a host lends to the library.
// in: functions of a host -> out: the C struct that leads to them; Status, Result
// docs/embedding.md
#ifndef PILEUS_HOST_HPP
#define PILEUS_HOST_HPP

#include <pileus/pileus.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pileus::embed {

enum class Code : std::int32_t {
    kOk = PILEUS_OK,
    kCheckFailed = PILEUS_ERROR_CHECK,  ///< kernels that give other bits than they must
    kBadInput = PILEUS_ERROR_INPUT,     ///< an argument, a scene or a file of it
    kLimit = PILEUS_ERROR_LIMIT,        ///< out of memory, or more than a limit allows
    kIo = PILEUS_ERROR_IO               ///< reading or writing failed half way
};

/// How a call ended: true in an `if` where it worked, else with a line for each fault.
class [[nodiscard]] Status {
public:
    Status() = default;
    Status(Code code, std::string message) : code_(code), message_(std::move(message)) {}

    explicit operator bool() const { return code_ == Code::kOk; }
    Code code() const { return code_; }
    const std::string& message() const { return message_; }

private:
    Code code_ = Code::kOk;
    std::string message_;
};

/// A value, or why there is none. Without one `*result` is an empty T.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : value_(std::move(value)) {}
    Result(Status status) : status_(std::move(status)) {}

    explicit operator bool() const { return bool(status_); }
    const Status& status() const { return status_; }
    Code code() const { return status_.code(); }
    const std::string& message() const { return status_.message(); }

    T& operator*() & { return value_; }
    const T& operator*() const& { return value_; }
    T&& operator*() && { return std::move(value_); }
    T* operator->() { return &value_; }
    const T* operator->() const { return &value_; }

private:
    Status status_;
    T value_{};
};

/// Called with each index in [0, count) by Host::run.
class Body {
public:
    Body(void (*body)(void*, std::uint32_t), void* data) : body_(body), data_(data) {}
    void operator()(std::uint32_t index) const { body_(data_, index); }

private:
    void (*body_)(void*, std::uint32_t);
    void* data_;
};

/// What the library may use. All may be left as it is: all threads, the C++ runtime's memory.
/// Worlds and sessions keep a copy as long as they need it. Functions never come from two threads
/// of one call at once, but for `allocate` and `release`; where `run` is given, they may come from
/// its threads. None of them may throw.
struct Host {
    std::uint32_t threads = 0;       ///< 0: as many as there are processors; at most 1024
    std::string isa;                 ///< "scalar", "avx2", ...; empty: the widest of this machine
    std::uint64_t memory_limit = 0;  ///< bytes by the plan; 0: the default limit
    /// Arrays: at least `bytes` at a multiple of `alignment`, or null. Both or neither.
    std::function<void*(std::size_t bytes, std::size_t alignment)> allocate;
    std::function<void(void* memory)> release;
    /// Calls body(index) once for each index in [0, count), in any order, and returns when all have
    /// returned. Empty: as in pileus.h.
    std::function<void(std::uint32_t count, Body body)> run;
    std::function<void(const char* line)> log;  ///< what is doubtful about a picture
    std::function<void(const char* stage, double share)> progress;  ///< share done, 0 to 1
    std::function<bool()> stop;  ///< asked now and then; true ends a step early
};

namespace detail {

/// A struct of pileus.h, cleared and with its size.
template <class T>
T cleared() {
    T made;
    pileus_init(&made, static_cast<std::uint32_t>(sizeof made));
    return made;
}

/// call(error) as a Status.
template <class Call>
Status status_of(Call call) {
    pileus_error error = cleared<pileus_error>();
    const pileus_code code = call(&error);
    if (code == PILEUS_OK) return {};
    return {static_cast<Code>(code), error.message};
}

/// How many, for the C interface; more than it can count is more than it takes.
inline std::uint32_t count_of(std::size_t n) {
    return n < UINT32_MAX ? static_cast<std::uint32_t>(n) : UINT32_MAX;
}

template <class Vector, class Number>
void store(const Vector& from, Number (&to)[3]) {
    to[0] = from.x, to[1] = from.y, to[2] = from.z;
}

template <class Matrix>
void store(const Matrix& from, double (&to)[16]) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            to[4 * column + row] = static_cast<double>(from[column][row]);
}

/// A host that stays where it is, and the functions that lead to its own.
struct Lent {
    Host host;
    pileus_host given = cleared<pileus_host>();

    explicit Lent(const Host& from) : host(from) {
        given.threads = host.threads;
        given.isa = host.isa.empty() ? nullptr : host.isa.c_str();
        given.memory_limit = host.memory_limit;
        given.user = this;
        if (host.allocate)
            given.allocate = [](void* user, std::size_t bytes, std::size_t alignment) {
                return of(user).allocate(bytes, alignment);
            };
        if (host.release)
            given.release = [](void* user, void* memory) { of(user).release(memory); };
        if (host.run)
            given.run = [](void* user, std::uint32_t count, void (*body)(void*, std::uint32_t),
                           void* data) { of(user).run(count, Body(body, data)); };
        if (host.log) given.log = [](void* user, const char* line) { of(user).log(line); };
        if (host.progress)
            given.progress = [](void* user, const char* stage, double share) {
                of(user).progress(stage, share);
            };
        if (host.stop) given.stop = [](void* user) { return of(user).stop() ? 1 : 0; };
    }
    Lent(const Lent&) = delete;
    Lent& operator=(const Lent&) = delete;

private:
    static const Host& of(void* user) { return static_cast<const Lent*>(user)->host; }
};

using SharedLent = std::shared_ptr<const Lent>;

// What frees a handle keeps the hosts that it was made with, and outlives it.
struct FreeScene {
    void operator()(pileus_scene* scene) const { pileus_scene_free(scene); }
};
struct FreeWorld {
    SharedLent host;
    void operator()(pileus_world* world) const { pileus_world_free(world); }
};
struct FreeSession {
    SharedLent host;
    std::vector<SharedLent> lenders;  ///< of its arrays, which a hand-over exchanges with them

    void lent_by(const SharedLent& lender) {
        for (const SharedLent& own : lenders)
            if (own == lender) return;
        lenders.push_back(lender);
    }
    void operator()(pileus_session* session) const { pileus_session_free(session); }
};

}  // namespace detail

}  // namespace pileus::embed

#endif  // PILEUS_HOST_HPP
