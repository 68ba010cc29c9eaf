// SPDX-License-Identifier: Apache-2.0
// Which member of an ensemble a scene means.
// in: an index, or what the file calls it -> out: the place along the members.
// docs/weather.md, "Dimensions"
#include <algorithm>

#include "src/base/number_text.h"
#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/netcdf/netcdf_values.h"
#include "src/io/volumes/weather/weather_axes.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMaxMembers = 65536;

bool read_number(const std::string& text, double& value) {
    const char* end = text.data() + text.size();
    const auto read = number_from(text.data(), end, value);
    return read.ec == std::errc() && read.ptr == end;
}

/// Names of letters, one for each member.
Status read_names(const NcFile& file, const NcVariable& v, std::vector<std::string>& names) {
    PILEUS_TRY(read_letter_rows(file, v, kMaxMembers, names));
    for (std::string& name : names)
        name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    return Status::ok();
}

/// Numbers or names of all members; none where the file has no coordinate of them, or has one of a
/// type that is not read.
Status member_names(const NcFile& file, std::size_t dimension, std::vector<std::string>& names,
                    bool& unread) {
    const NcHead& head = file.head();
    const std::uint64_t size = head.dimensions[dimension].size;
    names.clear();
    unread = false;
    if (size > kMaxMembers) return Status::ok();
    const auto numbers = coordinates_of(head, dimension, AxisKind::kMember);
    if (!numbers.empty()) {
        std::vector<double> values(std::size_t(size), 0.0);
        PILEUS_TRY(read_unpacked(file, *numbers[0], whole_block(head, *numbers[0]),
                                 {values.data(), values.size()}));
        for (const double value : values)
            names.push_back(value == value ? number_text(value) : std::string());
        return Status::ok();
    }
    for (const NcVariable& v : head.variables) {
        const bool rows = v.type == NcType::kChar && v.dimensions.size() == 2 &&
                          v.dimensions[0] == dimension && v.dimensions[1] != dimension;
        const bool tells = v.name == head.dimensions[dimension].name ||
                           axis_by_attributes(v, false) == AxisKind::kMember ||
                           axis_by_name(v.name) == AxisKind::kMember;
        if (rows && tells && names.empty()) PILEUS_TRY(read_names(file, v, names));
        unread = unread || (tells && v.type == NcType::kOther && v.dimensions.size() == 1 &&
                            v.dimensions[0] == dimension);
    }
    return Status::ok();
}

bool says(const std::string& name, const std::string& wanted) {
    double a = 0, b = 0;
    if (name == wanted) return true;
    return read_number(name, a) && read_number(wanted, b) && a == b;
}

}  // namespace

Status choose_member(const NcFile& file, const WeatherChoice& wanted, WeatherAxes& axes) {
    const std::uint64_t size = file.head().dimensions[axes.member].size;
    std::vector<std::string> names;
    bool unread = false;
    PILEUS_TRY(member_names(file, axes.member, names, unread));
    std::uint64_t index = std::uint64_t(wanted.index), hits = 1;
    double number = -1;
    if (wanted.by_name && !names.empty()) {
        hits = 0;
        for (std::size_t i = 0; i < names.size(); ++i)
            if (says(names[i], wanted.name)) {
                index = i;
                ++hits;
            }
    } else if (wanted.by_name && unread) {
        return Status::bad_input(file.name() + ": member: names of a type that is not read, " +
                                 quote_text(wanted.name) + ", allowed: a whole number, an index");
    } else if (wanted.by_name) {
        // Members without numbers or names count from 0.
        hits = read_number(wanted.name, number) && number >= 0 && number < double(size) &&
               number == double(std::uint64_t(number));
        index = hits > 0 ? std::uint64_t(number) : 0;
    }
    if (hits == 1 && index < size) {
        axes.member_index = index;
        if (index < names.size()) axes.member_text = names[std::size_t(index)];
        return Status::ok();
    }
    std::string allowed = "0 to " + std::to_string(size - 1);
    if (!names.empty()) {
        allowed += ", or as text ";
        for (std::size_t i = 0; i < names.size() && allowed.size() < 120; ++i)
            allowed += (i > 0 ? ", " : "") + names[i];
    }
    return Status::bad_input(
        file.name() + ": member: " +
        printable_line((hits > 1 ? "several in the file, " : "not in the file, ") +
                       (wanted.by_name ? quote_text(wanted.name) : std::to_string(wanted.index)) +
                       ", allowed: " + allowed));
}

}  // namespace pileus
