// SPDX-License-Identifier: Apache-2.0
// See les_head.h.
#include "src/io/volumes/les_head.h"

#include <algorithm>
#include <string_view>

#include "src/io/volumes/volume_file.h"

namespace pileus {

namespace {

constexpr std::size_t kMaxColumns = 64, kLongestName = 40;

}  // namespace

/// Goes to where the next field begins.
Status LesText::open_field(Fields& fields, const std::string& key) const {
    skip(fields.range);
    if (commas_ && !fields.first && fields.range.at < fields.range.end) {
        if (text_[fields.range.at] != ',')
            return fault(fields.range.at, key + ": not parted by a comma, " +
                                              token(fields.range.at, fields.range.end));
        ++fields.range.at;
        skip(fields.range);
    }
    fields.first = false;
    if (fields.range.at >= fields.range.end)
        return fault(fields.range.at, key + ": missing, the line ends");
    return Status::ok();
}

Status LesText::bounded(Fields& fields, const std::string& key, double low, double high,
                        const char* allowed, double& value) const {
    PILEUS_TRY(open_field(fields, key));
    return number_in(fields, key, low, high, allowed, value);
}

Status LesText::number_in(Fields& fields, const std::string& key, double low, double high,
                          const char* allowed, double& value) const {
    const TextRange at = fields.range;
    PILEUS_TRY(number(fields.range, key, value));
    if (value >= low && value <= high) return Status::ok();
    return fault(at.at, key + ": out of range, " + token(at.at, at.end) + ", allowed: " + allowed);
}

Status LesText::close(Fields& fields, const std::string& what) const {
    skip(fields.range);
    if (fields.range.at >= fields.range.end) return Status::ok();
    return fault(fields.range.at,
                 what + ": more values than expected, " + token(fields.range.at, fields.range.end));
}

Status LesText::head_line(TextRange& rest, const char* what, Fields& fields) const {
    fields = Fields();
    if (next_line(rest, fields.range)) return Status::ok();
    return fault(text_.size, std::string(what) + ": missing, the text ends");
}

Status LesText::levels(Fields& fields, LesHead& head) const {
    const std::size_t count = std::size_t(head.size[2]);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string key = "level " + std::to_string(i);
        double km = 0;
        PILEUS_TRY(open_field(fields, key));
        const std::size_t at = fields.range.at;
        PILEUS_TRY(number_in(fields, key, -1000, 1000, "-1000 to 1000 km", km));
        if (i > 0 && !(1000 * km > head.levels_m.back()))
            return fault(at, key + ": not above the one before, allowed: ascending");
        head.levels_m.push_back(1000 * km);
    }
    return close(fields, "levels, " + std::to_string(count) + " as nz says");
}

/// SHDOM's head goes on with a temperature for each level, which says nothing about water.
Status LesText::temperatures(TextRange& rest, const LesHead& head) const {
    Fields fields;
    PILEUS_TRY(head_line(rest, "temperatures", fields));
    for (std::int64_t i = 0; i < head.size[2]; ++i) {
        double kelvin = 0;
        PILEUS_TRY(
            bounded(fields, "temperature " + std::to_string(i), 0, 1000, "0 to 1000 K", kelvin));
    }
    return close(fields, "temperatures, " + std::to_string(head.size[2]) + " as nz says");
}

/// Columns in any order; those of other names are passed over, and said to be.
Status LesText::column_names(TextRange& rest, LesHead& head) const {
    static const char* const known[kLesNeeded][2] = {
        {"i", "x"}, {"j", "y"}, {"k", "z"}, {"lwc", "lwc"}, {"reff", "reff"}};
    Fields fields;
    PILEUS_TRY(head_line(rest, "names of the columns", fields));
    bool given[kLesNeeded] = {};
    head.columns.clear();
    head.passed.clear();
    const std::size_t begin = fields.range.at;
    for (std::size_t at = begin; at <= fields.range.end; ++at) {
        std::string name;
        const std::size_t name_at = at;
        for (; at < fields.range.end && text_[at] != ','; ++at)
            if (!is_text_space(text_[at]) && text_[at] != '"' && name.size() < kLongestName)
                name +=
                    text_[at] >= 'A' && text_[at] <= 'Z' ? char(text_[at] - 'A' + 'a') : text_[at];
        LesColumn column = kLesPassed;
        for (std::size_t c = 0; c < kLesNeeded; ++c)
            if (name == known[c][0] || name == known[c][1]) column = LesColumn(c);
        if (column != kLesPassed && given[column])
            return fault(name_at, "names of the columns: " + name + " given twice, allowed: once");
        if (head.columns.size() == kMaxColumns)
            return fault(name_at, "names of the columns: too many, allowed: up to " +
                                      std::to_string(kMaxColumns));
        if (column != kLesPassed)
            given[column] = true;
        else
            head.passed += (head.passed.empty() ? "" : ", ") + printable_line(name);
        head.columns.push_back(column);
    }
    for (std::size_t c = 0; c < kLesNeeded; ++c)
        if (!given[c])
            return fault(begin,
                         std::string("names of the columns: no ") + known[c][0] + " among " +
                             std::string(text_.data + begin,
                                         std::min<std::size_t>(fields.range.end - begin, 200)) +
                             ", allowed: i,j,k,lwc,reff or x,y,z,lwc,reff, and others");
    return Status::ok();
}

Status LesText::head(LesHead& head) const {
    static const char* const sides[3] = {"nx", "ny", "nz"};
    static const char* const steps[2] = {"dx", "dy"};
    TextRange rest{0, text_.size};
    Fields fields;
    PILEUS_TRY(head_line(rest, "nx, ny, nz", fields));
    // "2 parameter LWC file" opens SHDOM's own files of this kind.
    const std::string_view title(text_.data + fields.range.at, fields.range.end - fields.range.at);
    head.shdom = title.find("parameter LWC file") != std::string_view::npos;
    if (head.shdom) PILEUS_TRY(head_line(rest, "nx, ny, nz", fields));
    for (std::size_t i = 0; i < 3; ++i) {
        Status status = field(fields, sides[i], head.size[i]);
        if (!status) status.message += ", allowed: LES text begins with the sizes nx ny nz";
        PILEUS_TRY(status);
    }
    PILEUS_TRY(close(fields, "nx, ny, nz"));
    PILEUS_TRY(check_volume_size(file_, head.size));

    // Lengths are kilometres; a step of 0 has no cells.
    PILEUS_TRY(head_line(rest, "dx, dy", fields));
    for (std::size_t i = 0; i < 2; ++i) {
        PILEUS_TRY(bounded(fields, steps[i], 1e-6, 100, "1e-6 to 100 km", head.step_m[i]));
        head.step_m[i] *= 1000;
    }
    head.commas = commas_;
    if (commas_ || head.shdom) {
        PILEUS_TRY(close(fields, "dx, dy"));
        PILEUS_TRY(head_line(rest, "levels", fields));
    }
    PILEUS_TRY(levels(fields, head));
    if (head.shdom) PILEUS_TRY(temperatures(rest, head));
    head.columns = {kLesI, kLesJ, kLesK, kLesLwc, kLesReff};
    if (commas_) PILEUS_TRY(column_names(rest, head));
    head.rows = rest;
    if (head.size[2] < 2) return Status::ok();
    head.stack = stack_of_levels(head.levels_m);
    return check_volume_size(file_ + ": levels laid on equal layers of the thinnest",
                             {head.size[0], head.size[1], head.stack.layers});
}

namespace {

/// Whether the first line that says something holds a comma.
bool has_commas(const std::string& name, Span<const char> text) {
    // The scan's own text, which may be shorter by a second mark.
    const TextScan scan(name, text);
    TextRange rest = scan.whole(), line;
    return scan.next_line(rest, line) && scan.holds(line, ',');
}

}  // namespace

Status read_les_text_head(const std::string& name, Span<const char> text, LesHead& head) {
    head = LesHead();
    return LesText(name, text, has_commas(name, text)).head(head);
}

}  // namespace pileus
