/* SPDX-License-Identifier: Apache-2.0
 * Sessions of a flight: all memory in one block of the caller, none asked for once one is open.
 * Included by itself; docs/flight.md says what is promised and how it is checked.
 */
#ifndef PILEUS_FLIGHT_H
#define PILEUS_FLIGHT_H

#include "pileus.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the head of a packed scene tells. The program makes one: `pileus pack SCENE -o FILE`. */
typedef struct pileus_packed {
    uint32_t struct_size;
    uint32_t width, height; /**< of the scene's camera, pixels; the most that frames may have */
    uint32_t reserved;
    /** That a session of it needs, with threads of one; with pileus_flight.depth up to 16 bytes a
     * pixel and 1 KiB more. */
    uint64_t block_bytes;
    char method[24];
    uint64_t in_place_bytes; /**< the same with pileus_flight.in_place */
} pileus_packed;

/** Reads the head and compares the digest of all bytes, head included. PILEUS_BAD_INPUT: no packed
 * scene, one of another version, or one that was changed. */
PILEUS_API pileus_code pileus_packed_read(const void* scene, size_t scene_bytes,
                                          pileus_packed* packed, pileus_error* error);

/** What a session of a flight is made of. All pointers but `scene` must stay valid as long as the
 * session; `scene`, too, with `in_place`. */
typedef struct pileus_flight {
    uint32_t struct_size;
    uint32_t threads;  /**< bodies that `run` gets at a time; 0 or 1: the caller's thread alone */
    const void* scene; /**< packed; without `in_place` read only while the session is opened */
    size_t scene_bytes;
    void* block; /**< at any address */
    size_t block_bytes;
    void* user; /**< handed to the callbacks */
    /** As pileus_host.run; may be null. */
    void (*run)(void* user, uint32_t count, void (*body)(void* data, uint32_t index), void* data);
    /** As pileus_host.log; may be null. */
    void (*log)(void* user, const char* line);
    const char* isa; /**< null: the widest of this machine that was compiled in */
    /** The first picture is drawn into it while the session is opened. Frames to come may be of any
     * other kind: other formats, blends, hashes, depths. */
    const pileus_frame* frame;
    int32_t depth; /**< not 0: frames will get depth images (pileus_session_set_depth) */
    /** Not 0: densities and other arrays of numbers are read where they lie in `scene`, which must
     * begin at a multiple of 64 bytes and is never written to. Machines that are not little-endian
     * copy them nevertheless. The pictures are the same. */
    int32_t in_place;
} pileus_flight;

/** Makes a session in the block: world, light of the first picture, that picture. Afterwards
 * nothing of it asks anyone for memory: functions of pileus_session_* take what they need for the
 * time of a call from the rest of the block, and give all of it back: PILEUS_LIMIT where that is
 * too little, and the session goes on. A picture that would be larger, a sky map, more lights than
 * the packed scene's are refused. The session ends with the block: forget both. Errors: those of
 * pileus_packed_read; PILEUS_LIMIT: the block is smaller than the packed scene tells, or needs. */
PILEUS_API pileus_code pileus_flight_open(const pileus_flight* flight, pileus_session** session,
                                          pileus_error* error);

/** Where an ordinary library, which has small memory of its own, gives that back; the block, which
 * may be gone already, is not looked at. In a library of the flight profile nothing happens. */
PILEUS_API void pileus_flight_close(pileus_session* session);

/** What has been taken of the block, bytes. */
typedef struct pileus_flight_use {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t block_bytes; /**< as given */
    uint64_t kept_bytes;  /**< of what the session is */
    uint64_t open_bytes;  /**< the most while it was made */
    uint64_t frame_bytes; /**< the most that a call took since */
    uint64_t frame_room;  /**< what calls may take */
    uint64_t taken;       /**< pieces that calls took and gave back */
    uint64_t refused;     /**< pieces for which there was no room: 0, or the block is too small */
    uint64_t kept;        /**< pieces that calls did not give back: 0, or the library is wrong */
    uint64_t lost;        /**< pieces of the session that calls gave back: likewise */
} pileus_flight_use;
PILEUS_API pileus_code pileus_flight_usage(const pileus_session* session, pileus_flight_use* use,
                                           pileus_error* error);

#ifdef __cplusplus
}
#endif

#endif /* PILEUS_FLIGHT_H */
