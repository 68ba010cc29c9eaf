// SPDX-License-Identifier: Apache-2.0
// Particles from Maya's PDB (32 bits, little-endian) and PDA (text).
// in: channels, each of all particles; or a line for each -> out: a set.
// Autodesk Maya, Gifts/readpdb; as Partio reads them (PDB, PDA); docs/particles.md, "Files".
#include "src/io/particles/particle_rows.h"
#include "src/io/text/byte_cursor.h"
#include "src/io/text/text_scan.h"

namespace pileus {
namespace {

constexpr std::uint32_t kPdbMagic = 670;
enum PdbType { kPdbVector = 1, kPdbReal = 2, kPdbLong = 3 };

/// A column: where its first number stands, and how far it is to the next particle's.
struct PdbColumn {
    const unsigned char* first = nullptr;
    std::uint64_t step = 0;
    bool floats = true;
};

class PdbReader {
public:
    PdbReader(const std::string& file, Span<const char> bytes) : file_(file), in_(file, bytes) {}

    Status read(const ParticleReading& reading, ParticleSet& set) {
        std::uint32_t magic = 0, channels = 0;
        PILEUS_TRY(in_.u32("magic", magic));
        if (magic != kPdbMagic)
            return in_.fault("magic: not a PDB file, allowed: 670, of 4 bytes, little-endian");
        // Byte order, version, time.
        PILEUS_TRY(in_.skip(12, "head"));
        PILEUS_TRY(in_.u32("particles", count_));
        PILEUS_TRY(in_.u32("channels", channels));
        PILEUS_TRY(in_.skip(36, "head"));
        for (std::uint32_t i = 0; i < channels; ++i) PILEUS_TRY(channel());
        return read_particle_rows(file_, attributes_, count_, reading, set,
                                  [&](std::uint64_t i, std::vector<double>& row) {
                                      for (std::size_t n = 0; n < row.size(); ++n)
                                          row[n] = attribute_number(
                                              columns_[n].first + i * columns_[n].step, false,
                                              columns_[n].floats);
                                      return Status::ok();
                                  });
    }

private:
    Status name_of(std::string& name) {
        constexpr std::size_t kLongestName = 256;
        for (name.clear();;) {
            unsigned letter = 0;
            PILEUS_TRY(in_.u8("name of a channel", letter));
            if (letter == 0) return Status::ok();
            if (name.size() == kLongestName)
                return in_.fault("name of a channel: too long, allowed: at most 256 letters");
            name += char(letter);
        }
    }
    Status channel() {
        std::string name;
        std::uint32_t type = 0, bytes = 0;
        // A head of its own, then what Maya kept in memory: name, type, sizes, pointers.
        PILEUS_TRY(in_.skip(10, "channel"));
        PILEUS_TRY(in_.u32("type of a channel", type));
        PILEUS_TRY(in_.skip(28, "channel"));
        PILEUS_TRY(name_of(name));
        PILEUS_TRY(in_.skip(4, "channel"));
        PILEUS_TRY(in_.u32("bytes of a channel", bytes));
        PILEUS_TRY(in_.skip(12, "channel"));
        if (count_ * std::uint64_t(bytes) > in_.left())
            return in_.fault("channel " + name + ": more than the file can hold, " +
                             std::to_string(count_) + " of " + std::to_string(bytes) + " bytes");
        const unsigned char* from = nullptr;
        PILEUS_TRY(in_.take(count_ * std::uint64_t(bytes), "channel", from));
        const std::uint64_t size = bytes / 4;
        const bool numbers = (type == kPdbVector && bytes == 12) ||
                             ((type == kPdbReal || type == kPdbLong) && bytes == 4);
        // Others count, but have no number that is read.
        const std::string wrong = attributes_.add(numbers ? name : "", numbers ? size : 0);
        if (!wrong.empty()) return in_.fault(wrong);
        for (std::uint64_t i = 0; numbers && i < size; ++i)
            columns_.push_back({from + 4 * i, bytes, type != kPdbLong});
        return Status::ok();
    }

    const std::string& file_;
    ByteCursor in_;
    std::uint32_t count_ = 0;
    ParticleAttributes attributes_;
    std::vector<PdbColumn> columns_;
};

class PdaReader : private TextScan {
public:
    PdaReader(const std::string& file, Span<const char> text)
        : TextScan(file, text), rest_{0, text_.size} {}

    Status read(const ParticleReading& reading, ParticleSet& set) {
        PILEUS_TRY(head());
        std::int64_t count = 0;
        skip(rest_);
        const std::size_t from = rest_.at;
        PILEUS_TRY(number(rest_, "NUMBER_OF_PARTICLES", count));
        PILEUS_TRY(expect("BEGIN"));
        PILEUS_TRY(expect("DATA"));
        // A number is a digit and a space.
        const std::uint64_t room = (rest_.end - rest_.at + 1) /
                                   (2 * (attributes_.numbers() > 0 ? attributes_.numbers() : 1));
        if (count < 0 || std::uint64_t(count) > room)
            return fault(
                from, "NUMBER_OF_PARTICLES: more than the file can hold, " + std::to_string(count));
        const TextRange first = rest_;
        return read_particle_rows(file_, attributes_, std::uint64_t(count), reading, set,
                                  [&](std::uint64_t i, std::vector<double>& row) {
                                      if (i == 0) rest_ = first;
                                      for (double& v : row) {
                                          skip(rest_);
                                          PILEUS_TRY(number(rest_, "particle", v));
                                      }
                                      return Status::ok();
                                  });
    }

private:
    Status word(std::string& value) {
        skip(rest_);
        const std::size_t from = rest_.at;
        if (from == rest_.end) return fault(from, "ends too early, nothing, allowed: a word");
        while (rest_.at < rest_.end && !is_text_space(text_[rest_.at])) ++rest_.at;
        value.assign(text_.data + from, rest_.at - from);
        return Status::ok();
    }
    Status expect(const char* wanted) {
        std::string found;
        PILEUS_TRY(word(found));
        if (found == wanted) return Status::ok();
        return fault(rest_.at - found.size(),
                     token(rest_.at - found.size(), rest_.at) + ": unknown, allowed: " + wanted);
    }
    /// Names, then their types, V of three numbers, R and I of one.
    Status head() {
        PILEUS_TRY(expect("ATTRIBUTES"));
        std::vector<std::string> names;
        std::string next;
        for (;;) {
            PILEUS_TRY(word(next));
            if (next == "TYPES") break;
            if (names.size() == kMaxAttributes)
                return fault(rest_.at, "attributes: too many, allowed: at most " +
                                           std::to_string(kMaxAttributes));
            names.push_back(next);
        }
        for (const std::string& name : names) {
            PILEUS_TRY(word(next));
            const std::size_t from = rest_.at - next.size();
            if (next != "V" && next != "R" && next != "I")
                return fault(from, token(from, rest_.at) + ": no such type, allowed: V, R or I");
            const std::string wrong = attributes_.add(name, next == "V" ? 3 : 1);
            if (!wrong.empty()) return fault(from, wrong);
        }
        return expect("NUMBER_OF_PARTICLES:");
    }

    TextRange rest_;
    ParticleAttributes attributes_;
};

}  // namespace

Status decode_particle_pdb(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set) {
    return PdbReader(name, bytes).read(reading, set);
}

Status decode_particle_pda(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set) {
    return PdaReader(name, bytes).read(reading, set);
}

}  // namespace pileus
