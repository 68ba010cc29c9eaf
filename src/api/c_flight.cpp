// SPDX-License-Identifier: Apache-2.0
// pileus.h: a session in a block of the caller.
#include "include/pileus/pileus.h"
#include "src/api/c_types.h"
#include "src/flight/block.h"
#include "src/flight/flight.h"
#include "src/flight/jump.h"

namespace pileus::api {
namespace {

/// A library without exceptions leaves its constructors by a jump where the block ends, which only
/// the caller's own thread can: threads are lent once the session is open.
#ifdef __cpp_exceptions
constexpr bool kOpensOnThreads = true;
#else
constexpr bool kOpensOnThreads = false;
#endif

/// What is lent to a session of a flight: nothing that takes memory.
void lend(const pileus_flight& given, Block* block, HostParts& parts) {
    pileus_host& h = parts.given;
    h.threads = given.threads > 1 && given.run != nullptr ? given.threads : 1;
    h.user = given.user;
    h.run = kOpensOnThreads ? given.run : nullptr;
    h.log = given.log;
    h.isa = given.isa;
    parts.allocator = block->allocator();
    parts.executor = {given.run, given.user};
    parts.block = block;
}

/// The fault of what is handed over, null without one: there is no memory yet to word it in.
const char* flight_fault(const pileus_flight* flight, pileus_flight& f, pileus_session** session) {
    if (!take(flight, f))
        return "flight: null or not initialised, allowed: what pileus_flight_default() made";
    if (session == nullptr) return "session: null, allowed: where to put it";
    if (f.block == nullptr) return "flight.block: null, allowed: memory";
    static_assert(kMaxThreads == 1024);
    if (f.threads > kMaxThreads) return "flight.threads: too many, allowed: 0 to 1024";
    if (f.frame == nullptr) return "flight.frame: null, allowed: what frames will be drawn into";
    if (marked_size(f.frame->struct_size) < sizeof(std::uint32_t))
        return "flight.frame: not initialised, allowed: what pileus_frame_default() made";
    if (f.scene == nullptr) return "flight.scene: null, allowed: a packed scene";
    // Sizes that no memory has: sums of places would begin anew at 0.
    if (f.block_bytes > UINTPTR_MAX - reinterpret_cast<std::uintptr_t>(f.block))
        return "flight.block_bytes: beyond the end of memory, allowed: what the block has";
    if (f.scene_bytes > UINTPTR_MAX - reinterpret_cast<std::uintptr_t>(f.scene))
        return "flight.scene_bytes: beyond the end of memory, allowed: what the scene has";
    return nullptr;
}

/// For calls that have no block: words of faults, and no more.
template <class Work>
pileus_code call_small(pileus_error* error, Work work) {
    alignas(64) char memory[8192];
    HostParts parts;
    parts.allocator = Block::make(memory, sizeof memory)->allocator();
    return call(&parts, error, work);
}

/// In the block, and with its memory lent.
Status open_flight(const pileus_flight& f, const std::shared_ptr<HostParts>& parts,
                   pileus_session** session) {
    auto made = std::make_unique<pileus_session>();
    made->host = parts;
    made->flight = std::make_unique<Packed>();
    RenderOptions options;
    options.threads = int(parts->given.threads);
    if (f.isa != nullptr) options.isa = f.isa;
    PILEUS_TRY(begin_flight(f.scene, f.scene_bytes, f.block_bytes, options, f.in_place != 0,
                            f.depth != 0, *made->flight, *made->session));
    parts->block->begin_pictures();
    // Twice: some of what reprojection keeps is made by the second one.
    pileus_frame frame;
    take(f.frame, frame);
    for (int i = 0; i < 2; ++i) PILEUS_TRY(render_frame(frame, *made));
    made->session->seal();
    parts->given.run = f.run;
    *session = made.release();
    return Status::ok();
}

constexpr const char* kTooSmall =
    "flight.block: too few bytes, allowed: those that pileus_packed_read tells";

}  // namespace
}  // namespace pileus::api

using namespace pileus;
using namespace pileus::api;

extern "C" {

pileus_code pileus_packed_read(const void* scene, size_t scene_bytes, pileus_packed* packed,
                               pileus_error* error) {
    return call_small(error, [&]() -> Status {
        if (scene == nullptr) return Status::bad_input("scene: null, allowed: a packed scene");
        PackedHead head;
        PILEUS_TRY(read_packed_head(scene, scene_bytes, head));
        pileus_packed out{};
        out.width = std::uint32_t(head.width);
        out.height = std::uint32_t(head.height);
        out.block_bytes = head.block_bytes;
        out.in_place_bytes = head.in_place_bytes;
        std::memcpy(out.method, head.method.data(), head.method.size());
        return give(out, packed, "packed");
    });
}

pileus_code pileus_flight_open(const pileus_flight* flight, pileus_session** session,
                               pileus_error* error) {
    pileus_flight f;
    if (const char* fault = flight_fault(flight, f, session))
        return finish(Code::kBadInput, fault, error);
    Block* const block = Block::make(f.block, f.block_bytes);
    if (block == nullptr) return finish(Code::kLimit, kTooSmall, error);
    // All that constructors took lies in the block; what else calls change is put back here, whose
    // guards are not jumped over.
    const HostGuard host{Host(current_host())};
    const FpModeGuard mode;
    JumpPlace way_out;
    if (PILEUS_SET_JUMP(way_out) != 0) return finish(Code::kLimit, kTooSmall, error);
    block->set_way_out(&way_out);
    HostParts first;
    lend(f, block, first);
    const pileus_code code = call(&first, error, [&]() -> Status {
        const auto parts = std::make_shared<HostParts>();
        lend(f, block, *parts);
        // What is taken remembers whom it goes back to: these parts stay.
        const HostGuard lent(parts->host());
        const Status status = open_flight(f, parts, session);
        if (status.code == Code::kLimit && block->use().refused > 0)
            return Status{Code::kLimit, kTooSmall};
        return status;
    });
    block->set_way_out(nullptr);
    if (code != PILEUS_OK) return code;
    if (block->seal()) return code;
    *session = nullptr;
    return finish(Code::kLimit, kTooSmall, error);
}

pileus_code pileus_flight_usage(const pileus_session* session, pileus_flight_use* use,
                                pileus_error* error) {
    if (session == nullptr || session->host->block == nullptr)
        return finish(Code::kBadInput, "session: not of a flight, allowed: of pileus_flight_open",
                      error);
    const BlockUse& told = session->host->block->use();
    pileus_flight_use out{};
    out.block_bytes = told.bytes;
    out.kept_bytes = told.kept_bytes;
    out.open_bytes = told.open_bytes;
    out.frame_bytes = told.frame_bytes;
    out.frame_room = told.bytes - told.kept_bytes;
    out.taken = told.frame_pieces;
    out.refused = told.refused;
    out.kept = told.kept_pieces;
    out.lost = told.lost_pieces;
    return call_small(error, [&] { return give(out, use, "use"); });
}

}  // extern "C"
