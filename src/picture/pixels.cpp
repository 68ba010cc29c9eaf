// SPDX-License-Identifier: Apache-2.0
// See pixels.h.
#include "src/picture/pixels.h"

#include <atomic>
#include <cstring>
#include <utility>

#include "kernels_cpu/display/tone.h"
#include "platform/threads.h"
#include "src/base/digest.h"
#include "src/io/images/srgb.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

/// Light and alpha, and what of a pixel that was there before is left.
struct Rgba {
    float c[4];
    float left[3];
};

/// Radiances of one pixel: below 0 and what is no number become 0.
float sound(float v, std::uint64_t& broken) {
    if (!(v - v == 0.0f)) ++broken;
    return v == v ? (v < 0.0f ? 0.0f : v) : 0.0f;
}

/// What is laid over a host's own pixel: all light before it, and behind it where none of it is
/// seen.
Rgba pixel_over(const Planes& p, std::size_t i, std::uint64_t& broken) {
    const std::size_t pixels = p.transmittance.size();
    const float transmittance = p.transmittance[i];
    Rgba out{};
    float sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = c * pixels + i;
        out.c[c] = sound(p.colour[at] + transmittance * p.background[at], broken);
        out.left[c] = transmittance * p.kept[at];
        sum += out.left[c];
    }
    out.c[3] = 1.0f - sum * (1.0f / 3);
    return out;
}

/// The whole picture, or the media's own light.
Rgba pixel_of(const Planes& p, std::size_t i, bool whole, std::uint64_t& broken) {
    if (!whole && !p.kept.empty()) return pixel_over(p, i, broken);
    const std::size_t pixels = p.transmittance.size();
    const float transmittance = p.transmittance[i];
    Rgba out{};
    for (float& left : out.left) left = transmittance;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = c * pixels + i;
        float v = !whole && !p.cloud.empty() ? p.cloud[at] : p.colour[at];
        if (whole && !p.background.empty()) v += transmittance * p.background[at];
        out.c[c] = sound(v, broken);
    }
    out.c[3] = 1.0f - transmittance;
    return out;
}

/// Display-linear light of each 8-bit code, and the way back.
struct SrgbTable {
    float linear[256];
    SrgbCodes codes;
};

void fill(SrgbTable& table) {
    for (int i = 0; i < 256; ++i) table.linear[i] = float(linear_of_srgb(i / 255.0));
}

/// The curve is the program's; a medium is shown as its own light would be, as far as it covers.
Rgb<float> shown_of(const Rgba& p, PixelBlend blend, float gain) {
    const float share = blend != PixelBlend::kReplace ? p.c[3] : 1.0f;
    if (!(share > 0.0f)) return {};
    const Rgb<float> shown =
        tone_curve(Rgb<float>{p.c[0] / share, p.c[1] / share, p.c[2] / share}, gain);
    return {shown.r * share, shown.g * share, shown.b * share};
}

/// `red`: its byte, 0 or 2; blue has the other.
void store_8bit(const Rgba& p, PixelBlend blend, float gain, const SrgbTable* table,
                std::size_t red, unsigned char* to) {
    const std::size_t blue = 2 - red;
    Rgb<float> shown = shown_of(p, blend, gain);
    float alpha = p.c[3];
    if (blend == PixelBlend::kOver) {
        shown.r += p.left[0] * table->linear[to[red]];
        shown.g += p.left[1] * table->linear[to[1]];
        shown.b += p.left[2] * table->linear[to[blue]];
        alpha += (1.0f - alpha) * (float(to[3]) / 255.0f);
    }
    to[red] = table->codes(shown.r);
    to[1] = table->codes(shown.g);
    to[blue] = table->codes(shown.b);
    to[3] = static_cast<unsigned char>(alpha * 255.0f + 0.5f);
}

/// Codes of 10 bits: the light at which each begins, and its own.
struct DeepCodes {
    static constexpr std::uint32_t kMost = 1023;
    Buffer<float> begins, linear;

    Status make() {
        PILEUS_TRY(begins.resize(kMost + 1, "codes"));
        PILEUS_TRY(linear.resize(kMost + 1, "codes"));
        for (std::uint32_t i = 0; i <= kMost; ++i) {
            linear[i] = float(linear_of_srgb(double(i) / kMost));
            begins[i] = i == 0 ? 0.0f : float(linear_of_srgb((double(i) - 0.5) / kMost));
        }
        return Status::ok();
    }
    std::uint32_t code(float v) const {
        std::uint32_t low = 0;
        for (std::uint32_t step = 512; step > 0; step /= 2)
            if (v >= begins[low + step]) low += step;
        return low;
    }
};

/// A word of the machine's own byte order, red in its lowest bits.
void store_10bit(const Rgba& p, PixelBlend blend, float gain, const DeepCodes& codes,
                 unsigned char* to) {
    Rgb<float> shown = shown_of(p, blend, gain);
    float alpha = p.c[3];
    std::uint32_t word;
    if (blend == PixelBlend::kOver) {
        std::memcpy(&word, to, sizeof word);
        shown.r += p.left[0] * codes.linear[word & 1023u];
        shown.g += p.left[1] * codes.linear[word >> 10 & 1023u];
        shown.b += p.left[2] * codes.linear[word >> 20 & 1023u];
        alpha += (1.0f - alpha) * (float(word >> 30) / 3.0f);
    }
    word = codes.code(shown.r) | codes.code(shown.g) << 10 | codes.code(shown.b) << 20 |
           std::uint32_t(alpha * 3.0f + 0.5f) << 30;
    std::memcpy(to, &word, sizeof word);
}

/// A row of pixels; `Load` and `Store` are of one number of it.
template <class Number, class Load, class Store>
void store_row(const Planes& p, std::size_t first, std::size_t width, PixelBlend blend,
               unsigned char* row, std::uint64_t& broken, Load load, Store store) {
    for (std::size_t x = 0; x < width; ++x) {
        Rgba v = pixel_of(p, first + x, blend == PixelBlend::kReplace, broken);
        Number held[4];
        unsigned char* at = row + x * sizeof held;
        if (blend == PixelBlend::kOver) {
            std::memcpy(held, at, sizeof held);
            const float rest = 1.0f - v.c[3];
            // What is hidden may be infinite, and no times infinity is no number.
            for (int c = 0; c < 3; ++c)
                if (v.left[c] > 0.0f) v.c[c] += v.left[c] * load(held[c]);
            if (rest > 0.0f) v.c[3] += rest * load(held[3]);
        }
        for (int c = 0; c < 4; ++c) held[c] = store(v.c[c]);
        std::memcpy(at, held, sizeof held);
    }
}

/// The most frequent way, on lanes.
Status replace_8bit(const Planes& planes, int width, int height, const PixelTarget& target,
                    const SrgbTable& table, const KernelTable& kernels, int threads,
                    std::uint64_t& broken) {
    constexpr std::int64_t kPiece = 8;
    Buffer<std::int64_t> counts;
    PILEUS_TRY(counts.resize(std::uint64_t(height), "counters"));
    const PixelParams k{width, height, exposure_gain(target.stops)};
    PixelBuffers b{};
    b.transmittance = planes.transmittance.data();
    b.colour = planes.colour.data();
    b.background = planes.background.empty() ? nullptr : planes.background.data();
    b.codes = table.codes.bins();
    b.first = target.rows.row(0, height);
    b.stride = target.rows.bottom_up ? -target.rows.stride : target.rows.stride;
    b.broken = counts.data();
    parallel_for(threads, (height + kPiece - 1) / kPiece, [&](std::int64_t piece, int) {
        const std::int64_t begin = piece * kPiece, end = begin + kPiece;
        kernels.pixel_rows(k, b, std::uint32_t(begin), std::uint32_t(end < height ? end : height));
    });
    for (std::int64_t n : counts.span()) broken += std::uint64_t(n);
    if (target.format != PixelFormat::kBgra8Srgb) return Status::ok();
    parallel_for(threads, height, [&](std::int64_t y, int) {
        unsigned char* row = target.rows.row(int(y), height);
        for (int x = 0; x < width; ++x) std::swap(row[4 * x], row[4 * x + 2]);
    });
    return Status::ok();
}

bool is_8bit(PixelFormat format) {
    return format == PixelFormat::kRgba8Srgb || format == PixelFormat::kBgra8Srgb;
}

}  // namespace

std::size_t pixel_bytes(PixelFormat format) {
    return format == PixelFormat::kRgba16F ? 8 : format == PixelFormat::kRgba32F ? 16 : 4;
}

std::uint16_t half_of(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    const std::uint32_t sign = (bits >> 16) & 0x8000u, rest = bits & 0x7fffffffu;
    if (rest > 0x7f800000u) return std::uint16_t(sign | 0x7e00u);
    // 65520 and more round to infinity.
    if (rest >= 0x477ff000u) return std::uint16_t(sign | 0x7c00u);
    // Below 2^-25 all rounds to 0; below 2^-14 the last place is 2^-24.
    if (rest < 0x33000000u) return std::uint16_t(sign);
    std::uint32_t mantissa = rest & 0x7fffffu;
    const std::uint32_t exponent = rest >> 23;
    std::uint32_t shift = 13, half = 0;
    if (exponent < 113) {
        mantissa |= 0x800000u;
        shift = 126 - exponent;
    } else {
        half = (exponent - 112) << 10;
    }
    const std::uint32_t last = 1u << shift, lost = mantissa & (last - 1);
    half += mantissa >> shift;
    if (lost > last / 2 || (lost == last / 2 && (half & 1u) != 0)) ++half;
    return std::uint16_t(sign | half);
}

float float_of_half(std::uint16_t half) {
    const std::uint32_t sign = std::uint32_t(half & 0x8000u) << 16;
    const std::uint32_t exponent = (half >> 10) & 31u, mantissa = half & 0x3ffu;
    std::uint32_t bits = sign;
    if (exponent == 31) {
        bits |= 0x7f800000u | (mantissa << 13);
    } else if (exponent > 0) {
        bits |= ((exponent + 112) << 23) | (mantissa << 13);
    } else {
        const float small = float(mantissa) * 0x1p-24f;
        std::memcpy(&bits, &small, sizeof bits);
        bits |= sign;
    }
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

Status write_pixels(const Planes& planes, int width, int height, const PixelTarget& target,
                    const KernelTable* kernels, int threads, std::uint64_t& broken) {
    broken = 0;
    const bool codes_8bit = is_8bit(target.format);
    SrgbTable table{};
    if (codes_8bit && target.blend == PixelBlend::kOver) fill(table);
    DeepCodes deep;
    if (target.format == PixelFormat::kRgb10A2Srgb) PILEUS_TRY(deep.make());
    const std::size_t red = target.format == PixelFormat::kBgra8Srgb ? 2 : 0;
    if (codes_8bit && target.blend == PixelBlend::kReplace && kernels != nullptr &&
        kernels->pixel_rows != nullptr)
        return replace_8bit(planes, width, height, target, table, *kernels, threads, broken);
    const float gain = exposure_gain(target.stops);
    const std::size_t columns = std::size_t(width);
    std::atomic<std::uint32_t> all{0};  // below 2^30
    parallel_for(threads, height, [&](std::int64_t y, int) {
        unsigned char* row = target.rows.row(int(y), height);
        const std::size_t first = std::size_t(y) * columns;
        std::uint64_t own = 0;
        const bool whole = target.blend == PixelBlend::kReplace;
        if (codes_8bit)
            for (std::size_t x = 0; x < columns; ++x)
                store_8bit(pixel_of(planes, first + x, whole, own), target.blend, gain, &table, red,
                           row + 4 * x);
        else if (target.format == PixelFormat::kRgb10A2Srgb)
            for (std::size_t x = 0; x < columns; ++x)
                store_10bit(pixel_of(planes, first + x, whole, own), target.blend, gain, deep,
                            row + 4 * x);
        else if (target.format == PixelFormat::kRgba16F)
            store_row<std::uint16_t>(planes, first, columns, target.blend, row, own, float_of_half,
                                     half_of);
        else
            store_row<float>(
                planes, first, columns, target.blend, row, own, [](float v) { return v; },
                [](float v) { return v; });
        if (own > 0) all.fetch_add(std::uint32_t(own), std::memory_order_relaxed);
    });
    broken = all.load();
    return Status::ok();
}

std::uint64_t hash_planes(const Planes& planes) {
    Digest digest;
    constexpr std::size_t kBlock = 64;  // pixels: the stack of a flight is bounded
    float block[4 * kBlock];
    std::uint64_t broken = 0;
    const std::size_t pixels = planes.transmittance.size();
    for (std::size_t first = 0; first < pixels; first += kBlock) {
        const std::size_t count = pixels - first < kBlock ? pixels - first : kBlock;
        for (std::size_t i = 0; i < count; ++i) {
            const Rgba p = pixel_of(planes, first + i, true, broken);
            for (std::size_t c = 0; c < 4; ++c) block[4 * i + c] = p.c[c];
        }
        digest.floats({block, 4 * count});
    }
    return digest.value();
}

Status take_depths(const Rows& rows, DepthKind kind, const DepthScale& scale,
                   const CameraParams& camera, CameraDepth& depth) {
    const std::size_t width = std::size_t(camera.width);
    const std::uint64_t pixels = std::uint64_t(camera.width) * std::uint64_t(camera.height);
    if (depth.metres.size() != pixels) PILEUS_TRY(depth.metres.resize(pixels, "camera depth"));
    depth.columns = width;
    depth.broken = depth.negative = 0;
    for (int y = 0; y < camera.height; ++y) {
        const unsigned char* row = rows.row(y, camera.height);
        for (std::size_t x = 0; x < width; ++x) {
            float given;
            std::memcpy(&given, row + x * sizeof given, sizeof given);
            double metres = double(given);
            if (kind == DepthKind::kBuffer) metres = scale.metres(metres);
            if (kind != DepthKind::kDistance) metres *= ray_slant(camera, double(x), double(y));
            depth.put(std::size_t(y) * width + x, metres);
        }
    }
    return Status::ok();
}

void write_depths(const Planes& planes, const CameraParams& camera, DepthKind kind, bool halves,
                  const DepthScale& scale, const Rows& rows) {
    const std::size_t width = std::size_t(camera.width);
    for (int y = 0; y < camera.height; ++y) {
        unsigned char* row = rows.row(y, camera.height);
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t i = std::size_t(y) * width + x;
            float metres = planes.half_depth[i];
            if (!planes.opaque_depth.empty() && planes.opaque_depth[i] < metres)
                metres = planes.opaque_depth[i];
            if (kind != DepthKind::kDistance) {
                const double z = double(metres) / ray_slant(camera, double(x), double(y));
                metres = float(kind == DepthKind::kBuffer ? scale.value(z) : z);
            }
            if (halves) {
                const std::uint16_t half = half_of(metres);
                std::memcpy(row + x * sizeof half, &half, sizeof half);
            } else {
                std::memcpy(row + x * sizeof metres, &metres, sizeof metres);
            }
        }
    }
}

}  // namespace pileus
