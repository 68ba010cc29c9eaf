// SPDX-License-Identifier: Apache-2.0
// Reads a density grid in pbrt's text form, trusting nothing in it.
// in: Volume "volumegrid" and its parameters in any order -> out: a Volume in file order.
// pbrt-v2 file format: "volumegrid"; docs/formats.md
#include "src/base/file.h"
#include "src/io/text/text_scan.h"
#include "src/io/volumes/undershoot.h"
#include "src/io/volumes/volume_file.h"

namespace pileus {

namespace {

using Range = TextRange;

/// What the parameters said; the list of densities is only found, not yet read.
struct PbrtGrid {
    std::array<std::int64_t, 3> size{-1, -1, -1};
    std::array<Double3, 2> points{};
    std::array<bool, 2> has_point{false, false};
    Range density;
    bool has_density = false;

    bool knows_all_but_density() const {
        return size[0] > 0 && size[1] > 0 && size[2] > 0 && has_point[0] && has_point[1];
    }
};

class Reader : private TextScan {
public:
    Reader(const std::string& file, Span<const char> text) : TextScan(file, text) {}

    /// `head_only`: ends at the densities once size and place are known.
    Status parameters(bool head_only, PbrtGrid& grid);
    Status densities(const PbrtGrid& grid, Volume& volume);

private:
    Status quoted(Range& range, const char* what, std::string& word) const;
    Status values(Range& range, const std::string& key, Range& list) const;
    Status single(Range list, const std::string& key, std::int64_t& value) const;
    Status point(Range list, const std::string& key, Double3& value) const;
    Status parameter(const std::string& key, std::size_t at, Range list, PbrtGrid& grid) const;
    Status check(const PbrtGrid& grid) const;
    Status wrong_count(const PbrtGrid& grid, std::uint64_t count) const;
};

Status Reader::quoted(Range& range, const char* what, std::string& word) const {
    const std::size_t begin = range.at;
    std::size_t end = begin + 1;
    if (begin < range.end && text_[begin] == '"')
        while (end < range.end && text_[end] != '"' && text_[end] != '\n') ++end;
    if (end >= range.end || text_[begin] != '"' || text_[end] != '"')
        return fault(begin, std::string(what) + ": not found, " + token(begin, range.end) +
                                ", allowed: a word in double quotes");
    word.assign(text_.data + begin + 1, end - begin - 1);
    range.at = end + 1;
    return Status::ok();
}

/// Finds the bytes of one value or of a bracketed list, and passes them.
Status Reader::values(Range& range, const std::string& key, Range& list) const {
    skip(range);
    const std::size_t begin = range.at;
    if (begin >= range.end) return fault(begin, key + ": value missing");
    if (text_[begin] != '[') {
        list.at = begin;
        std::string word;
        if (text_[begin] == '"') {
            PILEUS_TRY(quoted(range, key.c_str(), word));
        } else {
            while (range.at < range.end && !is_text_space(text_[range.at]) &&
                   text_[range.at] != '"')
                ++range.at;
        }
        list.end = range.at;
        return Status::ok();
    }
    list.at = ++range.at;
    for (skip(range); range.at < range.end && text_[range.at] != ']'; skip(range)) {
        std::string word;
        if (text_[range.at] == '"')
            PILEUS_TRY(quoted(range, key.c_str(), word));
        else
            ++range.at;
    }
    if (range.at >= range.end)
        return fault(begin, key + ": list not closed before the end of the text, allowed: [ ... ]");
    list.end = range.at++;
    return Status::ok();
}

Status Reader::single(Range list, const std::string& key, std::int64_t& value) const {
    skip(list);
    const std::size_t at = list.at;
    PILEUS_TRY(number(list, key, value));
    skip(list);
    if (list.at < list.end) return fault(list.at, key + ": more than one value");
    if (value < 1 || value > kMaxVolumeSide)
        return fault(at, key + ": out of range, " + std::to_string(value) + ", allowed: 1 to " +
                             std::to_string(kMaxVolumeSide));
    return Status::ok();
}

Status Reader::point(Range list, const std::string& key, Double3& value) const {
    for (int a = 0; a < 3; ++a) {
        double& coordinate = value[a];
        skip(list);
        const std::size_t at = list.at;
        PILEUS_TRY(number(list, key, coordinate));
        if (!(coordinate >= -1e12 && coordinate <= 1e12))
            return fault(
                at, key + ": out of range, " + token(at, list.end) + ", allowed: -1e12 to 1e12");
    }
    skip(list);
    if (list.at < list.end) return fault(list.at, key + ": more than three values");
    return Status::ok();
}

Status Reader::parameter(const std::string& key, std::size_t at, Range list, PbrtGrid& grid) const {
    static const char* const sides[3] = {"integer nx", "integer ny", "integer nz"};
    static const char* const points[2] = {"point p0", "point p1"};
    const std::string twice = key + ": given twice, allowed: once";
    for (std::size_t i = 0; i < 3; ++i)
        if (key == sides[i]) {
            if (grid.size[i] >= 0) return fault(at, twice);
            return single(list, key, grid.size[i]);
        }
    for (std::size_t i = 0; i < 2; ++i)
        if (key == points[i]) {
            if (grid.has_point[i]) return fault(at, twice);
            grid.has_point[i] = true;
            return point(list, key, grid.points[i]);
        }
    if (key == "float density") {
        if (grid.has_density) return fault(at, twice);
        grid.has_density = true;
        grid.density = list;
        return Status::ok();
    }
    // Refuse a wrong type for a name that matters, and pass parameters of other meaning.
    static const char* const names[6] = {" nx", " ny", " nz", " p0", " p1", " density"};
    const std::size_t blank = key.rfind(' ');
    for (const char* name : names)
        if (blank != std::string::npos && key.compare(blank, std::string::npos, name) == 0)
            return fault(at, key + ": wrong type, allowed: integer for nx, ny, nz, point for p0 " +
                                 "and p1, float for density");
    return Status::ok();
}

Status Reader::parameters(bool head_only, PbrtGrid& grid) {
    Range range{0, text_.size};
    skip(range);
    const std::string directive = token(range.at, range.end);
    if (directive != "Volume")
        return fault(range.at, "directive: unknown, " + directive + ", allowed: Volume");
    range.at += directive.size();
    skip(range);
    const std::size_t kind_at = range.at;
    std::string word;
    PILEUS_TRY(quoted(range, "kind of volume", word));
    if (word != "volumegrid")
        return fault(kind_at, "kind of volume: unknown, " + token(kind_at, range.end) +
                                  ", allowed: \"volumegrid\"");
    for (skip(range); range.at < range.end; skip(range)) {
        const std::size_t at = range.at;
        PILEUS_TRY(quoted(range, "parameter", word));
        if (head_only && word == "float density" && grid.knows_all_but_density()) {
            grid.has_density = true;
            break;
        }
        Range list;
        PILEUS_TRY(values(range, word, list));
        PILEUS_TRY(parameter(word, at, list, grid));
    }
    return check(grid);
}

/// Whether all that is needed is there, and whether the text can hold that many values at all.
Status Reader::check(const PbrtGrid& grid) const {
    static const char* const sides[3] = {"integer nx", "integer ny", "integer nz"};
    for (std::size_t i = 0; i < 3; ++i)
        if (grid.size[i] < 0) return fault(text_.size, std::string(sides[i]) + ": missing");
    if (!grid.has_density) return fault(text_.size, "float density: missing");
    if (grid.has_point[0] != grid.has_point[1])
        return fault(text_.size, "point p0, point p1: one is missing, allowed: both or neither");
    for (std::size_t i = 0; i < 3 && grid.has_point[0]; ++i)
        if (!(grid.points[0][i] < grid.points[1][i]))
            return fault(text_.size, "point p1: not above p0 on axis " + std::to_string(i) +
                                         ", allowed: p0 < p1 on every axis");
    return check_volume_size(file_, grid.size);
}

Status Reader::wrong_count(const PbrtGrid& grid, std::uint64_t count) const {
    const auto& n = grid.size;
    return fault(grid.density.at, "float density: wrong number of values, " +
                                      std::to_string(count) + ", allowed: exactly " +
                                      std::to_string(n[0] * n[1] * n[2]) + " = " +
                                      std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
                                      std::to_string(n[2]));
}

Status Reader::densities(const PbrtGrid& grid, Volume& volume) {
    const std::uint64_t wanted = std::uint64_t(grid.size[0] * grid.size[1] * grid.size[2]);
    Range list = grid.density;

    // A value takes a digit and a space at least: never allocate more than the text can fill.
    if (wanted <= (list.end - list.at) / 2 + 1)
        PILEUS_TRY(volume.density.resize(wanted, file_.c_str()));
    const std::uint64_t room = volume.density.size();
    for (std::size_t i = 0; i < 3; ++i) volume.size[i] = int(grid.size[i]);

    std::uint64_t count = 0, lowest = 0;
    std::size_t lowest_at = 0;
    Undershoot undershoot;
    for (skip(list); list.at < list.end; skip(list), ++count) {
        const std::size_t at = list.at;
        float value = 0;
        PILEUS_TRY(number(list, "float density", value));
        if (!(value - value == 0.0f))
            return fault(at, "float density: " + voxel_name(volume.size, count) + ", " +
                                 token(at, list.end) + ", allowed: a finite number >= 0");
        if (undershoot.take(value)) lowest = count, lowest_at = at;
        if (count < room) volume.density.at(std::size_t(count)) = value;
    }
    if (count != wanted) return wrong_count(grid, count);
    if (undershoot.is_fault())
        return fault(lowest_at, "float density: " + voxel_name(volume.size, lowest) + ", " +
                                    undershoot.text());
    volume.missing = volume.clamped = 0;
    undershoot.settle(volume);
    volume.knows_bounds = grid.has_point[0];
    volume.bounds_m = grid.points;
    return Status::ok();
}

}  // namespace

Status decode_pbrt_volume(const std::string& name, Span<const char> text, Volume& volume) {
    volume.density = Buffer<float>();
    volume.in_extinction = false;
    Reader reader(name, text);
    PbrtGrid grid;
    PILEUS_TRY(reader.parameters(false, grid));
    return reader.densities(grid, volume);
}

Status read_pbrt_volume(const std::string& path, Volume& volume) {
    Buffer<char> text;
    PILEUS_TRY(read_whole_file(path, kMaxTextBytes, text));
    return decode_pbrt_volume(path, text.span(), volume);
}

Status read_pbrt_head(const std::string& path, VolumeHead& head) {
    // The parameters mostly stand before the densities; where they do not, read on.
    Buffer<char> text;
    PILEUS_TRY(read_file_start(path, kTextStartBytes, text));
    PbrtGrid grid;
    if (!Reader(path, text.span()).parameters(true, grid) || !grid.knows_all_but_density()) {
        PILEUS_TRY(read_whole_file(path, kMaxTextBytes, text));
        grid = PbrtGrid();
        PILEUS_TRY(Reader(path, text.span()).parameters(false, grid));
    }
    head = VolumeHead();
    for (std::size_t i = 0; i < 3; ++i) head.size[i] = int(grid.size[i]);
    head.knows_bounds = grid.has_point[0];
    head.bounds_m = grid.points;
    head.kind = "pbrt text volume";
    return Status::ok();
}

}  // namespace pileus
