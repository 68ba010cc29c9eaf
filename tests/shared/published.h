// SPDX-License-Identifier: Apache-2.0
// Tables of published numbers, as they lie below PILEUS_DATA_DIR.
// in: text of comma-separated or blank-separated values -> out: rows of cells, by column name.
// docs/validation.md; docs/testing.md, label shared
#pragma once
#include <doctest/doctest.h>

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "src/base/file.h"

namespace published {

/// The folder of the data, or empty after a line that says so.
inline std::string data_folder() {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root != nullptr && *root != '\0') return root;
    MESSAGE("skipped: PILEUS_DATA_DIR is not set");
    return "";
}

inline std::string text_of_file(const std::string& path) {
    pileus::Buffer<char> bytes;
    const pileus::Status status = pileus::read_whole_file(path, 1u << 24, bytes);
    REQUIRE_MESSAGE(status, status.message);
    return {bytes.data(), bytes.size()};
}

/// The pieces of `text` between any of the characters of `marks`; empty pieces are kept.
inline std::vector<std::string> split(const std::string& text, const char* marks) {
    std::vector<std::string> out;
    std::size_t from = 0;
    while (true) {
        const std::size_t to = text.find_first_of(marks, from);
        out.push_back(text.substr(from, to == std::string::npos ? to : to - from));
        if (to == std::string::npos) return out;
        from = to + 1;
    }
}

inline double number(const std::string& cell) {
    char* end = nullptr;
    const double v = std::strtod(cell.c_str(), &end);
    REQUIRE_MESSAGE(end != cell.c_str(), "no number: ", cell);
    return v;
}

struct Row {
    std::map<std::string, std::string> cells;

    const std::string& text(const char* column) const {
        const auto at = cells.find(column);
        REQUIRE_MESSAGE(at != cells.end(), "no column ", column);
        return at->second;
    }
    double value(const char* column) const { return number(text(column)); }
};

/// A file of comma-separated values whose first line names its columns.
inline std::vector<Row> read_table(const std::string& path) {
    const std::vector<std::string> lines = split(text_of_file(path), "\n");
    const std::vector<std::string> names = split(lines[0], ",");
    std::vector<Row> rows;
    for (std::size_t l = 1; l < lines.size(); ++l) {
        if (lines[l].empty()) continue;
        const std::vector<std::string> cells = split(lines[l], ",");
        REQUIRE(cells.size() == names.size());
        Row row;
        for (std::size_t i = 0; i < names.size(); ++i) row.cells[names[i]] = cells[i];
        rows.push_back(row);
    }
    return rows;
}

/// All numbers of a file of blanks and numbers.
inline std::vector<double> read_numbers(const std::string& path) {
    std::vector<double> out;
    for (const std::string& cell : split(text_of_file(path), " \t\r\n"))
        if (!cell.empty()) out.push_back(number(cell));
    return out;
}

/// Half a unit of the last digit of a number as it is printed, "0.00760" or "1.2e-05" or "64.0".
inline double half_of_last_digit(const std::string& printed) {
    const std::size_t e = printed.find_first_of("eE");
    const std::string mantissa = printed.substr(0, e);
    const std::size_t point = mantissa.find('.');
    const int places = point == std::string::npos ? 0 : int(mantissa.size() - point) - 1;
    const int power = e == std::string::npos ? 0 : int(number(printed.substr(e + 1)));
    double half = 0.5;
    for (int i = 0; i < places - power; ++i) half /= 10;
    for (int i = 0; i < power - places; ++i) half *= 10;
    return half;
}

}  // namespace published
