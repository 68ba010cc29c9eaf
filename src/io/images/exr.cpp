// SPDX-License-Identifier: Apache-2.0
// OpenEXR in memory; with exr_tiles.cpp all that touches OpenEXR, whose exceptions end here.
// in: an Image -> out: the bytes of a 32-bit float scanline ZIP file without clock or host; back.
// OpenEXR file layout and standard attributes; docs/formats.md
#include "src/io/images/exr_header.h"
#include "src/io/images/image_file.h"

#ifdef PILEUS_WITH_OPENEXR
#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#endif

namespace pileus {

#ifdef PILEUS_WITH_OPENEXR
namespace {

/// Grows a buffer as the library writes and seeks in it.
class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : Imf::OStream("memory") {}
    void write(const char data[], int count) override {
        const std::uint64_t end = at_ + std::uint64_t(count);
        if (end > bytes_.size()) grow(end);
        std::memcpy(bytes_.data() + at_, data, std::size_t(count));
        at_ = end;
        if (end > used_) used_ = end;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }
    /// Hands over what was written, without a copy.
    void take(Buffer<char>& bytes) {
        bytes_.truncate(std::size_t(used_));
        bytes.swap(bytes_);
    }

private:
    void grow(std::uint64_t end) {
        Buffer<char> larger;
        if (!larger.resize(end * 2, "EXR file")) throw std::bad_alloc();
        if (used_ > 0) std::memcpy(larger.data(), bytes_.data(), std::size_t(used_));
        bytes_.swap(larger);
    }
    Buffer<char> bytes_;
    std::uint64_t at_ = 0, used_ = 0;
};

/// Reads from bytes that it does not own; never past their end.
class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(Span<const char> bytes) : Imf::IStream("memory"), bytes_(bytes) {}
    bool read(char data[], int count) override {
        if (count < 0 || at_ > bytes_.size || std::size_t(count) > bytes_.size - at_)
            throw std::runtime_error("unexpected end of file");
        std::memcpy(data, bytes_.data + at_, std::size_t(count));
        at_ += std::size_t(count);
        return at_ < bytes_.size;
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = std::size_t(position); }

private:
    Span<const char> bytes_;
    std::size_t at_ = 0;
};

/// What names of our own attributes begin with.
constexpr std::string_view kOurs = "pileus.";

/// Rec. 709 primaries and white point D65.
Imf::Chromaticities rec709() {
    return {{0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}};
}

Imath::M44f to_matrix(const std::array<float, 16>& values) {
    Imath::M44f matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[std::size_t(i)];
    return matrix;
}

std::array<float, 16> from_matrix(const Imath::M44f& matrix) {
    std::array<float, 16> values;
    for (int i = 0; i < 16; ++i) values[std::size_t(i)] = matrix[i / 4][i % 4];
    return values;
}

/// The pixels as the data window, in the display window where the picture is a part of one.
Imf::Header sized_header(const Image& image) {
    const DisplayWindow& shown = image.display;
    // What other programs count from far away is counted from here.
    constexpr std::int64_t kMax = 1 << 24;
    const auto far = [](std::int64_t v) { return v < -kMax || v > kMax; };
    if (shown.width == 0 || far(shown.x) || far(shown.y) || far(shown.width) || far(shown.height))
        return Imf::Header(image.width, image.height);
    const Imath::V2i first(int(-shown.x), int(-shown.y));
    return Imf::Header(Imath::Box2i({0, 0}, {int(shown.width) - 1, int(shown.height) - 1}),
                       Imath::Box2i(first, first + Imath::V2i(image.width - 1, image.height - 1)));
}

}  // namespace

Imf::Header make_header(const Image& image) {
    Imf::Header header = sized_header(image);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.zipCompressionLevel() = 4;
    header.screenWindowWidth() = image.screen_window_width;
    Imf::addChromaticities(header, rec709());
    Imf::addWorldToCamera(header, to_matrix(image.world_to_camera));
    Imf::addWorldToNDC(header, to_matrix(image.world_to_ndc));
    header.insert("pileus.scene", Imf::StringAttribute(image.scene_text));
    header.insert("pileus.pixelHash", Imf::StringAttribute(image.pixel_hash));
    for (const auto& [name, text] : image.origin)
        header.insert(std::string(kOurs) + name, Imf::StringAttribute(text));
    for (const Channel& channel : image.channels)
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    return header;
}

namespace {

void write_stream(const Image& image, MemoryOutput& stream) {
    const Imf::Header header = make_header(image);
    Imf::FrameBuffer frame;
    const std::size_t row = std::size_t(image.width) * sizeof(float);
    for (const Channel& channel : image.channels) {
        frame.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.pixels.data(),
                                                    header.dataWindow(), sizeof(float), row));
    }
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
}

/// What would make colours or rows something else than what they are taken for.
std::string foreign_meaning(const Imf::Header& header) {
    if (Imf::hasEnvmap(header) && Imf::envmap(header) != Imf::ENVMAP_LATLONG)
        return "envmap: a cube, allowed: latitude and longitude";
    if (!Imf::hasChromaticities(header)) return "";
    const Imf::Chromaticities &own = Imf::chromaticities(header), ours = rec709();
    const Imath::V2f pairs[4][2] = {{own.red, ours.red},
                                    {own.green, ours.green},
                                    {own.blue, ours.blue},
                                    {own.white, ours.white}};
    // Other programs round to three digits, or have white at 0.3127 0.3291.
    bool same = true;
    for (const auto& pair : pairs)
        for (int a = 0; a < 2; ++a) {
            const float apart = pair[0][a] - pair[1][a];
            same = same && apart < 2e-3f && apart > -2e-3f;
        }
    if (same) return "";
    return "chromaticities: red at " + std::to_string(own.red.x) + ' ' + std::to_string(own.red.y) +
           ", white at " + std::to_string(own.white.x) + ' ' + std::to_string(own.white.y) +
           ", allowed: those of Rec. 709, or none";
}

void read_attributes(const Imf::Header& header, Image& image) {
    image.foreign = foreign_meaning(header);
    if (Imf::hasWorldToCamera(header))
        image.world_to_camera = from_matrix(Imf::worldToCamera(header));
    if (Imf::hasWorldToNDC(header)) image.world_to_ndc = from_matrix(Imf::worldToNDC(header));
    image.screen_window_width = header.screenWindowWidth();
    const auto* scene = header.findTypedAttribute<Imf::StringAttribute>("pileus.scene");
    const auto* hash = header.findTypedAttribute<Imf::StringAttribute>("pileus.pixelHash");
    if (scene != nullptr) image.scene_text = scene->value();
    if (hash != nullptr) image.pixel_hash = hash->value();
    for (auto a = header.begin(); a != header.end(); ++a) {
        const std::string name = a.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
        if (text == nullptr || text == scene || text == hash ||
            name.compare(0, kOurs.size(), kOurs))
            continue;
        image.origin.emplace_back(name.substr(kOurs.size()), text->value());
    }
}

/// Refuses what a small file can claim but not hold.
Status check_header(const std::string& name, const Imf::Header& header, std::uint64_t file_bytes,
                    std::uint64_t most_pixels) {
    const Imath::Box2i& window = header.dataWindow();
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    PILEUS_TRY(check_image_size(name, width, height, most_pixels));
    std::size_t channels = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c, ++channels)
        if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
            return Status::bad_input(name + ": channel " + printable_line(c.name()) +
                                     ": subsampled, allowed: one value per pixel");
    if (channels < 1 || channels > kMaxChannels)
        return Status::bad_input(name + ": channels: wrong number, " + std::to_string(channels) +
                                 ", allowed: 1 to " + std::to_string(kMaxChannels));
    const std::uint64_t decoded = std::uint64_t(width) * std::uint64_t(height) * channels * 4;
    const std::uint64_t plausible = plausible_exr_bytes(file_bytes);
    if (decoded > plausible)
        return Status::limit(name + ": size: too large, " + std::to_string(decoded) +
                             " bytes once decoded, allowed: at most " + std::to_string(plausible));
    return Status::ok();
}

Status read_stream(const std::string& name, Span<const char> bytes, Image& image,
                   std::uint64_t most_pixels) {
    // The library takes memory for all that the head claims, so look at the head first.
    PILEUS_TRY(check_exr_head(name, bytes, most_pixels));
    MemoryInput stream(bytes);
    Imf::InputFile file(stream, 0);
    const Imf::Header& header = file.header();
    PILEUS_TRY(check_header(name, header, bytes.size, most_pixels));
    const Imath::Box2i& window = header.dataWindow();
    image.width = window.max.x - window.min.x + 1;
    image.height = window.max.y - window.min.y + 1;
    const Imath::Box2i& shown = header.displayWindow();
    image.display = {
        std::int64_t(shown.min.x) - window.min.x, std::int64_t(shown.min.y) - window.min.y,
        std::int64_t(shown.max.x) - shown.min.x + 1, std::int64_t(shown.max.y) - shown.min.y + 1};
    const std::uint64_t pixels = std::uint64_t(image.width) * std::uint64_t(image.height);

    // Every channel becomes a plane of floats whose first value is the window's upper left corner.
    Imf::FrameBuffer frame;
    const std::size_t row = std::size_t(image.width) * sizeof(float);
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        image.channels.emplace_back();
        image.channels.back().name = c.name();
        PILEUS_TRY(image.channels.back().pixels.resize(pixels, name.c_str()));
        frame.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, image.channels.back().pixels.data(),
                                                window, sizeof(float), row));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    read_attributes(header, image);
    return Status::ok();
}

}  // namespace

Status encode_exr(const Image& image, Buffer<char>& bytes) {
    try {
        MemoryOutput stream;
        write_stream(image, stream);
        stream.take(bytes);
        return Status::ok();
    } catch (const std::bad_alloc&) {
        return Status::limit("EXR file: out of memory");
    } catch (const std::exception& fault) {
        // The picture is sound and nothing is written yet: only memory can be what is missing.
        return Status::limit("EXR file: out of memory, " + printable_line(fault.what()));
    }
}

Status decode_exr(const std::string& name, Span<const char> bytes, Image& image,
                  std::uint64_t most_pixels) {
    try {
        return read_stream(name, bytes, image, most_pixels);
    } catch (const std::bad_alloc&) {
        return Status::limit(name + ": EXR file: out of memory");
    } catch (const std::exception& fault) {
        return Status::bad_input(name + ": EXR file: not readable, " +
                                 printable_line(fault.what()));
    }
}
#else
Status encode_exr(const Image&, Buffer<char>&) {
    return Status::bad_input(
        "EXR file: left out of this build, configure with -DPILEUS_OPENEXR=ON");
}
Status decode_exr(const std::string& name, Span<const char>, Image&, std::uint64_t) {
    return Status::bad_input(name +
                             ": EXR file: left out of this build, configure with "
                             "-DPILEUS_OPENEXR=ON");
}
#endif

}  // namespace pileus
