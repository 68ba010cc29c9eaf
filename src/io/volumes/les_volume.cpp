// SPDX-License-Identifier: Apache-2.0
// Reads liquid water and droplet size as text, trusting nothing in it.
// in: head lines and rows `i j k lwc reff` -> out: extinction in 1/m, x fastest.
// docs/formats.md

#include "src/base/file.h"
#include "src/io/text/text_scan.h"
#include "src/io/volumes/les_layers.h"
#include "src/io/volumes/volume_file.h"

namespace pileus {

namespace {

constexpr double kMaxExtinction = 1e12;  // 1/m, as for the key extinction_per_m

// Rows take ten bytes at least, so a sparse cloud may still fill one voxel in ten thousand.
constexpr std::uint64_t kVoxelsPerByte = 1024, kVoxelsAlways = std::uint64_t{1} << 20;

struct Header {
    bool sparse = false;
    std::array<std::int64_t, 3> size{0, 0, 0};
    std::array<double, 2> step_m{0, 0};  ///< along x and y
    std::vector<double> levels_m;        ///< cell centres, ascending
    LayerStack stack;                    ///< of two levels or more
    TextRange rows;                      ///< what follows the head
};

class Reader : private TextScan {
public:
    Reader(const std::string& name, Span<const char> text, bool commas)
        : TextScan(name, text, commas ? ',' : ' '), commas_(commas) {}

    Status header(Header& header) const;
    Status rows(const Header& header, Volume& volume) const;

private:
    /// Fields of one line, in turn.
    struct Fields {
        TextRange range;
        bool first = true;
    };

    Status open_field(Fields& fields, const std::string& key) const;
    template <class Number>
    Status field(Fields& fields, const std::string& key, Number& value) const;
    Status bounded(Fields& fields, const std::string& key, double low, double high,
                   const char* allowed, double& value) const;
    Status number_in(Fields& fields, const std::string& key, double low, double high,
                     const char* allowed, double& value) const;
    Status close(Fields& fields, const std::string& what) const;
    Status head_line(TextRange& rest, const char* what, Fields& fields) const;
    Status levels(Fields& fields, Header& header) const;
    Status column_names(TextRange& rest) const;
    Status row(Fields fields, const Header& header, Volume& volume) const;
    Status extinction(Fields& fields, float& value) const;
    Status check_room(const Header& header) const;

    bool commas_;
};

/// Goes to where the next field begins.
Status Reader::open_field(Fields& fields, const std::string& key) const {
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

template <class Number>
Status Reader::field(Fields& fields, const std::string& key, Number& value) const {
    PILEUS_TRY(open_field(fields, key));
    return number(fields.range, key, value);
}

Status Reader::bounded(Fields& fields, const std::string& key, double low, double high,
                       const char* allowed, double& value) const {
    PILEUS_TRY(open_field(fields, key));
    return number_in(fields, key, low, high, allowed, value);
}

Status Reader::number_in(Fields& fields, const std::string& key, double low, double high,
                         const char* allowed, double& value) const {
    const TextRange at = fields.range;
    PILEUS_TRY(number(fields.range, key, value));
    if (value >= low && value <= high) return Status::ok();
    return fault(at.at, key + ": out of range, " + token(at.at, at.end) + ", allowed: " + allowed);
}

Status Reader::close(Fields& fields, const std::string& what) const {
    skip(fields.range);
    if (fields.range.at >= fields.range.end) return Status::ok();
    return fault(fields.range.at,
                 what + ": more values than expected, " + token(fields.range.at, fields.range.end));
}

Status Reader::head_line(TextRange& rest, const char* what, Fields& fields) const {
    fields = Fields();
    if (next_line(rest, fields.range)) return Status::ok();
    return fault(text_.size, std::string(what) + ": missing, the text ends");
}

Status Reader::levels(Fields& fields, Header& header) const {
    const std::size_t count = std::size_t(header.size[2]);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string key = "level " + std::to_string(i);
        double km = 0;
        PILEUS_TRY(open_field(fields, key));
        const std::size_t at = fields.range.at;
        PILEUS_TRY(number_in(fields, key, -1000, 1000, "-1000 to 1000 km", km));
        if (i > 0 && !(1000 * km > header.levels_m.back()))
            return fault(at, key + ": not above the one before, allowed: ascending");
        header.levels_m.push_back(1000 * km);
    }
    return close(fields, "levels, " + std::to_string(count) + " as nz says");
}

/// The columns have one order only; another one must not be read as if it were this.
Status Reader::column_names(TextRange& rest) const {
    Fields fields;
    PILEUS_TRY(head_line(rest, "names of the columns", fields));
    std::string names;
    for (std::size_t at = fields.range.at; at < fields.range.end && names.size() < 40; ++at)
        if (!is_text_space(text_[at])) names += text_[at];
    if (names == "i,j,k,lwc,reff" || names == "x,y,z,lwc,reff") return Status::ok();
    return fault(fields.range.at, "names of the columns: unknown, " +
                                      token(fields.range.at, fields.range.end) +
                                      ", allowed: i,j,k,lwc,reff or x,y,z,lwc,reff");
}

Status Reader::header(Header& header) const {
    static const char* const sides[3] = {"nx", "ny", "nz"};
    static const char* const steps[2] = {"dx", "dy"};
    TextRange rest{0, text_.size};
    Fields fields;
    PILEUS_TRY(head_line(rest, "nx, ny, nz", fields));
    for (std::size_t i = 0; i < 3; ++i) {
        Status status = field(fields, sides[i], header.size[i]);
        if (!status) status.message += ", allowed: LES text begins with the sizes nx ny nz";
        PILEUS_TRY(status);
    }
    PILEUS_TRY(close(fields, "nx, ny, nz"));
    PILEUS_TRY(check_volume_size(file_, header.size));

    // Lengths are kilometres; a step of 0 has no cells.
    PILEUS_TRY(head_line(rest, "dx, dy", fields));
    for (std::size_t i = 0; i < 2; ++i) {
        PILEUS_TRY(bounded(fields, steps[i], 1e-6, 100, "1e-6 to 100 km", header.step_m[i]));
        header.step_m[i] *= 1000;
    }
    header.sparse = commas_;
    if (commas_) {
        PILEUS_TRY(close(fields, "dx, dy"));
        PILEUS_TRY(head_line(rest, "levels", fields));
    }
    PILEUS_TRY(levels(fields, header));
    if (commas_) PILEUS_TRY(column_names(rest));
    header.rows = rest;
    if (header.size[2] < 2) return Status::ok();
    header.stack = stack_of_levels(header.levels_m);
    return check_volume_size(file_ + ": levels laid on equal layers of the thinnest",
                             {header.size[0], header.size[1], header.stack.layers});
}

/// Extinction of spheres much larger than the wavelength: 3 LWC / (2 rho_water r_eff).
Status Reader::extinction(Fields& fields, float& value) const {
    double lwc = 0, radius = 0;
    PILEUS_TRY(bounded(fields, "lwc", 0, kMaxExtinction, "0 to 1e12 g/m3", lwc));
    PILEUS_TRY(open_field(fields, "reff"));
    const TextRange at = fields.range;
    PILEUS_TRY(number_in(fields, "reff", 0, kMaxExtinction, "0 to 1e12 um", radius));
    if (lwc > 0 && radius == 0)
        return fault(at.at, "reff: must not be 0, " + token(at.at, at.end) +
                                ", allowed: above 0 um where lwc is above 0");
    const double kappa = lwc > 0 ? 1.5 * lwc / radius : 0;
    if (kappa > kMaxExtinction)
        return fault(at.at, "reff: too small for this lwc, " + token(at.at, at.end) +
                                ", allowed: an extinction of at most 1e12 per m");
    value = float(kappa);
    return Status::ok();
}

Status Reader::row(Fields fields, const Header& header, Volume& volume) const {
    static const char* const names[3] = {"i", "j", "k"};
    const std::size_t begin = fields.range.at;
    std::uint64_t place[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::int64_t index = 0;
        PILEUS_TRY(open_field(fields, names[axis]));
        const std::size_t at = fields.range.at;
        PILEUS_TRY(number(fields.range, names[axis], index));
        if (index < 0 || index >= header.size[axis])
            return fault(at, std::string(names[axis]) + ": out of range, " + std::to_string(index) +
                                 ", allowed: 0 to " + std::to_string(header.size[axis] - 1));
        place[axis] = std::uint64_t(index);
    }
    float value = 0;
    PILEUS_TRY(extinction(fields, value));
    PILEUS_TRY(close(fields, "row"));
    const std::uint64_t nx = std::uint64_t(header.size[0]), ny = std::uint64_t(header.size[1]);
    const std::uint64_t index = (place[2] * ny + place[1]) * nx + place[0];
    float& voxel = volume.density.at(std::size_t(index));
    if (voxel >= 0)
        return fault(begin,
                     "row: given twice, " + voxel_name(volume.size, index) + ", allowed: once");
    voxel = value;
    return Status::ok();
}

/// Never take more memory than a text of this length can mean.
Status Reader::check_room(const Header& header) const {
    const std::uint64_t columns = std::uint64_t(header.size[0] * header.size[1]);
    const std::uint64_t cells = columns * std::uint64_t(header.size[2]);
    const std::uint64_t laid = columns * std::uint64_t(header.stack.layers);
    const std::uint64_t bytes = header.rows.end - header.rows.at;
    constexpr std::uint64_t kLeastRow = 10;  // "0 0 0 0 0\n", the last without its end
    if (!header.sparse && cells > (bytes + 1) / kLeastRow)
        return fault(text_.size, "rows: the text is too short, " + std::to_string(bytes) +
                                     " bytes, allowed: one row for each of " +
                                     std::to_string(cells) + " voxels");
    const std::uint64_t most = kVoxelsAlways + kVoxelsPerByte * bytes;
    if (cells <= most && laid <= most) return Status::ok();
    return Status::limit(file_ + ": size: too many voxels for so short a text, " +
                         std::to_string(cells > laid ? cells : laid) + ", allowed: at most " +
                         std::to_string(most));
}

Status Reader::rows(const Header& header, Volume& volume) const {
    PILEUS_TRY(check_room(header));
    for (std::size_t i = 0; i < 3; ++i) volume.size[i] = int(header.size[i]);
    const std::uint64_t cells =
        std::uint64_t(header.size[0]) * std::uint64_t(header.size[1] * header.size[2]);
    PILEUS_TRY(volume.density.resize(cells, file_.c_str()));

    // A negative value marks a voxel that no row has named yet.
    for (float& value : volume.density.span()) value = -1;
    TextRange rest = header.rows;
    Fields fields;
    while (next_line(rest, fields.range)) PILEUS_TRY(row(fields, header, volume));
    for (std::uint64_t i = 0; i < cells; ++i) {
        float& value = volume.density.at(std::size_t(i));
        if (value >= 0) continue;
        if (!header.sparse)
            return fault(text_.size, "row: missing, " + voxel_name(volume.size, i) +
                                         ", allowed: a row for every voxel");
        value = 0;
    }
    return Status::ok();
}

/// Whether the first line that says something holds a comma.
bool has_commas(const std::string& name, Span<const char> text) {
    TextRange rest{0, text.size}, line;
    if (!TextScan(name, text).next_line(rest, line)) return false;
    for (std::size_t at = line.at; at < line.end; ++at)
        if (text[at] == ',') return true;
    return false;
}

/// Where the grid lies once its levels are equal layers.
void set_place(const Header& header, std::array<int, 3>& size, bool& knows_bounds,
               std::array<Double3, 2>& bounds_m) {
    size = {int(header.size[0]), int(header.size[1]), int(header.size[2])};
    bounds_m = {};
    knows_bounds = header.size[2] > 1;
    if (!knows_bounds) return;
    size[2] = header.stack.layers;
    bounds_m[0][2] = header.stack.faces_m.front();
    bounds_m[1] = {header.step_m[0] * size[0], header.step_m[1] * size[1],
                   header.stack.faces_m.back()};
}

Status read_header(const std::string& name, Span<const char> text, Header& header) {
    header = Header();
    return Reader(name, text, has_commas(name, text)).header(header);
}

}  // namespace

Status decode_les_volume(const std::string& name, Span<const char> text, Volume& volume) {
    volume.density = Buffer<float>();
    Header header;
    PILEUS_TRY(read_header(name, text, header));
    PILEUS_TRY(Reader(name, text, header.sparse).rows(header, volume));
    if (header.size[2] > 1 && !header.stack.even)
        PILEUS_TRY(lay_on_even_layers(header.stack, volume));
    set_place(header, volume.size, volume.knows_bounds, volume.bounds_m);
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
    Buffer<char> text;
    Header header;
    PILEUS_TRY(read_file_start(path, kTextStartBytes, text));
    if (!read_header(path, text.span(), header) || header.rows.at == text.size()) {
        PILEUS_TRY(read_whole_file(path, kMaxTextBytes, text));
        PILEUS_TRY(read_header(path, text.span(), header));
    }
    head = VolumeHead();
    set_place(header, head.size, head.knows_bounds, head.bounds_m);
    head.in_extinction = true;
    head.kind = header.sparse ? "LES text, sparse rows" : "LES text, dense rows";
    if (header.size[2] < 2)
        head.detail = "one level, so its thickness is not known";
    else if (!header.stack.even)
        head.detail = std::to_string(header.size[2]) + " stretched levels laid on equal layers";
    return Status::ok();
}

}  // namespace pileus
