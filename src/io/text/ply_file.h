// SPDX-License-Identifier: Apache-2.0
// The head of a PLY file and the numbers behind it, as text or binary of either byte order,
// trusting nothing in it. in: the bytes of a file -> out: its elements and their properties;
// numbers one after the other. Turk 1994, "The PLY polygon file format"; docs/formats.md.
#pragma once
#include <string>
#include <vector>

#include "src/io/text/text_scan.h"

namespace pileus {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble, kNone };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::kNone, count = PlyType::kNone;  ///< `count` of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;  ///< no more than the file has bytes
    std::vector<PlyProperty> properties;
};

class PlyFile : protected TextScan {
public:
    /// `file` and `text` outlive it.
    PlyFile(const std::string& file, Span<const char> text) : TextScan(file, text) {}

    /// Up to end_header; the next number is the first of the first element.
    Status read_head();
    const std::vector<PlyElement>& elements() const { return elements_; }
    /// Items of the element of that name; 0 where there is none.
    std::uint64_t count_of(const char* element) const;

protected:
    /// kBadInput where the element has items, but not all of these properties: a place without one
    /// of its numbers would be somewhere that no one chose.
    Status need_axes(const PlyElement& element) const;
    void rewind() { rest_ = {body_, text_.size}; }
    Status value(PlyType type, double& out);
    /// A whole number below `count`.
    Status index(PlyType type, std::uint64_t count, const char* what, std::uint64_t& out);

    TextRange rest_;  ///< what is not read yet

private:
    std::string word(TextRange& line) const;
    Status type(TextRange& line, PlyType& out) const;
    Status format(TextRange line);
    Status element(TextRange line);
    Status property(TextRange line);

    std::vector<PlyElement> elements_;
    bool binary_ = false, big_ = false;
    std::size_t body_ = 0;
};

}  // namespace pileus
