// SPDX-License-Identifier: Apache-2.0
// Makes small classic NetCDF files in memory, of any of the three versions.
// in: dimensions, attributes, variables with their values -> out: bytes as in a file.
// Unidata, "NetCDF Classic Format Specification".
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "src/io/netcdf/netcdf_file.h"

namespace test {

using pileus::NcType;

class NetcdfMaker {
public:
    using Texts = std::vector<std::pair<std::string, std::string>>;
    using Numbers = std::vector<std::pair<std::string, double>>;

    struct Variable {
        std::string name;
        std::vector<std::string> dimensions;
        std::vector<double> values;
        Texts texts;
        Numbers numbers;  ///< attributes of the variable's own type
        Numbers doubles;  ///< and those that are doubles
        NcType type = NcType::kFloat;
    };

    /// size 0: unlimited, with `records`.
    void dimension(const std::string& name, std::uint64_t size) {
        dimensions_.push_back({name, size});
    }
    Variable& variable(const std::string& name, const std::vector<std::string>& dimensions,
                       const std::vector<double>& values, const std::string& units = "-") {
        Variable v;
        v.name = name;
        v.dimensions = dimensions;
        v.values = values;
        if (units != "-") v.texts.emplace_back("units", units);
        variables_.push_back(v);
        return variables_.back();
    }
    Variable& of(const std::string& name) {
        for (Variable& v : variables_)
            if (v.name == name) return v;
        return variables_.front();
    }
    void remove(const std::string& name) {
        for (std::size_t i = 0; i < variables_.size(); ++i)
            if (variables_[i].name == name) variables_.erase(variables_.begin() + long(i--));
    }
    void set_units(const std::string& name, const std::string& units) {
        of(name).texts.assign(1, {"units", units});
    }
    std::uint64_t records = 0;
    Numbers globals;

    std::string bytes(int version = 1) const {
        version_ = version;
        // The places of values are known once the head's length is: make it twice.
        std::string head = make_head(0);
        head = make_head(head.size());
        std::string out = head;
        for (const Variable& v : variables_)
            if (!by_record(v)) out += padded(values(v, 0, v.values.size()));
        std::size_t kinds = 0;
        for (const Variable& v : variables_) kinds += by_record(v) ? 1 : 0;
        for (std::uint64_t r = 0; r < records; ++r)
            for (const Variable& v : variables_) {
                if (!by_record(v)) continue;
                const std::size_t each = v.values.size() / std::size_t(records);
                const std::string row = values(v, std::size_t(r) * each, each);
                out += kinds == 1 ? row : padded(row);
            }
        return out;
    }

private:
    static std::string big(std::uint64_t value, unsigned width) {
        std::string out;
        for (unsigned i = width; i-- > 0;) out += char(value >> (8 * i) & 255);
        return out;
    }
    std::string count(std::uint64_t value) const { return big(value, version_ == 5 ? 8 : 4); }
    static std::string padded(std::string text) {
        while (text.size() % 4 != 0) text += '\0';
        return text;
    }
    std::string name_text(const std::string& name) const {
        return count(name.size()) + padded(name);
    }
    std::string list(unsigned tag, std::size_t elements) const {
        return big(elements > 0 ? tag : 0, 4) + count(elements);
    }

    static std::string number(NcType type, double value) {
        std::uint64_t bits = 0;
        if (type == NcType::kFloat) {
            const float f = float(value);
            std::uint32_t word;
            std::memcpy(&word, &f, 4);
            bits = word;
        } else if (type == NcType::kDouble) {
            std::memcpy(&bits, &value, 8);
        } else if (type == NcType::kUInt64) {
            bits = std::uint64_t(value);
        } else {
            bits = std::uint64_t(std::int64_t(value));
        }
        return big(bits, unsigned(pileus::nc_bytes(type)));
    }
    static std::string values(const Variable& v, std::size_t from, std::size_t n) {
        std::string out;
        for (std::size_t i = from; i < from + n; ++i) out += number(v.type, v.values[i]);
        return out;
    }

    std::string attributes(const Texts& texts, const Numbers& numbers, NcType type,
                           const Numbers& doubles = {}) const {
        std::string out = list(12, texts.size() + numbers.size() + doubles.size());
        for (const auto& a : texts)
            out += name_text(a.first) + big(2, 4) + count(a.second.size()) + padded(a.second);
        for (const auto& a : numbers)
            out += name_text(a.first) + big(std::uint64_t(type), 4) + count(1) +
                   padded(number(type, a.second));
        for (const auto& a : doubles)
            out += name_text(a.first) + big(6, 4) + count(1) + number(NcType::kDouble, a.second);
        return out;
    }

    std::size_t index_of(const std::string& dimension) const {
        for (std::size_t i = 0; i < dimensions_.size(); ++i)
            if (dimensions_[i].first == dimension) return i;
        return 999;
    }
    bool by_record(const Variable& v) const {
        return !v.dimensions.empty() && dimensions_[index_of(v.dimensions[0])].second == 0;
    }
    /// Bytes of the values, or of one record.
    std::uint64_t slab(const Variable& v) const {
        std::uint64_t n = v.values.size();
        if (by_record(v)) n = records > 0 ? n / records : 0;
        return n * pileus::nc_bytes(v.type);
    }

    std::string make_head(std::size_t length) const {
        std::string out = std::string("CDF") + char(version_) + count(records);
        out += list(10, dimensions_.size());
        for (const auto& d : dimensions_) out += name_text(d.first) + count(d.second);
        out += attributes({}, globals, NcType::kDouble);
        out += list(11, variables_.size());
        std::uint64_t at = length, record_at = length;
        for (const Variable& v : variables_)
            if (!by_record(v)) record_at += (slab(v) + 3) / 4 * 4;
        for (const Variable& v : variables_) {
            out += name_text(v.name) + count(v.dimensions.size());
            for (const std::string& d : v.dimensions) out += count(index_of(d));
            out +=
                attributes(v.texts, v.numbers, v.type, v.doubles) + big(std::uint64_t(v.type), 4);
            const std::uint64_t bytes = (slab(v) + 3) / 4 * 4;
            std::uint64_t& place = by_record(v) ? record_at : at;
            out += count(bytes) + big(place, version_ == 1 ? 4 : 8);
            place += bytes;
        }
        return out;
    }

    std::vector<std::pair<std::string, std::uint64_t>> dimensions_;
    std::vector<Variable> variables_;
    mutable int version_ = 1;
};

}  // namespace test
