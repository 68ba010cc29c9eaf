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

namespace {

/// Takes the first number of an attribute, where there is one.
void take(const NcVariable& v, const char* name, double& value) {
    const NcAttribute* a = v.find(name);
    if (a != nullptr && !a->numbers.empty()) value = a->numbers[0];
}

}  // namespace

NcPacking::NcPacking(const NcVariable& v) : single(v.type == NcType::kFloat) {
    for (const char* name : {"_FillValue", "missing_value"})
        if (const NcAttribute* a = v.find(name))
            for (const double number : a->numbers) add(number);
    if (v.find("_FillValue") == nullptr) add_default(v.type);
    if (const NcAttribute* a = v.find("valid_range"))
        if (a->numbers.size() == 2) {
            least = a->numbers[0];
            most = a->numbers[1];
        }
    take(v, "valid_min", least);
    take(v, "valid_max", most);
    take(v, "scale_factor", scale);
    take(v, "add_offset", offset);
}

void NcPacking::add(double number) {
    constexpr double kMostFloat = 3.4028234663852886e38;
    if (number != number) {
        nan_is_missing = true;
        return;
    }
    // A mark that is written as a double stands for the float nearest to it.
    const bool rounds = single && number >= -kMostFloat && number <= kMostFloat;
    missing.push_back(rounds ? double(float(number)) : number);
}

/// What the library fills in where nothing was written.
void NcPacking::add_default(NcType type) {
    if (type == NcType::kFloat || type == NcType::kDouble) add(9.9692099683868690e+36);
    if (type == NcType::kShort) add(-32767);
    if (type == NcType::kInt) add(-2147483647);
}

bool NcPacking::is_missing(double number) const {
    if (number != number) return nan_is_missing;
    for (const double mark : missing)
        if (number == mark) return true;
    return number < least || number > most;
}

}  // namespace pileus
