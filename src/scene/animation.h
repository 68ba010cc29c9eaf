// SPDX-License-Identifier: Apache-2.0
// What moves from picture to picture: ranges from the first frame to the last, and keys.
// in: keys of [animation] -> out: plain values; what a track is at a frame.
// docs/animation.md
#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace pileus {

/// Where the sun stands, from north over east and above the horizon.
struct SunPlace {
    double azimuth_deg = 0, elevation_deg = 45;
    bool operator==(const SunPlace& o) const {
        return azimuth_deg == o.azimuth_deg && elevation_deg == o.elevation_deg;
    }
};

/// What keys can move, in the order of kTracks.
enum class Track { kPosition, kTarget, kFov, kAzimuth, kElevation, kHours, kWind, kOffset, kYaw };
struct TrackRow {
    const char* name;  ///< in a key
    int first, numbers;
};
constexpr TrackRow kTracks[] = {
    {"camera_position_m", 0, 3}, {"camera_target_m", 3, 3},   {"camera_fov_deg", 6, 1},
    {"sun_azimuth_deg", 7, 1},   {"sun_elevation_deg", 8, 1}, {"hours", 9, 1},
    {"wind_s", 10, 1},           {"media_offset_m", 11, 3},   {"media_yaw_deg", 14, 1},
};
constexpr int kTrackCount = 9, kTrackNumbers = 15;

/// From a key to the next one that has the same track.
enum class KeyWay { kSmooth, kLinear, kStep };

struct AnimationKey {
    int frame = 0;
    KeyWay way = KeyWay::kSmooth;
    std::array<bool, kTrackCount> given{};
    std::array<double, kTrackNumbers> numbers{};
};
constexpr std::size_t kMaxKeys = 1000;

struct Animation {
    bool present = false;
    int frames = 1;
    std::array<double, 2> camera_orbit_deg{0, 0}, sun_elevation_deg{0, 0};
    std::array<double, 2> hours{0, 0};                                 ///< after atmosphere.time
    bool moves_camera = false, moves_sun = false, moves_time = false;  ///< by the ranges above
    std::vector<AnimationKey> keys;                                    ///< by rising frames

    /// Whether there is more than one frame.
    bool is_film() const { return present && frames > 1; }
};

bool has_track(const Animation& animation, Track track);

/// The track's numbers at a frame: before its first key and after its last as there; between keys
/// as the earlier one says. Smooth: cubic Hermite, at each key with the slope of the parabola
/// through it and its neighbours, at both ends that of the line to the next. Tracks of one number
/// never go beyond their keys: there slopes are held as in Fritsch and Carlson 1980. False: no key
/// has it.
bool track_at(const Animation& animation, Track track, int frame, double* numbers);

}  // namespace pileus
