// SPDX-License-Identifier: Apache-2.0
// Particles from a Krakatoa PRT file.
// in: a head, a list of channels, then all particles packed by zlib -> out: a ParticleSet.
// Thinkbox Software, "PRT File Format Specification"; docs/particles.md, "Data".
#include <cstring>

#include "src/base/reading_limit.h"
#include "src/io/particles/particle_rows.h"
#include "src/io/text/byte_cursor.h"
#include "src/io/text/packed_bytes.h"

namespace pileus {
namespace {

constexpr unsigned char kMagic[8] = {192, 'P', 'R', 'T', '\r', '\n', 26, '\n'};
constexpr std::uint32_t kHeadBytes = 56, kChannelBytes = 44;
constexpr std::uint32_t kMaxPrtChannels = 256, kMaxStride = 4096;
/// zlib makes at most so many bytes of one.
constexpr std::uint64_t kMaxRatio = 1032;
constexpr std::uint64_t kMaxUnpacked = std::uint64_t{1} << 34;

/// Bytes of a number by its type, and whether it is a float, or a whole number with a sign.
struct PrtType {
    unsigned bytes;
    bool floats, with_sign;
};
constexpr PrtType kTypes[] = {{2, false, true},  {4, false, true},  {8, false, true},
                              {2, true, true},   {4, true, true},   {8, true, true},
                              {2, false, false}, {4, false, false}, {8, false, false},
                              {1, false, true},  {1, false, false}};

double number_at(const unsigned char* from, const PrtType& type) {
    if (type.floats && type.bytes < 8) return double(packed_number(from, type.bytes));
    std::uint64_t bits = 0;
    for (unsigned i = type.bytes; i-- > 0;) bits = bits << 8 | from[i];
    if (type.floats) {
        double value;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    const unsigned unused = 64 - 8 * type.bytes;
    if (!type.with_sign) return double(bits);
    // The sign's bit counts as minus its place.
    const std::uint64_t top = std::uint64_t{1} << (63 - unused);
    return (bits & top) != 0 ? double(bits - top) - double(top) : double(bits);
}

/// Channels that are read, and what their numbers are to ParticleRows. Colours may be above 1 here
/// and are passed.
struct ChannelName {
    const char* name;
    const char* columns[3];
};
constexpr ChannelName kNames[] = {
    {"Position", {"x", "y", "z"}},
    {"Radius", {"radius", nullptr, nullptr}},
    {"Size", {"radius", nullptr, nullptr}},
    {"Density", {"density", nullptr, nullptr}},
    {"Velocity", {"vx", "vy", "vz"}},
    {"ID", {"id", nullptr, nullptr}},
    {"Emission", {"emission_red", "emission_green", "emission_blue"}}};

struct Slot {
    PrtType type{};
    std::uint32_t offset = 0;
};

class Reader {
public:
    Reader(const std::string& file, Span<const char> bytes) : file_(file), in_(file, bytes) {}

    Status read(const ParticleReading& reading, ParticleSet& set) {
        PILEUS_TRY(head());
        PILEUS_TRY(channels());
        if (count_ > kMaxUnpacked / stride_ || count_ * stride_ / kMaxRatio > in_.left())
            return in_.fault("particles: more than the file can hold, " + std::to_string(count_) +
                             " of " + std::to_string(stride_) + " bytes");
        ParticleRows rows(file_, set);
        PILEUS_TRY(rows.begin(columns_, count_, reading));
        const std::uint64_t size = count_ * stride_;
        PILEUS_TRY(check_reading(file_, size));
        PILEUS_TRY(data_.resize(size, "unpacked particles"));
        if (size > 0) {
            const std::uint64_t packed = in_.left();
            const unsigned char* from = nullptr;
            PILEUS_TRY(in_.take(packed, "particles", from));
            PILEUS_TRY(inflate_block(in_, false, from, packed, data_.data(), size));
        }
        std::vector<double> row(slots_.size());
        const auto each = [&](auto visit) {
            for (std::uint64_t i = 0; i < count_; ++i) {
                for (std::size_t s = 0; s < slots_.size(); ++s)
                    row[s] =
                        number_at(data_.data() + i * stride_ + slots_[s].offset, slots_[s].type);
                PILEUS_TRY(visit(i, Span<const double>{row.data(), row.size()}));
            }
            return Status::ok();
        };
        PILEUS_TRY(each([&](std::uint64_t i, Span<const double> r) { return rows.measure(i, r); }));
        rows.measured();
        return each([&](std::uint64_t i, Span<const double> r) { return rows.keep(i, r); });
    }

private:
    Status head() {
        const unsigned char* from = nullptr;
        PILEUS_TRY(in_.take(sizeof kMagic, "magic", from));
        if (std::memcmp(from, kMagic, sizeof kMagic) != 0)
            return in_.fault("magic: not a PRT file, allowed: one that begins with C0 P R T");
        std::uint32_t bytes = 0;
        PILEUS_TRY(in_.u32("length of the head", bytes));
        if (bytes < kHeadBytes)
            return in_.fault("length of the head: too short, " + std::to_string(bytes) +
                             ", allowed: at least 56");
        PILEUS_TRY(in_.skip(36, "signature and version"));
        PILEUS_TRY(in_.u64("particles", count_));
        PILEUS_TRY(in_.skip(bytes - kHeadBytes, "head"));
        return in_.skip(4, "reserved");
    }
    Status channels() {
        std::uint32_t number = 0, bytes = 0;
        PILEUS_TRY(in_.u32("channels", number));
        PILEUS_TRY(in_.u32("length of a channel", bytes));
        if (number < 1 || number > kMaxPrtChannels || bytes < kChannelBytes || bytes > kMaxStride)
            return in_.fault("channels: out of range, " + std::to_string(number) + " of " +
                             std::to_string(bytes) + " bytes, allowed: 1 to 256 of 44 to 4096");
        for (std::uint32_t i = 0; i < number; ++i) {
            PILEUS_TRY(channel());
            PILEUS_TRY(in_.skip(bytes - kChannelBytes, "channel"));
        }
        return Status::ok();
    }
    Status channel() {
        const unsigned char* from = nullptr;
        PILEUS_TRY(in_.take(32, "channel", from));
        std::string name(reinterpret_cast<const char*>(from), 32);
        name.resize(std::strlen(name.c_str()));
        std::uint32_t type = 0, arity = 0, offset = 0;
        PILEUS_TRY(in_.u32("type of a channel", type));
        PILEUS_TRY(in_.u32("arity of a channel", arity));
        PILEUS_TRY(in_.u32("offset of a channel", offset));
        if (type >= sizeof kTypes / sizeof kTypes[0])
            return in_.fault("channel " + name + ": no such type, " + std::to_string(type) +
                             ", allowed: 0 to 10");
        const unsigned bytes = kTypes[type].bytes;
        if (arity < 1 || arity > kMaxStride || offset > kMaxStride ||
            offset + arity * bytes > kMaxStride)
            return in_.fault("channel " + name + ": too long, " + std::to_string(arity) + " at " +
                             std::to_string(offset) + ", allowed: within 4096 bytes");
        if (offset + arity * bytes > stride_) stride_ = offset + arity * bytes;
        for (const ChannelName& known : kNames) {
            if (name != known.name) continue;
            const std::uint32_t wanted = known.columns[1] != nullptr ? 3 : 1;
            if (arity != wanted)
                return in_.fault("channel " + name + ": wrong arity, " + std::to_string(arity) +
                                 ", allowed: " + std::to_string(wanted));
            for (std::uint32_t a = 0; a < arity; ++a) {
                columns_.push_back({known.columns[a]});
                slots_.push_back({kTypes[type], offset + a * bytes});
            }
        }
        return Status::ok();
    }

    const std::string& file_;
    ByteCursor in_;
    std::uint64_t count_ = 0, stride_ = 0;
    std::vector<ParticleColumn> columns_;
    std::vector<Slot> slots_;
    Buffer<unsigned char> data_;
};

}  // namespace

Status decode_particle_prt(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set) {
    return Reader(name, bytes).read(reading, set);
}

}  // namespace pileus
