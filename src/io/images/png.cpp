// SPDX-License-Identifier: Apache-2.0
// 8-bit PNG in memory; with png_samples.cpp the only files that touch libpng.
// in: sRGB bytes, rows from the top -> out: the bytes of a PNG file with an sRGB chunk; and back.
// PNG specification 11.3.3.5 (sRGB); docs/formats.md
#include "src/base/reading_limit.h"
#include "src/io/images/image_file.h"
#include "src/io/images/srgb.h"

#ifdef PILEUS_WITH_PNG
#include <png.h>

#include <csetjmp>
#endif

namespace pileus {

#ifdef PILEUS_WITH_PNG
namespace {

/// Where libpng's bytes and its first complaint go. Lives in the caller of the frame that jumps.
struct Sink {
    Buffer<char>* bytes = nullptr;
    std::size_t used = 0;
    bool out_of_memory = false;
    char message[160] = {0};
};

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
    Sink* sink = static_cast<Sink*>(png_get_error_ptr(png));
    std::strncpy(sink->message, text, sizeof sink->message - 1);
    png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

/// Doubles the buffer when it is full.
bool append(Sink& sink, const void* data, std::size_t length) {
    const std::size_t needed = sink.used + length;
    if (needed > sink.bytes->size()) {
        Buffer<char> larger;
        if (!larger.resize(needed * 2, "PNG file")) return false;
        if (sink.used > 0) std::memcpy(larger.data(), sink.bytes->data(), sink.used);
        sink.bytes->swap(larger);
    }
    std::memcpy(sink.bytes->data() + sink.used, data, length);
    sink.used = needed;
    return true;
}

void on_write(png_structp png, png_bytep data, png_size_t length) {
    Sink* sink = static_cast<Sink*>(png_get_io_ptr(png));
    if (append(*sink, data, length)) return;
    sink->out_of_memory = true;
    png_error(png, "out of memory");
}

void on_flush(png_structp) {}

/// The frame that libpng may jump back to: it owns nothing and changes nothing of its own.
bool write_all(png_structp png, png_infop info, Sink* sink, std::uint32_t width,
               std::uint32_t height, const std::uint8_t* rgb, png_textp texts, int text_count) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, sink, on_write, on_flush);
    png_set_compression_level(png, 6);
    png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (text_count > 0) png_set_text(png, info, texts, text_count);
    png_write_info(png, info);
    for (std::size_t y = 0; y < height; ++y) png_write_row(png, rgb + y * width * 3);
    png_write_end(png, info);
    return true;
}

/// libpng's simple interface, which keeps its jumps to itself; frees what a read has left.
struct Reader {
    png_image png;
    Reader() : png() { png.version = PNG_IMAGE_VERSION; }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { png_image_free(&png); }
};

Status not_readable(const std::string& name, const png_image& png) {
    return Status::bad_input(name + ": PNG file: not readable, " + printable_line(png.message));
}

Status planes_of(const std::string& name, const Buffer<std::uint8_t>& rgba, bool alpha,
                 Image& image) {
    float light[256];
    for (int code = 0; code < 256; ++code) light[code] = float(linear_of_srgb(code / 255.0));
    const std::size_t pixels = rgba.size() / 4;
    const char* const names[4] = {"R", "G", "B", "A"};
    image.channels.resize(alpha ? 4 : 3);
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
        image.channels[c].name = names[c];
        Buffer<float>& plane = image.channels[c].pixels;
        PILEUS_TRY(plane.resize(pixels, name.c_str()));
        for (std::size_t i = 0; i < pixels; ++i) {
            const float share = float(rgba[4 * i + 3]) / 255.0f;
            plane[i] = c == 3 ? share : light[rgba[4 * i + c]] * share;
        }
    }
    return Status::ok();
}

}  // namespace

Status encode_png(int width, int height, Span<const std::uint8_t> rgb,
                  const std::vector<std::pair<std::string, std::string>>& texts,
                  Buffer<char>& bytes) {
    PILEUS_TRY(check_image_size("PNG file", width, height));
    if (rgb.size != std::size_t(width) * std::size_t(height) * 3)
        return Status::bad_input("PNG file: pixels: wrong number of bytes, " +
                                 std::to_string(rgb.size));
    // libpng reads these, and asks for letters that it might write to.
    std::vector<png_text> chunks(texts.size(), png_text{});
    for (std::size_t i = 0; i < texts.size(); ++i) {
        chunks[i].compression = PNG_TEXT_COMPRESSION_NONE;
        chunks[i].key = const_cast<char*>(texts[i].first.c_str());
        chunks[i].text = const_cast<char*>(texts[i].second.c_str());
        chunks[i].text_length = texts[i].second.size();
    }
    Buffer<char> growing;
    Sink sink;
    sink.bytes = &growing;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, on_error, on_warning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool made =
        info != nullptr && write_all(png, info, &sink, std::uint32_t(width), std::uint32_t(height),
                                     rgb.data, chunks.data(), int(chunks.size()));
    if (png != nullptr) png_destroy_write_struct(&png, &info);
    // Pixels and sizes are sound and nothing is written yet: only memory can be what is missing.
    if (!made && (info == nullptr || sink.out_of_memory))
        return Status::limit("PNG file: out of memory");
    if (!made) return Status::limit(std::string("PNG file: out of memory, ") + sink.message);

    // Hand over exactly the bytes that were written.
    growing.truncate(sink.used);
    bytes.swap(growing);
    return Status::ok();
}

Status decode_png(const std::string& name, Span<const char> bytes, Image& image,
                  std::uint64_t most_pixels) {
    Reader reader;
    if (png_image_begin_read_from_memory(&reader.png, bytes.data, bytes.size) == 0)
        return not_readable(name, reader.png);
    const std::uint64_t width = reader.png.width, height = reader.png.height;
    PILEUS_TRY(check_image_size(name, std::int64_t(width), std::int64_t(height), most_pixels));
    // Deflate packs at most 1032 to 1; a bit a pixel is the least that a picture takes.
    const std::uint64_t rows = width * height / 8;
    if (rows / 1032 > bytes.size)
        return Status::bad_input(name + ": size: too large, " + std::to_string(width) + " x " +
                                 std::to_string(height) + ", allowed: what " +
                                 std::to_string(bytes.size) + " bytes can hold");
    // Bytes of four channels, and as many floats.
    PILEUS_TRY(check_reading(name, width * height * 4 * (1 + sizeof(float))));
    const bool alpha = (reader.png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    reader.png.format = PNG_FORMAT_RGBA;
    Buffer<std::uint8_t> rgba;
    PILEUS_TRY(rgba.resize(width * height * 4, name.c_str()));
    if (png_image_finish_read(&reader.png, nullptr, rgba.data(), 0, nullptr) == 0)
        return not_readable(name, reader.png);
    image.width = int(width);
    image.height = int(height);
    image.display_colours = true;
    return planes_of(name, rgba, alpha, image);
}
#else
Status encode_png(int, int, Span<const std::uint8_t>,
                  const std::vector<std::pair<std::string, std::string>>&, Buffer<char>&) {
    return Status::bad_input("PNG file: left out of this build, configure with -DPILEUS_PNG=ON");
}
Status decode_png(const std::string& name, Span<const char>, Image&, std::uint64_t) {
    return Status::bad_input(name +
                             ": PNG file: left out of this build, configure with -DPILEUS_PNG=ON");
}
#endif

Status encode_png(int width, int height, Span<const std::uint8_t> rgb, Buffer<char>& bytes) {
    return encode_png(width, height, rgb, {}, bytes);
}

}  // namespace pileus
