// SPDX-License-Identifier: Apache-2.0
// See film_file.h. Words of 64 bits, little-endian: head, tally, sums, squares, digest of all.
#include "src/methods/path/film_file.h"

#include "src/base/digest.h"
#include "src/base/file.h"
#include "src/world/solids/camera_depth.h"
#include "src/world/solids/solids.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMagic = 0x4d4c494653554c50;  // "PLUSFILM"
constexpr std::uint64_t kFormat = 4;
// Magic, format, digest, width, height, parts, samples, pixels ahead and by how many samples.
constexpr std::size_t kHeadWords = 9;
constexpr std::size_t kTallyWords = sizeof(PathTally) / sizeof(std::int64_t);
constexpr std::uint64_t kMaxSamples = std::uint64_t{1} << 40;

std::uint64_t bits_of(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

std::size_t total_words(const Film& film) {
    return kHeadWords + kTallyWords + film.sum.size() + film.square.size() + 1;
}

void put(std::uint64_t word, char* to) {
    for (int i = 0; i < 8; ++i) to[i] = char(word >> (8 * i) & 255);
}
std::uint64_t get(const char* from) {
    std::uint64_t word = 0;
    for (int i = 0; i < 8; ++i) word |= std::uint64_t(static_cast<unsigned char>(from[i])) << 8 * i;
    return word;
}

/// Of all bytes of a file before its last word.
std::uint64_t digest_before_last(Span<const char> bytes) {
    Digest digest;
    digest.bytes(bytes.data, bytes.size - 8);
    return digest.value();
}

/// Writes words one behind the other.
struct Writer {
    char* to;

    void word(std::uint64_t w) {
        put(w, to);
        to += 8;
    }
};

Status fault(const std::string& path, const std::string& what) {
    return Status::bad_input(path + ": state: " + what +
                             ", allowed: the state of this scene with these settings, or a name "
                             "that is free");
}

void add_phase(const PhaseParams& phase, Digest& d) {
    // By what it does: tables behind pointers are part of that.
    for (int i = 0; i <= 64; ++i) d.f32(phase_density(phase, float(i) / 32.0f));
    for (int i = 0; i < 64; ++i)
        d.f32(phase_sample(phase, (float(i) + 0.5f) / 64.0f).one_minus_cos);
}

void add_medium(const PathInput& in, Digest& d) {
    const Medium& m = *in.medium;
    for (int a = 0; a < 3; ++a) {
        d.u32(std::uint32_t(m.grid.size[a]));
        d.f32(m.grid.cell_m[a]);
    }
    d.f32(m.sigma);
    d.u32(m.grid.periodic ? 1 : 0);
    d.u32(std::uint32_t(m.channels));
    d.u32(std::uint32_t(m.count));
    for (int i = 0; i < m.count; ++i) {
        const Optics& optics = m.optics[std::size_t(i)];
        for (float albedo : optics.albedo) d.f32(albedo);
        if (emits(m))
            for (float emission : optics.emission) d.f32(emission);
        add_phase(optics.phase, d);
    }
    d.floats(m.volume.density.span());
    d.floats(m.parts.span());
    d.u32(std::uint32_t(in.block));
    d.floats(in.majorants);
}

void add_paint(const GroundPaint& paint, Digest& d) {
    for (const float share : paint.share) d.f32(share);
    if (paint.sea != nullptr) {
        const SeaWaves& waves = paint.waves;
        d.f32(paint.sea->slope);
        for (int i = 0; i < kSeaWaves; ++i)
            for (const float v : {waves.x[i], waves.y[i], waves.phase[i], waves.lean_x[i],
                                  waves.lean_y[i], waves.bend[i][0], waves.bend[i][1]})
                d.f32(v);
    }
    const GroundMapView& map = paint.map;
    if (map.columns == 0) return;
    for (const std::int32_t v : {map.columns, map.rows, map.planes, map.repeats})
        d.u32(std::uint32_t(v));
    for (const float v : map.to_column) d.f32(v);
    for (const float v : map.to_row) d.f32(v);
    d.floats({map.albedo, std::size_t(map.texels) * std::size_t(map.planes)});
}

void add_light(const Lighting& light, Digest& d) {
    d.u32(light.sunlit ? 1 : 0);
    d.u32(light.ground.present ? 1 : 0);
    for (std::size_t c = 0; c < 3; ++c) {
        d.f32(light.to_sun[c]);
        d.f32(float(light.sun_irradiance[c]));
        d.f32(float(light.sky[c]));
    }
    // In air the sun at the ground tells its light at every height.
    for (std::size_t c = 0; c < 3 && light.sun_heights.rows > 0; ++c)
        d.f32(float(sun_at_height(light, light.ground.z)[int(c)]));
    d.f32(float(light.ground.z));
    d.f32(float(light.ground.albedo));
    if (light.ground.paint.on != 0) add_paint(light.ground.paint, d);
    for (const LampParams& lamp : light.lamps) {
        d.u32(std::uint32_t(lamp.parallel));
        for (std::size_t c = 0; c < 3; ++c) {
            d.f32(lamp.at[c]);
            d.f32(lamp.axis[c]);
            d.f32(lamp.light[c]);
        }
        d.f32(lamp.edge);
        d.f32(lamp.slope);
        d.f32(lamp.least_square);
        if (lamp.radius > 0) d.f32(lamp.radius);
    }
    const SkyMapView& map = light.map;
    d.u32(std::uint32_t(map.columns));
    d.u32(std::uint32_t(map.rows));
    d.f32(map.turn_of_first);
    const std::size_t texels = std::size_t(map.columns) * std::size_t(map.rows);
    if (texels > 0) d.floats({map.radiance, texels * std::size_t(map.planes)});
}

void add_camera(const CameraParams& c, Digest& d) {
    for (const float* axis : {c.origin, c.right, c.up, c.forward}) d.floats({axis, 3});
    d.f32(c.half_width);
    d.f32(c.half_height);
    for (std::int32_t v : {c.width, c.height, c.orthographic, c.flux, c.left, c.top, c.more_columns,
                           c.more_rows, c.parts, c.part})
        d.u32(std::uint32_t(v));
}

/// Word `i` of a file, whose length is a multiple of eight bytes.
std::uint64_t word_at(Span<const char> bytes, std::size_t i) {
    return get(bytes.part(8 * i, 8).data);
}

/// The head of a file against the film that it should fill.
Status check_head(const std::string& path, Span<const char> bytes, std::uint64_t digest,
                  const Film& film) {
    const std::uint64_t samples = word_at(bytes, 6);
    if (word_at(bytes, 0) != kMagic) return fault(path, "not a file of this kind");
    if (word_at(bytes, 1) != kFormat)
        return fault(path, "written in form " + std::to_string(word_at(bytes, 1)) +
                               ", this version reads " + std::to_string(kFormat));
    if (word_at(bytes, 2) != digest || word_at(bytes, 3) != std::uint64_t(film.width) ||
        word_at(bytes, 4) != std::uint64_t(film.height) ||
        word_at(bytes, 5) != std::uint64_t(film.parts))
        return fault(path, "of another scene, seed, layers or version");
    const std::uint64_t ahead = word_at(bytes, 7), more = word_at(bytes, 8);
    if (ahead > 0 && (ahead >= film.pixels() || more == 0 || more > 0xffffffffu / film.pixels()))
        return fault(path, "damaged, a pass that cannot be");
    return samples <= kMaxSamples ? Status::ok() : fault(path, "damaged, too many samples");
}

/// Copies doubles out of the file, from word `first` on; false where one is no finite number.
bool take_doubles(Span<const char> bytes, std::size_t first, Buffer<double>& to) {
    bool finite = true;
    for (std::size_t i = 0; i < to.size(); ++i) {
        const std::uint64_t bits = word_at(bytes, first + i);
        std::memcpy(&to[i], &bits, sizeof bits);
        finite = finite && to[i] - to[i] == 0;
    }
    return finite;
}

Status decode(const std::string& path, Span<const char> bytes, std::uint64_t digest, Film& film) {
    const std::size_t words = total_words(film);
    // A file of another kind is named as one before its length is looked at.
    if (bytes.size >= 8 && word_at(bytes, 0) != kMagic)
        return fault(path, "not a file of this kind");
    if (bytes.size >= 8 * kHeadWords) PILEUS_TRY(check_head(path, bytes, digest, film));
    if (bytes.size != 8 * words)
        return fault(path, std::to_string(bytes.size) + " bytes instead of " +
                               std::to_string(8 * words) + ", cut or damaged");
    if (digest_before_last(bytes) != word_at(bytes, words - 1))
        return fault(path, "damaged, its digest does not fit");
    std::int64_t tally[kTallyWords];
    for (std::size_t i = 0; i < kTallyWords; ++i)
        tally[i] = std::int64_t(word_at(bytes, kHeadWords + i));
    std::memcpy(&film.tally, tally, sizeof tally);
    const std::size_t sums = kHeadWords + kTallyWords;
    bool finite = take_doubles(bytes, sums, film.sum);
    finite = take_doubles(bytes, sums + film.sum.size(), film.square) && finite;
    if (!finite) return fault(path, "damaged, a sum is no finite number");
    film.samples = word_at(bytes, 6);
    film.ahead = word_at(bytes, 7);
    film.ahead_samples = film.ahead > 0 ? word_at(bytes, 8) : 0;
    return Status::ok();
}

void add_solids(const Solids& solids, Digest& d) {
    for (const SolidTriangle& t : solids.triangles.span()) {
        for (const auto& corner : t.corner) d.floats({corner, 3});
        d.u32(std::uint32_t(t.colour));
        if (t.smooth > 0) d.floats(solids.normals.span().part(9 * std::size_t(t.smooth - 1), 9));
    }
    d.floats(solids.albedo.span());
}

}  // namespace

std::uint64_t path_state_digest(const PathInput& in, const std::string& version) {
    Digest d;
    d.text(version);
    add_medium(in, d);
    add_light(*in.lighting, d);
    if (in.lighting->solids != nullptr) add_solids(*in.lighting->solids, d);
    if (in.lighting->depth != nullptr) d.floats(in.lighting->depth->metres.span());
    add_camera(in.camera, d);
    d.u64(in.seed);
    d.u32(std::uint32_t(in.rules.max_depth));
    d.u32(in.jitter ? 1 : 0);
    d.u32(in.parts ? 1 : 0);
    d.u32(in.rules.max_events);
    d.u32(in.rules.guide ? 1 : 0);
    d.f32(float(in.rules.sun_radius_deg));
    d.u32(in.rules.importance != nullptr ? 1 : 0);
    return d.value();
}

std::uint64_t path_state_bytes(std::uint64_t film_bytes) {
    return film_bytes + 8 * (kHeadWords + kTallyWords + 1);
}

Status write_path_state(const std::string& path, std::uint64_t digest, const Film& film) {
    Buffer<char> bytes;
    PILEUS_TRY(bytes.resize(8 * std::uint64_t(total_words(film)), "state file"));
    Writer out{bytes.data()};
    for (std::uint64_t word :
         {kMagic, kFormat, digest, std::uint64_t(film.width), std::uint64_t(film.height),
          std::uint64_t(film.parts), film.samples, film.ahead, film.ahead_samples})
        out.word(word);
    std::int64_t tally[kTallyWords];
    std::memcpy(tally, &film.tally, sizeof tally);
    for (std::int64_t count : tally) out.word(std::uint64_t(count));
    for (double v : film.sum.span()) out.word(bits_of(v));
    for (double v : film.square.span()) out.word(bits_of(v));
    put(digest_before_last(bytes.span()), out.to);
    return write_file(path, bytes.span());
}

Status read_path_state(const std::string& path, std::uint64_t digest, Film& film) {
    PILEUS_TRY(check_file_name(path));
    InputFile file;
    if (file.open(path.c_str()).fault == FileFault::kMissing) return Status::ok();
    PILEUS_TRY(open_file(path, file));
    const std::uint64_t expected = 8 * std::uint64_t(total_words(film));
    Buffer<char> bytes;
    // A longer file is foreign; one byte more than expected is enough to tell.
    PILEUS_TRY(read_file_start(path, expected + 1, bytes));
    return decode(path, bytes.span(), digest, film);
}

}  // namespace pileus
