// SPDX-License-Identifier: Apache-2.0
// See metar.h: a report is parted into words, and each is handed to the readers of groups.
// docs/metar.md
#include "src/scene/metar/metar.h"

#include "src/base/printable.h"
#include "src/scene/metar/metar_groups.h"

namespace pileus {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < text.size();) {
        while (i < text.size() && is_blank(text[i])) ++i;
        std::string word;
        for (; i < text.size() && !is_blank(text[i]); ++i) {
            const char c = text[i];
            word += c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
        }
        if (!word.empty()) words.push_back(word);
    }
    return words;
}

bool is_station(std::string_view word) {
    if (word.size() != 4 || word[0] < 'A' || word[0] > 'Z') return false;
    for (const char c : word)
        if (!(c >= 'A' && c <= 'Z') && !(c >= '0' && c <= '9')) return false;
    return true;
}

bool has_form_of_time(std::string_view word) {
    Metar spare;
    Status fault;
    return read_metar_time(word, spare, fault) != MetarForm::kOther;
}

class Reader {
public:
    explicit Reader(std::vector<std::string> words) : words_(std::move(words)) {}

    Status read(Metar& out) {
        end_ = words_.size();
        for (std::size_t i = 0; i < words_.size() && end_ == words_.size(); ++i)
            if (words_[i].back() == '=') {
                words_[i].pop_back();
                end_ = i + 1;
            }
        for (at_ = 0; at_ < end_; ++at_)
            if (!words_[at_].empty()) PILEUS_TRY(read_word(words_[at_]));
        for (std::size_t i = end_; i < words_.size(); ++i) aside(words_[i]);
        if (known_ == 0)
            return metar_fault("no group of a METAR", join(0, words_.size()),
                               "as METAR KJFK 121651Z 27010KT 10SM FEW045 24/16 A3002");
        out = std::move(metar_);
        return Status::ok();
    }

private:
    /// The text of some words.
    std::string join(std::size_t from, std::size_t to) const {
        std::string text;
        for (std::size_t i = from; i < to; ++i) text += (i == from ? "" : " ") + words_[i];
        return printable_line(text);
    }
    void aside(const std::string& word) { metar_.not_understood.push_back(printable_line(word)); }
    void no_effect(const std::string& text) {
        ++known_;
        metar_.without_effect.push_back(printable_line(text));
    }
    /// All up to the remarks or the end, as one entry.
    void skip(bool to_remarks) {
        std::size_t to = at_ + 1;
        while (to < end_ && !(to_remarks && words_[to] == "RMK")) ++to;
        no_effect(join(at_, to));
        at_ = to - 1;
    }

    /// Type, corrections, station and time; whether the word was one of these.
    bool read_head(const std::string& word) {
        if (word == "METAR" || word == "SPECI") {
            metar_.special = word == "SPECI";
            return true;
        }
        if (word == "COR" || word == "AUTO") {
            (word == "COR" ? metar_.corrected : metar_.automatic) = true;
            return true;
        }
        // Only before the time: later four letters are weather, or nothing that is known.
        if (!metar_.station.empty() || metar_.time_given || body_ || !is_station(word))
            return false;
        const bool before_time =
            at_ + 1 < end_ && (has_form_of_time(words_[at_ + 1]) || words_[at_ + 1] == "NIL");
        MetarWeather weather;
        if (!before_time && read_metar_weather(word, weather)) return false;
        metar_.station = word;
        return true;
    }

    /// SKC and the like; whether the word was one.
    bool read_clear(const std::string& word) {
        const struct {
            const char* word;
            MetarClear clear;
        } kWords[] = {{"CAVOK", MetarClear::kCavok},
                      {"SKC", MetarClear::kSkc},
                      {"CLR", MetarClear::kClr},
                      {"NSC", MetarClear::kNsc},
                      {"NCD", MetarClear::kNcd}};
        for (const auto& known : kWords)
            if (word == known.word) {
                metar_.clear = known.clear;
                if (known.clear == MetarClear::kCavok) {
                    metar_.visibility.given = true;
                    metar_.visibility.m = 10000;
                    metar_.visibility.bound = MetarBound::kMore;
                }
                return true;
            }
        return false;
    }

    /// Strokes alone: a part that an automatic station could not tell.
    bool read_strokes(const std::string& word) {
        if (word == "//" || word == "////" || word == "//////") {
            const char* part = word.size() == 2   ? "weather"
                               : word.size() == 4 ? "visibility"
                                                  : "clouds";
            no_effect(word + ": " + part + " not reported");
            return true;
        }
        return false;
    }

    /// Wind shear: WS R24, WS RWY24, WS ALL RWY, WS TKOF RWY12.
    void read_shear() {
        std::size_t to = at_ + 1;
        for (const char* word : {"ALL", "TKOF", "LDG"})
            if (to < end_ && words_[to] == word) ++to;
        if (to < end_ && words_[to].size() <= 6 && words_[to][0] == 'R' &&
            words_[to].find('/') == std::string::npos)
            ++to;
        no_effect(join(at_, to));
        at_ = to - 1;
    }

    /// Groups with numbers; each is read once, a second one is set aside.
    MetarForm read_numbers(const std::string& word, Status& fault) {
        MetarForm form = MetarForm::kOther;
        if (!metar_.time_given) form = read_metar_time(word, metar_, fault);
        if (form == MetarForm::kOther && !wind_) {
            form = read_metar_wind(word, metar_.wind, fault);
            wind_ = form == MetarForm::kRead;
        }
        if (form == MetarForm::kOther && metar_.wind.given)
            form = read_metar_sector(word, metar_.wind, fault);
        if (form == MetarForm::kOther) form = read_visibility(word, fault);
        if (form == MetarForm::kOther && metar_.clouds.size() < kMaxMetarGroups)
            form = read_metar_cloud(word, metar_);
        if (form == MetarForm::kOther && !temperature_) {
            form = read_metar_temperature(word, metar_);
            temperature_ = form == MetarForm::kRead;
        }
        if (form == MetarForm::kOther && read_metar_pressure(word, metar_) == MetarForm::kRead) {
            no_effect(word);
            return MetarForm::kRead;
        }
        if (form == MetarForm::kRead) ++known_;
        return form;
    }

    MetarForm read_visibility(const std::string& word, Status& fault) {
        MetarVisibility& seen = metar_.visibility;
        int whole = 0;
        MetarCursor number(word);
        const std::string next = at_ + 1 < end_ ? words_[at_ + 1] : "";
        const bool two = number.take_digits(1, 2, whole) && number.at_end() && next.size() > 2 &&
                         next.substr(next.size() - 2) == "SM";
        if (two && !seen.given) {
            const MetarForm form = read_metar_visibility(next, whole, seen, fault);
            if (form == MetarForm::kRead) ++at_;
            return form;
        }
        if (seen.given && word.size() > 2 && word.substr(word.size() - 2) == "SM")
            return MetarForm::kOther;
        return read_metar_visibility(word, 0, seen, fault);
    }

    Status read_word(const std::string& word) {
        if (word == "NIL")
            return metar_fault("NIL, the report is missing", join(0, end_), "a report with groups");
        const std::size_t known = known_;
        if (read_head(word)) return Status::ok();
        body_ = true;
        Status fault;
        const MetarForm form = read_numbers(word, fault);
        if (form == MetarForm::kFault) return fault;
        if (form == MetarForm::kRead) return Status::ok();
        MetarWeather weather;
        if (read_clear(word)) {
            ++known_;
        } else if (metar_.weather.size() < kMaxMetarGroups && read_metar_weather(word, weather)) {
            ++known_;
            metar_.weather.push_back(weather);
        } else if (word == "RMK") {
            skip(false);
        } else if (word == "BECMG" || word == "TEMPO" || word == "INTER") {
            skip(true);
        } else if (word == "WS") {
            read_shear();
        } else if (!read_strokes(word) && metar_without_effect(word)) {
            no_effect(word);
        } else if (known_ == known) {
            aside(word);
        }
        return Status::ok();
    }

    std::vector<std::string> words_;
    std::size_t at_ = 0, end_ = 0, known_ = 0;
    bool body_ = false, wind_ = false, temperature_ = false;
    Metar metar_;
};

}  // namespace

Status read_metar(std::string_view text, Metar& out) {
    if (text.size() > kMaxMetarBytes)
        return Status::limit("metar: too long, " + std::to_string(text.size()) +
                             " bytes, allowed: up to " + std::to_string(kMaxMetarBytes));
    std::vector<std::string> words = words_of(text);
    if (words.empty())
        return metar_fault("empty", "", "as METAR KJFK 121651Z 27010KT 10SM FEW045 24/16 A3002");
    return Reader(std::move(words)).read(out);
}

}  // namespace pileus
