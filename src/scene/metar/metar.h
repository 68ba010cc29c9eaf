// SPDX-License-Identifier: Apache-2.0
// Weather reports of aerodromes, METAR and SPECI.
// in: the text of one report -> out: what it says, group by group, and what was left aside.
// ICAO Annex 3, Appendix 3; WMO No. 306, Volume I.1, FM 15; FMH-1 (2019), chapter 12. docs/metar.md
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "src/base/status.h"

namespace pileus {

/// Longest report in bytes; real ones have up to some 400.
constexpr std::size_t kMaxMetarBytes = 4096;
/// Most groups of clouds, and of weather, that are read; further ones are set aside. The code has
/// up to four and three.
constexpr std::size_t kMaxMetarGroups = 8;

enum class MetarBound { kExact, kLess, kMore };

struct MetarWind {
    bool given = false;     ///< false where the group is missing or made of strokes
    bool variable = false;  ///< VRB: no direction
    double from_deg = 0;    ///< where it comes from, from north towards east
    double speed_m_per_s = 0;
    double gust_m_per_s = 0;                        ///< 0: none
    double sector_from_deg = 0, sector_to_deg = 0;  ///< of 270V330; both 0: none
};

struct MetarVisibility {
    bool given = false;
    double m = 0;  ///< prevailing; of 9999, CAVOK and the like the least that they say
    MetarBound bound = MetarBound::kExact;
    bool no_directions = false;  ///< NDV: measured at one place
    double least_m = 0;          ///< of a group with a direction, 1500SW; 0: none
    std::string least_towards;   ///< "SW"
};

enum class MetarIntensity { kLight, kModerate, kHeavy, kVicinity };

/// One group of present weather: -SHRASN is light, "SH", {"RA", "SN"}. Descriptor or phenomena may
/// be empty, not both.
struct MetarWeather {
    MetarIntensity intensity = MetarIntensity::kModerate;
    std::string descriptor;
    std::vector<std::string> phenomena;
};

enum class MetarCover { kUnknown, kFew, kScattered, kBroken, kOvercast };
enum class MetarTower { kNone, kCumulonimbus, kCongestus };

struct MetarCloud {
    MetarCover cover = MetarCover::kUnknown;
    bool height_given = false;
    double height_m = 0;  ///< of the base above the aerodrome
    MetarTower tower = MetarTower::kNone;
};

/// Words for a sky without reported clouds; kUnknown where there is no such word.
enum class MetarClear { kUnknown, kCavok, kSkc, kClr, kNsc, kNcd };

struct Metar {
    bool special = false;    ///< SPECI
    bool corrected = false;  ///< COR
    bool automatic = false;  ///< AUTO
    std::string station;     ///< four letters or digits; empty: not reported
    bool time_given = false;
    int day = 0, hour = 0, minute = 0;  ///< UTC; the day of a month that is not reported
    MetarWind wind;
    MetarVisibility visibility;
    std::vector<MetarWeather> weather;
    std::vector<MetarCloud> clouds;
    MetarClear clear = MetarClear::kUnknown;
    bool obscured = false;  ///< VVnnn or VV///
    bool vertical_visibility_given = false;
    double vertical_visibility_m = 0;
    bool temperature_given = false, dew_point_given = false;
    double temperature_c = 0, dew_point_c = 0;
    double pressure_hpa = 0;                  ///< QNH; 0: not reported
    std::vector<std::string> without_effect;  ///< understood, but nothing that a picture shows
    std::vector<std::string> not_understood;  ///< as they stand, printable
};

/// Reads one report. Small letters count as capitals, any white space parts groups, "=" ends it.
/// Errors: kBadInput in one line: an empty text, NIL, a text without any group of the code, or a
/// value that the code does not allow, with its group; kLimit: more than kMaxMetarBytes.
/// `out` is changed only on success.
Status read_metar(std::string_view text, Metar& out);

}  // namespace pileus
