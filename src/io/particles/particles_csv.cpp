// SPDX-License-Identifier: Apache-2.0
// Particles from text: a line with the names of the columns, then a line for each particle.
// in: columns parted by commas, semicolons, tabs or spaces -> out: a set.
// docs/formats.md, "Particles".
#include "src/io/particles/particle_rows.h"
#include "src/io/text/text_scan.h"

namespace pileus {
namespace {

constexpr std::size_t kMaxColumns = 256;

class Reader : private TextScan {
public:
    Reader(const std::string& file, Span<const char> text, char separator)
        : TextScan(file, text, separator) {}

    Status read(const ParticleReading& reading, ParticleSet& set);

private:
    void pass_space(TextRange& line) const {
        while (line.at < line.end && is_text_space(text_[line.at])) ++line.at;
    }
    Status head(TextRange& rest, std::vector<ParticleColumn>& columns) const;
    Status pass(TextRange rest, std::size_t columns, bool keep, ParticleRows& rows) const;
};

Status Reader::head(TextRange& rest, std::vector<ParticleColumn>& columns) const {
    TextRange line;
    if (!next_line(rest, line)) return fault(0, "no line with the names of the columns");
    const auto between = [&](char c) { return is_text_space(c) || c == separator_; };
    for (std::size_t at = line.at; at < line.end;) {
        while (at < line.end && between(text_[at])) ++at;
        std::size_t begin = at;
        while (at < line.end && !between(text_[at])) ++at;
        std::size_t end = at;
        if (end > begin + 1 && text_[begin] == '"' && text_[end - 1] == '"') ++begin, --end;
        if (columns.size() == kMaxColumns)
            return fault(begin, "too many columns, allowed: up to " + std::to_string(kMaxColumns));
        if (end > begin) columns.push_back({std::string(text_.data + begin, end - begin), false});
    }
    return Status::ok();
}

Status Reader::pass(TextRange rest, std::size_t columns, bool keep, ParticleRows& rows) const {
    std::vector<double> row(columns);
    TextRange line;
    for (std::uint64_t particle = 0; next_line(rest, line); ++particle) {
        for (std::size_t c = 0; c < columns; ++c) {
            pass_space(line);
            // One separator, so that a number left out is none.
            if (c > 0 && line.at < line.end && text_[line.at] == separator_) ++line.at;
            pass_space(line);
            PILEUS_TRY(number(line, "column " + std::to_string(c + 1), row[c]));
        }
        pass_space(line);
        if (line.at < line.end)
            return fault(line.at, "more numbers than columns, allowed: " + std::to_string(columns));
        const Span<const double> numbers{row.data(), row.size()};
        PILEUS_TRY(keep ? rows.keep(particle, numbers) : rows.measure(particle, numbers));
    }
    return Status::ok();
}

Status Reader::read(const ParticleReading& reading, ParticleSet& set) {
    TextRange rest{0, text_.size};
    std::vector<ParticleColumn> columns;
    PILEUS_TRY(head(rest, columns));
    std::uint64_t count = 0;
    TextRange line, ahead = rest;
    while (next_line(ahead, line)) ++count;
    ParticleRows rows(file_, set);
    PILEUS_TRY(rows.begin(columns, count, reading));
    PILEUS_TRY(pass(rest, columns.size(), false, rows));
    rows.measured();
    return pass(rest, columns.size(), true, rows);
}

}  // namespace

Status decode_particle_csv(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set) {
    // The first line tells what parts the columns.
    char separator = ' ';
    for (std::size_t i = 0; i < bytes.size && bytes[i] != '\n'; ++i)
        if (bytes[i] == ',' || bytes[i] == ';') separator = bytes[i];
    return Reader(name, bytes, separator).read(reading, set);
}

}  // namespace pileus
