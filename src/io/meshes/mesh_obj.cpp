// SPDX-License-Identifier: Apache-2.0
// Reads the faces of a Wavefront OBJ file, trusting nothing in it.
// in: lines "v x y z" and "f a b c ...", corners as a, a/t, a//n or a/t/n -> out: triangles.
// Wavefront, "Object files"; all other lines are passed over. docs/solids.md, "Files".
#include <charconv>

#include "src/io/meshes/mesh_file.h"
#include "src/io/text/text_scan.h"

namespace pileus {
namespace {

class Reader : private TextScan {
public:
    Reader(const std::string& file, Span<const char> text) : TextScan(file, text) {}

    Status read(std::uint64_t most_triangles, Mesh& mesh);

private:
    bool opens(TextRange line, char word) const {
        return line.end - line.at > 1 && text_[line.at] == word &&
               is_text_space(text_[line.at + 1]);
    }
    std::uint64_t words(TextRange line) const;
    Status vertex(TextRange line, Span<double> to) const;
    Status corner(TextRange& line, std::uint64_t vertices, std::uint64_t& index) const;
    Status face(TextRange line, std::uint64_t vertices, const Buffer<double>& places, Mesh& mesh,
                std::uint64_t& triangles) const;
};

/// Words behind the first one.
std::uint64_t Reader::words(TextRange line) const {
    std::uint64_t count = 0;
    for (std::size_t i = line.at + 1; i < line.end; ++i)
        if (!is_text_space(text_[i]) && is_text_space(text_[i - 1])) ++count;
    return count;
}

Status Reader::vertex(TextRange line, Span<double> to) const {
    ++line.at;
    for (std::size_t a = 0; a < 3; ++a) {
        skip(line);
        const std::size_t begin = line.at;
        PILEUS_TRY(number(line, "v", to[a]));
        if (!(to[a] >= -kMaxCoordinate && to[a] <= kMaxCoordinate))
            return fault(begin, "v: out of range, " + token(begin, line.end) +
                                    ", allowed: number in [-1e12, 1e12]");
    }
    return Status::ok();
}

/// The vertex of one corner; counted from 1, or backwards from the last one before by a minus.
Status Reader::corner(TextRange& line, std::uint64_t vertices, std::uint64_t& index) const {
    skip(line);
    const char *begin = text_.data + line.at, *end = text_.data + line.end;
    std::int64_t value = 0;
    const std::from_chars_result read = std::from_chars(begin, end, value);
    const bool whole = read.ptr == end || is_text_space(*read.ptr) || *read.ptr == '/';
    const std::int64_t at = value < 0 ? std::int64_t(vertices) + value : value - 1;
    if (read.ec != std::errc() || !whole || at < 0 || std::uint64_t(at) >= vertices)
        return fault(line.at, "f: no such vertex, " + token(line.at, line.end) +
                                  ", allowed: 1 to " + std::to_string(vertices));
    index = std::uint64_t(at);
    line.at = std::size_t(read.ptr - text_.data);
    while (line.at < line.end && !is_text_space(text_[line.at])) ++line.at;
    return Status::ok();
}

Status Reader::face(TextRange line, std::uint64_t vertices, const Buffer<double>& places,
                    Mesh& mesh, std::uint64_t& triangles) const {
    const std::uint64_t corners = words(line);
    std::uint64_t first = 0, last = 0, next = 0;
    ++line.at;
    for (std::uint64_t i = 0; i < corners; ++i, last = next) {
        PILEUS_TRY(corner(line, vertices, next));
        if (i == 0) first = next;
        if (i < 2) continue;
        double* to = mesh.corners.span().part(std::size_t(9 * triangles++), 9).data;
        for (std::uint64_t v : {first, last, next})
            for (std::size_t a = 0; a < 3; ++a) *to++ = places.at(std::size_t(3 * v) + a);
    }
    return Status::ok();
}

Status Reader::read(std::uint64_t most_triangles, Mesh& mesh) {
    // Count first, so that memory is taken once.
    std::uint64_t vertices = 0, triangles = 0;
    TextRange rest{0, text_.size}, line;
    while (next_line(rest, line)) {
        if (opens(line, 'v')) ++vertices;
        if (!opens(line, 'f')) continue;
        const std::uint64_t corners = words(line);
        if (corners < 3)
            return fault(line.at,
                         "f: too few corners, " + std::to_string(corners) + ", allowed: 3 or more");
        triangles += corners - 2;
    }
    PILEUS_TRY(check_triangles(file_, triangles, most_triangles));
    Buffer<double> places;
    PILEUS_TRY(places.resize(3 * vertices, "vertices"));
    PILEUS_TRY(mesh.corners.resize(9 * triangles, "mesh"));
    std::uint64_t known = 0, made = 0;
    rest = {0, text_.size};
    while (next_line(rest, line)) {
        if (opens(line, 'v'))
            PILEUS_TRY(vertex(line, places.span().part(std::size_t(3 * known++), 3)));
        if (opens(line, 'f')) PILEUS_TRY(face(line, known, places, mesh, made));
    }
    return Status::ok();
}

}  // namespace

Status decode_obj(const std::string& name, Span<const char> bytes, std::uint64_t most_triangles,
                  Mesh& mesh) {
    return Reader(name, bytes).read(most_triangles, mesh);
}

}  // namespace pileus
