// SPDX-License-Identifier: Apache-2.0
// See png_samples.h; with png.cpp the only files that touch libpng.
// in: bytes of a PNG file -> out: samples as they are stored.
// PNG specification; docs/solids.md, "Height maps".
#include "src/io/images/png_samples.h"

#include "src/base/printable.h"
#include "src/base/reading_limit.h"

#ifdef PILEUS_WITH_PNG
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <vector>
#endif

namespace pileus {

#ifdef PILEUS_WITH_PNG
namespace {

/// Where bytes come from or go to, and the first complaint. Lives in the caller of the frame that
/// jumps.
struct Stream {
    Span<const char> from;
    std::size_t used = 0;
    Buffer<char>* to = nullptr;
    bool out_of_memory = false;
    char message[160] = {0};
};

[[noreturn]] void stop(png_structp png, png_const_charp text) {
    auto* stream = static_cast<Stream*>(png_get_error_ptr(png));
    std::strncpy(stream->message, text, sizeof stream->message - 1);
    png_longjmp(png, 1);
}

void pass(png_structp, png_const_charp) {}

void give_bytes(png_structp png, png_bytep data, png_size_t length) {
    auto* stream = static_cast<Stream*>(png_get_io_ptr(png));
    if (length > stream->from.size - stream->used) png_error(png, "the file ends too early");
    std::memcpy(data, stream->from.data + stream->used, length);
    stream->used += length;
}

/// Keeps the bytes: doubles the buffer when it is full.
void take_bytes(png_structp png, png_bytep data, png_size_t length) {
    auto* stream = static_cast<Stream*>(png_get_io_ptr(png));
    const std::size_t needed = stream->used + length;
    if (needed > stream->to->size()) {
        Buffer<char> larger;
        if (!larger.resize(needed * 2, "PNG file")) {
            stream->out_of_memory = true;
        } else {
            if (stream->used > 0) std::memcpy(larger.data(), stream->to->data(), stream->used);
            stream->to->swap(larger);
        }
    }
    if (stream->out_of_memory) png_error(png, "out of memory");
    std::memcpy(stream->to->data() + stream->used, data, length);
    stream->used = needed;
}

void flush(png_structp) {}

struct Head {
    std::uint32_t columns = 0, rows = 0;
    int bits = 0, colour = 0;
};

/// The frames that libpng may jump back to own nothing and change nothing of their own.
bool take_head(png_structp png, png_infop info, Stream* stream, Head* head) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_read_fn(png, stream, give_bytes);
    png_read_info(png, info);
    head->columns = png_get_image_width(png, info);
    head->rows = png_get_image_height(png, info);
    head->bits = png_get_bit_depth(png, info);
    head->colour = png_get_color_type(png, info);
    return true;
}

bool take_rows(png_structp png, png_infop info, png_bytepp rows, std::size_t row_bytes) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_expand_gray_1_2_4_to_8(png);
    png_set_strip_alpha(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (png_get_rowbytes(png, info) != row_bytes) png_error(png, "rows of another length");
    png_read_image(png, rows);
    png_read_end(png, nullptr);
    return true;
}

bool put_rows(png_structp png, png_infop info, Stream* stream, std::uint32_t columns,
              std::uint32_t rows, const std::uint8_t* from) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, stream, take_bytes, flush);
    png_set_compression_level(png, 9);
    png_set_IHDR(png, info, columns, rows, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (std::size_t r = 0; r < rows; ++r) png_write_row(png, from + r * columns * 2);
    png_write_end(png, info);
    return true;
}

/// libpng's state while one file is read.
struct Reader {
    Stream stream;
    png_structp png;
    png_infop info = nullptr;
    explicit Reader(Span<const char> bytes)
        : stream(), png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &stream, stop, pass)) {
        stream.from = bytes;
        if (png != nullptr) info = png_create_info_struct(png);
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() {
        if (png != nullptr) png_destroy_read_struct(&png, &info, nullptr);
    }
};

Status not_readable(const std::string& name, const Stream& stream) {
    return Status::bad_input(name + ": PNG file: not readable, " + printable_line(stream.message) +
                             ", allowed: a whole PNG file");
}

Status open_head(const std::string& name, Reader& reader, Head& head) {
    if (reader.info == nullptr) return Status::limit(name + ": PNG file: out of memory");
    if (!take_head(reader.png, reader.info, &reader.stream, &head))
        return not_readable(name, reader.stream);
    return Status::ok();
}

}  // namespace

Status PngSamples::read_head(const std::string& name, Span<const char> bytes) {
    name_ = name, bytes_ = bytes;
    Reader reader(bytes);
    Head head;
    PILEUS_TRY(open_head(name, reader, head));
    if ((head.colour & PNG_COLOR_MASK_PALETTE) != 0)
        return Status::bad_input(name +
                                 ": PNG file: a palette, allowed: grey samples, or R G B that are "
                                 "equal");
    // Deflate packs at most 1032 to 1; a bit a pixel is the least that a picture takes.
    if (std::uint64_t(head.columns) * head.rows / 8 / 1032 > bytes.size)
        return Status::bad_input(name + ": size: too large, " + std::to_string(head.columns) +
                                 " x " + std::to_string(head.rows) + ", allowed: what " +
                                 std::to_string(bytes.size) + " bytes can hold");
    columns_ = int(head.columns), rows_ = int(head.rows);
    deep_ = head.bits == 16;
    return Status::ok();
}

Status PngSamples::read_samples(Span<float> to) {
    Reader reader(bytes_);
    Head head;
    PILEUS_TRY(open_head(name_, reader, head));
    const std::size_t planes = (head.colour & PNG_COLOR_MASK_COLOR) != 0 ? 3 : 1;
    const std::size_t step = planes * (deep_ ? 2 : 1), row_bytes = step * std::size_t(columns_);
    PILEUS_TRY(check_reading(name_, row_bytes * std::uint64_t(rows_)));
    Buffer<std::uint8_t> all;
    PILEUS_TRY(all.resize(row_bytes * std::uint64_t(rows_), name_.c_str()));
    std::vector<png_bytep> rows(std::size_t(rows_), nullptr);
    for (std::size_t r = 0; r < rows.size(); ++r) rows[r] = all.data() + r * row_bytes;
    if (!take_rows(reader.png, reader.info, rows.data(), row_bytes))
        return not_readable(name_, reader.stream);
    for (std::size_t i = 0; i < to.size; ++i) {
        const std::uint8_t* at = all.data() + i * step;
        const auto plane = [&](std::size_t p) {
            return deep_ ? at[2 * p] << 8 | at[2 * p + 1] : int(at[p]);
        };
        for (std::size_t p = 1; p < planes; ++p)
            if (plane(p) != plane(0))
                return Status::bad_input(name_ + ": PNG file: colours, at row " +
                                         std::to_string(i / std::size_t(columns_)) + ", column " +
                                         std::to_string(i % std::size_t(columns_)) +
                                         ", allowed: grey samples, or R G B that are equal");
        to[i] = float(plane(0));
    }
    return Status::ok();
}

Status encode_png_samples(int columns, int rows, Span<const std::uint16_t> samples,
                          Buffer<char>& bytes) {
    Buffer<std::uint8_t> big_endian;
    PILEUS_TRY(big_endian.resize(2 * std::uint64_t(columns) * std::uint64_t(rows), "PNG file"));
    for (std::size_t i = 0; i < big_endian.size() / 2; ++i) {
        big_endian[2 * i] = std::uint8_t(samples.at(i) >> 8);
        big_endian[2 * i + 1] = std::uint8_t(samples.at(i) & 255);
    }
    Buffer<char> growing;
    Stream stream;
    stream.to = &growing;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &stream, stop, pass);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool made = info != nullptr && put_rows(png, info, &stream, std::uint32_t(columns),
                                                  std::uint32_t(rows), big_endian.data());
    if (png != nullptr) png_destroy_write_struct(&png, &info);
    if (!made) return Status::limit("PNG file: out of memory");
    growing.truncate(stream.used);
    bytes.swap(growing);
    return Status::ok();
}
#else
namespace {

Status left_out(const std::string& name) {
    return Status::bad_input(name +
                             ": PNG file: left out of this build, configure with -DPILEUS_PNG=ON");
}

}  // namespace

Status PngSamples::read_head(const std::string& name, Span<const char>) { return left_out(name); }
Status PngSamples::read_samples(Span<float>) { return left_out(name_); }
Status encode_png_samples(int, int, Span<const std::uint16_t>, Buffer<char>&) {
    return left_out("samples");
}
#endif

}  // namespace pileus
