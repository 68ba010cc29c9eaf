// SPDX-License-Identifier: Apache-2.0
// The table of kinds of height maps, and the reader for each extension.
// in: one row for each -> out: see src/scene/rows/height_format.h, height_map.h.
// docs/solids.md, "Height maps"; docs/contributing.md, "Add a file format".
#include <algorithm>

#include "src/base/file.h"
#include "src/base/number_text.h"
#include "src/base/reading_limit.h"
#include "src/io/heights/height_map.h"
#include "src/scene/rows/height_format.h"

namespace pileus {
namespace {

// Extension, title; scaled, whole, raw, placed; reader.
constexpr HeightFormat kFormats[] = {
    {".png", "PNG", true, true, false, false, decode_png_heights},
    {".exr", "OpenEXR", false, false, false, false, decode_exr_heights},
    {".pfm", "PFM", false, false, false, false, decode_pfm_heights},
    {".tif", "GeoTIFF", false, true, false, true, decode_tiff_heights},
    {".tiff", "GeoTIFF", false, true, false, true, decode_tiff_heights},
    {".hgt", "SRTM", false, false, false, false, decode_hgt_heights},
    {".raw", "raw numbers", false, true, true, false, decode_raw_heights}};

/// Whole numbers become shares of the range that the scene gives, all others metres.
Status scale_heights(const std::string& name, const SolidSettings& settings, HeightGrid& grid) {
    const std::array<double, 2>& range = settings.heights.height_m;
    const bool ranged = range[0] != range[1];
    if (ranged && !(grid.full_scale > 0))
        return Status::bad_input(name +
                                 ": samples: heights as they are, allowed: height_m left out");
    const double base = ranged ? range[0] : 0;
    const double unit = ranged ? (range[1] - range[0]) / grid.full_scale : settings.scale;
    for (float& h : grid.height.span()) h = float(base + unit * double(h));
    return Status::ok();
}

}  // namespace

Status size_heights(const std::string& name, std::int64_t columns, std::int64_t rows,
                    const HeightMapSettings& settings, std::uint64_t max_triangles,
                    HeightGrid& grid) {
    const std::string size = std::to_string(columns) + " x " + std::to_string(rows);
    const std::int64_t every = settings.every;
    if (columns < 2 || rows < 2 || columns > kMaxHeightSide || rows > kMaxHeightSide)
        return Status::bad_input(name + ": size: out of range, " + size + ", allowed: 2 x 2 to " +
                                 std::to_string(kMaxHeightSide) + " samples along a side");
    const std::int64_t across = height_posts(columns, int(every)),
                       along = height_posts(rows, int(every));
    if (across < 2 || along < 2)
        return Status::bad_input(name + ": every: too many, " + std::to_string(every) + " of " +
                                 size + " samples, allowed: less than each side");
    PILEUS_TRY(check_triangles(name, 2 * std::uint64_t(across - 1) * std::uint64_t(along - 1),
                               max_triangles));
    const std::uint64_t count = std::uint64_t(columns) * std::uint64_t(rows);
    PILEUS_TRY(check_reading(name, count * sizeof(float)));
    grid.columns = int(columns), grid.rows = int(rows);
    return grid.height.resize(count, name.c_str());
}

Status bound_heights(const std::string& path, std::uint64_t bytes,
                     const HeightMapSettings& settings, std::uint64_t& triangles) {
    const HeightFormat* format = height_format_of(path);
    triangles = ~std::uint64_t{0};
    std::uint64_t samples = bytes / 2;
    if (format == nullptr || format->decode == decode_exr_heights ||
        format->decode == decode_tiff_heights)
        return Status::ok();
    if (format->decode == decode_png_heights) {
        // Behind eight bytes of signature and eight of the first chunk's head: columns, rows.
        constexpr std::size_t kSizes = 16;
        Buffer<char> head;
        PILEUS_TRY(read_file_start(path, kSizes + 8, head));
        std::uint64_t side[2] = {};
        for (std::size_t i = kSizes; i < head.size(); ++i)
            side[(i - kSizes) / 4] = side[(i - kSizes) / 4] << 8 | std::uint8_t(head[i]);
        samples = side[0] * side[1];
    }
    // Of 2 x 2 samples or more; the last group of a side may be smaller than all others.
    const std::uint64_t every = std::uint64_t(settings.every);
    samples = std::min(samples, std::uint64_t(kMaxHeightSide) * kMaxHeightSide);
    triangles = std::min(2 * samples, 8 * samples / (every * every) + 8);
    return Status::ok();
}

Status decode_height_map(const std::string& name, const std::string& extension,
                         Span<const char> bytes, const SolidSettings& settings,
                         std::uint64_t max_triangles, Mesh& mesh) {
    const HeightFormat* format = height_format_of("map" + extension);
    if (format == nullptr)
        return Status::bad_input(name + ": heights: unknown kind of file, " + extension +
                                 ", allowed: " + height_extensions());
    HeightGrid grid;
    PILEUS_TRY(format->decode(name, bytes, settings.heights, max_triangles, grid));
    PILEUS_TRY(scale_heights(name, settings, grid));
    PILEUS_TRY(settle_holes(name, settings.heights.holes, grid));
    return mesh_of_heights(name, settings, grid, mesh);
}

Status read_height_map(const std::string& path, const SolidSettings& settings, const Limits& limits,
                       Mesh& mesh) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, limits[LimitId::kFile], bytes));
    return decode_height_map(path, file_extension(path), bytes.span(), settings,
                             limits[LimitId::kTriangles], mesh);
}

Span<const HeightFormat> height_formats() {
    return {kFormats, sizeof kFormats / sizeof kFormats[0]};
}

const HeightFormat* height_format_of(const std::string& path) {
    return row_of_extension(kFormats, path);
}

std::string height_extensions() {
    return extensions_of(kFormats, ", ", [](const HeightFormat&) { return true; });
}

}  // namespace pileus
