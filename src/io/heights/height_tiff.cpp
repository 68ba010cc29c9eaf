// SPDX-License-Identifier: Apache-2.0
// See height_map.h: GeoTIFF through libtiff, which is loaded when a scene has such a file.
// in: the bytes of a TIFF file, trusted in nothing -> out: samples, holes, where they lie.
// The only file that touches the library. OGC 19-008r4, "GeoTIFF"; docs/solids.md, "Height maps".
#include "src/io/heights/height_map.h"

#ifdef PILEUS_WITH_TIFF
#include <tiffio.h>

#include <cstring>
#include <limits>

#include "src/base/dynamic_library.h"
#include "src/base/number_text.h"
#include "src/base/printable.h"
#include "src/base/reading_limit.h"
#endif

namespace pileus {

#if defined(PILEUS_WITH_TIFF) && TIFFLIB_VERSION >= 20221213
namespace {

constexpr std::uint32_t kPixelScale = 33550, kTiepoint = 33922, kGeoKeys = 34735, kNoData = 42113;
constexpr int kKeyModelType = 1024, kKeyRasterType = 1025, kKeyLinearUnit = 3076;
constexpr int kGeographic = 2, kPixelIsPoint = 2, kUnitMetre = 9001;

/// The library while one file is read.
struct Library {
    decltype(&TIFFClientOpenExt) open = nullptr;
    decltype(&TIFFClose) close = nullptr;
    decltype(&TIFFGetField) get = nullptr;
    decltype(&TIFFGetFieldDefaulted) get_defaulted = nullptr;
    decltype(&TIFFFindField) find_field = nullptr;
    decltype(&TIFFFieldReadCount) read_count = nullptr;
    decltype(&TIFFFieldPassCount) pass_count = nullptr;
    decltype(&TIFFFieldDataType) data_type = nullptr;
    decltype(&TIFFIsTiled) is_tiled = nullptr;
    decltype(&TIFFTileSize64) tile_size = nullptr;
    decltype(&TIFFStripSize64) strip_size = nullptr;
    decltype(&TIFFReadEncodedTile) read_tile = nullptr;
    decltype(&TIFFReadEncodedStrip) read_strip = nullptr;
    decltype(&TIFFOpenOptionsAlloc) new_options = nullptr;
    decltype(&TIFFOpenOptionsFree) free_options = nullptr;
    decltype(&TIFFOpenOptionsSetMaxSingleMemAlloc) set_max_memory = nullptr;
    decltype(&TIFFOpenOptionsSetErrorHandlerExtR) set_on_error = nullptr;
    decltype(&TIFFOpenOptionsSetWarningHandlerExtR) set_on_warning = nullptr;

    bool load() {
        DynamicLibrary library("libtiff.so.6");
        library.find("TIFFClientOpenExt", open);
        library.find("TIFFClose", close);
        library.find("TIFFGetField", get);
        library.find("TIFFGetFieldDefaulted", get_defaulted);
        library.find("TIFFFindField", find_field);
        library.find("TIFFFieldReadCount", read_count);
        library.find("TIFFFieldPassCount", pass_count);
        library.find("TIFFFieldDataType", data_type);
        library.find("TIFFIsTiled", is_tiled);
        library.find("TIFFTileSize64", tile_size);
        library.find("TIFFStripSize64", strip_size);
        library.find("TIFFReadEncodedTile", read_tile);
        library.find("TIFFReadEncodedStrip", read_strip);
        library.find("TIFFOpenOptionsAlloc", new_options);
        library.find("TIFFOpenOptionsFree", free_options);
        library.find("TIFFOpenOptionsSetMaxSingleMemAlloc", set_max_memory);
        library.find("TIFFOpenOptionsSetErrorHandlerExtR", set_on_error);
        library.find("TIFFOpenOptionsSetWarningHandlerExtR", set_on_warning);
        return library.is_whole();
    }
};

/// The file as the library sees it, and its first complaint.
struct Stream {
    Span<const char> bytes;
    std::uint64_t at = 0;
    char message[200] = {0};
};

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t count) {
    auto* s = static_cast<Stream*>(handle);
    const std::uint64_t left = s->at < s->bytes.size ? s->bytes.size - s->at : 0;
    const std::uint64_t n = std::uint64_t(count) < left ? std::uint64_t(count) : left;
    if (n > 0) std::memcpy(to, s->bytes.data + s->at, std::size_t(n));
    s->at += n;
    return tmsize_t(n);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek(thandle_t handle, toff_t by, int from) {
    auto* s = static_cast<Stream*>(handle);
    s->at = by + (from == SEEK_CUR ? s->at : from == SEEK_END ? s->bytes.size : 0);
    return s->at;
}

int stay_open(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return static_cast<Stream*>(handle)->bytes.size; }

int keep_message(TIFF*, void* user, const char*, const char* format, va_list values) {
    auto* s = static_cast<Stream*>(user);
    if (s->message[0] == 0) std::vsnprintf(s->message, sizeof s->message, format, values);
    return 1;  // and nothing to stderr
}
int ignore(TIFF*, void*, const char*, const char*, va_list) { return 1; }

/// How samples are stored.
struct Layout {
    std::uint32_t columns = 0, rows = 0, tile_columns = 0, tile_rows = 0;
    std::uint16_t bits = 0, format = 0, planes = 0, packing = 0;
    bool tiled = false;
};

class Reader {
public:
    Reader(const std::string& name, Span<const char> bytes) : name_(name) { stream_.bytes = bytes; }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() {
        if (tiff_ != nullptr) library_.close(tiff_);
    }
    Status read(const HeightMapSettings& settings, std::uint64_t max_triangles, HeightGrid& grid);

private:
    Status fault(const std::string& text) const { return Status::bad_input(name_ + ": " + text); }
    Status not_readable() const {
        return fault("TIFF file: not readable, " + printable_line(stream_.message) +
                     ", allowed: a whole TIFF file");
    }
    Status open();
    Status check_layout();
    Status read_samples(HeightGrid& grid);
    void copy_block(const unsigned char* block, std::uint32_t column, std::uint32_t row,
                    std::uint32_t rows, HeightGrid& grid) const;
    float sample(const unsigned char* at) const;
    template <class Value>
    Span<const Value> values(std::uint32_t tag, TIFFDataType type);
    void mark_holes(HeightGrid& grid);
    Status find_place(HeightGrid& grid);

    const std::string& name_;
    Library library_;
    Stream stream_;
    TIFF* tiff_ = nullptr;
    Layout layout_;
};

Status Reader::open() {
    if (!library_.load())
        return fault("TIFF file: libtiff.so.6 is not installed, allowed: install it, or a .png");
    TIFFOpenOptions* options = library_.new_options();
    if (options == nullptr) return Status::limit(name_ + ": TIFF file: out of memory");
    const std::uint64_t room = reading_room();
    library_.set_max_memory(options, tmsize_t(room < (1u << 30) ? room : (1u << 30)));
    library_.set_on_error(options, keep_message, &stream_);
    library_.set_on_warning(options, ignore, nullptr);
    // "m": the file is not mapped, "r": read only its first directory.
    tiff_ = library_.open(name_.c_str(), "rm", &stream_, read_bytes, write_nothing, seek, stay_open,
                          size_of, nullptr, nullptr, options);
    library_.free_options(options);
    return tiff_ != nullptr ? Status::ok() : not_readable();
}

Status Reader::check_layout() {
    Layout& l = layout_;
    library_.get(tiff_, TIFFTAG_IMAGEWIDTH, &l.columns);
    library_.get(tiff_, TIFFTAG_IMAGELENGTH, &l.rows);
    library_.get_defaulted(tiff_, TIFFTAG_BITSPERSAMPLE, &l.bits);
    library_.get_defaulted(tiff_, TIFFTAG_SAMPLEFORMAT, &l.format);
    library_.get_defaulted(tiff_, TIFFTAG_SAMPLESPERPIXEL, &l.planes);
    library_.get_defaulted(tiff_, TIFFTAG_COMPRESSION, &l.packing);
    l.tiled = library_.is_tiled(tiff_) != 0;
    const bool whole = (l.format == SAMPLEFORMAT_UINT || l.format == SAMPLEFORMAT_INT) &&
                       (l.bits == 8 || l.bits == 16 || l.bits == 32);
    const bool real = l.format == SAMPLEFORMAT_IEEEFP && (l.bits == 32 || l.bits == 64);
    if (l.planes != 1 || !(whole || real))
        return fault("samples: " + std::to_string(l.planes) + " of " + std::to_string(l.bits) +
                     " bits, format " + std::to_string(l.format) +
                     ", allowed: 1 of 8, 16 or 32 bits, or of 32 or 64 as floats");
    for (const int packing : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE,
                              COMPRESSION_DEFLATE, COMPRESSION_PACKBITS, COMPRESSION_ZSTD})
        if (l.packing == packing) return Status::ok();
    return fault("compression: number " + std::to_string(l.packing) +
                 ", allowed: none, LZW, deflate, PackBits, Zstandard");
}

/// The values of a tag that libtiff itself knows nothing of; none where it is missing.
template <class Value>
Span<const Value> Reader::values(std::uint32_t tag, TIFFDataType type) {
    const TIFFField* field = library_.find_field(tiff_, tag, TIFF_ANY);
    if (field == nullptr || library_.data_type(field) != type || !library_.pass_count(field))
        return {};
    const Value* data = nullptr;
    if (library_.read_count(field) == TIFF_VARIABLE2) {
        std::uint32_t count = 0;
        if (library_.get(tiff_, tag, &count, &data) != 1 || data == nullptr) return {};
        return {data, count};
    }
    std::uint16_t count = 0;
    if (library_.read_count(field) != TIFF_VARIABLE ||
        library_.get(tiff_, tag, &count, &data) != 1 || data == nullptr)
        return {};
    return {data, count};
}

template <class Value>
float as_float(const unsigned char* at) {
    Value value;
    std::memcpy(&value, at, sizeof value);
    return float(value);
}

/// The library has put bytes into this machine's order.
float Reader::sample(const unsigned char* at) const {
    const int bits = layout_.bits;
    if (layout_.format == SAMPLEFORMAT_IEEEFP)
        return bits == 64 ? as_float<double>(at) : as_float<float>(at);
    if (layout_.format == SAMPLEFORMAT_INT)
        return bits == 8    ? as_float<std::int8_t>(at)
               : bits == 16 ? as_float<std::int16_t>(at)
                            : as_float<std::int32_t>(at);
    return bits == 8    ? as_float<std::uint8_t>(at)
           : bits == 16 ? as_float<std::uint16_t>(at)
                        : as_float<std::uint32_t>(at);
}

void Reader::copy_block(const unsigned char* block, std::uint32_t column, std::uint32_t row,
                        std::uint32_t rows, HeightGrid& grid) const {
    const std::size_t step = layout_.bits / 8;
    for (std::uint32_t r = 0; r < rows && row + r < layout_.rows; ++r)
        for (std::uint32_t c = 0; c < layout_.tile_columns && column + c < layout_.columns; ++c) {
            const std::size_t from = std::size_t(r) * layout_.tile_columns + c;
            grid.height.at(std::size_t(row + r) * layout_.columns + column + c) =
                sample(block + from * step);
        }
}

Status Reader::read_samples(HeightGrid& grid) {
    Layout& l = layout_;
    if (l.tiled) {
        library_.get(tiff_, TIFFTAG_TILEWIDTH, &l.tile_columns);
        library_.get(tiff_, TIFFTAG_TILELENGTH, &l.tile_rows);
    } else {
        library_.get_defaulted(tiff_, TIFFTAG_ROWSPERSTRIP, &l.tile_rows);
        l.tile_columns = l.columns;
        if (l.tile_rows > l.rows) l.tile_rows = l.rows;
    }
    const std::uint64_t size = l.tiled ? library_.tile_size(tiff_) : library_.strip_size(tiff_);
    const std::uint64_t wanted = std::uint64_t(l.tile_columns) * l.tile_rows * (l.bits / 8);
    if (l.tile_columns < 1 || l.tile_rows < 1 || l.tile_columns > (1u << 20) ||
        l.tile_rows > (1u << 20) || size != wanted)
        return fault("tiles: " + std::to_string(l.tile_columns) + " x " +
                     std::to_string(l.tile_rows) + ", allowed: up to 1048576 along a side");
    PILEUS_TRY(check_reading(name_, size));
    Buffer<unsigned char> block;
    PILEUS_TRY(block.resize(size, name_.c_str()));
    std::uint32_t number = 0;
    for (std::uint32_t row = 0; row < l.rows; row += l.tile_rows)
        for (std::uint32_t column = 0; column < l.columns; column += l.tile_columns, ++number) {
            std::memset(block.data(), 0, block.size());
            const tmsize_t room = tmsize_t(block.size());
            const tmsize_t got = l.tiled ? library_.read_tile(tiff_, number, block.data(), room)
                                         : library_.read_strip(tiff_, number, block.data(), room);
            if (got < 0) return not_readable();
            copy_block(block.data(), column, row, l.tile_rows, grid);
        }
    return Status::ok();
}

/// GDAL writes the value that stands for no height as a text.
void Reader::mark_holes(HeightGrid& grid) {
    const Span<const char> text = values<char>(kNoData, TIFF_ASCII);
    std::size_t begin = 0, end = 0;
    while (begin < text.size && text[begin] == ' ') ++begin;
    for (end = begin; end < text.size && text[end] != 0 && text[end] != ' ';) ++end;
    double value = 0;
    const auto read = number_from(text.data + begin, text.data + end, value);
    if (begin == end || read.ec != std::errc() || read.ptr != text.data + end) return;
    for (float& h : grid.height.span())
        if (h == float(value)) h = std::numeric_limits<float>::quiet_NaN();
}

/// Metres on the map, where the file says them; without, or in degrees, the scene has to.
Status Reader::find_place(HeightGrid& grid) {
    const Span<const double> scale = values<double>(kPixelScale, TIFF_DOUBLE);
    const Span<const double> tie = values<double>(kTiepoint, TIFF_DOUBLE);
    if (scale.size < 2 || tie.size < 6) return Status::ok();
    const Span<const std::uint16_t> keys = values<std::uint16_t>(kGeoKeys, TIFF_SHORT);
    double middle = 0.5;  // of a sample that is an area
    for (std::size_t k = 4; k + 3 < keys.size; k += 4) {
        if (keys[k + 1] != 0) continue;
        const int key = keys[k], value = keys[k + 3];
        if (key == kKeyRasterType && value == kPixelIsPoint) middle = 0;
        if ((key == kKeyModelType && value == kGeographic) ||
            (key == kKeyLinearUnit && value != kUnitMetre))
            return fault("place: not in metres, allowed: bounds_m");
    }
    const double step[2] = {scale[0], scale[1]};
    const double west = tie[3] + (middle - tie[0]) * step[0];
    const double north = tie[4] - (middle - tie[1]) * step[1];
    const double east = west + (grid.columns - 1) * step[0];
    const double south = north - (grid.rows - 1) * step[1];
    if (!(west < east && south < north && west >= -1e12 && east <= 1e12 && south >= -1e12 &&
          north <= 1e12))
        return fault("place: samples without a place, allowed: bounds_m");
    grid.placed = true;
    grid.bounds_m = {{{west, south}, {east, north}}};
    return Status::ok();
}

Status Reader::read(const HeightMapSettings& settings, std::uint64_t max_triangles,
                    HeightGrid& grid) {
    PILEUS_TRY(open());
    PILEUS_TRY(check_layout());
    PILEUS_TRY(size_heights(name_, layout_.columns, layout_.rows, settings, max_triangles, grid));
    PILEUS_TRY(read_samples(grid));
    mark_holes(grid);
    if (layout_.format == SAMPLEFORMAT_UINT && layout_.bits < 32)
        grid.full_scale = layout_.bits == 8 ? 255 : 65535;
    if (settings.bounds_m[0] != settings.bounds_m[1]) return Status::ok();
    return find_place(grid);
}

}  // namespace

Status decode_tiff_heights(const std::string& name, Span<const char> bytes,
                           const HeightMapSettings& settings, std::uint64_t max_triangles,
                           HeightGrid& grid) {
    return Reader(name, bytes).read(settings, max_triangles, grid);
}
#else
Status decode_tiff_heights(const std::string& name, Span<const char>, const HeightMapSettings&,
                           std::uint64_t, HeightGrid&) {
    return Status::bad_input(name +
                             ": TIFF file: this build reads none (PILEUS_TIFF), allowed: a .png, "
                             ".exr, .pfm, .hgt or .raw");
}
#endif

}  // namespace pileus
