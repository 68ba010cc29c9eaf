// SPDX-License-Identifier: Apache-2.0
// Whatever is unpacked: gzip by members, nothing behind them, and the limit of memory before any is
// taken.
// in: files made by hand -> out: pass or fail
// RFC 1950 to 1952; docs/particles.md, "Data"; docs/program.md, "Limits"; docs/testing.md, label io
#include <doctest/doctest.h>

#include "platform/memory.h"
#include "src/base/reading_limit.h"
#include "src/io/images/image_file.h"
#include "src/io/particles/placed_particles.h"
#include "src/io/text/packed_bytes.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

std::string little(std::uint64_t value, unsigned bytes) {
    std::string text;
    for (unsigned i = 0; i < bytes; ++i, value >>= 8) text += char(value & 0xff);
    return text;
}

std::uint32_t crc_of(const std::string& text) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : text) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1)));
    }
    return ~crc;
}

const std::string kGzipHead("\x1f\x8b\x08\0\0\0\0\0\0\x03", 10);

/// A block that is stored as it stands.
std::string stored_block(const std::string& text) {
    return '\x01' + little(text.size(), 2) + little(~text.size(), 2) + text;
}
std::string gzip_of(const std::string& text) {
    return kGzipHead + stored_block(text) + little(crc_of(text), 4) + little(text.size(), 4);
}

/// A member that gives `runs` times 258 spaces, by 13 bits each, and has no end.
std::string bomb_of(int runs) {
    std::string bytes = kGzipHead;
    unsigned held = 0, count = 0;
    const auto bits = [&](unsigned value, int number, bool code) {
        for (int i = 0; i < number; ++i) {
            held |= (value >> (code ? number - 1 - i : i) & 1) << count;
            if (++count < 8) continue;
            bytes += char(held);
            held = count = 0;
        }
    };
    bits(3, 3, false);              // the last block, of fixed codes
    bits(0x30 + ' ', 8, true);      // a space
    for (int i = 0; i < runs; ++i)  // 258 bytes again, from one byte before
        bits(0xc5, 8, true), bits(0, 5, true);
    return bytes;
}

Status decode(const std::string& bytes, ParticleSet& set) {
    return decode_particles("p.csv.gz", ".csv", {bytes.data(), bytes.size()}, ParticleReading{},
                            set);
}
bool has_zlib() {
    if (holds(packing_library_text(), "zlib yes")) return true;
    MESSAGE("left out: zlib is not in this build");
    return false;
}

/// Memory of the machine, and the most of it that was held at once.
struct Watched {
    std::size_t held = 0, most = 0;
    Allocator allocator{
        [](void* user, std::size_t bytes, std::size_t alignment) -> void* {
            Watched& w = *static_cast<Watched*>(user);
            char* memory = static_cast<char*>(std::aligned_alloc(alignment, bytes + alignment));
            std::memcpy(memory, &bytes, sizeof bytes);
            w.held += bytes;
            w.most = std::max(w.most, w.held);
            return memory + alignment;
        },
        [](void* user, void* memory) {
            char* begin = static_cast<char*>(memory) - 64;
            std::size_t bytes = 0;
            std::memcpy(&bytes, begin, sizeof bytes);
            static_cast<Watched*>(user)->held -= bytes;
            std::free(begin);
        },
        this};
};

}  // namespace

TEST_CASE("packed files: members of gzip are one text") {
    if (!has_zlib()) return;
    const std::string one = gzip_of("x,y,z,radius\n1,2,3,4\n"), two = gzip_of("5,6,7,8\n"),
                      none = gzip_of(""), half = gzip_of("9,9,9,");
    ParticleSet set;
    for (const std::string& bytes :
         {one + two, none + one + none + none + two, one + two + std::string(1, '\0'),
          one + two + std::string(5000, '\0')}) {
        const Status status = decode(bytes, set);
        REQUIRE_MESSAGE(status, status.message);
        REQUIRE(set.count == 2);
        CHECK(set.radius[1] == 8.0f);
    }
    // A row may go on in the next member.
    REQUIRE(decode(one + half + gzip_of("5\n"), set));
    CHECK(set.radius[1] == 5.0f);
    for (std::size_t n = 1; n < two.size(); ++n)
        CHECK(holds(decode(one + two.substr(0, n), set).message, "p.csv.gz: byte 0: gzip: "));
}

TEST_CASE("packed files: nothing but members and zeros") {
    if (!has_zlib()) return;
    const std::string one = gzip_of("x,y,z,radius\n1,2,3,4\n");
    ParticleSet set;
    for (const std::string& junk :
         {std::string("j"), std::string("junk"), std::string("\x1f"), std::string("\x1f\x8c"),
          std::string(8, '\0') + "j", std::string(8, '\0') + one, std::string("1,2,3,4\n")}) {
        const Status status = decode(one + junk, set);
        CHECK(status.code == Code::kBadInput);
        CHECK(holds(status.message, "gzip: no member begins at packed byte " +
                                        std::to_string(one.size()) +
                                        ", allowed: members, or zeros"));
    }
}

TEST_CASE("packed files: a gigabyte out of little is refused before its memory is taken") {
    if (!has_zlib()) return;
    const test::TempFolder folder;
    const std::string bomb = bomb_of(40000);  // 65 kB, 10.3 MB unpacked
    const std::string path = folder.put("p.csv.gz", bomb);
    Limits limits;
    limits[LimitId::kMemory] = 1'000'000;
    Watched watched;
    Host host;
    host.allocator = &watched.allocator;
    ParticleSet set;
    {
        const HostGuard guard(host);
        const ReadingLimit readers(limits);
        const Status status = read_placed_particles(MediumSettings{}, path, set);
        CHECK(status.code == Code::kLimit);
        CHECK(holds(status.message, "p.csv.gz: limits.memory: needs "));
        CHECK(holds(status.message, "allowed: at most 1000000 bytes (--limit memory=...)"));
    }
    CHECK(watched.most < 100'000);
    CHECK(watched.held == 0);
    // Where there is room, it is only damaged.
    CHECK(holds(decode(bomb, set).message, "gzip: damaged or cut off"));
}

TEST_CASE("packed files: the limit counts the file, the text and the particles") {
    if (!has_zlib()) return;
    const test::TempFolder folder;
    std::string text = "x,y,z,radius\n";
    for (int i = 0; i < 100; ++i) text += "1,2,3,4\n";
    const std::string packed = gzip_of(text);
    const std::string path = folder.put("p.csv.gz", packed), plain = folder.put("p.csv", text);
    const std::uint64_t needed = packed.size() + text.size() + 100 * 16;
    ParticleSet set;
    const auto code = [&](const std::string& from, std::uint64_t most) {
        Limits limits;
        limits[LimitId::kMemory] = most;
        const ReadingLimit readers(limits);
        return read_placed_particles(MediumSettings{}, from, set).code;
    };
    CHECK(code(path, needed) == Code::kOk);
    for (const std::uint64_t most : {needed - 1, packed.size() + text.size(), packed.size(),
                                     packed.size() - 1, std::uint64_t{0}})
        CHECK(code(path, most) == Code::kLimit);
    CHECK(code(plain, text.size() + 1600) == Code::kOk);
    CHECK(code(plain, text.size() + 1599) == Code::kLimit);
    // Nothing stays behind a guard.
    CHECK(reading_room() == std::uint64_t{1} << 34);
}

TEST_CASE("packed files: a block of zlib is all that stands there") {
    if (!has_zlib()) return;
    const std::string text = "abcd";
    std::uint32_t a = 1, b = 0;
    for (const char c : text) a += unsigned(c), b += a;
    std::string block = "\x78\x01" + stored_block(text);
    for (const unsigned shift : {24u, 16u, 8u, 0u}) block += char((b << 16 | a) >> shift & 0xff);
    const std::string name = "v";
    const ByteCursor in(name, {block.data(), block.size()});
    unsigned char to[4];
    const auto unpack = [&](const std::string& bytes) {
        return inflate_block(in, false, reinterpret_cast<const unsigned char*>(bytes.data()),
                             bytes.size(), to, sizeof to);
    };
    CHECK(unpack(block));
    CHECK(std::string(reinterpret_cast<char*>(to), 4) == text);
    CHECK(holds(unpack(block + "junk").message,
                "packed values: 4 bytes behind their end, allowed: none"));
    CHECK_FALSE(bool(unpack(block.substr(0, block.size() - 1))));
}

TEST_CASE("packed files: pictures keep to the limit of memory") {
    Image image;
    image.width = image.height = 32;
    image.channels.resize(1);
    image.channels[0].name = "R";
    REQUIRE(image.channels[0].pixels.resize(1024, "pixels"));
    Buffer<char> exr, png;
    const Buffer<std::uint8_t> colours = [] {
        Buffer<std::uint8_t> own;
        (void)own.resize(3 * 1024, "pixels");
        return own;
    }();
    const bool made[2] = {bool(encode_exr(image, exr)),
                          bool(encode_png(32, 32, colours.span(), png))};
    const auto code = [&](bool of_exr, std::uint64_t most) {
        Limits limits;
        limits[LimitId::kMemory] = most;
        const ReadingLimit readers(limits);
        Image read;
        return (of_exr ? decode_exr("p", exr.span(), read) : decode_png("p", png.span(), read))
            .code;
    };
    if (made[0]) CHECK(code(true, 4096) == Code::kOk);
    if (made[0]) CHECK(code(true, 4095) == Code::kLimit);
    if (made[1]) CHECK(code(false, 20 * 1024) == Code::kOk);
    if (made[1]) CHECK(code(false, 20 * 1024 - 1) == Code::kLimit);
}
