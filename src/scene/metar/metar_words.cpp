// SPDX-License-Identifier: Apache-2.0
// Groups of a METAR that are words: present weather, and what no picture shows.
// in: a word -> out: its parts, or whether it is known.
// WMO No. 306, code tables 4678, 0366 and others of FM 15. docs/metar.md
#include "src/base/span.h"
#include "src/scene/metar/metar_groups.h"

namespace pileus {
namespace {

constexpr const char* kDescriptors[] = {"MI", "BC", "PR", "DR", "BL", "SH", "TS", "FZ"};
constexpr const char* kPhenomena[] = {"DZ", "RA", "SN", "SG", "IC", "PL", "GR", "GS",
                                      "UP", "BR", "FG", "FU", "VA", "DU", "SA", "HZ",
                                      "PY", "PO", "SQ", "FC", "SS", "DS"};
// Colours of military aerodromes, corrections (COR has a member), closed by snow.
constexpr const char* kWords[] = {"BLU",    "BLU+",    "WHT",      "GRN", "YLO", "YLO1",
                                  "YLO2",   "AMB",     "RED",      "CCA", "CCB", "CCC",
                                  "SNOCLO", "RSNOCLO", "R/SNOCLO", "RTD", "NSW", "NOSIG"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool of(std::string_view set, char c) { return set.find(c) != std::string_view::npos; }

bool take_one_of(MetarCursor& at, const char* const* begin, const char* const* end,
                 std::string& word) {
    for (const char* const* i = begin; i != end; ++i)
        if (at.take(*i)) {
            word = *i;
            return true;
        }
    return false;
}

/// P0600 or M0050 of a range on a runway.
bool take_range(MetarCursor& at) {
    int metres = 0;
    if (!at.take("P")) at.take("M");
    return at.take_digits(4, 4, metres);
}

/// R24L/0600V1200U and R24/5000FT, a visual range; R24/290055, R88/CLRD//, a state of the runway.
bool is_runway(std::string_view word) {
    MetarCursor at(word);
    int number = 0;
    if (!at.take("R") || !at.take_digits(2, 2, number)) return false;
    for (int i = 0; i < 2 && (at.take("L") || at.take("C") || at.take("R")); ++i) {
    }
    if (!at.take("/")) return false;
    if (at.rest() == "////" || at.rest() == "//////") return true;
    MetarCursor range = at;
    if (take_range(range)) {
        const bool fine = !range.take("V") || take_range(range);
        range.take("FT");
        const bool stroke = range.take("/");
        const bool tendency = range.take("U") || range.take("D") || range.take("N");
        if (fine && (tendency || !stroke) && range.at_end()) return true;
    }
    if (at.take("CLRD")) {
        return at.rest() == "//" || (at.take_digits(2, 2, number) && at.at_end());
    }
    if (at.rest().size() != 6) return false;
    for (const char c : at.rest())
        if (!is_digit(c) && c != '/') return false;
    return true;
}

/// 24290055, the state of a runway in the older form.
bool is_old_runway_state(std::string_view word) {
    if (word.size() != 8 || !is_digit(word[0]) || !is_digit(word[1])) return false;
    if (word.substr(2, 4) == "CLRD") return true;
    for (const char c : word)
        if (!is_digit(c) && c != '/') return false;
    return true;
}

/// W19/S4, WM01/H12: temperature and state of the sea.
bool is_sea(std::string_view word) {
    MetarCursor at(word);
    int number = 0;
    if (!at.take("W")) return false;
    if (!at.take_strokes(2)) {
        at.take("M");
        if (!at.take_digits(2, 2, number)) return false;
    }
    if (!at.take("/") || (!at.take("S") && !at.take("H"))) return false;
    if (at.rest().empty() || at.rest().size() > 3) return false;
    for (const char c : at.rest())
        if (!of("0123456789/", c)) return false;
    return true;
}

}  // namespace

bool read_metar_weather(std::string_view word, MetarWeather& out) {
    MetarWeather weather;
    MetarCursor at(word);
    if (at.take("-"))
        weather.intensity = MetarIntensity::kLight;
    else if (at.take("+"))
        weather.intensity = MetarIntensity::kHeavy;
    else if (at.take("VC"))
        weather.intensity = MetarIntensity::kVicinity;
    take_one_of(at, std::begin(kDescriptors), std::end(kDescriptors), weather.descriptor);
    std::string phenomenon;
    while (take_one_of(at, std::begin(kPhenomena), std::end(kPhenomena), phenomenon))
        weather.phenomena.push_back(phenomenon);
    // Up to three phenomena (WMO No. 306, 15.8). Alone stand thunder, and showers nearby.
    const bool alone =
        weather.descriptor == "TS" ||
        (weather.descriptor == "SH" && weather.intensity == MetarIntensity::kVicinity);
    if (!at.at_end() || weather.phenomena.size() > 3 || (weather.phenomena.empty() && !alone))
        return false;
    out = weather;
    return true;
}

bool metar_without_effect(std::string_view word) {
    for (const char* known : kWords)
        if (word == known) return true;
    if (word.substr(0, 5) == "BLACK") {
        const std::string_view colour = word.substr(5);
        for (const char* known : kWords)
            if (colour.empty() || colour == known) return true;
    }
    MetarWeather recent;
    if (word.substr(0, 2) == "RE" && (word == "RE//" || read_metar_weather(word.substr(2), recent)))
        return true;
    if (word.substr(0, 3) == "QFE") {
        MetarCursor at(word.substr(3));
        int number = 0;
        return at.take_digits(3, 4, number) && (at.at_end() || at.take("/"));
    }
    return is_runway(word) || is_old_runway_state(word) || is_sea(word);
}

}  // namespace pileus
