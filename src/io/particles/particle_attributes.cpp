// SPDX-License-Identifier: Apache-2.0
// See particle_attributes.h.
#include "src/io/particles/particle_attributes.h"

#include <cstring>

namespace pileus {
namespace {

/// Names in lower case, parted by '|', as Houdini, Maya and Partio have them.
struct AttributeRow {
    const char* names;
    const char* columns[3];
};
constexpr AttributeRow kAttributeRows[] = {
    {"|p|position|", {"x", "y", "z"}},
    {"|v|velocity|", {"vx", "vy", "vz"}},
    {"|cd|color|rgbpp|", {"red", "green", "blue"}},
    {"|pscale|radius|radiuspp|", {"radius", nullptr, nullptr}},
    {"|density|", {"density", nullptr, nullptr}},
    {"|id|particleid|", {"id", nullptr, nullptr}},
};

const AttributeRow* attribute_row(std::string name) {
    if (name.empty() || name.find('|') != std::string::npos) return nullptr;
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    for (const AttributeRow& row : kAttributeRows)
        if (std::string(row.names).find('|' + name + '|') != std::string::npos) return &row;
    return nullptr;
}

}  // namespace

std::string ParticleAttributes::add(const std::string& name, std::uint64_t size) {
    if (++attributes_ > kMostAttributes)
        return "attributes: too many, allowed: at most " + std::to_string(kMostAttributes);
    if (size > kMostAttributeNumbers - numbers())
        return "attribute " + name + ": too long, " + std::to_string(size) + ", allowed: at most " +
               std::to_string(kMostAttributeNumbers) + " numbers for a particle";
    const AttributeRow* row = attribute_row(name);
    const std::uint64_t wanted = row == nullptr ? size : row->columns[1] != nullptr ? 3 : 1;
    if (size != wanted)
        return "attribute " + name + ": wrong size, " + std::to_string(size) +
               ", allowed: " + std::to_string(wanted);
    for (std::uint64_t i = 0; i < size; ++i)
        columns_.push_back({row != nullptr ? row->columns[i] : "", false});
    return "";
}

double attribute_number(const unsigned char* from, bool big_endian, bool floats) {
    std::uint32_t bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits = bits << 8 | from[big_endian ? i : 3 - i];
    if (floats) {
        float value;
        std::memcpy(&value, &bits, sizeof value);
        return double(value);
    }
    return double(bits) - ((bits & 0x80000000u) != 0 ? 0x1p32 : 0);
}

}  // namespace pileus
