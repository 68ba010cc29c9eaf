// SPDX-License-Identifier: Apache-2.0
// Big-endian numbers of any NetCDF type as doubles.
// in: bytes -> out: see netcdf_values.h.
// docs/formats.md
#include "src/io/netcdf/netcdf_values.h"

#include <cstring>

namespace pileus {

namespace {

template <class Bits>
Bits bits_of(const unsigned char* from) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i) bits = bits << 8 | from[i];
    return Bits(bits);
}

/// `Number` has as many bytes as `Bits`.
template <class Number, class Bits>
void values(const unsigned char* from, Span<double> to) {
    static_assert(sizeof(Number) == sizeof(Bits), "the same bytes");
    for (double& value : to) {
        const Bits bits = bits_of<Bits>(from);
        Number number;
        std::memcpy(&number, &bits, sizeof number);
        value = double(number);
        from += sizeof bits;
    }
}

}  // namespace

std::uint64_t nc_bytes(NcType type) {
    static constexpr std::uint64_t bytes[12] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    return bytes[std::size_t(type)];
}

const char* nc_type_name(NcType type) {
    static constexpr const char* names[12] = {"other",  "byte",  "char",   "short",
                                              "int",    "float", "double", "ubyte",
                                              "ushort", "uint",  "int64",  "uint64"};
    return names[std::size_t(type)];
}

void nc_values(NcType type, const unsigned char* from, Span<double> to) {
    switch (type) {
        case NcType::kByte:
            return values<std::int8_t, std::uint8_t>(from, to);
        case NcType::kChar:
        case NcType::kUByte:
            return values<std::uint8_t, std::uint8_t>(from, to);
        case NcType::kShort:
            return values<std::int16_t, std::uint16_t>(from, to);
        case NcType::kInt:
            return values<std::int32_t, std::uint32_t>(from, to);
        case NcType::kFloat:
            return values<float, std::uint32_t>(from, to);
        case NcType::kDouble:
            return values<double, std::uint64_t>(from, to);
        case NcType::kUShort:
            return values<std::uint16_t, std::uint16_t>(from, to);
        case NcType::kUInt:
            return values<std::uint32_t, std::uint32_t>(from, to);
        case NcType::kInt64:
            return values<std::int64_t, std::uint64_t>(from, to);
        case NcType::kUInt64:
            return values<std::uint64_t, std::uint64_t>(from, to);
        case NcType::kOther:
            break;
    }
    for (double& value : to) value = 0;
}

Status read_letter_rows(const NcFile& file, const NcVariable& v, std::uint64_t most,
                        std::vector<std::string>& rows) {
    const NcBlock block = whole_block(file.head(), v);
    if (block.values() > most * 64) return Status::ok();
    std::vector<double> letters(std::size_t(block.values()));
    PILEUS_TRY(file.read(v, block, {letters.data(), letters.size()}));
    const std::size_t length = std::size_t(block.count[1]);
    for (std::size_t i = 0; i < block.count[0]; ++i) {
        std::string row;
        for (std::size_t k = 0; k < length; ++k)
            if (const char c = nc_letter(letters[i * length + k]); c != '\0') row += c;
        rows.push_back(row);
    }
    return Status::ok();
}

}  // namespace pileus
