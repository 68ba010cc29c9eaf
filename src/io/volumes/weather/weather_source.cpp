// SPDX-License-Identifier: Apache-2.0
// Opens weather data: axes, fields, what tells the heights.
// in: an NcFile -> out: see weather_source.h.
// docs/weather.md; CF conventions 1.10, appendix D (hybrid coordinates).
#include "src/io/volumes/weather/weather_source.h"

#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/volumes/weather/weather_hints.h"

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
    PILEUS_TRY(read_unpacked(file, v, block, {values.data(), values.size()}));
    for (const double value : values)
        if (!(value > -1e12 && value < 1e12))
            return nc_fault(file.name(), v, "values: not finite or missing, allowed: numbers");
    return Status::ok();
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
            std::string positive = v.text("positive");
            for (char& c : positive)
                if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
            if (!positive.empty() && positive != "up")
                return nc_fault(
                    file_.name(), v,
                    "positive: " +
                        std::string(positive == "down" ? "levels upside down" : "not understood") +
                        ", \"" + v.text("positive") + "\", allowed: up for heights");
            s_.vertical = height.on_faces ? Vertical::kHeightFaces : Vertical::kHeightLevels;
            return direction(Role::kHeight, true);
        }
        if (pressure.there() && pressure.on_faces) {
            s_.vertical = Vertical::kPressureFaces;
            return direction(Role::kPressure, false);
        }
        PILEUS_TRY(hybrid(found));
        if (found && s_.hybrid_heights) return Status::ok();
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
    /// The levels' own coordinate, or else one along them whose unit tells where they lie.
    Status level_variable(const NcVariable*& found, std::string& unit) const {
        UnitScale scale;
        found = nullptr;
        for (const NcVariable* v : coordinates_of(head_, s_.axes.level, AxisKind::kLevel)) {
            std::string text;
            bool there = false;
            PILEUS_TRY(read_unit(file_, *s_.settings, *v, text, there));
            const bool tells = find_unit(text, Quantity::kPressure, scale) ||
                               find_unit(text, Quantity::kHeight, scale) ||
                               !v->text("formula_terms").empty();
            if (!tells && found != nullptr) continue;
            found = v;
            unit = text;
            if (tells) break;
        }
        return Status::ok();
    }

    /// The levels' coordinate, where its unit says what it is and no variable says it better.
    Status coordinate() {
        const NcVariable* v = nullptr;
        std::string text;
        PILEUS_TRY(level_variable(v, text));
        if (v == nullptr || !v->text("formula_terms").empty()) return Status::ok();
        UnitScale unit;
        WeatherField& height = s_.fields[Role::kHeight];
        WeatherField& pressure = s_.fields[Role::kPressure];
        if (!pressure.there() && find_unit(text, Quantity::kPressure, unit)) {
            pressure.parts = {v};
            pressure.quantity = Quantity::kPressure;
            pressure.unit = unit;
        }
        if (!height.there() && s_.settings->names.height != "none" &&
            find_unit(text, Quantity::kHeight, unit) && !is_level_number(file_, *v)) {
            height.parts = {v};
            height.quantity = Quantity::kHeight;
            height.unit = unit;
            height.above_ground = is_above_ground(*v);
        }
        return Status::ok();
    }

    /// Of a term of a formula that is one number.
    Status number_of(const NcVariable* v, double& value) const {
        if (v == nullptr || !v->dimensions.empty()) return Status::ok();
        std::vector<double> one;
        PILEUS_TRY(read_all(file_, *v, 1, one));
        value = one[0];
        UnitScale unit;
        if (find_unit(v->text("units"), Quantity::kPressure, unit)) value *= unit.factor;
        return Status::ok();
    }

    bool is_line(const NcVariable* v) const {
        return v != nullptr && v->dimensions.size() == 1 && head_.size(*v, 0) == s_.axes.levels;
    }

    /// CF conventions, appendix D: formulas that are none of pressures a + b ps.
    Status formula(const NcVariable& level, bool& found) {
        const std::string terms = level.text("formula_terms"), name = level.text("standard_name");
        const std::uint64_t n = s_.axes.levels;
        if (name == "atmosphere_hybrid_height_coordinate") {
            const NcVariable *a = head_.find(term_of(terms, "a")),
                             *b = head_.find(term_of(terms, "b"));
            UnitScale unit;
            if (!is_line(a) || !is_line(b) || !s_.has(Role::kSurfaceHeight) ||
                !find_unit(a->text("units"), Quantity::kHeight, unit))
                return formula_fault(level, "a in m and b of each level, and the ground's height");
            PILEUS_TRY(read_all(file_, *a, n, s_.hybrid_a));
            PILEUS_TRY(read_all(file_, *b, n, s_.hybrid_b));
            for (double& value : s_.hybrid_a) value *= unit.factor;
            s_.vertical = Vertical::kHeightLevels;
            s_.hybrid_heights = true;
            s_.top_down = n > 1 && s_.hybrid_a.front() > s_.hybrid_a.back();
            found = true;
        } else if (name == "atmosphere_sigma_coordinate") {
            const NcVariable* sigma = head_.find(term_of(terms, "sigma"));
            if (!is_line(sigma) || !s_.has(Role::kSurfacePressure))
                return formula_fault(level, "sigma of each level and the pressure at the ground");
            double top = 0;
            PILEUS_TRY(number_of(head_.find(term_of(terms, "ptop")), top));
            PILEUS_TRY(read_all(file_, *sigma, n, s_.hybrid_b));
            for (const double share : s_.hybrid_b) s_.hybrid_a.push_back(top * (1 - share));
            s_.vertical = Vertical::kPressureLevels;
            found = true;
        } else if (name != "atmosphere_hybrid_sigma_pressure_coordinate" && !name.empty()) {
            return formula_fault(level, "a formula of hybrid pressures, hybrid heights or sigma");
        }
        return Status::ok();
    }
    Status formula_fault(const NcVariable& level, const char* allowed) const {
        return nc_fault(file_.name(), level,
                        "formula_terms: not enough to place the levels of " +
                            level.text("standard_name") + ", allowed: " + allowed +
                            ", or heights or pressures as variables");
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
        PILEUS_TRY(number_of(head_.find("P0"), reference));
        PILEUS_TRY(take(head_.find("hyai"), head_.find("hybi"), reference, true, found));
        if (found) return Status::ok();
        PILEUS_TRY(take(head_.find("ak"), head_.find("bk"), reference, true, found));
        if (found) return Status::ok();
        const NcVariable* level = nullptr;
        std::string unit;
        PILEUS_TRY(level_variable(level, unit));
        const std::string terms = level != nullptr ? level->text("formula_terms") : "";
        // Pressures of levels tell where these lie as well.
        if (!terms.empty() && !s_.has(Role::kPressure)) PILEUS_TRY(formula(*level, found));
        if (found) return Status::ok();
        if (!terms.empty()) {
            PILEUS_TRY(number_of(head_.find(term_of(terms, "p0")), reference));
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

    /// By the first column that has values.
    Status direction(Role role, bool ascends) {
        Buffer<double> row;
        s_.top_down = false;
        const std::size_t n = s_.levels() + (s_.fields[role].on_faces ? 1 : 0);
        for (std::uint64_t y = 0; y < s_.axes.ny && n > 1; ++y) {
            PILEUS_TRY(read_field(s_, role, y, 1, row));
            for (std::size_t x = 0; x < s_.row_columns(); ++x) {
                const double low = row.at(x * n), high = row.at(x * n + n - 1);
                if (low != low || high != high) continue;
                s_.top_down = (low < high) != ascends;
                return Status::ok();
            }
        }
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
    PILEUS_TRY(check_hints(file, settings));
    PILEUS_TRY(find_water(file, settings, source.water));
    PILEUS_TRY(find_axes(file, *source.water, settings, source.axes));
    // No column may have more levels than a grid can show, no row more columns.
    constexpr std::uint64_t kMaxHeights = 10'000, kMaxSide = std::uint64_t{1} << 20;
    constexpr std::uint64_t kMaxRow = std::uint64_t{1} << 24;
    const WeatherAxes& axes = source.axes;
    if (axes.levels > kMaxHeights || axes.nx > kMaxSide || axes.ny > kMaxSide ||
        axes.nx * axes.levels > kMaxRow)
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
