// SPDX-License-Identifier: Apache-2.0
// See weather_hints.h.
#include "src/io/volumes/weather/weather_hints.h"

#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/volumes/weather/weather_axes.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

std::string trimmed(const std::string& text) {
    const std::size_t from = text.find_first_not_of(' ');
    if (from == std::string::npos) return "";
    return text.substr(from, text.find_last_not_of(' ') - from + 1);
}

/// "a: b, c: d"; false where a part has no colon or one side is empty.
bool read_pairs(const std::string& text, Pairs& pairs) {
    pairs.clear();
    std::size_t from = 0;
    while (from <= text.size() && !text.empty()) {
        std::size_t end = text.find(',', from);
        if (end == std::string::npos) end = text.size();
        const std::string part = text.substr(from, end - from);
        const std::size_t colon = part.find(':');
        if (colon == std::string::npos) return false;
        pairs.emplace_back(trimmed(part.substr(0, colon)), trimmed(part.substr(colon + 1)));
        if (pairs.back().first.empty() || pairs.back().second.empty()) return false;
        from = end + 1;
    }
    return true;
}

Status fault(const NcFile& file, const char* key, const std::string& line) {
    return Status::bad_input(file.name() + ": " + key + ": " + printable_line(line));
}

template <class List>
std::string names_of(const List& list) {
    std::string text;
    for (const auto& element : list)
        if (text.size() < 200) text += (text.empty() ? "" : ", ") + element.name;
    return text;
}

}  // namespace

Status check_hints(const NcFile& file, const WeatherSettings& settings) {
    const NcHead& head = file.head();
    Pairs pairs;
    if (!read_pairs(settings.names.axes, pairs))
        return fault(file, "axes",
                     "not understood, " + quote_text(settings.names.axes) +
                         ", allowed: as \"x: ni, y: nj, level: nk\"");
    for (const auto& [axis, name] : pairs) {
        if (axis_named(axis) == AxisKind::kUnknown)
            return fault(file, "axes",
                         "no such axis, " + quote_text(axis) +
                             ", allowed: time, member, level, y, x, column");
        bool found = false;
        for (const NcDimension& d : head.dimensions) found = found || d.name == name;
        if (!found)
            return fault(file, "axes",
                         "no such dimension, " + quote_text(name) +
                             ", allowed: " + names_of(head.dimensions));
    }
    if (!read_pairs(settings.names.units, pairs))
        return fault(file, "units",
                     "not understood, " + quote_text(settings.names.units) +
                         ", allowed: as \"ql: kg kg-1, x: km\"");
    for (const auto& pair : pairs)
        if (head.find(pair.first) == nullptr)
            return fault(file, "units",
                         "no such variable, " + quote_text(pair.first) +
                             ", allowed: " + names_of(head.variables));
    return Status::ok();
}

std::string hinted_axis(const WeatherSettings& settings, const std::string& dimension) {
    Pairs pairs;
    if (settings.names.axes.empty() || !read_pairs(settings.names.axes, pairs)) return "";
    for (const auto& pair : pairs)
        if (pair.second == dimension) return pair.first;
    return "";
}

Status read_unit(const NcFile& file, const WeatherSettings& settings, const NcVariable& variable,
                 std::string& text, bool& there) {
    Pairs pairs;
    there = true;
    if (!settings.names.units.empty() && read_pairs(settings.names.units, pairs))
        for (const auto& pair : pairs)
            if (pair.first == variable.name) {
                text = pair.second;
                return Status::ok();
            }
    there = variable.find("units") != nullptr;
    return read_text(file.name(), variable, "units", text);
}

}  // namespace pileus
