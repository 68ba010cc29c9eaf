// SPDX-License-Identifier: Apache-2.0
// Writes classic NetCDF files.
// in: plain structs -> out: see netcdf_write.h.
// Unidata, "NetCDF Classic Format Specification"; docs/formats.md
#include "src/io/netcdf/netcdf_write.h"

#include <cstring>

namespace pileus {
namespace {

constexpr std::uint32_t kDimensionList = 10, kVariableList = 11, kAttributeList = 12;

/// Big-endian numbers at the end of a text.
void put(std::string& out, std::uint64_t value, unsigned width) {
    for (unsigned i = width; i-- > 0;) out += static_cast<char>(value >> (8 * i) & 255);
}

void put_text(std::string& out, const std::string& text) {
    put(out, text.size(), 4);
    out += text;
    while (out.size() % 4 != 0) out += '\0';
}

void put_list(std::string& out, std::uint32_t tag, std::size_t elements) {
    put(out, elements > 0 ? tag : 0, 4);
    put(out, elements, 4);
}

void put_attributes(std::string& out, const NcTexts& texts) {
    put_list(out, kAttributeList, texts.size());
    for (const auto& [name, text] : texts) {
        put_text(out, name);
        put(out, std::uint64_t(NcType::kChar), 4);
        put_text(out, text);
    }
}

std::uint64_t bytes_of(const NcNewVariable& v) {
    return v.holds_floats() ? std::uint64_t(v.floats.size) * 4
                            : std::uint64_t(v.doubles.size()) * 8;
}

/// The head; values begin at `length`, which is its own once that is known.
std::string make_head(const NcNewFile& file, std::uint64_t length) {
    std::string out = "CDF\x02";
    put(out, 0, 4);  // no records
    put_list(out, kDimensionList, file.dimensions.size());
    for (const auto& [name, size] : file.dimensions) {
        put_text(out, name);
        put(out, size, 4);
    }
    put_attributes(out, file.texts);
    put_list(out, kVariableList, file.variables.size());
    std::uint64_t place = length;
    for (const NcNewVariable& v : file.variables) {
        put_text(out, v.name);
        put(out, v.dimensions.size(), 4);
        for (const std::size_t d : v.dimensions) put(out, d, 4);
        put_attributes(out, v.texts);
        put(out, std::uint64_t(v.holds_floats() ? NcType::kFloat : NcType::kDouble), 4);
        // What is too large to be said here is told by the dimensions.
        const std::uint64_t bytes = bytes_of(v), most = 0xffffffffu;
        put(out, bytes > most - 3 ? most : bytes, 4);
        put(out, place, 8);
        place += bytes;
    }
    return out;
}

template <class Number, class Bits>
char* put_values(Span<const Number> values, char* to) {
    static_assert(sizeof(Number) == sizeof(Bits), "the same bytes");
    for (const Number& value : values) {
        Bits bits;
        std::memcpy(&bits, &value, sizeof bits);
        for (unsigned i = sizeof bits; i-- > 0;) *to++ = static_cast<char>(bits >> (8 * i) & 255);
    }
    return to;
}

double face(double low, double high, std::uint64_t cells, std::uint64_t i) {
    if (i == 0) return low;
    return i == cells ? high : low + (high - low) * (double(i) / double(cells));
}

}  // namespace

Status encode_netcdf(const NcNewFile& file, Buffer<char>& bytes) {
    const std::string head = make_head(file, make_head(file, 0).size());
    std::uint64_t total = head.size();
    for (const NcNewVariable& v : file.variables) total += bytes_of(v);
    PILEUS_TRY(bytes.resize(total, "NetCDF file"));
    std::memcpy(bytes.data(), head.data(), head.size());
    char* to = bytes.data() + head.size();
    for (const NcNewVariable& v : file.variables)
        to = v.holds_floats()
                 ? put_values<float, std::uint32_t>(v.floats, to)
                 : put_values<double, std::uint64_t>({v.doubles.data(), v.doubles.size()}, to);
    return Status::ok();
}

NcNewVariable nc_middles(const std::string& name, std::size_t dimension, double low, double high,
                         std::uint64_t cells) {
    NcNewVariable v;
    v.name = name;
    v.dimensions = {dimension};
    for (std::uint64_t i = 0; i < cells; ++i)
        v.doubles.push_back(0.5 * (face(low, high, cells, i) + face(low, high, cells, i + 1)));
    return v;
}

NcNewVariable nc_bounds(const std::string& name, std::size_t dimension, std::size_t pair,
                        double low, double high, std::uint64_t cells) {
    NcNewVariable v;
    v.name = name;
    v.dimensions = {dimension, pair};
    for (std::uint64_t i = 0; i < cells; ++i)
        for (const std::uint64_t side : {i, i + 1})
            v.doubles.push_back(face(low, high, cells, side));
    return v;
}

}  // namespace pileus
