// SPDX-License-Identifier: Apache-2.0
// Reads liquid water and droplet size as text, trusting nothing in it.
// in: head lines and rows `i j k lwc reff ...` -> out: extinction in 1/m, x fastest.
// Forms: AT3D's and I3RC's columns with names and commas; pySHDOM's, and SHDOM's own, with blanks.
// docs/formats.md

#include "src/base/file.h"
#include "src/io/volumes/les_head.h"
#include "src/io/volumes/undershoot.h"
#include "src/io/volumes/volume_file.h"

namespace pileus {

namespace {

constexpr double kMaxExtinction = 1e12;  // 1/m, as for the key extinction_per_m

// Rows take ten bytes at least, so a sparse cloud may still fill one voxel in ten thousand.
constexpr std::uint64_t kVoxelsPerByte = 1024, kVoxelsAlways = std::uint64_t{1} << 20;

class Reader : private LesText {
public:
    Reader(const std::string& name, Span<const char> text, const LesHead& head)
        : LesText(name, text, head.commas), head_(head) {}

    Status rows(Volume& volume);

private:
    Status index(Fields& fields, LesColumn axis, std::uint64_t& place) const;
    Status row(Fields fields, std::uint64_t number, Volume& volume);
    Status extinction(double lwc, double radius, std::size_t reff_at, float& value) const;
    Status pass(Fields& fields) const;
    Status check_room() const;
    Status check_end(std::uint64_t rows, std::uint64_t cells) const;

    const LesHead& head_;
    Undershoot undershoot_;
    std::size_t lowest_at_ = 0;
    bool dry_ = false;                 ///< a row without water
    bool in_order_[2] = {true, true};  ///< rows for each voxel in turn, x or z fastest
};

/// Extinction of spheres much larger than the wavelength: 3 LWC / (2 rho_water r_eff).
Status Reader::extinction(double lwc, double radius, std::size_t reff_at, float& value) const {
    if (lwc > 0 && radius == 0)
        return fault(reff_at, "reff: must not be 0, " + token(reff_at, text_.size) +
                                  ", allowed: above 0 um where lwc is above 0");
    // Where there is no water, its size does not matter.
    const double kappa = lwc > 0 ? 1.5 * lwc / radius : radius > 1 ? 1.5 * lwc / radius : 1.5 * lwc;
    if (kappa > kMaxExtinction)
        return fault(reff_at, "reff: too small for this lwc, " + token(reff_at, text_.size) +
                                  ", allowed: an extinction of at most 1e12 per m");
    value = float(kappa);
    return Status::ok();
}

/// Passes a field whatever it holds, or nothing.
Status Reader::pass(Fields& fields) const {
    TextRange& range = fields.range;
    skip(range);
    if (!fields.first) {
        if (range.at >= range.end || text_[range.at] != ',')
            return fault(range.at, "column: missing, allowed: one for each name");
        ++range.at;
    }
    fields.first = false;
    while (range.at < range.end && text_[range.at] != ',') ++range.at;
    return Status::ok();
}

Status Reader::index(Fields& fields, LesColumn axis, std::uint64_t& place) const {
    static const char* const names[3] = {"i", "j", "k"};
    const std::size_t at = fields.range.at;
    const std::int64_t first = head_.shdom ? 1 : 0, size = head_.size[axis];
    std::int64_t index = 0;
    PILEUS_TRY(number(fields.range, names[axis], index));
    if (index < first || index >= size + first)
        return fault(at, std::string(names[axis]) + ": out of range, " + std::to_string(index) +
                             ", allowed: " + std::to_string(first) + " to " +
                             std::to_string(size + first - 1));
    place = std::uint64_t(index - first);
    return Status::ok();
}

Status Reader::row(Fields fields, std::uint64_t number, Volume& volume) {
    static const char* const names[kLesNeeded] = {"i", "j", "k", "lwc", "reff"};
    const std::size_t begin = fields.range.at;
    std::uint64_t place[3] = {};
    std::size_t lwc_at = begin, reff_at = begin;
    double lwc = 0, radius = 0, width = 0;
    for (const LesColumn column : head_.columns) {
        if (column == kLesPassed) {
            PILEUS_TRY(pass(fields));
            continue;
        }
        PILEUS_TRY(open_field(fields, names[column]));
        if (column == kLesLwc) lwc_at = fields.range.at;
        if (column == kLesReff) reff_at = fields.range.at;
        if (column <= kLesK)
            PILEUS_TRY(index(fields, column, place[column]));
        else if (column == kLesLwc)
            PILEUS_TRY(
                number_in(fields, "lwc", -kMaxExtinction, kMaxExtinction, "0 to 1e12 g/m3", lwc));
        else
            PILEUS_TRY(number_in(fields, "reff", 0, kMaxExtinction, "0 to 1e12 um", radius));
    }
    // pySHDOM's sixth column is the width of the distribution of sizes: extinction has none of it.
    skip(fields.range);
    if (!commas_ && fields.range.at < fields.range.end)
        PILEUS_TRY(bounded(fields, "veff", 0, kMaxExtinction, "0 to 1e12", width));
    PILEUS_TRY(close(fields, "row"));
    float value = 0;
    PILEUS_TRY(extinction(lwc, radius, reff_at, value));
    if (undershoot_.take(value)) lowest_at_ = lwc_at;

    const std::uint64_t nx = std::uint64_t(head_.size[0]), ny = std::uint64_t(head_.size[1]),
                        nz = std::uint64_t(head_.size[2]);
    const std::uint64_t index = (place[2] * ny + place[1]) * nx + place[0];
    dry_ = dry_ || lwc == 0;
    in_order_[0] = in_order_[0] && index == number;
    in_order_[1] = in_order_[1] && (place[0] * ny + place[1]) * nz + place[2] == number;
    float& voxel = volume.density.at(std::size_t(index));
    if (voxel >= 0)
        return fault(begin,
                     "row: given twice, " + voxel_name(volume.size, index) + ", allowed: once");
    voxel = value;
    return Status::ok();
}

/// Never take more memory than a text of this length can mean.
Status Reader::check_room() const {
    const std::uint64_t columns = std::uint64_t(head_.size[0] * head_.size[1]);
    const std::uint64_t cells = columns * std::uint64_t(head_.size[2]);
    const std::uint64_t laid = columns * std::uint64_t(head_.stack.layers);
    const std::uint64_t bytes = head_.rows.end - head_.rows.at;
    const std::uint64_t most = kVoxelsAlways + kVoxelsPerByte * bytes;
    if (cells <= most && laid <= most) return Status::ok();
    return Status::limit(file_ + ": size: too many voxels for so short a text, " +
                         std::to_string(cells > laid ? cells : laid) + ", allowed: at most " +
                         std::to_string(most));
}

/// Rows that are absent hold no water. But a text that begins with a row for each voxel in turn,
/// dry ones too, and then ends, has lost the others.
Status Reader::check_end(std::uint64_t rows, std::uint64_t cells) const {
    if (!dry_ || rows == cells || !(in_order_[0] || in_order_[1])) return Status::ok();
    return fault(text_.size, "rows: the text ends after " + std::to_string(rows) + " of " +
                                 std::to_string(cells) +
                                 " voxels, allowed: all of them in turn, or those with water");
}

Status Reader::rows(Volume& volume) {
    PILEUS_TRY(check_room());
    for (std::size_t i = 0; i < 3; ++i) volume.size[i] = int(head_.size[i]);
    const std::uint64_t cells =
        std::uint64_t(head_.size[0]) * std::uint64_t(head_.size[1] * head_.size[2]);
    PILEUS_TRY(volume.density.resize(cells, file_.c_str()));

    // A negative value marks a voxel that no row has named yet.
    for (float& value : volume.density.span()) value = -1;
    TextRange rest = head_.rows;
    Fields fields;
    std::uint64_t count = 0;
    for (; next_line(rest, fields.range); ++count) PILEUS_TRY(row(fields, count, volume));
    PILEUS_TRY(check_end(count, cells));
    if (undershoot_.is_fault())
        return fault(lowest_at_, "lwc: out of range, " + token(lowest_at_, text_.size) +
                                     " g/m3, an extinction of " + undershoot_.text());
    volume.missing = volume.clamped = 0;
    undershoot_.settle(volume);
    for (float& value : volume.density.span())
        if (value < 0) value = 0;
    return Status::ok();
}

/// Where the grid lies once its levels are equal layers.
void set_place(const LesHead& head, std::array<int, 3>& size, bool& knows_bounds,
               std::array<Double3, 2>& bounds_m) {
    size = {int(head.size[0]), int(head.size[1]), int(head.size[2])};
    bounds_m = {};
    knows_bounds = head.size[2] > 1;
    if (!knows_bounds) return;
    size[2] = head.stack.layers;
    bounds_m[0][2] = head.stack.faces_m.front();
    bounds_m[1] = {head.step_m[0] * size[0], head.step_m[1] * size[1], head.stack.faces_m.back()};
}

}  // namespace

Status decode_les_volume(const std::string& name, Span<const char> bytes, Volume& volume) {
    const Span<const char> text = without_mark(bytes);
    volume.density = Buffer<float>();
    LesHead head;
    PILEUS_TRY(read_les_text_head(name, text, head));
    PILEUS_TRY(Reader(name, text, head).rows(volume));
    if (head.size[2] > 1 && !head.stack.even) PILEUS_TRY(lay_on_even_layers(head.stack, volume));
    set_place(head, volume.size, volume.knows_bounds, volume.bounds_m);
    volume.in_extinction = true;
    return Status::ok();
}

Status read_les_volume(const std::string& path, Volume& volume) {
    Buffer<char> text;
    PILEUS_TRY(read_whole_file(path, kMaxTextBytes, text));
    return decode_les_volume(path, text.span(), volume);
}

Status read_les_head(const std::string& path, VolumeHead& head) {
    // A head line that the start of the file cuts off has no end there: then read all of it.
    Buffer<char> bytes;
    LesHead text;
    PILEUS_TRY(read_file_start(path, kTextStartBytes, bytes));
    const Span<const char> start = without_mark(bytes.span());
    if (!read_les_text_head(path, start, text) || text.rows.at == start.size) {
        PILEUS_TRY(read_whole_file(path, kMaxTextBytes, bytes));
        PILEUS_TRY(read_les_text_head(path, without_mark(bytes.span()), text));
    }
    head = VolumeHead();
    set_place(text, head.size, head.knows_bounds, head.bounds_m);
    head.in_extinction = true;
    head.kind = text.commas  ? "LES text, columns with names"
                : text.shdom ? "LES text, as SHDOM's own"
                             : "LES text, columns without names";
    if (text.size[2] < 2)
        head.detail = "one level, so its thickness is not known";
    else if (!text.stack.even)
        head.detail = std::to_string(text.size[2]) + " stretched levels laid on equal layers";
    if (!text.passed.empty())
        head.detail += (head.detail.empty() ? "" : "; ") + ("columns not used: " + text.passed);
    return Status::ok();
}

}  // namespace pileus
