// SPDX-License-Identifier: Apache-2.0
// See phase_file.h.
// in: bytes of a text that nobody has checked -> out: numbers, or one line file:line:column.
// docs/phase.md, "Files".
#include "src/io/text/phase_file.h"

#include "src/base/file.h"
#include "src/io/text/text_scan.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 24;
constexpr double kMaxValue = 1e30;

class Reader : private TextScan {
public:
    Reader(const std::string& file, Span<const char> text) : TextScan(file, text) {}

    Status table(PhaseNodes& nodes);
    Status moments(Buffer<double>& list);

private:
    /// Lines that hold more than comments; kBadInput where they are fewer or more than allowed.
    Status count_lines(const char* what, std::uint64_t least, std::uint64_t most,
                       std::uint64_t& lines) const;
    /// Nothing may follow the last number of a line.
    Status end_of(TextRange line, const char* what) const;
    Status node(TextRange line, std::uint64_t index, bool last, PhaseNodes& nodes) const;
};

Status Reader::count_lines(const char* what, std::uint64_t least, std::uint64_t most,
                           std::uint64_t& lines) const {
    TextRange rest{0, text_.size}, line;
    std::size_t at = 0;
    for (lines = 0; next_line(rest, line); ++lines)
        if (lines <= most) at = line.at;
    if (lines >= least && lines <= most) return Status::ok();
    return fault(lines < least ? text_.size : at,
                 std::string(what) + ": wrong number of lines, " + std::to_string(lines) +
                     ", allowed: " + std::to_string(least) + " to " + std::to_string(most));
}

Status Reader::end_of(TextRange line, const char* what) const {
    skip(line);
    if (line.at >= line.end) return Status::ok();
    return fault(line.at,
                 std::string("line: too long, ") + token(line.at, line.end) + ", allowed: " + what);
}

Status Reader::node(TextRange line, std::uint64_t index, bool last, PhaseNodes& nodes) const {
    const std::size_t begin = line.at;
    double angle = 0, value = 0;
    PILEUS_TRY(number(line, "angle", angle));
    const std::string word = token(begin, line.end);
    if (!(angle >= 0 && angle <= 180))
        return fault(begin, "angle: out of range, " + word + ", allowed: number in [0, 180]");
    if (index == 0 && angle > 0)
        return fault(begin, "angle: the first is not 0, " + word + ", allowed: 0 to 180 degrees");
    if (index > 0 && !(angle > nodes.angle_deg.at(std::size_t(index) - 1)))
        return fault(begin,
                     "angle: not above the one before, " + word + ", allowed: ascending angles");
    if (last && angle < 180)
        return fault(begin, "angle: the last is not 180, " + word + ", allowed: 0 to 180 degrees");
    skip(line);
    if (line.at >= line.end)
        return fault(line.at, "value: missing, nothing, allowed: `angle value` on each line");
    const std::size_t at = line.at;
    PILEUS_TRY(number(line, "value", value));
    if (!(value >= 0 && value <= kMaxValue))
        return fault(
            at, "value: out of range, " + token(at, line.end) + ", allowed: number in [0, 1e+30]");
    PILEUS_TRY(end_of(line, "`angle value` on each line"));
    nodes.angle_deg.at(std::size_t(index)) = angle;
    nodes.value.at(std::size_t(index)) = value;
    return Status::ok();
}

Status Reader::table(PhaseNodes& nodes) {
    std::uint64_t lines = 0;
    PILEUS_TRY(count_lines("phase table", 2, kMaxPhaseNodes, lines));
    PILEUS_TRY(nodes.angle_deg.resize(lines, "phase table"));
    PILEUS_TRY(nodes.value.resize(lines, "phase table"));
    TextRange rest{0, text_.size}, line;
    bool light = false;
    for (std::uint64_t i = 0; next_line(rest, line); ++i) {
        PILEUS_TRY(node(line, i, i + 1 == lines, nodes));
        light = light || nodes.value.at(std::size_t(i)) > 0;
    }
    if (!light)
        return fault(text_.size, "value: all are 0, nothing is scattered, allowed: one above 0");
    return Status::ok();
}

Status Reader::moments(Buffer<double>& list) {
    std::uint64_t lines = 0;
    PILEUS_TRY(count_lines("moments", 1, kMaxPhaseMoments, lines));
    PILEUS_TRY(list.resize(lines, "phase moments"));
    TextRange rest{0, text_.size}, line;
    for (std::uint64_t i = 0; next_line(rest, line); ++i) {
        const std::size_t begin = line.at;
        double moment = 0;
        PILEUS_TRY(number(line, "moment", moment));
        const bool first = i == 0 && !(moment >= 0.999999 && moment <= 1.000001);
        if (first || !(moment >= -1 && moment <= 1.000001))
            return fault(begin, "moment: out of range, " + token(begin, line.end) +
                                    ", allowed: " + (first ? "1, the first" : "number in [-1, 1]"));
        PILEUS_TRY(end_of(line, "one moment on each line, without 2l+1"));
        list.at(std::size_t(i)) = moment;
    }
    return Status::ok();
}

}  // namespace

Status decode_phase_table(const std::string& name, Span<const char> text, PhaseNodes& nodes) {
    return Reader(name, text).table(nodes);
}

Status decode_phase_moments(const std::string& name, Span<const char> text,
                            Buffer<double>& moments) {
    return Reader(name, text).moments(moments);
}

Status read_phase_table(const std::string& path, PhaseNodes& nodes) {
    Buffer<char> text;
    PILEUS_TRY(read_whole_file(path, kMaxBytes, text));
    return decode_phase_table(path, text.span(), nodes);
}

Status read_phase_moments(const std::string& path, Buffer<double>& moments) {
    Buffer<char> text;
    PILEUS_TRY(read_whole_file(path, kMaxBytes, text));
    return decode_phase_moments(path, text.span(), moments);
}

}  // namespace pileus
