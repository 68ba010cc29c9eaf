// SPDX-License-Identifier: Apache-2.0
// Opens weather data: axes, fields, what tells the heights.
// in: an NcFile -> out: see weather_source.h.
// docs/weather.md; CF conventions 1.10, appendix D (hybrid coordinates).
#include "src/io/volumes/weather/weather_source.h"

namespace pileus {
namespace {

Status read_all(const NcFile& file, const NcVariable& v, std::uint64_t count,
                std::vector<double>& values) {
    const NcBlock block = whole_block(file.head(), v);
    if (block.values() != count)
        return nc_fault(
            file.name(), v,
            "values: " + std::to_string(block.values()) + ", allowed: " + std::to_string(count));
    values.assign(std::size_t(count), 0.0);
    return file.read(v, block, {values.data(), values.size()});
}

/// "a: hyam b: hybm ps: sp" -> the variable of a term; empty where there is none.
std::string term_of(const std::string& terms, const std::string& term) {
    const std::string key = term + ":";
    std::size_t at = terms.find(key);
    while (at != std::string::npos && at > 0 && terms[at - 1] != ' ') at = terms.find(key, at + 1);
    if (at == std::string::npos) return "";
    at += key.size();
    while (at < terms.size() && terms[at] == ' ') ++at;
    return terms.substr(at, terms.find(' ', at) - at);
}

class VerticalSearch {
public:
    explicit VerticalSearch(WeatherSource& source)
        : s_(source), file_(*source.file), head_(source.file->head()) {}

    Status run() {
        bool found = false;
        PILEUS_TRY(coordinate());
        const WeatherField& height = s_.fields[Role::kHeight];
        const WeatherField& pressure = s_.fields[Role::kPressure];
        if (height.there()) {
            const NcVariable& v = *height.parts[0];
            if (v.text("positive") == "down")
                return nc_fault(file_.name(), v,
                                "positive: levels upside down, \"down\", allowed: up for heights");
            s_.vertical = height.on_faces ? Vertical::kHeightFaces : Vertical::kHeightLevels;
            return direction(Role::kHeight, true);
        }
        if (pressure.there() && pressure.on_faces) {
            s_.vertical = Vertical::kPressureFaces;
            return direction(Role::kPressure, false);
        }
        PILEUS_TRY(hybrid(found));
        if (found) return hybrid_direction();
        if (pressure.there()) {
            s_.vertical = Vertical::kPressureLevels;
            return direction(Role::kPressure, false);
        }
        return nc_fault(file_.name(), *s_.water,
                        "levels: neither height nor pressure is known, nothing, allowed: a "
                        "variable of one, hybrid coefficients with the pressure at the ground, "
                        "or a coordinate in " +
                            unit_names(Quantity::kPressure) + " or " +
                            unit_names(Quantity::kHeight));
    }

private:
    const NcVariable* level_variable() const {
        const NcVariable* v = head_.find(head_.dimensions[s_.axes.level].name);
        const bool along = v != nullptr && v->dimensions.size() == 1 &&
                           v->dimensions[0] == s_.axes.level && v->type != NcType::kChar;
        return along ? v : nullptr;
    }

    /// The levels' own coordinate, where its unit says what it is and no variable says it better.
    Status coordinate() {
        const NcVariable* v = level_variable();
        if (v == nullptr || !v->text("formula_terms").empty()) return Status::ok();
        UnitScale unit;
        const std::string text = v->text("units");
        WeatherField& height = s_.fields[Role::kHeight];
        WeatherField& pressure = s_.fields[Role::kPressure];
        if (!pressure.there() && find_unit(text, Quantity::kPressure, unit)) {
            pressure.parts = {v};
            pressure.quantity = Quantity::kPressure;
            pressure.unit = unit;
        }
        if (!height.there() && s_.settings->height != "none" &&
            find_unit(text, Quantity::kHeight, unit)) {
            height.parts = {v};
            height.quantity = Quantity::kHeight;
            height.unit = unit;
        }
        return Status::ok();
    }

    Status take(const NcVariable* a, const NcVariable* b, double reference, bool faces,
                bool& found) {
        const std::uint64_t n = s_.axes.levels + (faces ? 1 : 0);
        if (b == nullptr || !s_.has(Role::kSurfacePressure)) return Status::ok();
        for (const NcVariable* v : {a, b})
            if (v != nullptr && (v->dimensions.size() != 1 || head_.size(*v, 0) != n))
                return Status::ok();
        s_.hybrid_a.assign(std::size_t(n), 0.0);
        if (a != nullptr) {
            PILEUS_TRY(read_all(file_, *a, n, s_.hybrid_a));
            UnitScale unit;
            if (find_unit(a->text("units"), Quantity::kPressure, unit)) reference = unit.factor;
            for (double& value : s_.hybrid_a) value *= reference;
        }
        PILEUS_TRY(read_all(file_, *b, n, s_.hybrid_b));
        s_.vertical = faces ? Vertical::kPressureFaces : Vertical::kPressureLevels;
        found = true;
        return Status::ok();
    }

    /// Coefficients of faces where the file has them, or else of levels.
    Status hybrid(bool& found) {
        double reference = 1;
        if (const NcVariable* p0 = head_.find("P0"))
            if (p0->dimensions.empty()) {
                std::vector<double> value;
                PILEUS_TRY(read_all(file_, *p0, 1, value));
                reference = value[0];
            }
        PILEUS_TRY(take(head_.find("hyai"), head_.find("hybi"), reference, true, found));
        if (found) return Status::ok();
        PILEUS_TRY(take(head_.find("ak"), head_.find("bk"), reference, true, found));
        if (found) return Status::ok();
        const NcVariable* level = level_variable();
        const std::string terms = level != nullptr ? level->text("formula_terms") : "";
        if (!terms.empty()) {
            const NcVariable* p0 = head_.find(term_of(terms, "p0"));
            if (p0 != nullptr && p0->dimensions.empty()) {
                std::vector<double> value;
                PILEUS_TRY(read_all(file_, *p0, 1, value));
                reference = value[0];
            }
            const std::string ap = term_of(terms, "ap"), a = term_of(terms, "a");
            PILEUS_TRY(take(head_.find(ap.empty() ? a : ap), head_.find(term_of(terms, "b")),
                            ap.empty() ? reference : 1, false, found));
            if (found) return Status::ok();
        }
        return take(head_.find("hyam"), head_.find("hybm"), reference, false, found);
    }

    /// Of pressures at a usual ground, so that no column need be read.
    Status hybrid_direction() {
        const std::size_t n = s_.hybrid_b.size();
        const auto at = [&](std::size_t k) { return s_.hybrid_a[k] + s_.hybrid_b[k] * 1e5; };
        s_.top_down = n > 1 && at(0) < at(n - 1);
        return Status::ok();
    }

    /// By the first column.
    Status direction(Role role, bool ascends) {
        Buffer<double> first;
        s_.top_down = false;
        PILEUS_TRY(read_field(s_, role, 0, 1, first));
        const std::size_t n = s_.levels() + (s_.fields[role].on_faces ? 1 : 0);
        if (n < 2) return Status::ok();
        const bool upwards = first.at(0) < first.at(n - 1);
        s_.top_down = upwards != ascends;
        return Status::ok();
    }

    WeatherSource& s_;
    const NcFile& file_;
    const NcHead& head_;
};

}  // namespace

Status find_vertical(WeatherSource& source) { return VerticalSearch(source).run(); }

Status open_weather(const NcFile& file, const WeatherSettings& settings, WeatherSource& source) {
    source = WeatherSource();
    source.file = &file;
    source.settings = &settings;
    PILEUS_TRY(find_water(file, settings, source.water));
    PILEUS_TRY(find_axes(file, *source.water, settings, source.axes));
    // No column may have more levels than a grid can show, no row more columns.
    constexpr std::uint64_t kMostHeights = 10'000, kMostSide = std::uint64_t{1} << 20;
    constexpr std::uint64_t kMostRow = std::uint64_t{1} << 24;
    const WeatherAxes& axes = source.axes;
    if (axes.levels > kMostHeights || axes.nx > kMostSide || axes.ny > kMostSide ||
        axes.nx * axes.levels > kMostRow)
        return Status::limit(file.name() + ": variable " + printable_line(source.water->name) +
                             ": too large, " + std::to_string(axes.nx) + " x " +
                             std::to_string(axes.ny) + " x " + std::to_string(axes.levels) +
                             ", allowed: at most 10000 levels, 2^20 columns along x and y and 2^24 "
                             "values in a row of columns");
    // Of a classic file: the sizes are true before anything is made as large as they say.
    PILEUS_TRY(file.check_room(*source.water, whole_block(file.head(), *source.water)));
    PILEUS_TRY(find_fields(file, settings, axes, source.fields));
    PILEUS_TRY(find_footprints(file, *source.water, axes, settings, source.ground));
    return find_vertical(source);
}

}  // namespace pileus
