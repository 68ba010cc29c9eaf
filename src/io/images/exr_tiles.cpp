// SPDX-License-Identifier: Apache-2.0
// See exr_tiles.h. Exceptions of OpenEXR end here.
#include "src/io/images/exr_tiles.h"

#include "src/base/file.h"
#include "src/io/images/exr_header.h"
#include "src/io/images/image_file.h"

#ifdef PILEUS_WITH_OPENEXR
#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfTiledOutputFile.h>

#include <exception>
#include <new>
#include <stdexcept>
#endif

namespace pileus {

#ifdef PILEUS_WITH_OPENEXR
namespace {

/// Writes to a file that has no name yet, and keeps its first bytes.
class FileOutput : public Imf::OStream {
public:
    explicit FileOutput(NewFile& file) : Imf::OStream("file"), file_(file) {}
    void write(const char data[], int count) override {
        result = file_.write_at(at_, data, std::size_t(count));
        if (!result) throw std::runtime_error("cannot write");
        if (at_ == head.size() && at_ < kHead) head.append(data, std::size_t(count));
        at_ += std::uint64_t(count);
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }

    FileResult result;
    std::string head;

private:
    static constexpr std::size_t kHead = std::size_t{1} << 22;
    NewFile& file_;
    std::uint64_t at_ = 0;
};

}  // namespace

struct TiledExr::Writer {
    NewFile file;
    FileOutput stream{file};
    std::unique_ptr<Imf::TiledOutputFile> out;
    std::string path;
    int side = 0;
    std::uint64_t hash_at = 0;

    /// Where the header has the 16 letters of the hash, which is known last.
    bool find_hash() {
        const std::string name("pileus.pixelHash\0string\0\x10\0\0\0", 28);
        const std::size_t at = stream.head.find(name);
        hash_at = at + name.size();
        return at != std::string::npos;
    }
    void begin(const Image& band, int height) {
        Image whole;
        whole.width = band.width;
        whole.height = height;
        whole.world_to_camera = band.world_to_camera;
        whole.world_to_ndc = band.world_to_ndc;
        whole.screen_window_width = band.screen_window_width;
        whole.scene_text = band.scene_text;
        whole.origin = band.origin;
        whole.pixel_hash = "0000000000000000";
        Imf::Header header = make_header(whole);
        for (const Channel& channel : band.channels)
            header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        header.setTileDescription(Imf::TileDescription(unsigned(side), unsigned(side)));
        header.lineOrder() = Imf::INCREASING_Y;
        out = std::make_unique<Imf::TiledOutputFile>(stream, header, 0);
    }
    void write(int y, const Image& band) {
        Imf::FrameBuffer frame;
        const Imath::Box2i window({0, y}, {band.width - 1, y + band.height - 1});
        const std::size_t row = std::size_t(band.width) * sizeof(float);
        for (const Channel& channel : band.channels)
            frame.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.pixels.data(), window,
                                                        sizeof(float), row));
        out->setFrameBuffer(frame);
        const int from = y / side, to = (y + band.height + side - 1) / side;
        out->writeTiles(0, out->numXTiles() - 1, from, to - 1);
    }
};

TiledExr::TiledExr() = default;
TiledExr::~TiledExr() = default;

Status TiledExr::begin(const std::string& path, int side) {
    writer_ = std::make_unique<Writer>();
    writer_->path = path;
    writer_->side = side;
    const FileResult result = writer_->file.begin(path.c_str());
    if (!result) return write_fault(path, result);
    if (!writer_->file.has_places())
        return Status::io(path + ": a device or a pipe, allowed: a file");
    return Status::ok();
}

Status TiledExr::add(int y, int height, const Image& band) {
    try {
        if (!writer_->out) writer_->begin(band, height);
        writer_->write(y, band);
        return Status::ok();
    } catch (const std::bad_alloc&) {
        return Status::limit("EXR file: out of memory");
    } catch (const std::exception&) {
        return write_fault(writer_->path, writer_->stream.result);
    }
}

Status TiledExr::end(const std::string& hash) {
    try {
        writer_->out.reset();
    } catch (const std::exception&) {
        return write_fault(writer_->path, writer_->stream.result);
    }
    FileResult result = writer_->stream.result;
    if (result && hash.size() == 16 && writer_->find_hash())
        result = writer_->file.write_at(writer_->hash_at, hash.data(), hash.size());
    if (result) result = writer_->file.flush();
    if (result) result = writer_->file.publish();
    if (!result) return write_fault(writer_->path, result);
    writer_->file.keep();
    return Status::ok();
}
#else
struct TiledExr::Writer {};
TiledExr::TiledExr() = default;
TiledExr::~TiledExr() = default;
Status TiledExr::begin(const std::string&, int) {
    Buffer<char> none;
    return encode_exr(Image(), none);
}
Status TiledExr::add(int, int, const Image&) { return Status::ok(); }
Status TiledExr::end(const std::string&) { return Status::ok(); }
#endif

}  // namespace pileus
