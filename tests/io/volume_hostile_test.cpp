// SPDX-License-Identifier: Apache-2.0
// Files that claim more than they hold, or hold what no density is, cost a line and no memory.
// in: short files with vast claims, cut files, wrong numbers -> out: refusals; no large array.
// docs/testing.md S64; docs/formats.md
#include <doctest/doctest.h>

#include <cstdio>
#include <limits>

#include "platform/clock.h"
#include "src/io/volumes/volume_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;

namespace {

std::string pbrt_of(const std::string& nx, const std::string& ny, const std::string& nz) {
    return "Volume \"volumegrid\" \"integer nx\" " + nx + " \"integer ny\" " + ny +
           " \"integer nz\" " + nz + " \"float density\" [0.5 0.5]";
}

}  // namespace

TEST_CASE("volume: claims of 10^12 voxels and of overflowing products are refused without memory") {
    const test::TempFolder folder;
    const long long before = peak_memory_bytes();
    const char* const sides[][3] = {{"10000", "10000", "10000"},
                                    {"4096", "4096", "4096"},
                                    {"4096", "4096", "128"},
                                    {"2097152", "2097152", "2097152"},
                                    {"65536", "65536", "65536"},
                                    {"2147483647", "2147483647", "2147483647"},
                                    {"4294967296", "4294967296", "1"},
                                    {"9223372036854775807", "3", "3"},
                                    {"18446744073709551617", "1", "1"},
                                    {"-4096", "-4096", "16"}};
    for (const auto& s : sides) {
        Volume v;
        const Status status = read_pbrt_volume(folder.put("v.pbrt", pbrt_of(s[0], s[1], s[2])), v);
        CAPTURE(s[0]);
        CHECK((status.code == Code::kBadInput || status.code == Code::kLimit));
        VolumeHead head;
        MediumSettings medium;
        medium.source.format = "pbrt";
        (void)read_volume_head(medium, folder.path("v.pbrt"), head);
    }
    for (const std::array<int, 3>& size :
         {std::array<int, 3>{4096, 4096, 4096}, std::array<int, 3>{4096, 4096, 128},
          std::array<int, 3>{2147483647, 2147483647, 2147483647}, std::array<int, 3>{-1, -1, 4},
          std::array<int, 3>{1, 1, 1}})
        for (RawType type : {RawType::kUint8, RawType::kUint16, RawType::kFloat32}) {
            Volume v;
            const Status status =
                read_raw_volume(folder.put("v.raw", "12345678901"), type, size, false, v);
            CHECK((status.code == Code::kBadInput || status.code == Code::kLimit));
        }
    for (const char* text : {"10000,10000,10000\n", "4096,4096,128\n1,1\n1\n0,0,0,1\n",
                             "2147483647 2147483647 2147483647\n", "4294967297,1,1\n1,1\n0\n"}) {
        Volume v;
        MediumSettings les;
        les.source.format = "les";
        const Status status = read_volume(les, folder.put("v.txt", text), v);
        CAPTURE(text);
        CHECK((status.code == Code::kBadInput || status.code == Code::kLimit));
    }
    for (const std::int32_t side : {10000, 4096, 2147483647, -1, 0}) {
        std::string bytes("VOL\x03\x01\0\0\0", 8);
        const auto put = [&](std::int32_t n) {
            for (int i = 0; i < 4; ++i) bytes += char(std::uint32_t(n) >> 8 * i & 255);
        };
        put(side), put(side), put(side), put(1);
        bytes += std::string(24, '\0') + "12345678";
        Volume v;
        MediumSettings vol;
        vol.source.format = "vol";
        const Status status = read_volume(vol, folder.put("v.vol", bytes), v);
        CAPTURE(side);
        CHECK((status.code == Code::kBadInput || status.code == Code::kLimit));
    }
    // What files of fewer than a hundred bytes can fill is nothing beside 64 MiB.
    CHECK(peak_memory_bytes() - before < (64 << 20));
}

TEST_CASE("volume: raw files cut or lengthened by any number of bytes are refused") {
    const test::TempFolder folder;
    const std::string whole(4 * 3 * 2 * 5, '\0');
    Volume v;
    REQUIRE(read_raw_volume(folder.put("v.raw", whole), RawType::kFloat32, {3, 2, 5}, false, v));
    for (std::size_t n = 0; n < whole.size(); ++n)
        CHECK(read_raw_volume(folder.put("v.raw", whole.substr(0, n)), RawType::kFloat32, {3, 2, 5},
                              false, v)
                  .code == Code::kBadInput);
    for (std::size_t n = 1; n < 9; ++n)
        CHECK(read_raw_volume(folder.put("v.raw", whole + std::string(n, '\0')), RawType::kFloat32,
                              {3, 2, 5}, false, v)
                  .code == Code::kBadInput);
}

TEST_CASE("S64: one wrong number at any place of a raw file is found and named") {
    const test::TempFolder folder;
    // NaN of both signs and kinds, infinities, -1e-8 where all else is 0.
    const char* const wrong[] = {"\x00\x00\xc0\x7f", "\x01\x00\x80\x7f", "\x00\x00\xc0\xff",
                                 "\x00\x00\x80\x7f", "\x00\x00\x80\xff", "\x77\xcc\x2b\xb2"};
    for (std::size_t at : {0u, 1u, 13u, 23u})
        for (const char* bytes : wrong) {
            std::string text(4 * 24, '\0');
            text.replace(4 * at, 4, std::string(bytes, 4));
            Volume v;
            const Status status =
                read_raw_volume(folder.put("v.raw", text), RawType::kFloat32, {2, 3, 4}, false, v);
            CHECK(status.code == Code::kBadInput);
            CHECK(test::holds(status.message, ("(index " + std::to_string(at) + ")").c_str()));
        }
    // Minus zero and denormals are densities.
    std::string text(8, '\0');
    text[3] = '\x80', text[4] = '\x01';
    Volume v;
    REQUIRE(read_raw_volume(folder.put("v.raw", text), RawType::kFloat32, {2, 1, 1}, false, v));
    CHECK(v.density[0] == 0.0f);
    CHECK(v.density[1] == std::numeric_limits<float>::denorm_min());
}
