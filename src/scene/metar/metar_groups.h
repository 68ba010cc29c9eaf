// SPDX-License-Identifier: Apache-2.0
// Single groups of a METAR.
// in: one word in capitals -> out: whether it has the form of the group, its values, a fault.
// ICAO Annex 3, Appendix 3; WMO No. 306, FM 15; FMH-1, chapter 12. docs/metar.md
#pragma once
#include "src/scene/metar/metar.h"

namespace pileus {

/// kFault: the form is that of the group, a value is not allowed; the status says which.
enum class MetarForm { kOther, kRead, kFault };

/// The next characters of a word.
class MetarCursor {
public:
    explicit MetarCursor(std::string_view word) : rest_(word) {}

    bool at_end() const { return rest_.empty(); }
    std::string_view rest() const { return rest_; }

    bool take(std::string_view text) {
        if (rest_.substr(0, text.size()) != text) return false;
        rest_.remove_prefix(text.size());
        return true;
    }
    /// As many digits as there are, `least` to `most` (9 at most) of them.
    bool take_digits(std::size_t least, std::size_t most, int& number) {
        std::size_t count = 0;
        int sum = 0;
        while (count < rest_.size() && count <= most && rest_[count] >= '0' && rest_[count] <= '9')
            if (count++ < most) sum = 10 * sum + (rest_[count - 1] - '0');
        if (count < least || count > most) return false;
        rest_.remove_prefix(count);
        number = sum;
        return true;
    }
    bool take_strokes(std::size_t count) {
        return take(std::string_view("/////////").substr(0, count));
    }

private:
    std::string_view rest_;
};

/// "metar: WHAT, "WORD", allowed: ALLOWED".
Status metar_fault(std::string_view what, std::string_view word, std::string_view allowed);

MetarForm read_metar_time(std::string_view word, Metar& out, Status& fault);
MetarForm read_metar_wind(std::string_view word, MetarWind& out, Status& fault);
/// 270V330.
MetarForm read_metar_sector(std::string_view word, MetarWind& out, Status& fault);
/// Metres, or miles after `whole` of them: 1 of "1 1/2SM".
MetarForm read_metar_visibility(std::string_view word, int whole, MetarVisibility& out,
                                Status& fault);
MetarForm read_metar_cloud(std::string_view word, Metar& out);
MetarForm read_metar_temperature(std::string_view word, Metar& out);
/// Q1013, A2992; a value that no air has is kOther.
MetarForm read_metar_pressure(std::string_view word, Metar& out);
bool read_metar_weather(std::string_view word, MetarWeather& out);

/// Whether a word is a group that no picture shows: runways, recent weather, state of the sea,
/// colours of aerodromes, corrections.
bool metar_without_effect(std::string_view word);

}  // namespace pileus
