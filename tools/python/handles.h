// SPDX-License-Identifier: Apache-2.0
// What every part of the Python module shares: calls into pileus.h, their faults, rows of arrays.
// in: functions of pileus.h, NumPy arrays -> out: exceptions, pointers and strides.
// docs/python.md
#pragma once
#include <pileus/pileus.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pileus_python {

namespace py = pybind11;

/// A code other than PILEUS_OK, on its way to Python.
struct Failure {
    int code;
    std::string text;
};

[[noreturn]] inline void bad_input(const std::string& text) {
    throw Failure{PILEUS_ERROR_INPUT, text};
}

/// What Python's str() gives.
inline std::string text_of(py::handle object) { return py::str(object); }

template <class T>
T cleared() {
    T made;
    PILEUS_INIT(made);
    return made;
}

struct Freed {
    void operator()(pileus_scene* p) const { pileus_scene_free(p); }
    void operator()(pileus_world* p) const { pileus_world_free(p); }
    void operator()(pileus_session* p) const { pileus_session_free(p); }
    void operator()(pileus_sky* p) const { pileus_sky_free(p); }
};

/// What Python lends to a handle: threads, a log, and an end by Ctrl-C. It stays where it is.
class Host {
public:
    Host(std::uint32_t threads, const std::string& isa, std::uint64_t memory_limit,
         bool layers = false);
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    const pileus_host* given() const { return &host_; }
    std::vector<std::string> take_lines() { return std::exchange(lines_, {}); }

private:
    static std::int32_t stop(void* user);
    static void log(void* user, const char* line);

    pileus_host host_ = cleared<pileus_host>();
    std::string isa_;
    std::vector<std::string> lines_;
    std::chrono::steady_clock::time_point asked_{};
};

/// Calls `work(error)` while other threads of Python run. What Ctrl-C raised wins over its code.
template <class Work>
void call(Work work) {
    auto error = cleared<pileus_error>();
    pileus_code code = PILEUS_OK;
    {
        const py::gil_scoped_release others_run;
        code = work(&error);
    }
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    if (code != PILEUS_OK) throw Failure{code, error.message};
}

struct Scene {
    std::unique_ptr<pileus_scene, Freed> scene;
};

struct World {
    std::shared_ptr<Host> host;
    std::unique_ptr<pileus_world, Freed> world;
};

struct Session {
    std::shared_ptr<World> world;  ///< its host is that of the world's arrays
    std::unique_ptr<Host> host;
    std::unique_ptr<pileus_session, Freed> session;
    std::atomic<bool> busy{false};
};

/// A thread's turn with a session, which takes one at a time.
class Turn {
public:
    explicit Turn(Session& session) : session_(session) {
        if (session_.busy.exchange(true))
            bad_input("session: in use, allowed: one thread at a time, or a session for each");
    }
    ~Turn() { session_.busy.store(false); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

private:
    Session& session_;
};

/// An array as rows that the library reads and writes in place.
struct ArrayRows {
    void* first = nullptr;
    std::int64_t stride = 0;  ///< bytes; positive
    bool flipped = false;     ///< the lowest row in memory is the array's last
};

/// Of an array [height][width] or, with channels, [height][width][channels]. BadInput: another
/// shape or kind of numbers, pixels that do not lie close, rows that overlap, read only; `whose`
/// says in it where the shape comes from.
ArrayRows rows_of(const char* name, const py::array& array, const py::dtype& dtype,
                  std::uint32_t width, std::uint32_t height, std::uint32_t channels, bool writes,
                  const char* whose = "as the session's camera");

using Three = std::array<double, 3>;
using Size = std::array<std::uint32_t, 2>;

/// Pixels of a session's camera.
Size size_of(const Session& session);

/// What of a frame is an array of the caller, and how its numbers are to be read.
struct FrameArrays {
    std::optional<py::array> colour;
    std::uint32_t format = 0, blend = 0;
    float exposure = 0;
    std::optional<py::array> depth;
    std::uint32_t depth_kind = 0;
    bool bottom_up = false;
};
pileus_frame frame_of(const FrameArrays& arrays, const Size& size);

/// Opaque things of the caller, an array [height][width]; none: nothing solid.
pileus_depth_image depth_of(const std::optional<py::array>& values, std::uint32_t kind,
                            bool bottom_up, const Size& size, const char* name = "depth");

void add_session(py::module_& module);
void add_sky(py::module_& module);

}  // namespace pileus_python
