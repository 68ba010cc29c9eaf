// SPDX-License-Identifier: Apache-2.0
// What stands behind the handles of pileus.h, and how its functions begin and end.
// in: structs of a host, of any age -> out: structs of this library; a Status as code and message.
// docs/embedding.md
#pragma once
#include <atomic>
#include <cstring>
#include <memory>
#include <new>

#include "include/pileus/pileus.h"
#include "platform/fp_mode.h"
#include "platform/memory.h"
#include "src/flight/block.h"
#include "src/flight/jump.h"
#include "src/flight/pack.h"
#include "src/session/session.h"

namespace pileus {
class Clouds;
}

namespace pileus::api {

/// The fault of a null session, told without memory.
pileus_code no_session(pileus_error* error);

/// What a host lends. Handles keep it, as their arrays go back to it.
struct HostParts {
    pileus_host given{};
    Allocator allocator;
    Executor executor;
    Block* block = nullptr;  ///< of a flight

    Host host() const {
        return {allocator.allocate != nullptr ? &allocator : nullptr,
                given.run != nullptr ? &executor : nullptr, nullptr};
    }
};

/// A world and the memory it lies in.
struct HeldWorld {
    std::shared_ptr<const HostParts> host;
    std::shared_ptr<const World> world;
};

/// Stands in the upper half of every struct_size, so that memory that nobody wrote is no struct.
constexpr std::uint32_t kStructMark = 0x50490000u;

/// Bytes of a caller's struct by its struct_size; 0: not marked.
inline std::size_t marked_size(std::uint32_t struct_size) {
    return (struct_size & 0xffff0000u) == kStructMark ? struct_size & 0xffffu : 0;
}

/// Whether there may be a struct of so many bytes at `place`.
inline bool is_room(const void* place, std::uint32_t size) {
    return place != nullptr && size >= sizeof size && size <= 0xffffu;
}

/// Bytes of a struct of `size` that are members of T: whole ones, as no version of a struct ends
/// within a pointer. Every version has the alignment of the first.
template <class T>
std::size_t known_bytes(std::size_t size) {
    return size < sizeof(T) ? size - size % alignof(T) : sizeof(T);
}

/// The part of a caller's struct that this library knows; the rest stays 0. False: null, or not
/// marked.
template <class T>
bool take(const T* given, T& own) {
    own = T{};
    const std::size_t size = given == nullptr ? 0 : marked_size(given->struct_size);
    if (size < sizeof(std::uint32_t)) return false;
    std::memcpy(static_cast<void*>(&own), given, known_bytes<T>(size));
    return true;
}

/// Element `i` of a caller's array, whose elements lie as far apart as the first one tells. False:
/// no size there, or an element of another size.
template <class T>
bool take_element(const T* first, std::size_t i, T& own) {
    own = T{};
    std::uint32_t mark = 0, size = 0;
    std::memcpy(&mark, first, sizeof mark);
    const std::size_t step = marked_size(mark);
    if (step < sizeof mark) return false;
    const unsigned char* at = reinterpret_cast<const unsigned char*>(first) + i * step;
    std::memcpy(&size, at, sizeof size);
    if (size != mark) return false;
    std::memcpy(static_cast<void*>(&own), at, known_bytes<T>(step));
    return true;
}

Status no_struct(const char* name);
/// Of an array whose elements are not alike, or have no size.
Status no_element(const char* name, std::size_t i);
Status no_handle(const char* name);

/// The part of a result that the caller's struct has room for.
template <class T>
Status give(T own, T* to, const char* name) {
    const std::size_t size = to == nullptr ? 0 : marked_size(to->struct_size);
    if (size < sizeof(std::uint32_t)) return no_struct(name);
    own.struct_size = to->struct_size;
    std::memcpy(static_cast<void*>(to), &own, known_bytes<T>(size));
    return Status::ok();
}

/// Copies a text and its zero into `room` bytes, 1 or more; one that is longer ends in "...".
void copy_cut(std::string_view text, char* to, std::size_t room);

/// Copies a text and its zero into the caller's memory. `needed`, where not null: bytes of both.
/// kLimit: too small a size; kBadInput: null with a size.
Status give_text(const std::string& own, const char* name, char* text, std::size_t size,
                 std::size_t* needed);

/// kBadInput: rows that would overlap, or end beyond what memory can have.
Status take_stride(const char* name, std::int64_t stride, std::int64_t least, std::uint32_t count,
                   Rows& rows);

/// The end of every call: code and message.
pileus_code finish(Code code, std::string_view text, pileus_error* error);
inline pileus_code finish(const Status& status, pileus_error* error) {
    return finish(status.code, status.message, error);
}

/// A call's body: `work` returns a Status; running out of small memory is a code as well.
template <class Work>
pileus_code call(const HostParts* host, pileus_error* error, Work work) {
    const HostGuard lent(host != nullptr ? host->host() : Host{});
    const FpModeGuard mode;
#ifdef __cpp_exceptions
    try {
        return finish(work(), error);
    } catch (const std::bad_alloc&) {
        return finish(Status{Code::kLimit, "out of memory"}, error);
    }
#else
    return finish(work(), error);
#endif
}

/// The end of a call of a session: what a flight took for it is back.
pileus_code settle(const HostParts& host, pileus_code code, pileus_error* error);

/// The fault of a flight whose block had no room even for small objects, in this call or an earlier
/// one: what that call changed may be half done.
pileus_code broken_off(const HostParts& host, pileus_error* error);

/// A call of a session.
template <class Work>
pileus_code call(const pileus_session& session, pileus_error* error, Work work);

/// Copies what a host lends and turns it into options. kBadInput: one of two functions alone.
Status take_host(const pileus_host* given, std::shared_ptr<const HostParts>& host,
                 RenderOptions& options);

/// A call that makes something in the memory and on the threads of `given`:
/// `work(host, options)` returns a Status.
template <class Work>
pileus_code call_with(const pileus_host* given, pileus_error* error, Work work) {
    return call(nullptr, error, [&]() -> Status {
        std::shared_ptr<const HostParts> host;
        RenderOptions options;
        PILEUS_TRY(take_host(given, host, options));
        const HostGuard lent(host->host());
        return work(host, options);
    });
}

/// Element `i` of a caller's array that take_element knew, as far as the caller has room.
template <class T>
void give_element(T own, T* first, std::size_t i) {
    const std::size_t step = marked_size(first->struct_size);
    own.struct_size = first->struct_size;
    unsigned char* at = reinterpret_cast<unsigned char*>(first) + i * step;
    std::memcpy(at, static_cast<const void*>(&own), known_bytes<T>(step));
}

}  // namespace pileus::api

struct pileus_scene {
    pileus::Scene scene;
};

struct pileus_world {
    std::shared_ptr<const pileus::api::HostParts> host;
    std::shared_ptr<const pileus::World> world;  ///< keeps its host's parts
};

struct pileus_session {
    std::atomic<std::uint32_t> users{1};  ///< its host, and skies of clouds
    std::shared_ptr<const pileus::api::HostParts> host;
    std::unique_ptr<pileus::Packed> flight;  ///< what a flight's session points into
    /// Another one after a hand-over.
    std::unique_ptr<pileus::Session> session = std::make_unique<pileus::Session>();
    std::vector<std::string> told;  ///< accidents that the log has been told of
    std::atomic<bool> cancelled{false};
};

namespace pileus::api {

/// In a flight. A library without exceptions leaves what it is at by a jump where even small
/// objects find no room; the guards are those that are jumped over.
template <class Work>
pileus_code call_in_block(const HostParts& host, pileus_error* error, Work work) {
    if (host.block->is_broken()) return broken_off(host, error);
#ifdef __cpp_exceptions
    return settle(host, call(&host, error, work), error);
#else
    const HostGuard outer{Host(current_host())};
    const FpModeGuard mode;
    JumpPlace way_out;
    if (PILEUS_SET_JUMP(way_out) != 0) return broken_off(host, error);
    host.block->set_way_out(&way_out);
    const pileus_code code = settle(host, call(&host, error, work), error);
    host.block->set_way_out(nullptr);
    return code;
#endif
}

template <class Work>
pileus_code call(const pileus_session& session, pileus_error* error, Work work) {
    const HostParts& host = *session.host;
    return host.block != nullptr ? call_in_block(host, error, work) : call(&host, error, work);
}

/// At the end of a call that pileus_session_cancel ends: the next one is whole again.
class CancelEnd {
public:
    explicit CancelEnd(pileus_session& session) : session_(session) {}
    CancelEnd(const CancelEnd&) = delete;
    CancelEnd& operator=(const CancelEnd&) = delete;
    ~CancelEnd() { session_.cancelled = false; }

private:
    pileus_session& session_;
};

/// One user less; the last one frees it.
void leave(pileus_session* session);

/// Options of a session's run, which its pileus_session_cancel ends, too.
RenderOptions with_cancel(const RenderOptions& options, pileus_session& session);

/// Takes up what a host has drawn.
Status set_depth_image(const pileus_depth_image* given, Session& session);

/// Clouds over a session, none at first; and what stands behind them.
Status make_clouds(pileus_session& sky, pileus_clouds*& clouds);
std::unique_ptr<Clouds>& clouds_of(pileus_clouds& clouds);

/// The caller's frame of clouds, over what a host has drawn where `over_host` is set. `depth`,
/// where not null: that, once the frame is sound.
Status draw_clouds(const pileus_frame* frame, const pileus_depth_image* depth, bool over_host,
                   Session& sky, Clouds& clouds);

/// The caller's buffers, as far as they are given; the hash is left out.
Status take_target(const pileus_frame& frame, const Camera& camera, FrameTarget& target);

/// Draws into the caller's buffers.
Status render_frame(const pileus_frame& frame, pileus_session& session);

}  // namespace pileus::api
