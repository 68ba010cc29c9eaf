// SPDX-License-Identifier: Apache-2.0
// See pack.h.
#include "src/flight/pack.h"

#include "src/base/digest.h"
#include "src/flight/fields_scene.h"
#include "src/flight/fields_world.h"
#include "src/methods/path/path_importance.h"
#include "src/scene/method_column.h"
#include "src/world/camera/places.h"
#include "src/world/medium/detail.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMagic = 0x4c465355454c4950ull;  // "PILEUSFL"
constexpr std::uint64_t kFormat = 10;
/// Its last bytes are zeros, so that what follows begins at a multiple of kLine.
constexpr std::size_t kHeadBytes = 2 * kLine, kToldBytes = 8 * 8 + 24, kDigestAt = 24;

/// Of all but the digest's own eight bytes.
std::uint64_t digest_of(const char* bytes, std::size_t size) {
    Digest digest;
    digest.bytes(bytes, kDigestAt);
    digest.bytes(bytes + kDigestAt + 8, size - kDigestAt - 8);
    return digest.value();
}

struct Head {
    std::uint64_t magic = kMagic, format = kFormat, payload = 0, digest = 0;
    PackedHead told;
};

template <class A>
void fields(A& a, Head& v) {
    for (std::uint64_t* word : {&v.magic, &v.format, &v.payload, &v.digest, &v.told.width,
                                &v.told.height, &v.told.block_bytes, &v.told.in_place_bytes})
        a.word(*word, 8);
    for (std::size_t i = 0; i < 24; ++i) {
        std::uint64_t letter = i < v.told.method.size() ? std::uint8_t(v.told.method[i]) : 0;
        a.word(letter, 1);
        if constexpr (A::kReads)
            if (letter != 0 && i < 23) v.told.method += char(letter);
    }
    for (std::size_t i = kToldBytes; i < kHeadBytes; ++i) {
        std::uint64_t none = 0;
        a.word(none, 1);
    }
}

/// Numbers of the tables that the media point to: one more than the store's, 0 for none.
void number_tables(const Medium& medium, std::array<std::uint64_t, kMaxMedia>& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = 0;
        for (std::size_t k = 0; k < medium.phases.size(); ++k)
            if (medium.optics[i].phase.table != nullptr &&
                medium.optics[i].phase.table == medium.phases[k].table.data())
                numbers[i] = k + 1;
    }
}

template <class A>
void sky_fields(A& a, Image& sky) {
    all(a, sky.width, sky.height);
    std::uint64_t channels = sky.channels.size();
    a.word(channels, 8);
    if constexpr (A::kReads) {
        if (channels > 4) return a.fail();
        sky.channels.resize(std::size_t(channels));
    }
    for (Channel& channel : sky.channels) all(a, channel.name, channel.pixels);
}

Status refuse(const Scene& scene, const char* key, const char* what, const char* allowed) {
    return Status::bad_input(scene.file + ": " + key + ": " + what + ", allowed: " + allowed);
}

Status check_packable(const Scene& scene) {
    if (!scene.solids.empty())
        return refuse(scene, "solid", "not packed",
                      "no meshes: the host's depth images stand for what is solid");
    if (!scene.view_files.depth.empty())
        return refuse(scene, "camera.depth", "not packed", "the host's depth images");
    if (scene.crop[2] > 0)
        return refuse(scene, "camera.crop", "not packed", "the host's projection of a part");
    PILEUS_TRY(refuse_marched_detail(scene, "a packed scene"));
    if (!is_grey_land(scene.surface))
        return refuse(scene, "ground", "a map, colours and a sea are not packed", "grey land");
    if (scene.animation.present)
        return refuse(scene, "animation", "not packed", "left out: the host moves what moves");
    if (is_of_collectors(method_column(scene)) &&
        scene.collectors.display.compositor != Compositor::kBuiltin)
        return refuse(scene, "collectors.compositor", "not packed", "builtin");
    if (refused(scene, Feature::kFilter) == nullptr && scene.filter.kind == FilterKind::kOidn)
        return refuse(scene, "filter.kind", "not packed", "none, regression");
    return Status::ok();
}

Status damaged(const char* what) {
    return Status::bad_input(std::string("packed scene: ") + what +
                             ", allowed: what `pileus pack` of this version wrote");
}

bool is_within(int v, int low, int high) { return v >= low && v <= high; }

/// Whether arrays have the sizes that numbers ask for.
bool is_whole(const NoiseTexture& noise, const NoiseView& view) {
    if (noise.words.size() == 0) return view.share == 0;
    const std::int64_t size = noise.size;
    return is_within(noise.size, 1, 512) && view.size == noise.size &&
           is_within(view.last, 0, kMaxNoiseLevels - 1) &&
           std::int64_t(noise.words.size()) == noise_words(size) &&
           std::int64_t(noise.largest.size()) * 4 >= noise_words(noise_blocks(noise.size));
}

bool is_whole(const ParticleSet& p) {
    const auto has = [&](const auto& list, std::uint64_t each, bool needed) {
        return list.size() == p.count * each || (!needed && list.size() == 0);
    };
    return p.count < (std::uint64_t{1} << 32) && has(p.position, 3, true) &&
           has(p.radius, 1, true) && has(p.density, 1, false) && has(p.colour, 3, false) &&
           has(p.emission, 3, false) && has(p.velocity, 3, false) && has(p.id, 1, false);
}

bool is_whole(const Medium& m) {
    for (std::size_t a = 0; a < 3; ++a)
        if (!is_within(m.grid.size[a], 1, 4096) || m.volume.size[a] != m.grid.size[a] ||
            !(m.grid.cell_m[a] > 0) || !(m.extent_m[a] > 0))
            return false;
    if (!is_within(m.count, 1, kMaxMedia) || !(m.channels == 1 || m.channels == 3)) return false;
    for (const PhaseStore& store : m.phases)
        if (!store.table.empty() && !is_whole(store)) return false;
    for (const Emitter& e : m.emitters)
        if (!is_within(e.medium, 0, m.count - 1) || e.below.size() != voxel_count(m.grid))
            return false;
    return m.parts.size() == std::uint64_t(m.count - 1) * voxel_count(m.grid);
}

bool is_whole(const World& w) {
    if (!is_whole(w.medium)) return false;
    if (w.shows_particles && !is_whole(w.particles)) return false;
    const std::uint64_t cells = w.medium.volume.density.size();
    if (!w.direct_sky) return cells == voxel_count(w.medium.grid);
    return is_whole(w.layer.perlin, w.layer.params.perlin) &&
           is_whole(w.layer.worley, w.layer.params.worley);
}

/// Puts back what points into arrays.
bool connect(const std::array<std::uint64_t, kMaxMedia>& tables, World& world) {
    Medium& m = world.medium;
    for (PhaseStore& store : m.phases)
        if (!store.table.empty()) point_into(store);
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const std::uint64_t k = tables[i];
        const bool tabled = m.optics[i].phase.type == kPhaseTable;
        if (k > m.phases.size() || (k > 0 && m.phases[k - 1].table.empty())) return false;
        if (tabled && k == 0) return false;
        m.optics[i].phase.table = k > 0 ? m.phases[k - 1].table.data() : nullptr;
    }
    NoiseView *perlin = &world.layer.params.perlin, *worley = &world.layer.params.worley;
    perlin->words = world.layer.perlin.words.data();
    perlin->largest = world.layer.perlin.largest.data();
    worley->words = world.layer.worley.words.data();
    worley->largest = world.layer.worley.largest.data();
    return true;
}

Status read_head(const char* bytes, std::size_t size, Head& head) {
    if (bytes == nullptr || size < kHeadBytes) return damaged("too short");
    ArchiveReader reader(bytes, kHeadBytes);
    head = Head{};
    fields(reader, head);
    if (head.magic != kMagic) return damaged("other bytes at its start");
    if (head.format != kFormat) return damaged("of another version");
    if (head.payload != size - kHeadBytes) return damaged("cut short, or longer than it says");
    if (head.digest != digest_of(bytes, size)) return damaged("changed since it was written");
    return Status::ok();
}

/// Puts the head before its payload, and the digest of both into it.
void sign(Head& head, std::string& bytes) {
    const auto write = [&] {
        ArchiveWriter writer;
        fields(writer, head);
        bytes.replace(0, kHeadBytes, writer.bytes);
    };
    write();
    head.digest = digest_of(bytes.data(), bytes.size());
    write();
}

}  // namespace

std::string packed_bytes(const PackedHead& told, const std::string& payload) {
    std::string bytes(kHeadBytes, '\0');
    bytes += payload;
    Head head;
    head.payload = payload.size();
    head.told = told;
    sign(head, bytes);
    return bytes;
}

void tell_block(std::uint64_t block_bytes, std::uint64_t in_place_bytes, std::string& bytes) {
    Head head;
    ArchiveReader reader(bytes.data(), kHeadBytes);
    fields(reader, head);
    head.told.block_bytes = block_bytes;
    head.told.in_place_bytes = in_place_bytes;
    sign(head, bytes);
}

Status pack_scene(const Scene& given, const World& world, std::string& bytes) {
    PILEUS_TRY(check_packable(given));
    if (method_column(given) == MethodColumn::kPath && asks_for_importance(given, world))
        return refuse(given, "path.importance", "not packed", "false");
    Scene scene = given;
    PILEUS_TRY(place_camera(scene));
    Image sky;
    if (!scene.view_files.sky_map.empty()) {
        PILEUS_TRY(read_sky_image(scene, sky));
        scene.sky.mapped = true;
    }
    // Names of files say nothing there.
    scene.file = "packed scene";
    for (MediumSettings& medium : scene.media) {
        medium.source.file.clear();
        medium.optics.phase.file.clear();
    }
    std::array<std::uint64_t, kMaxMedia> tables{};
    number_tables(world.medium, tables);
    ArchiveWriter payload;
    // Writing changes nothing of it.
    all(payload, scene, const_cast<World&>(world), tables);
    sky_fields(payload, sky);
    bytes = packed_bytes({std::uint64_t(scene.camera.resolution[0]),
                          std::uint64_t(scene.camera.resolution[1]), 0, 0, scene.method},
                         payload.bytes);
    return Status::ok();
}

Status read_packed_head(const void* bytes, std::size_t size, PackedHead& head) {
    Head read;
    PILEUS_TRY(read_head(static_cast<const char*>(bytes), size, read));
    head = read.told;
    if (!kLittleEndian) head.in_place_bytes = head.block_bytes;
    return Status::ok();
}

Status unpack_scene(const void* bytes, std::size_t size, bool in_place, Packed& out) {
    Head head;
    const char* const begin = static_cast<const char*>(bytes);
    if (in_place && reinterpret_cast<std::uintptr_t>(begin) % kLine != 0)
        return Status::bad_input("packed scene: at no multiple of 64 bytes, allowed in place: one");
    PILEUS_TRY(read_head(begin, size, head));
    out.head = head.told;
    out.in_place = in_place && kLittleEndian;
    out.world = std::make_shared<World>();
    std::array<std::uint64_t, kMaxMedia> tables{};
    ArchiveReader reader(begin + kHeadBytes, size - kHeadBytes, in_place);
    all(reader, out.scene, *out.world, tables);
    sky_fields(reader, out.sky);
    if (reader.out_of_memory()) return Status::limit("packed scene: out of memory");
    if (!reader.is_done() || !is_whole(*out.world) || !connect(tables, *out.world))
        return damaged("no scene");
    return Status::ok();
}

}  // namespace pileus
