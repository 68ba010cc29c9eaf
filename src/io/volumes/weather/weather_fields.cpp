// SPDX-License-Identifier: Apache-2.0
// The search for variables by their names.
// in: a head -> out: see weather_fields.h.
// docs/weather.md, "Variables"
#include "src/io/volumes/weather/weather_fields.h"

#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/volumes/weather/weather_hints.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

using Q = Quantity;
using M = Meaning;

const char* const kKeys[] = {"liquid",
                             "ice",
                             "cloud_fraction",
                             "temperature",
                             "pressure",
                             "height",
                             "humidity",
                             "liquid_radius",
                             "ice_radius",
                             "surface_pressure",
                             "surface_geopotential",
                             "variable"};

const std::string& wanted_name(const WeatherSettings& s, Role role) {
    const std::string* const names[] = {&s.names.liquid,
                                        &s.names.ice,
                                        &s.names.cloud_fraction,
                                        &s.names.temperature,
                                        &s.names.pressure,
                                        &s.names.height,
                                        &s.names.humidity,
                                        &s.names.liquid_radius,
                                        &s.names.ice_radius,
                                        &s.names.surface_pressure,
                                        &s.names.surface_geopotential,
                                        &s.names.variable};
    return *names[std::size_t(role)];
}

/// What counts for water alone is left out where something else is shown.
bool is_of_water(Role role) {
    return role == Role::kLiquid || role == Role::kIce || role == Role::kFraction ||
           role == Role::kLiquidRadius || role == Role::kIceRadius;
}

bool is_surface(Role role) {
    return role == Role::kSurfacePressure || role == Role::kSurfaceHeight;
}

/// Variables that a name of one or two parts means; false where one is not there.
bool find_parts(const NcHead& head, const std::string& name, std::vector<const NcVariable*>& to) {
    to.clear();
    std::size_t from = 0;
    for (;;) {
        const std::size_t plus = name.find('+', from);
        const NcVariable* part = head.find(name.substr(from, plus - from));
        if (part == nullptr) return false;
        to.push_back(part);
        if (plus == std::string::npos) return true;
        from = plus + 1;
    }
}

/// Where the levels of a variable stand: on levels, on faces, nowhere, or not as it must be.
enum class Standing { kWrong, kSurface, kLevels, kFaces };

Standing standing_of(const NcHead& head, const WeatherAxes& axes, const NcVariable& v) {
    Standing standing = Standing::kSurface;
    for (std::size_t k = 0; k < v.dimensions.size(); ++k) {
        const std::size_t d = v.dimensions[k];
        if (d == axes.time || d == axes.member || d == axes.y || d == axes.x || d == axes.column)
            continue;
        const std::uint64_t size = head.dimensions[d].size;
        if (d == axes.level) {
            standing = Standing::kLevels;
        } else if (size == axes.levels + 1 && standing == Standing::kSurface) {
            standing = Standing::kFaces;
        } else if (size != 1) {
            return Standing::kWrong;
        }
    }
    return standing;
}

/// Name and description, in lower case.
std::string words_of(const NcVariable& v) {
    std::string text = v.name;
    for (const char* name : {"long_name", "longname", "description"}) text += ' ' + v.text(name);
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

class Search {
public:
    Search(const NcFile& file, const WeatherSettings& settings)
        : file_(file), head_(file.head()), settings_(settings), wrf_(is_wrf(head_)) {}

    /// The variables of a role; its row where one names them, null for a name of the scene's own.
    Status parts(Role role, const WeatherAxes* axes, std::vector<const NcVariable*>& found,
                 const WeatherName*& row) const {
        const std::string& wanted = wanted_name(settings_, role);
        row = nullptr;
        found.clear();
        if (wanted == "none" && role != Role::kShown) return Status::ok();
        if (!wanted.empty()) {
            if (!find_parts(head_, wanted, found))
                return Status::bad_input(file_.name() + ": " + role_key(role) +
                                         ": no such variable, " + quote_text(wanted) +
                                         ", allowed: " + variable_list());
            for (const WeatherName& r : weather_names())
                if (r.role == role && row == nullptr && says(r, *found[0], wanted)) row = &r;
            return Status::ok();
        }
        // Heights of each column tell more than those of a coordinate, which may be numbers alone.
        for (const bool lines : {false, true}) {
            if (!lines && role != Role::kHeight) continue;
            for (const WeatherName& r : weather_names())
                if (r.role == role && (!r.wrf || wrf_) && look(r, axes, lines, found)) {
                    row = &r;
                    return Status::ok();
                }
        }
        found.clear();
        return Status::ok();
    }

    Status field(Role role, const WeatherAxes& axes, WeatherField& out) const {
        const WeatherName* row = nullptr;
        out = WeatherField();
        if (!settings_.names.variable.empty() && is_of_water(role)) return Status::ok();
        PILEUS_TRY(parts(role, &axes, out.parts, row));
        if (!out.there()) return Status::ok();
        NcPacking packing;
        for (const NcVariable* part : out.parts) {
            PILEUS_TRY(NcPacking::of(file_.name(), *part, packing));
            const Standing standing = standing_of(head_, axes, *part);
            const bool good = is_surface(role)
                                  ? standing == Standing::kSurface
                                  : standing == Standing::kLevels || standing == Standing::kFaces;
            if (!good)
                return nc_fault(file_.name(), *part,
                                std::string("dimensions: other than those of the cloud's water, "
                                            "allowed: ") +
                                    (is_surface(role) ? "the same without levels" : "the same"));
            out.on_faces = standing == Standing::kFaces;
        }
        out.quantity = row != nullptr ? row->quantity : default_quantity(role);
        out.meaning = row != nullptr ? row->meaning : M::kPlain;
        if (wrf_) out.gravity = 9.81;
        if (role == Role::kHeight) out.above_ground = is_above_ground(*out.parts[0]);
        if (role == Role::kTemperature && says_potential(*out.parts[0]))
            out.meaning = M::kPotential;
        if (role == Role::kShown) return shown(out);
        PILEUS_TRY(unit(role, out));
        if (row != nullptr) out.unit.offset += row->offset;
        return Status::ok();
    }

private:
    /// By what its files have and no others: QCLOUD of one that lacks PB is known, too.
    static bool is_wrf(const NcHead& head) {
        bool levels = false;
        for (const NcDimension& d : head.dimensions) levels = levels || d.name == "bottom_top";
        return head.find("PB") != nullptr || levels || head.attribute("MAP_PROJ") != nullptr;
    }

    /// A temperature without a standard name may say what it is in words, as that of UCLALES.
    static bool says_potential(const NcVariable& v) {
        return v.find("standard_name") == nullptr &&
               words_of(v).find("potential temp") != std::string::npos;
    }

    static bool says(const WeatherName& row, const NcVariable& v, const std::string& name) {
        return row.name != nullptr ? name == row.name
                                   : v.text("standard_name") == row.standard_name;
    }

    /// A variable of any kind keeps its own unit.
    Status shown(WeatherField& field) const {
        field.meaning = M::kPlain;
        field.unit = UnitScale();
        if (!field.on_faces) return Status::ok();
        return nc_fault(file_.name(), *field.parts[0], "dimensions: other than those of its sum");
    }

    static Q default_quantity(Role role) {
        static constexpr Q of[] = {Q::kRatio,    Q::kRatio,    Q::kFraction, Q::kTemperature,
                                   Q::kPressure, Q::kHeight,   Q::kRatio,    Q::kRadius,
                                   Q::kRadius,   Q::kPressure, Q::kHeight,   Q::kRatio};
        return of[std::size_t(role)];
    }

    bool fits(Role role, const WeatherAxes* axes, const NcVariable& v) const {
        if (v.type == NcType::kOther || v.type == NcType::kChar) return false;
        if (axes == nullptr) return v.dimensions.size() >= 1;
        const Standing standing = standing_of(head_, *axes, v);
        if (is_surface(role)) return standing == Standing::kSurface;
        return standing == Standing::kLevels || standing == Standing::kFaces;
    }

    /// `lines`: heights may be those of all columns alike.
    bool look(const WeatherName& row, const WeatherAxes* axes, bool lines,
              std::vector<const NcVariable*>& found) const {
        const auto good = [&](const NcVariable& v) {
            if (!fits(row.role, axes, v)) return false;
            if (row.role != Role::kHeight || v.dimensions.size() > 1) return true;
            return lines && v.text("formula_terms").empty() && !is_level_number(file_, v);
        };
        found.clear();
        if (row.name != nullptr) {
            if (!find_parts(head_, row.name, found)) return false;
        } else {
            for (const NcVariable& v : head_.variables)
                if (found.empty() && v.text("standard_name") == row.standard_name && good(v))
                    found.push_back(&v);
            if (found.empty()) return false;
        }
        for (const NcVariable* v : found)
            if (!good(*v)) return false;
        return true;
    }

    /// All parts have one unit. Water and heights may come in either of two quantities.
    Status unit(Role role, WeatherField& field) const {
        const NcVariable& v = *field.parts[0];
        std::string text, other;
        bool units = false, others = false;
        PILEUS_TRY(read_unit(file_, settings_, v, text, units));
        const bool water = role == Role::kLiquid || role == Role::kIce;
        const bool height = role == Role::kHeight || role == Role::kSurfaceHeight;
        if (field.meaning == M::kLogarithm) return Status::ok();
        for (const NcVariable* part : field.parts) {
            PILEUS_TRY(read_unit(file_, settings_, *part, other, others));
            if (other != text)
                return nc_fault(file_.name(), *part,
                                "units: " + quote_text(other) + ", allowed: as those of " + v.name +
                                    ", " + quote_text(text));
        }
        if (find_unit(text, field.quantity, field.unit)) return Status::ok();
        if (water && find_unit(text, Q::kContent, field.unit)) {
            field.quantity = Q::kContent;
            field.meaning = M::kPlain;
            return Status::ok();
        }
        if (water && units && find_unit(text, Q::kRatio, field.unit)) {
            field.quantity = Q::kRatio;
            return Status::ok();
        }
        if (height && find_unit(text, Q::kHeight, field.unit)) {
            field.quantity = Q::kHeight;
            field.meaning = M::kPlain;
            return Status::ok();
        }
        if (height && find_unit(text, Q::kGeopotential, field.unit)) {
            field.quantity = Q::kGeopotential;
            field.meaning = M::kGeopotential;
            return Status::ok();
        }
        std::string allowed = unit_names(field.quantity);
        if (water)
            allowed += ", " + unit_names(field.quantity == Q::kRatio ? Q::kContent : Q::kRatio);
        return nc_fault(
            file_.name(), v,
            (!units ? std::string("units: missing, nothing")
                    : "units: not of " + std::string(role_key(role)) + ", " + quote_text(text)) +
                ", allowed: " + allowed + "; or the key units of the density");
    }

    std::string variable_list() const {
        std::string list;
        for (const NcVariable& v : head_.variables)
            if (v.dimensions.size() >= 2 && list.size() < 200)
                list += (list.empty() ? "" : ", ") + v.name;
        return printable_line(list);
    }

    const NcFile& file_;
    const NcHead& head_;
    const WeatherSettings& settings_;
    bool wrf_;
};

}  // namespace

std::string WeatherField::name() const {
    std::string text;
    for (const NcVariable* part : parts) text += (text.empty() ? "" : " + ") + part->name;
    return text;
}

bool is_above_ground(const NcVariable& v) {
    const std::string standard = v.text("standard_name"), words = words_of(v);
    if (!standard.empty()) return standard == "height";
    for (const char* said : {"above ground", "above_ground", "above the ground", "above surface",
                             "above_surface", "above the surface", "above local surface"})
        if (words.find(said) != std::string::npos) return true;
    return false;
}

bool is_level_number(const NcFile& file, const NcVariable& v) {
    const std::string words = words_of(v), units = v.text("units");
    if (words.find("generalized") != std::string::npos) return true;
    if (v.text("standard_name") == "model_level_number") return true;
    const bool bare = units.empty() || units == "1" || units == "level" || units == "layer";
    const std::uint64_t n = whole_block(file.head(), v).values();
    if (!bare || v.dimensions.size() != 1 || n == 0 || n > 10'000) return false;
    std::vector<double> values(std::size_t(n), 0.0);
    if (!read_unpacked(file, v, whole_block(file.head(), v), {values.data(), values.size()}))
        return false;
    const bool falls = values.front() > values.back();
    const double first = falls ? values.back() : values.front();
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[falls ? values.size() - 1 - i : i] != first + double(i)) return false;
    return first == 0 || first == 1;
}

const char* role_key(Role role) { return kKeys[std::size_t(role)]; }

Status find_water(const NcFile& file, const WeatherSettings& settings, const NcVariable*& water) {
    const Search search(file, settings);
    std::vector<const NcVariable*> found;
    const WeatherName* row = nullptr;
    for (const Role role : {Role::kShown, Role::kLiquid, Role::kIce}) {
        PILEUS_TRY(search.parts(role, nullptr, found, row));
        if (found.empty()) continue;
        water = found[0];
        return Status::ok();
    }
    return Status::bad_input(file.name() +
                             ": liquid: no variable of cloud water, nothing, allowed: one with a "
                             "standard_name or name of docs/weather.md, or the keys liquid and "
                             "ice of the density");
}

Status find_fields(const NcFile& file, const WeatherSettings& settings, const WeatherAxes& axes,
                   WeatherFields& fields) {
    const Search search(file, settings);
    for (std::size_t i = 0; i < std::size_t(Role::kCount); ++i)
        PILEUS_TRY(search.field(Role(i), axes, fields.of[i]));
    return Status::ok();
}

}  // namespace pileus
