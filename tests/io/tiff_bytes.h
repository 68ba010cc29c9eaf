// SPDX-License-Identifier: Apache-2.0
// Small TIFF files, put together byte by byte: one strip, not packed, with the tags of a GeoTIFF.
// in: samples, a place -> out: the bytes of a file of either byte order.
// TIFF 6.0; OGC 19-008r4, "GeoTIFF".
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "src/base/status.h"

namespace pileus {

/// Builds without libtiff, and machines, say so in their line.
inline bool without_tiff(const Status& status) {
    return !status && (status.message.find("PILEUS_TIFF") != std::string::npos ||
                       status.message.find("libtiff.so.6 is not") != std::string::npos);
}

class TiffBytes {
public:
    TiffBytes(int columns, int rows, bool big_endian)
        : columns_(columns), rows_(rows), big_(big_endian) {}

    /// `format`: 1 whole numbers from 0 on, 2 whole numbers, 3 floats.
    void samples(const std::vector<double>& values, int bits, int format) {
        bits_ = bits, format_ = format;
        for (const double v : values) {
            std::uint32_t word = std::uint32_t(std::int32_t(v));
            const float f = float(v);
            if (format == 3 && bits == 32) std::memcpy(&word, &f, 4);
            data_ += number(word, std::size_t(bits / 8));
        }
    }
    /// Metres from sample to sample, and of the north-west corner; `model` 1: projected, 2:
    /// degrees.
    void place(double across, double along, double west, double north, bool point, int model = 1) {
        scale_ = real(across) + real(along) + real(0);
        tie_ = real(0) + real(0) + real(0) + real(west) + real(north) + real(0);
        for (const int k : {1, 1, 0, 2, 1024, 0, 1, model, 1025, 0, 1, point ? 2 : 1})
            keys_ += number(std::uint32_t(k), 2);
    }
    void no_data(const std::string& text) { no_data_ = text + '\0'; }

    std::string bytes() const {
        // Head, samples, what does not fit into tags, tags.
        std::string out = big_ ? "MM" : "II";
        out += number(42, 2);
        std::string rest = data_;
        std::vector<std::string> tags;
        const auto add = [&](int tag, int type, std::size_t count, std::string value) {
            if (value.size() > 4) {
                if (rest.size() % 2 != 0) rest += '\0';
                const std::uint32_t at = std::uint32_t(8 + rest.size());
                rest += value;
                value = number(at, 4);
            }
            value.resize(4, '\0');
            tags.push_back(number(std::uint32_t(tag), 2) + number(std::uint32_t(type), 2) +
                           number(std::uint32_t(count), 4) + value);
        };
        const auto small = [&](int tag, int v) { add(tag, 3, 1, number(std::uint32_t(v), 2)); };
        small(256, columns_), small(257, rows_), small(258, bits_), small(259, 1), small(262, 1);
        add(273, 4, 1, number(8, 4));
        small(277, 1), small(278, rows_);
        add(279, 4, 1, number(std::uint32_t(data_.size()), 4));
        small(339, format_);
        if (!scale_.empty()) {
            add(33550, 12, 3, scale_);
            add(33922, 12, 6, tie_);
            add(34735, 3, 12, keys_);
        }
        if (!no_data_.empty()) add(42113, 2, no_data_.size(), no_data_);
        if (rest.size() % 2 != 0) rest += '\0';
        out += number(std::uint32_t(8 + rest.size()), 4) + rest;
        out += number(std::uint32_t(tags.size()), 2);
        for (const std::string& tag : tags) out += tag;
        return out + number(0, 4);
    }

private:
    std::string number(std::uint64_t v, std::size_t bytes) const {
        std::string out;
        for (std::size_t i = 0; i < bytes; ++i)
            out += char(v >> (8 * (big_ ? bytes - 1 - i : i)) & 255);
        return out;
    }
    std::string real(double v) const {
        std::uint64_t bits;
        std::memcpy(&bits, &v, 8);
        return number(bits, 8);
    }

    int columns_, rows_;
    bool big_;
    int bits_ = 16, format_ = 2;
    std::string data_, scale_, tie_, keys_, no_data_;
};

}  // namespace pileus
