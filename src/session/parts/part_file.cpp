// SPDX-License-Identifier: Apache-2.0
// See parts.h: parts as bytes. Words of 64 bits, little-endian; texts behind their lengths, padded
// to words; the last word is the digest of all before.
#include <cstring>

#include "src/base/digest.h"
#include "src/io/images/image_file.h"
#include "src/session/parts/parts.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMagic = 0x5452415053554c50;  // "PLUSPART"
constexpr std::uint64_t kFormat = 1;
constexpr std::uint64_t kMaxTexts = 4096, kMaxPartChannels = 256;

std::uint64_t little(std::uint64_t v) {
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return __builtin_bswap64(v);
#else
    return v;
#endif
}

/// Counts words first, then writes them.
class Writer {
public:
    explicit Writer(char* to) : to_(to) {}
    std::uint64_t words() const { return words_; }

    void word(std::uint64_t v) {
        v = little(v);
        if (to_ != nullptr) std::memcpy(to_ + 8 * words_, &v, 8);
        ++words_;
    }
    void text(const std::string& s) {
        word(s.size());
        if (to_ != nullptr) {
            std::memset(to_ + 8 * words_, 0, (s.size() + 7) / 8 * 8);
            std::memcpy(to_ + 8 * words_, s.data(), s.size());
        }
        words_ += (s.size() + 7) / 8;
    }
    void number(double v) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &v, sizeof bits);
        word(bits);
    }
    void number(float v) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &v, sizeof bits);
        word(bits);
    }

private:
    char* to_;
    std::uint64_t words_ = 0;
};

void write_part(const Part& part, Writer& w) {
    w.word(kMagic);
    w.word(kFormat);
    w.word(std::uint64_t(part.division));
    w.word(part.part.index);
    w.word(part.part.count);
    w.word(std::uint64_t(part.frame));
    w.text(part.rows.scene_text);
    w.word(part.rows.origin.size());
    for (const auto& [name, text] : part.rows.origin) w.text(name), w.text(text);
    w.word(part.counters.size());
    for (const auto& [name, count] : part.counters) w.text(name), w.word(count);
    for (const auto* list : {&part.light.same, &part.light.first}) {
        w.word(list->size());
        for (const std::uint64_t v : *list) w.word(v);
    }
    w.word(part.light.sums.size());
    for (const std::int64_t v : part.light.sums.span()) w.word(std::uint64_t(v));
    w.word(part.light.rows.size());
    for (const double v : part.light.rows.span()) w.number(v);
    w.word(std::uint64_t(part.rows.width));
    w.word(std::uint64_t(part.rows.height));
    for (const auto* matrix : {&part.rows.world_to_camera, &part.rows.world_to_ndc})
        for (const float v : *matrix) w.number(v);
    w.number(part.rows.screen_window_width);
    w.word(part.rows.channels.size());
    for (const Channel& channel : part.rows.channels) {
        w.text(channel.name);
        for (const float v : channel.pixels.span()) w.number(v);
    }
}

/// Reads words of a file; what is not there is 0 and a fault.
class Reader {
public:
    explicit Reader(Span<const char> bytes) : bytes_(bytes) {}
    bool sound() const { return sound_; }
    std::uint64_t left() const { return bytes_.size / 8 - at_; }

    std::uint64_t word() {
        if (left() < 1) return fail();
        std::uint64_t v = 0;
        std::memcpy(&v, bytes_.data + 8 * at_++, 8);
        return little(v);
    }
    /// A length of what takes so many words each.
    std::uint64_t count(std::uint64_t words_each, std::uint64_t most = ~std::uint64_t{0}) {
        const std::uint64_t n = word();
        return n > most || n > left() / words_each ? fail() : n;
    }
    std::string text() {
        const std::uint64_t size = word(), words = size / 8 + (size % 8 != 0 ? 1 : 0);
        if (words > left()) return fail(), "";
        const std::string s(bytes_.data + 8 * at_, std::size_t(size));
        at_ += words;
        return s;
    }
    double number64() {
        const std::uint64_t bits = word();
        double v = 0;
        std::memcpy(&v, &bits, sizeof v);
        return v;
    }
    float number32() {
        const std::uint64_t word_of = word();
        if (word_of >> 32 != 0) fail();
        const auto bits = std::uint32_t(word_of);
        float v = 0;
        std::memcpy(&v, &bits, sizeof v);
        return v;
    }
    std::uint64_t fail() {
        sound_ = false;
        return 0;
    }

private:
    Span<const char> bytes_;
    std::uint64_t at_ = 0;
    bool sound_ = true;
};

Status read_light(Reader& r, PartLight& light) {
    for (auto* list : {&light.same, &light.first}) {
        const std::uint64_t n = r.count(1);
        for (std::uint64_t i = 0; i < n && r.sound(); ++i) list->push_back(r.word());
    }
    PILEUS_TRY(light.sums.resize(r.count(1), "light of a part"));
    for (std::int64_t& v : light.sums.span()) v = std::int64_t(r.word());
    PILEUS_TRY(light.rows.resize(r.count(1), "light of a part"));
    for (double& v : light.rows.span()) {
        v = r.number64();
        if (!(v - v == 0)) r.fail();
    }
    return Status::ok();
}

Status read_rows(Reader& r, Image& rows) {
    const std::uint64_t width = r.word(), height = r.word();
    if (width > 32768 || height > 32768) r.fail();
    for (auto* matrix : {&rows.world_to_camera, &rows.world_to_ndc})
        for (float& v : *matrix) v = r.number32();
    rows.screen_window_width = r.number32();
    const std::uint64_t channels = r.count(1, kMaxPartChannels);
    if (!r.sound()) return Status::ok();
    rows.width = int(width);
    rows.height = int(height);
    for (std::uint64_t c = 0; c < channels && r.sound(); ++c) {
        Channel channel;
        channel.name = r.text();
        if (width * height > r.left()) r.fail();
        if (!r.sound()) break;
        PILEUS_TRY(channel.pixels.resize(width * height, "rows of a part"));
        for (float& v : channel.pixels.span()) v = r.number32();
        rows.channels.push_back(std::move(channel));
    }
    return Status::ok();
}

std::uint64_t digest_of(Span<const char> bytes) {
    Digest digest;
    digest.bytes(bytes.data, bytes.size);
    return digest.value();
}

}  // namespace

Status encode_part(const Part& part, Buffer<char>& bytes) {
    Writer count(nullptr);
    write_part(part, count);
    PILEUS_TRY(bytes.resize(8 * (count.words() + 1), "part file"));
    Writer out(bytes.data());
    write_part(part, out);
    const std::uint64_t digest = little(digest_of({bytes.data(), std::size_t(8 * count.words())}));
    std::memcpy(bytes.data() + 8 * count.words(), &digest, 8);
    return Status::ok();
}

Status decode_part(const std::string& name, Span<const char> bytes, Part& part) {
    const auto fault = [&](const std::string& what) {
        return Status::bad_input(name + ": part: " + what + ", allowed: a file of render --part");
    };
    part = Part();
    part.name = name;
    Reader r(bytes);
    if (bytes.size < 24 || r.word() != kMagic) return fault("not a file of this kind");
    const std::uint64_t format = r.word();
    if (format != kFormat) return fault("written in form " + std::to_string(format));
    std::uint64_t last = 0;
    std::memcpy(&last, bytes.data + bytes.size / 8 * 8 - 8, 8);
    if (bytes.size % 8 != 0 || digest_of({bytes.data, bytes.size - 8}) != little(last))
        return fault("damaged or cut, its digest does not fit");
    const std::uint64_t division = r.word(), index = r.word(), parts = r.word(), frame = r.word();
    if (division > 3 || parts < 1 || parts > kMaxParts || index >= parts || frame > 0x7fffffff)
        return fault("damaged, no such part");
    part.division = Division(division);
    part.part.index = std::uint32_t(index);
    part.part.count = std::uint32_t(parts);
    part.frame = int(frame);
    part.rows.scene_text = r.text();
    const std::uint64_t texts = r.count(2, kMaxTexts);
    for (std::uint64_t i = 0; i < texts && r.sound(); ++i) {
        std::string key = r.text(), text = r.text();
        part.rows.origin.emplace_back(std::move(key), std::move(text));
    }
    const std::uint64_t counters = r.count(2, kMaxTexts);
    for (std::uint64_t i = 0; i < counters && r.sound(); ++i) {
        std::string key = r.text();
        part.counters.emplace_back(std::move(key), r.word());
    }
    PILEUS_TRY(read_light(r, part.light));
    PILEUS_TRY(read_rows(r, part.rows));
    if (!r.sound() || r.left() != 1) return fault("damaged");
    return Status::ok();
}

}  // namespace pileus
