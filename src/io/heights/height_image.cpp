// SPDX-License-Identifier: Apache-2.0
// Maps of heights out of pictures: grey PNG by its samples, OpenEXR and PFM as metres.
// in: the bytes of a picture -> out: samples, rows from the top, which is the north.
// docs/solids.md, "Height maps".
#include "src/io/heights/height_map.h"
#include "src/io/images/image_file.h"
#include "src/io/images/png_samples.h"

namespace pileus {
namespace {

/// The one plane of a picture that holds heights; null where it is not clear which.
const Channel* height_channel(const Image& image) {
    if (image.channels.size() == 1) return &image.channels[0];
    for (const char* name : {"Y", "Z", "height"})
        if (const Channel* channel = image.find(name)) return channel;
    const Channel *r = image.find("R"), *g = image.find("G"), *b = image.find("B");
    if (r == nullptr || g == nullptr || b == nullptr) return nullptr;
    const auto same = [&](const Channel& c) {
        return std::memcmp(c.pixels.data(), r->pixels.data(), r->pixels.bytes()) == 0;
    };
    return same(*g) && same(*b) ? r : nullptr;
}

Status decode_plane(Status (*decode)(const std::string&, Span<const char>, Image&, std::uint64_t),
                    const std::string& name, Span<const char> bytes,
                    const HeightMapSettings& settings, std::uint64_t max_triangles,
                    HeightGrid& grid) {
    Image image;
    PILEUS_TRY(decode(name, bytes, image, kMaxImagePixels));
    const Channel* channel = height_channel(image);
    if (channel == nullptr)
        return Status::bad_input(name +
                                 ": channels: no heights among them, allowed: one channel, or Y, "
                                 "Z, height, or R G B that are equal");
    PILEUS_TRY(size_heights(name, image.width, image.height, settings, max_triangles, grid));
    std::memcpy(grid.height.data(), channel->pixels.data(), channel->pixels.bytes());
    return Status::ok();
}

}  // namespace

Status decode_png_heights(const std::string& name, Span<const char> bytes,
                          const HeightMapSettings& settings, std::uint64_t max_triangles,
                          HeightGrid& grid) {
    PngSamples png;
    PILEUS_TRY(png.read_head(name, bytes));
    PILEUS_TRY(size_heights(name, png.columns(), png.rows(), settings, max_triangles, grid));
    grid.full_scale = png.full_scale();
    return png.read_samples(grid.height.span());
}

Status decode_exr_heights(const std::string& name, Span<const char> bytes,
                          const HeightMapSettings& settings, std::uint64_t max_triangles,
                          HeightGrid& grid) {
    return decode_plane(decode_exr, name, bytes, settings, max_triangles, grid);
}

Status decode_pfm_heights(const std::string& name, Span<const char> bytes,
                          const HeightMapSettings& settings, std::uint64_t max_triangles,
                          HeightGrid& grid) {
    return decode_plane(decode_pfm, name, bytes, settings, max_triangles, grid);
}

}  // namespace pileus
