// SPDX-License-Identifier: Apache-2.0
// GRIB files that lie: lengths, sections, bitmaps and packed values are counted before ecCodes,
// which takes them at their word, gets a message. in: the stored messages of the fuzz target,
// changed -> out: pass or fail WMO, Manual on Codes, FM 92 GRIB; docs/weather.md, "Files";
// docs/testing.md, label weather
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "src/base/reading_limit.h"
#include "src/io/netcdf/grib_message.h"
#include "src/io/netcdf/netcdf_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;

namespace {

/// Messages of 6 times 4 points.
constexpr std::uint64_t kX = 6, kY = 4;

std::string stored(const std::string& name) {
    std::ifstream file("tests/fuzz/corpus/grib/" + name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    REQUIRE_MESSAGE(bytes.size() > 16, name);
    return bytes;
}

void put(std::string& bytes, std::size_t at, std::uint64_t value, unsigned count) {
    for (unsigned i = count; i-- > 0; value >>= 8) bytes[at + i] = char(value & 0xff);
}

struct Walked {
    Status status;
    std::vector<std::string> messages, faults;  ///< of values, one for each message
    std::vector<std::size_t> numbers;
};

/// What may be handed on of a file, each message checked by the manual alone.
Walked walk(const std::string& bytes) {
    Walked all;
    const std::string name = "w.grib";
    GribWalk walk(name, Span<const char>{bytes.data(), bytes.size()});
    for (;;) {
        bool more = false;
        all.status = walk.next(more);
        if (!all.status || !more) break;
        const Span<const unsigned char> m = walk.message();
        const std::string text(reinterpret_cast<const char*>(m.data), m.size);
        const bool first = m[7] == 1;
        REQUIRE(m.size >= 51);
        REQUIRE(text.substr(0, 4) == "GRIB");
        REQUIRE(text.substr(m.size - 4) == "7777");
        REQUIRE(grib_number(m, first ? 4 : 8, first ? 3 : 8) == m.size);
        // Sections, as far as they are there, fill it without a gap.
        std::size_t sum = first ? 12 : 20;
        for (const auto& section : walk.sections().of) {
            sum += section.size;
            if (section.size > 0) CHECK(grib_number(section, 0, first ? 3 : 4) == section.size);
        }
        CHECK(sum == m.size);
        all.messages.push_back(text);
        all.faults.push_back(grib_values_fault(walk.sections(), kX, kY));
        all.numbers.push_back(walk.number());
    }
    if (!all.status) {
        CHECK(all.status.message.rfind("w.grib: GRIB: message ", 0) == 0);
        CHECK(all.status.message.find('\n') == std::string::npos);
    }
    return all;
}

bool refused(const std::string& bytes) { return !walk(bytes).status; }

}  // namespace

TEST_CASE("grib damage: a length is at least that of the sections and at most what is left") {
    for (const char* name : {"simple", "edition1"}) {
        const std::string good = stored(name);
        CHECK(walk(good).messages == std::vector<std::string>{good});
        const bool first = good[7] == 1;
        for (std::uint64_t length = 0; length < 2 * good.size(); ++length) {
            std::string other = good;
            put(other, first ? 4 : 8, length, first ? 3 : 8);
            CHECK(refused(other) == (length != good.size()));
            // More bytes behind do not help.
            other += std::string(400, '\0');
            CHECK(refused(other) == (length != good.size()));
        }
        for (const std::uint64_t length : {std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
            std::string other = good;
            put(other, first ? 4 : 8, length, first ? 3 : 8);
            CHECK(refused(other));
        }
        for (int edition = 0; edition < 256; ++edition) {
            std::string other = good;
            other[7] = char(edition);
            CHECK(refused(other) == (edition != good[7]));
        }
    }
    const Walked least = walk(stored("short_length"));
    CHECK(least.status.message.find("damaged or cut short, length: 1 bytes, allowed: 86 to the ") !=
          std::string::npos);
}

TEST_CASE("grib damage: any byte changed, any byte missing") {
    for (const char* name : {"simple", "edition1", "edition1_bitmap", "hybrid", "fields"}) {
        const std::string good = stored(name);
        for (std::size_t n = 1; n < good.size(); ++n) CHECK(refused(good.substr(0, n)));
        // What is not refused is sound, which `walk` sees to.
        for (std::size_t n = 0; n < good.size(); ++n)
            for (const int change : {1, 2, 0x40, 0x80, 0xff}) {
                std::string other = good;
                other[n] = char(other[n] ^ change);
                walk(other);
            }
    }
}

TEST_CASE("grib damage: between messages there are zeros or nothing") {
    const std::string one = stored("simple"), two = stored("edition1");
    CHECK(walk(one + two).numbers == std::vector<std::size_t>{0, 1});
    CHECK(walk(one + std::string(5000, '\0') + two + std::string(9, '\0')).messages.size() == 2);
    for (const std::string& between : {std::string("7"), std::string("\r\r\n"), std::string("GRI")})
        for (const std::string& bytes : {one + between, one + between + two, between + one})
            CHECK(refused(bytes));
    CHECK(walk(one + "junk")
              .status.message.find("byte 215: no message begins there, allowed: GRIB, or zeros") !=
          std::string::npos);
}

TEST_CASE("grib damage: several fields of a message become a message each") {
    const Walked all = walk(stored("fields"));
    REQUIRE_MESSAGE(all.status, all.status.message);
    REQUIRE(all.messages.size() == 2);
    CHECK(all.numbers == std::vector<std::size_t>{0, 0});
    CHECK(all.messages[0].size() == all.messages[1].size());  // the bitmap went along
    CHECK(all.messages[0] != all.messages[1]);                // levels differ
    CHECK(all.faults == std::vector<std::string>{"", ""});
    // Without a field before there is no bitmap of it.
    std::string alone = stored("simple");
    const std::size_t bitmap = alone.find(std::string("\0\0\0\6\6\xff", 6));
    REQUIRE(bitmap != std::string::npos);
    put(alone, bitmap + 5, 254, 1);
    CHECK(refused(alone));
}

TEST_CASE("grib damage: values are as many, and take as many bytes, as the sections say") {
    for (const char* name : {"simple", "bitmap", "complex", "differences", "jpeg", "png", "ccsds",
                             "ieee", "edition1", "edition1_bitmap"}) {
        const std::string good = stored(name);
        INFO(name);
        CHECK(walk(good).faults == std::vector<std::string>{""});
        GribSections sections;
        const std::string file = "w.grib";
        GribWalk one(file, Span<const char>{good.data(), good.size()});
        bool more = false;
        REQUIRE(one.next(more));
        sections = one.sections();
        CHECK(grib_values_fault(sections, kX + 1, kY) != "");
        CHECK(grib_values_fault(sections, kX, kY - 1) != "");
        CHECK(grib_values_fault(sections, kY, kX) != "");
        CHECK(grib_values_fault(sections, std::uint64_t{1} << 40, std::uint64_t{1} << 40) != "");
        // A byte less of values.
        Span<const unsigned char>& data = sections.of[sections.edition == 1 ? 4 : 7];
        data = data.part(0, data.size - 1);
        const std::string packing = name;
        if (packing != "ccsds" && packing != "jpeg")
            CHECK(grib_values_fault(sections, kX, kY) != "");
    }
    CHECK(walk(stored("edition1_second_order")).faults[0] ==
          "packing: not simple, allowed: simple (grib_set -r -s packingType=grid_simple)");
    // Any byte of a section changed: a fault or none, and no byte outside of it is looked at.
    for (const char* name : {"complex", "differences", "jpeg", "png", "ccsds", "bitmap"}) {
        const std::string good = stored(name);
        for (std::size_t n = 109; n < good.size(); ++n)
            for (const int change : {1, 0x10, 0x80, 0xff}) {
                std::string other = good;
                other[n] = char(other[n] ^ change);
                walk(other);
            }
    }
}

TEST_CASE("grib damage: each count of a packing") {
    // Section 5 of the stored messages begins at byte 143, in the numbering from 0.
    const auto fault = [](const char* name, std::size_t octet, std::uint64_t value,
                          unsigned bytes) {
        std::string other = stored(name);
        const std::size_t at = 16 + 21 + 72 + 34;
        REQUIRE(other[at + 4] == 5);
        put(other, at + octet - 1, value, bytes);
        const Walked all = walk(other);
        return all.faults.empty() ? all.status.message : all.faults[0];
    };
    CHECK(fault("simple", 6, 23, 4) == "packed values: 23, allowed: 24");
    CHECK(fault("simple", 6, 0xffffffff, 4) == "packed values: 4294967295, allowed: 24");
    CHECK(fault("simple", 20, 13, 1) == "values: 36 bytes, allowed: at least 39");
    CHECK(fault("simple", 20, 255, 1) == "bits per value: 255, allowed: 0 to 32");
    CHECK(fault("simple", 10, 61, 2).rfind("packing: template 5.61, allowed: 5.0", 0) == 0);
    CHECK(fault("simple", 10, 3, 2) == "section 5: length: 21 bytes, allowed: at least 49");
    CHECK(fault("bitmap", 6, 24, 4) == "packed values: 24, allowed: 22");
    CHECK(fault("ieee", 12, 2, 1) == "values: 96 bytes, allowed: at least 192");
    CHECK(fault("complex", 32, 0xffffffff, 4) == "groups: 4294967295, allowed: 0 to 24");
    CHECK(fault("complex", 36, 32, 1).rfind("width of a group: ", 0) == 0);
    CHECK(fault("complex", 43, 25, 4).rfind("length of a group: 25", 0) == 0);
    CHECK(fault("differences", 48, 3, 1) == "order of differences: 3, allowed: 0 to 2");
    CHECK(fault("differences", 49, 9, 1) == "bytes of a difference: 9, allowed: 1 to 4");
    CHECK(fault("ccsds", 23, 7, 1) == "block of CCSDS: 7, allowed: 8, 16, 32 or 64");
    CHECK(fault("png", 20, 8, 1) == "bits of a pixel of a PNG: 16, allowed: 8");
    std::string wide = stored("jpeg");
    const std::size_t size = wide.find("\xff\x51");
    REQUIRE(size != std::string::npos);
    put(wide, size + 6, 600, 4);
    CHECK(walk(wide).faults[0] == "pixels of JPEG 2000: 2400, allowed: 24");
}

TEST_CASE("grib damage: dates, units of time and forecast times that there are") {
    const auto fault = [](const char* name, std::size_t at, std::uint64_t value, unsigned bytes) {
        std::string other = stored(name);
        put(other, at, value, bytes);
        const std::string file = "w.grib";
        GribWalk one(file, Span<const char>{other.data(), other.size()});
        bool more = false;
        REQUIRE(one.next(more));
        return grib_time_fault(one.sections());
    };
    const std::size_t date = 16 + 14, product = 16 + 21 + 72;
    CHECK(fault("simple", date, 6, 1) == "");
    CHECK(fault("simple", date, 13, 1) == "month: 13, allowed: 1 to 12");
    CHECK(fault("simple", date + 1, 0, 1) == "day: 0, allowed: 1 to 31");
    CHECK(fault("simple", date + 2, 25, 1) == "hour: 25, allowed: 0 to 24");
    CHECK(fault("simple", date + 3, 60, 1) == "minute: 60, allowed: 0 to 59");
    CHECK(fault("simple", date + 4, 61, 1) == "second: 61, allowed: 0 to 60");
    CHECK(fault("simple", product + 7, 20, 2).rfind("product: template 4.20, allowed: 4.0", 0) ==
          0);
    for (unsigned unit = 0; unit < 256; ++unit) {
        const bool known = unit <= 2 || (unit >= 10 && unit <= 13);
        CHECK((fault("simple", product + 17, unit, 1) == "") == known);
        const bool of_first = known || unit == 14 || unit == 254;
        CHECK((fault("edition1", 8 + 17, unit, 1) == "") == of_first);
    }
    // A century of hours.
    CHECK(fault("simple", product + 18, 878400, 4) == "");
    CHECK(fault("simple", product + 18, 878401, 4) ==
          "forecast time: 878401, allowed: 0 to 878400");
    CHECK(fault("edition1", 8 + 13, 0, 1) == "month: 0, allowed: 1 to 12");
}

TEST_CASE("grib damage: every packing gives its values") {
    if (grib_library_text() == "GRIB no") return;
    for (const char* name : {"simple", "complex", "differences", "jpeg", "png", "ccsds", "ieee",
                             "edition1", "bitmap", "edition1_bitmap"}) {
        INFO(name);
        const std::string bytes = stored(name);
        Buffer<char> made;
        const Status status = decode_grib("w.grib", {bytes.data(), bytes.size()}, made);
        REQUIRE_MESSAGE(status, status.message);
        NcFile file;
        REQUIRE(file.open_bytes("w.grib", made.span()));
        const NcVariable* t = file.head().find("t");
        REQUIRE((t != nullptr));
        double values[kX * kY];
        REQUIRE(file.read(*t, whole_block(file.head(), *t), {values, kX * kY}));
        // 280 to 291 twice, the last 295; rows from north to south in the file.
        const bool holes = std::string(name).find("bitmap") != std::string::npos;
        for (std::size_t i = 0; i < kX * kY; ++i) {
            const double wanted = i == 23 ? 295 : 280 + double(i % 12);
            if (holes && (i == 2 || i == 13))
                CHECK(values[i] > 1e30);
            else
                CHECK(values[i] == doctest::Approx(wanted).epsilon(1e-6));
        }
    }
}

TEST_CASE("grib damage: a file is refused in one line, with ecCodes and without") {
    const test::TempFolder folder;
    const std::string good = stored("simple");
    for (std::uint64_t length = 0; length < 20; ++length) {
        std::string other = good;
        put(other, 8, length, 8);
        NcFile file;
        const Status status = file.open(folder.put("w.grib", other));
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.find('\n') == std::string::npos);
    }
    if (grib_library_text() == "GRIB no") return;
    NcFile file;
    const Status whole = file.open(folder.put("w.grib", stored("levels")));
    CHECK_MESSAGE(whole, whole.message);
    // One value everywhere takes no bytes, so that a small file may ask for gigabytes.
    std::string flat = good;
    put(flat, 16 + 21 + 6, 1 << 28, 4);
    put(flat, 16 + 21 + 30, 1 << 14, 4);
    put(flat, 16 + 21 + 34, 1 << 14, 4);
    put(flat, 16 + 21 + 72 + 34 + 5, 1 << 28, 4);
    put(flat, 16 + 21 + 72 + 34 + 19, 0, 1);
    Limits limits;
    limits[LimitId::kMemory] = std::uint64_t{1} << 30;
    const ReadingLimit readers(limits);
    NcFile large;
    const Status status = large.open(folder.put("w.grib", flat));
    CHECK(status.code == Code::kLimit);
    CHECK(status.message.find("limits.memory: needs") != std::string::npos);
}
