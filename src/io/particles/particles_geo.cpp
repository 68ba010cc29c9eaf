// SPDX-License-Identifier: Apache-2.0
// Particles from Houdini's classic geometry, version 5: binary or text.
// in: points with attributes; groups and primitives behind them are not looked at -> out: a set.
// Side Effects Software, "Houdini geometry format"; as Partio reads it (BGEO, GEO);
// docs/particles.md, "Files".
#include <cstring>

#include "src/io/particles/particle_rows.h"
#include "src/io/text/byte_cursor.h"
#include "src/io/text/text_scan.h"

namespace pileus {
namespace {

constexpr const char* kNewer =
    "magic: geometry of Houdini 12 or later, allowed: saved as classic geometry (.bhclassic, "
    ".hclassic) or as PLY";

enum GeoType { kGeoFloat = 0, kGeoInt = 1, kGeoIndex = 4, kGeoVector = 5 };

class GeoBytes {
public:
    GeoBytes(const std::string& file, Span<const char> bytes) : file_(file), in_(file, bytes) {}

    Status read(const ParticleReading& reading, ParticleSet& set) {
        std::uint64_t counts[8];
        PILEUS_TRY(head(counts));
        const std::uint64_t points = counts[0];
        // Places have four numbers, x, y, z, w.
        (void)attributes_.add("P", 3);
        (void)attributes_.add("", 1);
        floats_.assign(4, true);
        for (std::uint64_t i = 0; i < counts[4]; ++i) PILEUS_TRY(attribute());
        const std::uint64_t stride = 4 * attributes_.numbers();
        if (points > in_.left() / stride)
            return in_.fault("points: more than the file can hold, " + std::to_string(points) +
                             " of " + std::to_string(stride) + " bytes");
        const unsigned char* from = nullptr;
        PILEUS_TRY(in_.take(points * stride, "points", from));
        return read_particle_rows(file_, attributes_, points, reading, set,
                                  [&](std::uint64_t i, std::vector<double>& row) {
                                      for (std::size_t n = 0; n < row.size(); ++n)
                                          row[n] = attribute_number(from + i * stride + 4 * n, true,
                                                                    floats_[n]);
                                      return Status::ok();
                                  });
    }

private:
    Status number(const char* what, unsigned bytes, std::uint64_t& value) {
        const unsigned char* from = nullptr;
        PILEUS_TRY(in_.take(bytes, what, from));
        value = 0;
        for (unsigned i = 0; i < bytes; ++i) value = value << 8 | from[i];
        return Status::ok();
    }
    Status text(const char* what, std::string& value) {
        std::uint64_t length = 0;
        PILEUS_TRY(number(what, 2, length));
        const unsigned char* from = nullptr;
        PILEUS_TRY(in_.take(length, what, from));
        value.assign(reinterpret_cast<const char*>(from), std::size_t(length));
        return Status::ok();
    }
    /// Points, primitives, groups of both, attributes of points, vertices, primitives and all.
    Status head(std::uint64_t counts[8]) {
        PILEUS_TRY(in_.skip(4, "magic"));
        std::uint64_t letter = 0, version = 0;
        PILEUS_TRY(number("version", 1, letter));
        PILEUS_TRY(number("version", 4, version));
        if (letter != 'V' || version != 5)
            return in_.fault("version: unknown, " + std::to_string(version) + ", allowed: 5");
        for (int i = 0; i < 8; ++i) PILEUS_TRY(number("counts", 4, counts[i]));
        return Status::ok();
    }
    Status attribute() {
        std::string name, passed;
        std::uint64_t size = 0, type = 0, texts = 0;
        PILEUS_TRY(text("name of an attribute", name));
        PILEUS_TRY(number("size of an attribute", 2, size));
        PILEUS_TRY(number("type of an attribute", 4, type));
        const std::string wrong = attributes_.add(name, size);
        if (!wrong.empty()) return in_.fault(wrong);
        floats_.resize(std::size_t(attributes_.numbers()), type == kGeoFloat || type == kGeoVector);
        if (type == kGeoFloat || type == kGeoInt || type == kGeoVector)
            return in_.skip(4 * size, "defaults of an attribute");
        if (type != kGeoIndex)
            return in_.fault("attribute " + name + ": no such type, " + std::to_string(type) +
                             ", allowed: 0, 1, 4 and 5");
        PILEUS_TRY(number("texts of an attribute", 4, texts));
        for (std::uint64_t i = 0; i < texts; ++i) PILEUS_TRY(text("text of an attribute", passed));
        return Status::ok();
    }

    const std::string& file_;
    ByteCursor in_;
    ParticleAttributes attributes_;
    std::vector<bool> floats_;  ///< each number of a point
};

class GeoText : private TextScan {
public:
    GeoText(const std::string& file, Span<const char> text)
        : TextScan(file, text, ')'), rest_{0, text_.size} {}

    Status read(const ParticleReading& reading, ParticleSet& set) {
        PILEUS_TRY(head());
        (void)attributes_.add("P", 3);
        (void)attributes_.add("", 1);
        if (own_ > 0) PILEUS_TRY(expect("PointAttrib"));
        for (std::int64_t i = 0; i < own_; ++i) PILEUS_TRY(attribute());
        // A number is a digit and a space.
        if (points_ > std::int64_t((rest_.end - rest_.at + 1) / (2 * attributes_.numbers())))
            return fault(rest_.at,
                         "points: more than the file can hold, " + std::to_string(points_));
        const TextRange first = rest_;
        return read_particle_rows(file_, attributes_, std::uint64_t(points_), reading, set,
                                  [&](std::uint64_t i, std::vector<double>& row) {
                                      if (i == 0) rest_ = first;
                                      return point(row);
                                  });
    }

private:
    void pass_space() {
        while (rest_.at < rest_.end && is_text_space(text_[rest_.at])) ++rest_.at;
    }
    /// The next word, or text in quotes; `from` is where it begins.
    Status word(std::string& value, std::size_t& from) {
        pass_space();
        from = rest_.at;
        if (rest_.at == rest_.end) return fault(from, "ends too early, nothing, allowed: a word");
        const bool quoted = text_[from] == '"';
        if (quoted) ++rest_.at;
        value.clear();
        for (; rest_.at < rest_.end; ++rest_.at) {
            if (quoted ? text_[rest_.at] == '"' : is_text_space(text_[rest_.at])) break;
            if (quoted && text_[rest_.at] == '\\' && rest_.at + 1 < rest_.end) ++rest_.at;
            value += text_[rest_.at];
        }
        if (quoted && rest_.at < rest_.end) ++rest_.at;
        return Status::ok();
    }
    Status expect(const char* wanted) {
        std::string found;
        std::size_t from = 0;
        PILEUS_TRY(word(found, from));
        return found == wanted
                   ? Status::ok()
                   : fault(from, token(from, rest_.at) + ": unknown, allowed: " + wanted);
    }
    Status expect(char wanted) {
        pass_space();
        if (rest_.at == rest_.end || text_[rest_.at] != wanted)
            return fault(rest_.at, std::string("point: no '") + wanted +
                                       "', allowed: numbers of "
                                       "its attributes in parentheses");
        ++rest_.at;
        return Status::ok();
    }
    Status whole(const char* what, std::int64_t& value) {
        pass_space();
        const std::size_t from = rest_.at;
        PILEUS_TRY(number(rest_, what, value));
        if (value < 0 || value > 0xffffffffll)
            return fault(from, std::string(what) + ": out of range, " + std::to_string(value) +
                                   ", allowed: 0 to 4294967295");
        return Status::ok();
    }
    Status head() {
        PILEUS_TRY(expect("PGEOMETRY"));
        PILEUS_TRY(expect("V5"));
        const struct {
            const char* name;
            std::int64_t* to;
        } kCounts[] = {{"NPoints", &points_},     {"NPrims", nullptr},
                       {"NPointGroups", nullptr}, {"NPrimGroups", nullptr},
                       {"NPointAttrib", &own_},   {"NVertexAttrib", nullptr},
                       {"NPrimAttrib", nullptr},  {"NAttrib", nullptr}};
        for (const auto& count : kCounts) {
            std::int64_t passed = 0;
            PILEUS_TRY(expect(count.name));
            PILEUS_TRY(whole(count.name, count.to != nullptr ? *count.to : passed));
        }
        return Status::ok();
    }
    Status attribute() {
        std::string name, type, passed;
        std::size_t from = 0, at = 0;
        std::int64_t size = 0, texts = 0;
        PILEUS_TRY(word(name, from));
        PILEUS_TRY(whole("size of an attribute", size));
        PILEUS_TRY(word(type, at));
        const std::string wrong = attributes_.add(name, std::uint64_t(size));
        if (!wrong.empty()) return fault(from, wrong);
        if (type == "index") {
            PILEUS_TRY(whole("texts of an attribute", texts));
            for (std::int64_t i = 0; i < texts; ++i) PILEUS_TRY(word(passed, at));
            return Status::ok();
        }
        if (type != "float" && type != "int" && type != "vector")
            return fault(
                at, token(at, rest_.at) + ": no such type, allowed: float, int, vector or index");
        double number_passed = 0;
        for (std::int64_t i = 0; i < size; ++i) {
            pass_space();
            PILEUS_TRY(number(rest_, "defaults of an attribute", number_passed));
        }
        return Status::ok();
    }
    Status point(std::vector<double>& row) {
        for (std::size_t n = 0; n < row.size(); ++n) {
            if (n == 4) PILEUS_TRY(expect('('));
            pass_space();
            PILEUS_TRY(number(rest_, "point", row[n]));
        }
        return row.size() > 4 ? expect(')') : Status::ok();
    }

    TextRange rest_;
    ParticleAttributes attributes_;
    std::int64_t points_ = 0, own_ = 0;
};

}  // namespace

Status decode_particle_geo(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set) {
    const auto begins = [&](const char* text) {
        const std::size_t length = std::strlen(text);
        return bytes.size >= length && std::memcmp(bytes.data, text, length) == 0;
    };
    if (begins("Bgeo")) return GeoBytes(name, bytes).read(reading, set);
    if (begins("PGEOMETRY")) return GeoText(name, bytes).read(reading, set);
    const ByteCursor in(name, bytes);
    if (begins("\x7fNSJ") || begins("[")) return in.fault(kNewer);
    return in.fault("magic: not Houdini's classic geometry, allowed: Bgeo or PGEOMETRY");
}

}  // namespace pileus
