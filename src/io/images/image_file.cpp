// SPDX-License-Identifier: Apache-2.0
// Chooses a picture format by extension, checks pictures, and names their pixels by a hash.
// in: an Image or a path -> out: see image_file.h.
// docs/formats.md
#include "src/io/images/image_file.h"

#include "src/base/digest.h"
#include "src/base/file.h"
#include "src/scene/rows/picture_format.h"

namespace pileus {

namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 34;

Status in_file(const std::string& path, Status status) {
    if (!status && status.message.compare(0, path.size(), path) != 0)
        status.message = path + ": " + status.message;
    return status;
}

}  // namespace

Status encode_ppm(int width, int height, Span<const std::uint8_t> rgb, Buffer<char>& bytes) {
    const std::string head =
        "P6\n" + std::to_string(width) + ' ' + std::to_string(height) + "\n255\n";
    PILEUS_TRY(bytes.resize(head.size() + rgb.size, "PPM file"));
    std::memcpy(bytes.data(), head.data(), head.size());
    std::memcpy(bytes.data() + head.size(), rgb.data, rgb.size);
    return Status::ok();
}

Status check_image_size(const std::string& where, std::int64_t width, std::int64_t height,
                        std::uint64_t most_pixels) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width < 1 || height < 1)
        return Status::bad_input(where + ": size: out of range, " + size + ", allowed: 1 x 1 up");
    if (width > kMaxImageSide || height > kMaxImageSide ||
        std::uint64_t(width) * std::uint64_t(height) > most_pixels)
        return Status::limit(where + ": size: too large, " + size + ", allowed: sides up to " +
                             std::to_string(kMaxImageSide) + " and " + std::to_string(most_pixels) +
                             " pixels");
    return Status::ok();
}

Status check_image(const Image& image) {
    PILEUS_TRY(check_image_size("image", image.width, image.height));
    const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
    if (image.channels.empty() || image.channels.size() > kMaxChannels)
        return Status::bad_input("image: channels: wrong number, " +
                                 std::to_string(image.channels.size()) + ", allowed: 1 to " +
                                 std::to_string(kMaxChannels));
    for (const Channel& channel : image.channels) {
        if (channel.name.empty() || channel.name.size() > 31)
            return Status::bad_input("image: channel name: wrong length, \"" + channel.name +
                                     "\", allowed: 1 to 31 characters");
        if (image.find(channel.name.c_str()) != &channel)
            return Status::bad_input("image: channel " + channel.name + ": given twice");
        if (channel.pixels.size() != pixels)
            return Status::bad_input("image: channel " + channel.name + ": wrong length, " +
                                     std::to_string(channel.pixels.size()) +
                                     ", allowed: " + std::to_string(pixels));
    }
    return Status::ok();
}

Status can_write_image(const std::string& path) {
    const PictureFormat* format = picture_format_of(path);
    if (format == nullptr || !is_written(*format))
        return Status::bad_input(path + ": extension: unknown, \"" + file_extension(path) +
                                 "\", allowed: " + picture_extensions(is_written, " "));
    if (format->built) return Status::ok();
    return Status::bad_input(
        path + ": extension: " + format->extension +
        " left out of this build, allowed: .pfm or .ppm, or configure with -D" + format->library +
        "=ON");
}

Status encode_image(const Image& image, const std::string& path, const ToneSettings& tone,
                    Buffer<char>& bytes) {
    PILEUS_TRY(can_write_image(path));
    Status status = check_image(image);
    if (status) status = picture_format_of(path)->encode(image, tone, bytes);
    return in_file(path, status);
}

Status write_image(const Image& image, const std::string& path, const ToneSettings& tone) {
    Buffer<char> bytes;
    PILEUS_TRY(encode_image(image, path, tone, bytes));
    return write_file(path, bytes.span());
}

Status read_image(const std::string& path, Image& image, std::uint64_t most_pixels) {
    const PictureFormat* format = picture_format_of(path);
    if (format == nullptr || !is_radiance(*format))
        return Status::bad_input(path + ": extension: unknown, \"" + file_extension(path) +
                                 "\", allowed: " + picture_extensions(is_radiance, " "));
    return decode_image(*format, path, image, most_pixels);
}

Status decode_image(const PictureFormat& format, const std::string& path, Image& image,
                    std::uint64_t most_pixels) {
    if (!format.built) PILEUS_TRY(can_write_image(path));
    image = Image();
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxFileBytes, bytes));
    return format.decode(path, bytes.span(), image, most_pixels);
}

Status read_colours(const std::string& path, const Limits& limits, std::uint64_t max_pixels,
                    Image& image, const Channel* (&rgb)[3]) {
    const PictureFormat* format = picture_format_of(path);
    if (format == nullptr || !is_read(*format))
        return Status::bad_input(path +
                                 ": extension: unknown, allowed: " + picture_extensions(is_read));
    InputFile file;
    PILEUS_TRY(open_file(path, file));
    PILEUS_TRY(check_limit(limits, LimitId::kFile, file.size(), path));
    PILEUS_TRY(decode_image(*format, path, image, max_pixels));
    return color_channels(image, rgb);
}

std::string pixel_hash(const Image& image) {
    Digest digest;
    add_pixels(image, digest);
    return digest.hex();
}

void add_pixels(const Image& image, Digest& digest) {
    const Channel* channels[4] = {image.find("R"), image.find("G"), image.find("B"),
                                  image.find("A")};
    for (int c = 0; c < 3; ++c)
        if (channels[c] == nullptr) channels[c] = image.find("Y");
    const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
    constexpr std::size_t kBlock = 256;  // pixels
    float block[4 * kBlock];
    for (std::size_t first = 0; first < pixels; first += kBlock) {
        const std::size_t count = pixels - first < kBlock ? pixels - first : kBlock;
        for (std::size_t c = 0; c < 4; ++c) {
            const float* from =
                channels[c] != nullptr ? channels[c]->pixels.data() + first : nullptr;
            const float missing = c == 3 ? 1.0f : 0.0f;
            for (std::size_t i = 0; i < count; ++i)
                block[4 * i + c] = from != nullptr ? from[i] : missing;
        }
        digest.floats({block, 4 * count});
    }
}

}  // namespace pileus
