// SPDX-License-Identifier: Apache-2.0
// Fuzz target: weather data in GRIB files, through ecCodes where it was built in.
// in: bytes as a .grib file -> out: messages that are sound before the library gets them, and a
// sound NetCDF file, or one line. docs/weather.md, "Files"
#include <cstring>

#include "src/base/reading_limit.h"
#include "src/io/netcdf/grib_message.h"
#include "src/io/netcdf/netcdf_file.h"
#include "tests/fuzz/target.h"

namespace {

/// By the manual on codes alone, without the reader's own words.
void check_message(pileus::Span<const unsigned char> m) {
    fuzz::require(m.size >= 51, "a message holds its sections");
    const bool first = m[7] == 1;
    fuzz::require(first || m[7] == 2, "a message is of edition 1 or 2");
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < (first ? 3 : 8); ++i) length = length << 8 | m[(first ? 4 : 8) + i];
    fuzz::require(length == m.size || (first && length >= 0x800000),
                  "a message is as long as it says");
    fuzz::require(std::memcmp(m.data, "GRIB", 4) == 0, "a message begins with GRIB");
    fuzz::require(std::memcmp(m.data + m.size - 4, "7777", 4) == 0, "a message ends with 7777");
}

}  // namespace

int fuzz::grib(const std::uint8_t* data, std::size_t size) {
    using namespace pileus;
    const std::string name = "w.grib";
    // A field that is the same everywhere says of any number of values what it is.
    Limits limits;
    limits[LimitId::kMemory] = std::uint64_t{1} << 24;
    const ReadingLimit readers(limits);
    GribWalk walk(name, fuzz::text_of(data, size));
    for (bool more = true; more;) {
        const Status status = walk.next(more);
        if (!status) fuzz::check_fault(status, "w.grib:", true);
        if (!status) break;
        if (more) check_message(walk.message());
    }
    Buffer<char> bytes;
    const Status status = decode_grib(name, fuzz::text_of(data, size), bytes);
    if (!status) {
        fuzz::check_fault(status, "w.grib:", true);
        fuzz::require(status.message.find("gave") == std::string::npos,
                      "ecCodes does not give up what was checked");
        return 0;
    }
    NcFile file;
    fuzz::require(bool(file.open_bytes(name, bytes.span())), "fields become a NetCDF file");
    return 0;
}
