// SPDX-License-Identifier: Apache-2.0
// See ply_file.h.
#include "src/io/text/ply_file.h"

#include <cstring>

namespace pileus {
namespace {

struct TypeName {
    const char *name, *other;
    unsigned bytes;
};
constexpr TypeName kTypes[] = {
    {"char", "int8", 1}, {"uchar", "uint8", 1}, {"short", "int16", 2},   {"ushort", "uint16", 2},
    {"int", "int32", 4}, {"uint", "uint32", 4}, {"float", "float32", 4}, {"double", "float64", 8}};

/// Files have two or three kinds of elements, with a name each.
constexpr std::size_t kMaxElements = 256;

}  // namespace

std::string PlyFile::word(TextRange& line) const {
    while (line.at < line.end && is_text_space(text_[line.at])) ++line.at;
    const std::size_t begin = line.at;
    while (line.at < line.end && !is_text_space(text_[line.at])) ++line.at;
    return std::string(text_.data + begin, line.at - begin);
}

Status PlyFile::type(TextRange& line, PlyType& out) const {
    const std::size_t begin = line.at;
    const std::string name = word(line);
    for (std::size_t i = 0; i < sizeof kTypes / sizeof kTypes[0]; ++i)
        if (name == kTypes[i].name || name == kTypes[i].other) {
            out = PlyType(i);
            return Status::ok();
        }
    return fault(begin, "property: no such type, " + name + ", allowed: char to double");
}

Status PlyFile::format(TextRange line) {
    const std::string kind = word(line);
    binary_ = kind != "ascii";
    big_ = kind == "binary_big_endian";
    if (!binary_ || big_ || kind == "binary_little_endian") return Status::ok();
    return fault(line.at, "format: unknown, " + kind +
                              ", allowed: ascii, binary_little_endian, binary_big_endian");
}

Status PlyFile::element(TextRange line) {
    PlyElement e;
    const std::size_t key = line.at;
    e.name = word(line);
    // Two counts of one element would size the same array twice.
    for (const PlyElement& other : elements_)
        if (other.name == e.name)
            return fault(key, "element " + e.name + ": given twice, allowed: once");
    if (elements_.size() == kMaxElements)
        return fault(key, "element " + e.name + ": too many elements, allowed: up to " +
                              std::to_string(kMaxElements));
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

Status PlyFile::property(TextRange line) {
    if (elements_.empty()) return fault(line.at, "property: before any element");
    PlyProperty p;
    TextRange ahead = line;
    if (word(ahead) == "list") {
        line = ahead;
        PILEUS_TRY(type(line, p.count));
        if (p.count >= PlyType::kFloat)
            return fault(line.at, "property: a list's length is a whole number");
    }
    PILEUS_TRY(type(line, p.type));
    p.name = word(line);
    elements_.back().properties.push_back(p);
    return Status::ok();
}

Status PlyFile::read_head() {
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
    rewind();
    return Status::ok();
}

std::uint64_t PlyFile::count_of(const char* element) const {
    for (const PlyElement& e : elements_)
        if (e.name == element) return e.count;
    return 0;
}

Status PlyFile::need_axes(const PlyElement& element) const {
    for (const char* axis : {"x", "y", "z"}) {
        bool found = element.count == 0;
        for (const PlyProperty& p : element.properties) found |= p.name == axis;
        if (!found)
            return fault(body_, "element " + element.name + ": no property " + axis +
                                    ", allowed: x, y and z");
    }
    return Status::ok();
}

Status PlyFile::value(PlyType type, double& out) {
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
        case PlyType::kInt8:
            out = double(std::int8_t(bits));
            break;
        case PlyType::kInt16:
            out = double(std::int16_t(bits));
            break;
        case PlyType::kInt32:
            out = double(std::int32_t(low));
            break;
        case PlyType::kFloat:
            std::memcpy(&single, &low, sizeof single);
            out = double(single);
            break;
        case PlyType::kDouble:
            std::memcpy(&out, &bits, sizeof out);
            break;
        default:
            out = double(bits);
    }
    return Status::ok();
}

/// A whole number below `count`.
Status PlyFile::index(PlyType type, std::uint64_t count, const char* what, std::uint64_t& out) {
    const std::size_t begin = rest_.at;
    double v = 0;
    PILEUS_TRY(value(type, v));
    if (!(v >= 0 && v < double(count)) || v != double(std::uint64_t(v)))
        return fault(begin, std::string(what) + ", allowed: 0 to " + std::to_string(count) +
                                ", not included");
    out = std::uint64_t(v);
    return Status::ok();
}

}  // namespace pileus
