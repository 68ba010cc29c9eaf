// SPDX-License-Identifier: Apache-2.0
// Every stream of random numbers: its name, its number, and what draws from it.
// in: nothing -> out: numbers for make_key (kernels_cpu/core/rng.h), no two of them the same.
// docs/methods.md 2, "Random numbers". A changed number changes every picture.
#pragma once
#include <cstdint>

namespace pileus {

// One row for a stream. A new one takes a number that no other has; the compiler checks it.
#define PILEUS_RANDOM_STREAMS(ROW)                                                           \
    ROW(kSunStream, 1, "photons of the sun")                                                 \
    ROW(kSkyStream, 2, "photons of the sky")                                                 \
    ROW(kGroundStream, 3, "photons of the ground")                                           \
    ROW(kLampStream, 4, "photons of points, spots and parallel lights")                      \
    ROW(kEmissionStream, 64, "photons of media that shine; 64 + the medium's number, to 71") \
    ROW(kEmissionShiftStream, 80, "shifts of their places; 80 to 87")                        \
    ROW(kSampleStream, 8, "places of the collectors' samples")                               \
    ROW(kSunShiftStream, 17, "shifts of the sun's cells of start")                           \
    ROW(kSkyShiftStream, 18, "shifts of the sky's cells of start")                           \
    ROW(kGroundShiftStream, 19, "shifts of the ground's cells")                              \
    ROW(kLampShiftStream, 20, "shifts of the lamps' directions")                             \
    ROW(kJitterStream, 31, "places of a ray's steps in raymarching")                         \
    ROW(kPathStream, 32, "light paths from the camera")                                      \
    ROW(kVerifyStream, 33, "light paths that verify a picture")                              \
    ROW(kVerifiedStream, 34, "the pixels that they are for")                                 \
    ROW(kBubbleStream, 0x63756d75, "bubbles of a procedural cumulus")                        \
    ROW(kDetailStream, 0x6e6f6973, "detail on a procedural cumulus")                         \
    ROW(kCloudBallStream, 0x62616c6c, "balls of a procedural cloud")                         \
    ROW(kCloudLumpStream, 0x6c756d70, "lumps and bends of a procedural cloud")               \
    ROW(kCloudFieldStream, 0x6669656c, "places and sizes of a field of procedural clouds")   \
    ROW(kCloudLifeStream, 0x6c696665, "times of turrets and clouds of a procedural cloud")   \
    ROW(kCloudRainStream, 0x7261696e, "streaks of rain below a procedural cloud")            \
    ROW(kPlumeStream, 0x706c756d, "particles of a procedural plume")                         \
    ROW(kParticleCumulusStream, 0x70636d75, "particles of a procedural cumulus")             \
    ROW(kReplicaStream, 0x7265706c, "particles that stand for one of a file")                \
    ROW(kScatterStream, 0x73636174, "places of many clouds")

enum RandomStream : std::uint32_t {
#define PILEUS_ROW(name, number, use) name = number,
    PILEUS_RANDOM_STREAMS(PILEUS_ROW)
#undef PILEUS_ROW
};

struct RandomStreamRow {
    const char* name;
    std::uint32_t number;
    const char* use;
};

constexpr RandomStreamRow kRandomStreams[] = {
#define PILEUS_ROW(name, number, use) {#name, number, use},
    PILEUS_RANDOM_STREAMS(PILEUS_ROW)
#undef PILEUS_ROW
};

/// Those that are several, by the number of a medium.
constexpr bool is_family(std::uint32_t number) {
    return number == kEmissionStream || number == kEmissionShiftStream;
}
constexpr std::uint32_t kStreamsOfFamily = 8;

constexpr bool streams_differ() {
    constexpr int kCount = sizeof kRandomStreams / sizeof kRandomStreams[0];
    for (int i = 0; i < kCount; ++i)
        for (int j = 0; j < kCount; ++j)
            if (i != j && is_family(kRandomStreams[i].number) &&
                kRandomStreams[j].number - kRandomStreams[i].number < kStreamsOfFamily)
                return false;
    for (int i = 0; i < kCount; ++i)
        for (int j = 0; j < i; ++j)
            if (kRandomStreams[i].number == kRandomStreams[j].number) return false;
    return true;
}
static_assert(streams_differ(), "two streams of random numbers have one number");

/// The stream that shifts the cells in which a light's photons start.
constexpr std::uint32_t shift_stream(std::uint32_t light) { return light + 16; }
static_assert(shift_stream(kSunStream) == kSunShiftStream &&
                  shift_stream(kSkyStream) == kSkyShiftStream &&
                  shift_stream(kGroundStream) == kGroundShiftStream &&
                  shift_stream(kLampStream) == kLampShiftStream &&
                  shift_stream(kEmissionStream) == kEmissionShiftStream,
              "a light's shifts have their own row");

}  // namespace pileus
