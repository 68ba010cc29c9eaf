// SPDX-License-Identifier: Apache-2.0
// Reads the faces of a PLY file, as text or binary of either byte order, trusting nothing in it.
// in: elements vertex (x, y, z) and face (vertex_indices) among others -> out: triangles.
// Turk 1994, "The PLY polygon file format"; docs/solids.md, "Files".
#include <vector>

#include "src/io/meshes/mesh_file.h"
#include "src/io/text/text_scan.h"

namespace pileus {
namespace {

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble, kNone };

struct TypeName {
    const char *name, *other;
    unsigned bytes;
};
constexpr TypeName kTypes[] = {
    {"char", "int8", 1}, {"uchar", "uint8", 1}, {"short", "int16", 2},   {"ushort", "uint16", 2},
    {"int", "int32", 4}, {"uint", "uint32", 4}, {"float", "float32", 4}, {"double", "float64", 8}};

struct Property {
    std::string name;
    Type type = Type::kNone, count = Type::kNone;  ///< `count` of a list
};
/// Files have two or three kinds of elements, with a name each.
constexpr std::size_t kMostElements = 256;

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

class Reader : private TextScan {
public:
    Reader(const std::string& file, Span<const char> text) : TextScan(file, text) {}

    Status header();
    /// Reads the elements; without `mesh` counts triangles only.
    Status body(std::uint64_t& triangles, Buffer<float>& places, Mesh* mesh);
    std::uint64_t vertices() const;
    const std::string& name() const { return file_; }

private:
    std::string word(TextRange& line) const;
    Status type(TextRange& line, Type& out) const;
    Status format(TextRange line);
    Status check_vertices() const;
    Status element(TextRange line);
    Status property(TextRange line);
    Status value(Type type, double& out);
    Status item(const Element& e, std::uint64_t number, std::uint64_t& triangles,
                Buffer<float>& places, Mesh* mesh);
    Status list(const Property& p, bool faces, std::uint64_t& triangles,
                const Buffer<float>& places, Mesh* mesh);
    Status index(Type type, std::uint64_t count, std::uint64_t& out);

    std::vector<Element> elements_;
    bool binary_ = false, big_ = false;
    std::size_t body_ = 0;
    TextRange rest_;
};

std::string Reader::word(TextRange& line) const {
    while (line.at < line.end && is_text_space(text_[line.at])) ++line.at;
    const std::size_t begin = line.at;
    while (line.at < line.end && !is_text_space(text_[line.at])) ++line.at;
    return std::string(text_.data + begin, line.at - begin);
}

Status Reader::type(TextRange& line, Type& out) const {
    const std::size_t begin = line.at;
    const std::string name = word(line);
    for (std::size_t i = 0; i < sizeof kTypes / sizeof kTypes[0]; ++i)
        if (name == kTypes[i].name || name == kTypes[i].other) {
            out = Type(i);
            return Status::ok();
        }
    return fault(begin, "property: no such type, " + name + ", allowed: char to double");
}

Status Reader::format(TextRange line) {
    const std::string kind = word(line);
    binary_ = kind != "ascii";
    big_ = kind == "binary_big_endian";
    if (!binary_ || big_ || kind == "binary_little_endian") return Status::ok();
    return fault(line.at, "format: unknown, " + kind +
                              ", allowed: ascii, binary_little_endian, binary_big_endian");
}

Status Reader::element(TextRange line) {
    Element e;
    const std::size_t key = line.at;
    e.name = word(line);
    // Two counts of one element would size the same array twice.
    for (const Element& other : elements_)
        if (other.name == e.name)
            return fault(key, "element " + e.name + ": given twice, allowed: once");
    if (elements_.size() == kMostElements)
        return fault(key, "element " + e.name + ": too many elements, allowed: up to " +
                              std::to_string(kMostElements));
    skip(line);
    std::int64_t count = 0;
    const std::size_t begin = line.at;
    PILEUS_TRY(number(line, "element", count));
    // An item is at least a byte.
    if (count < 0 || std::uint64_t(count) > text_.size)
        return fault(begin, "element " + e.name + ": more than the file can hold, " +
                                std::to_string(count) + ", allowed: 0 to " +
                                std::to_string(text_.size));
    e.count = std::uint64_t(count);
    elements_.push_back(e);
    return Status::ok();
}

Status Reader::property(TextRange line) {
    if (elements_.empty()) return fault(line.at, "property: before any element");
    Property p;
    TextRange ahead = line;
    if (word(ahead) == "list") {
        line = ahead;
        PILEUS_TRY(type(line, p.count));
        if (p.count >= Type::kFloat)
            return fault(line.at, "property: a list's length is a whole number");
    }
    PILEUS_TRY(type(line, p.type));
    p.name = word(line);
    elements_.back().properties.push_back(p);
    return Status::ok();
}

Status Reader::header() {
    std::size_t at = 0;
    for (bool first = true;; first = false) {
        TextRange line{at, at};
        while (line.end < text_.size && text_[line.end] != '\n') ++line.end;
        at = line.end + 1;
        if (line.end >= text_.size) return fault(text_.size, "header: no end_header");
        const std::string key = word(line);
        if (first && key != "ply") return fault(0, "header: does not begin with ply");
        if (key == "format") PILEUS_TRY(format(line));
        if (key == "element") PILEUS_TRY(element(line));
        if (key == "property") PILEUS_TRY(property(line));
        if (key == "end_header") break;
    }
    body_ = at;
    return check_vertices();
}

/// A corner without one of its numbers would stand somewhere that no one chose.
Status Reader::check_vertices() const {
    for (const Element& e : elements_)
        for (const char* axis : {"x", "y", "z"}) {
            if (e.name != "vertex" || e.count == 0) continue;
            bool found = false;
            for (const Property& p : e.properties) found |= p.name == axis;
            if (!found)
                return fault(body_, std::string("element vertex: no property ") + axis +
                                        ", allowed: x, y and z");
        }
    return Status::ok();
}

Status Reader::value(Type type, double& out) {
    if (!binary_) {
        while (rest_.at < rest_.end && is_text_space(text_[rest_.at])) ++rest_.at;
        return number(rest_, "value", out);
    }
    const unsigned bytes = kTypes[std::size_t(type)].bytes;
    if (rest_.end - rest_.at < bytes) return fault(rest_.at, "value: the file ends too early");
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < bytes; ++i) {
        const unsigned shift = 8 * (big_ ? bytes - 1 - i : i);
        bits |= std::uint64_t(static_cast<unsigned char>(text_[rest_.at + i])) << shift;
    }
    rest_.at += bytes;
    float single = 0;
    const std::uint32_t low = std::uint32_t(bits);
    switch (type) {
        case Type::kInt8:
            out = double(std::int8_t(bits));
            break;
        case Type::kInt16:
            out = double(std::int16_t(bits));
            break;
        case Type::kInt32:
            out = double(std::int32_t(low));
            break;
        case Type::kFloat:
            std::memcpy(&single, &low, sizeof single);
            out = double(single);
            break;
        case Type::kDouble:
            std::memcpy(&out, &bits, sizeof out);
            break;
        default:
            out = double(bits);
    }
    return Status::ok();
}

/// A whole number below `count`.
Status Reader::index(Type type, std::uint64_t count, std::uint64_t& out) {
    const std::size_t begin = rest_.at;
    double v = 0;
    PILEUS_TRY(value(type, v));
    if (!(v >= 0 && v < double(count)) || v != double(std::uint64_t(v)))
        return fault(begin, "face: no such vertex or length, allowed: 0 to " +
                                std::to_string(count) + ", not included");
    out = std::uint64_t(v);
    return Status::ok();
}

Status Reader::list(const Property& p, bool faces, std::uint64_t& triangles,
                    const Buffer<float>& places, Mesh* mesh) {
    std::uint64_t length = 0, first = 0, last = 0, next = 0;
    PILEUS_TRY(index(p.count, text_.size + 1, length));
    for (std::uint64_t i = 0; i < length; ++i, last = next) {
        double ignored = 0;
        if (!faces) {
            PILEUS_TRY(value(p.type, ignored));
            continue;
        }
        PILEUS_TRY(index(p.type, vertices(), next));
        if (i == 0) first = next;
        if (i < 2) continue;
        if (mesh != nullptr) {
            float* to = mesh->corners.span().part(std::size_t(9 * triangles), 9).data;
            for (std::uint64_t v : {first, last, next})
                for (std::size_t a = 0; a < 3; ++a) *to++ = places.at(std::size_t(3 * v) + a);
        }
        ++triangles;
    }
    return Status::ok();
}

Status Reader::item(const Element& e, std::uint64_t number, std::uint64_t& triangles,
                    Buffer<float>& places, Mesh* mesh) {
    static const char* const axes[3] = {"x", "y", "z"};
    const bool vertex = e.name == "vertex", face = e.name == "face";
    for (const Property& p : e.properties) {
        if (p.count != Type::kNone) {
            const bool corners = p.name == "vertex_indices" || p.name == "vertex_index";
            PILEUS_TRY(list(p, face && corners, triangles, places, mesh));
            continue;
        }
        const std::size_t begin = rest_.at;
        double v = 0;
        PILEUS_TRY(value(p.type, v));
        for (std::size_t a = 0; a < 3 && vertex; ++a) {
            if (p.name != axes[a]) continue;
            if (!(v >= -double(kMostCoordinate) && v <= double(kMostCoordinate)))
                return fault(begin,
                             "vertex: not a number or out of range, allowed: number in "
                             "[-1e12, 1e12]");
            places.at(std::size_t(3 * number) + a) = float(v);
        }
    }
    return Status::ok();
}

Status Reader::body(std::uint64_t& triangles, Buffer<float>& places, Mesh* mesh) {
    triangles = 0;
    rest_ = {body_, text_.size};
    for (const Element& e : elements_) {
        if (e.properties.empty()) continue;
        for (std::uint64_t i = 0; i < e.count; ++i) PILEUS_TRY(item(e, i, triangles, places, mesh));
    }
    return Status::ok();
}

std::uint64_t Reader::vertices() const {
    std::uint64_t count = 0;
    for (const Element& e : elements_)
        if (e.name == "vertex") count = e.count;
    return count;
}

}  // namespace

Status decode_ply(const std::string& name, Span<const char> bytes, std::uint64_t most_triangles,
                  Mesh& mesh) {
    Reader reader(name, bytes);
    PILEUS_TRY(reader.header());
    Buffer<float> places;
    PILEUS_TRY(places.resize(3 * reader.vertices(), "vertices"));
    std::uint64_t triangles = 0;
    PILEUS_TRY(reader.body(triangles, places, nullptr));
    PILEUS_TRY(check_triangles(name, triangles, most_triangles));
    PILEUS_TRY(mesh.corners.resize(9 * triangles, "mesh"));
    return reader.body(triangles, places, &mesh);
}

}  // namespace pileus
