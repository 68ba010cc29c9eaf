// SPDX-License-Identifier: Apache-2.0
// Writes a dense volume as a sparse OpenVDB fog volume.
// in: a Volume -> out: the bytes of a .vdb file of format version 224.
// OpenVDB 10.0.1, openvdb/io and openvdb/tree; docs/formats.md
#include "src/base/digest.h"
#include "src/base/file.h"
#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/vdb/vdb_values.h"

namespace pileus {

namespace {

constexpr std::int64_t kLeafSide = 8, kNodeLeaves = 16, kRootNodes = 32;
constexpr std::uint64_t kLeafBytes = 64 + 1 + 8 + 512 * 4;
constexpr std::uint64_t kNodeBytes = 2 * 512 + 9, kRootBytes = 2 * 4096 + 9, kHeadBytes = 4096;

/// Appends little-endian numbers; the buffer was sized for the worst case beforehand.
class Sink {
public:
    explicit Sink(Buffer<char>& bytes) : bytes_(bytes) {}
    std::size_t at() const { return at_; }
    unsigned char* room() { return reinterpret_cast<unsigned char*>(bytes_.data()) + at_; }
    void pass(std::size_t count) { at_ += count; }

    void number(std::uint64_t value, unsigned count) {
        put(at_, value, count);
        at_ += count;
    }
    void put(std::size_t at, std::uint64_t value, unsigned count) {
        for (unsigned i = 0; i < count; ++i) bytes_[at + i] = char(value >> (8 * i) & 255);
    }
    void u32(std::uint64_t value) { number(value, 4); }
    void f64(double value) {
        std::uint64_t bits;
        std::memcpy(&bits, &value, 8);
        number(bits, 8);
    }
    void f32(float value) {
        std::uint32_t bits;
        std::memcpy(&bits, &value, 4);
        u32(bits);
    }
    void bytes(const void* from, std::size_t count) {
        std::memcpy(bytes_.data() + at_, from, count);
        at_ += count;
    }
    void text(const std::string& value) {
        u32(value.size());
        bytes(value.data(), value.size());
    }

private:
    Buffer<char>& bytes_;
    std::size_t at_ = 0;
};

/// The tree of a volume whose voxel 0 0 0 lies at index 0 0 0: one child of the root holds it all.
class TreeWriter {
public:
    TreeWriter(const Volume& volume, bool zip) : volume_(volume), zip_(zip) {}

    Status survey();
    std::uint64_t most_bytes() const {
        return kHeadBytes + kRootBytes + nodes_ * kNodeBytes + leaves_ * (kLeafBytes + 64);
    }
    std::uint64_t active() const { return active_; }
    const std::array<std::int64_t, 3>& low() const { return low_; }
    const std::array<std::int64_t, 3>& high() const { return high_; }
    void topology(Sink& out) const;
    void values(Sink& out) const;

private:
    using Place = std::array<std::int64_t, 3>;

    float value(const Place& at) const {
        for (std::size_t a = 0; a < 3; ++a)
            if (at[a] >= volume_.size[a]) return 0.0f;
        return volume_
            .density[std::size_t((at[2] * volume_.size[1] + at[1]) * volume_.size[0] + at[0])];
    }
    bool leaf_there(const Place& leaf) const {
        for (std::size_t a = 0; a < 3; ++a)
            if (leaf[a] >= count_[a]) return false;
        return there_[std::size_t((leaf[2] * count_[1] + leaf[1]) * count_[0] + leaf[0])] != 0;
    }
    bool node_there(const Place& node) const {
        bool there = false;
        each(kNodeLeaves, node, [&](const Place& leaf, unsigned) { there |= leaf_there(leaf); });
        return there;
    }
    /// Calls for all side^3 children of `parent` with their place and entry, z fastest.
    template <class Call>
    static void each(std::int64_t side, const Place& parent, Call call) {
        unsigned entry = 0;
        for (std::int64_t x = 0; x < side; ++x)
            for (std::int64_t y = 0; y < side; ++y)
                for (std::int64_t z = 0; z < side; ++z)
                    call({parent[0] * side + x, parent[1] * side + y, parent[2] * side + z},
                         entry++);
    }
    template <class Call>
    void each_node(Call call) const {
        each(kRootNodes, {0, 0, 0}, [&](const Place& node, unsigned entry) {
            const bool within = node[0] * kNodeLeaves < count_[0] &&
                                node[1] * kNodeLeaves < count_[1] &&
                                node[2] * kNodeLeaves < count_[2];
            if (within && node_there(node)) call(node, entry);
        });
    }
    template <class Call>
    void each_leaf(const Place& node, Call call) const {
        each(kNodeLeaves, node, [&](const Place& leaf, unsigned entry) {
            if (leaf_there(leaf)) call(leaf, entry);
        });
    }
    void leaf_mask(const Place& leaf, unsigned char* mask) const;
    void leaf_values(const Place& leaf, Sink& out) const;
    void no_values(Sink& out) const;

    const Volume& volume_;
    bool zip_;
    Place count_{};                ///< leaves along each axis
    Buffer<unsigned char> there_;  ///< per leaf: holds a voxel that is not 0
    std::uint64_t leaves_ = 0, nodes_ = 0, active_ = 0;
    Place low_{0, 0, 0}, high_{-1, -1, -1};
};

/// Finds the leaves that hold anything, and the box of it.
Status TreeWriter::survey() {
    const auto& n = volume_.size;
    for (std::size_t a = 0; a < 3; ++a) count_[a] = (n[a] + kLeafSide - 1) / kLeafSide;
    PILEUS_TRY(there_.resize(std::uint64_t(count_[0] * count_[1] * count_[2]), "OpenVDB leaves"));
    std::size_t index = 0;
    for (std::int64_t z = 0; z < n[2]; ++z)
        for (std::int64_t y = 0; y < n[1]; ++y)
            for (std::int64_t x = 0; x < n[0]; ++x) {
                if (volume_.density[index++] == 0.0f) continue;
                const Place at{x, y, z};
                for (std::size_t a = 0; a < 3; ++a) {
                    if (active_ == 0 || at[a] < low_[a]) low_[a] = at[a];
                    if (active_ == 0 || at[a] > high_[a]) high_[a] = at[a];
                }
                ++active_;
                there_[std::size_t((z / 8 * count_[1] + y / 8) * count_[0] + x / 8)] = 1;
            }
    for (const unsigned char there : there_.span()) leaves_ += there;
    each_node([&](const Place&, unsigned) { ++nodes_; });
    return Status::ok();
}

void TreeWriter::leaf_mask(const Place& leaf, unsigned char* mask) const {
    std::memset(mask, 0, 64);
    each(kLeafSide, leaf, [&](const Place& at, unsigned entry) {
        if (value(at) != 0.0f) mask[entry >> 3] |= static_cast<unsigned char>(1u << (entry & 7));
    });
}

/// All entries of the node are children or inactive background: flag 0, and no value.
void TreeWriter::no_values(Sink& out) const {
    out.number(0, 1);
    if (zip_) out.number(0, 8);
}

void TreeWriter::topology(Sink& out) const {
    out.u32(1);
    out.f32(0.0f);
    out.u32(0);
    out.u32(active_ > 0 ? 1 : 0);
    if (active_ == 0) return;
    for (int a = 0; a < 3; ++a) out.u32(0);

    // A mask of children, filled while they are looked for, an empty one of tiles, then children.
    const auto masks = [&](std::size_t bytes, const auto& each_child) {
        unsigned char* mask = out.room();
        std::memset(mask, 0, 2 * bytes);
        out.pass(2 * bytes);
        each_child([&](const Place&, unsigned entry) {
            mask[entry >> 3] |= static_cast<unsigned char>(1u << (entry & 7));
        });
        no_values(out);
    };
    masks(4096, [&](const auto& call) { each_node(call); });
    each_node([&](const Place& node, unsigned) {
        masks(512, [&](const auto& call) { each_leaf(node, call); });
        each_leaf(node, [&](const Place& leaf, unsigned) {
            leaf_mask(leaf, out.room());
            out.pass(64);
        });
    });
}

void TreeWriter::leaf_values(const Place& leaf, Sink& out) const {
    leaf_mask(leaf, out.room());
    out.pass(64);
    out.number(0, 1);
    const std::size_t length_at = out.at();
    if (zip_) out.pass(8);
    const std::size_t begin = out.at();
    each(kLeafSide, leaf, [&](const Place& at, unsigned) {
        if (value(at) != 0.0f) out.f32(value(at));
    });
    if (!zip_) return;

    // Keep the packed bytes where they are fewer; a length that is not above 0 says they are not.
    const std::size_t count = out.at() - begin;
    unsigned char packed[4096];
    const std::uint64_t fewer = deflate_block(out.room() - count, count, packed, sizeof packed);
    if (fewer == 0) {
        out.put(length_at, 0 - std::uint64_t(count), 8);
        return;
    }
    out.put(length_at, fewer, 8);
    std::memcpy(out.room() - count, packed, std::size_t(fewer));
    out.pass(std::size_t(fewer) - count);
}

void TreeWriter::values(Sink& out) const {
    each_node([&](const Place& node, unsigned) {
        each_leaf(node, [&](const Place& leaf, unsigned) { leaf_values(leaf, out); });
    });
}

/// What every file begins with; the identifier is drawn from the values, not from chance.
void write_file_head(const Volume& volume, Sink& out) {
    constexpr std::uint64_t kMagic = 0x56444220;
    out.number(kMagic, 8);
    for (const unsigned number : {kVdbNewestVersion, 10u, 0u}) out.u32(number);
    out.number(1, 1);
    Digest digest;
    digest.floats(volume.density.span());
    const std::string hex = digest.hex();
    for (const double face : {volume.bounds_m[0][0], volume.bounds_m[1][2]})
        digest.f32(float(face));
    const std::string more = digest.hex();
    const std::string uuid = hex.substr(0, 8) + '-' + hex.substr(8, 4) + '-' + hex.substr(12) +
                             '-' + more.substr(0, 4) + '-' + more.substr(4);
    out.bytes(uuid.data(), uuid.size());
    out.u32(0);
}

void text_metadata(Sink& out, const char* name, const std::string& value) {
    out.text(name);
    out.text("string");
    out.text(value);
}

void place_metadata(Sink& out, const char* name, const std::array<std::int64_t, 3>& place) {
    out.text(name);
    out.text("vec3i");
    out.u32(12);
    for (const std::int64_t coordinate : place) out.u32(std::uint64_t(coordinate));
}

void write_metadata(const TreeWriter& tree, bool zip, Sink& out) {
    out.u32(7);
    text_metadata(out, "class", "fog volume");
    place_metadata(out, "file_bbox_max", tree.high());
    place_metadata(out, "file_bbox_min", tree.low());
    text_metadata(out, "file_compression", zip ? "zip + active values" : "active values");
    out.text("file_voxel_count");
    out.text("int64");
    out.u32(8);
    out.number(tree.active(), 8);
    out.text("is_saved_as_half_float");
    out.text("bool");
    out.u32(1);
    out.number(0, 1);
    text_metadata(out, "name", "density");
}

/// Voxel i's centre lies half a cell inside: scale * i + (low + scale / 2).
void write_transform(const Volume& volume, Sink& out) {
    double scale[3] = {1, 1, 1}, low[3] = {0, 0, 0};
    for (std::size_t a = 0; a < 3 && volume.knows_bounds; ++a) {
        low[a] = volume.bounds_m[0][a];
        scale[a] = (volume.bounds_m[1][a] - low[a]) / volume.size[a];
    }
    const bool uniform = scale[0] == scale[1] && scale[1] == scale[2];
    out.text(uniform ? "UniformScaleTranslateMap" : "ScaleTranslateMap");
    for (int a = 0; a < 3; ++a) out.f64(low[a] + 0.5 * scale[a]);
    for (int twice = 0; twice < 2; ++twice)
        for (const double s : scale) out.f64(s);
    for (const double s : scale) out.f64(1 / s);
    for (const double s : scale) out.f64(1 / (s * s));
    for (const double s : scale) out.f64(1 / (2 * s));
}

}  // namespace

Status encode_vdb(const Volume& volume, bool zip, Buffer<char>& bytes) {
    const unsigned char probe[64] = {};
    unsigned char packed[128];
    zip = zip && deflate_block(probe, sizeof probe, packed, sizeof packed) > 0;
    TreeWriter tree(volume, zip);
    PILEUS_TRY(tree.survey());
    Buffer<char> room;
    PILEUS_TRY(room.resize(tree.most_bytes(), "OpenVDB file"));
    Sink out(room);
    write_file_head(volume, out);
    out.u32(1);
    out.text("density");
    out.text("Tree_float_5_4_3");
    out.text("");
    const std::size_t offsets = out.at();
    out.pass(24);
    out.put(offsets, out.at(), 8);
    out.u32(kVdbActiveMask | (zip ? kVdbZip : 0));
    write_metadata(tree, zip, out);
    write_transform(volume, out);
    tree.topology(out);
    out.put(offsets + 8, out.at(), 8);
    tree.values(out);
    out.put(offsets + 16, out.at(), 8);

    // Hand out as many bytes as were used.
    PILEUS_TRY(bytes.resize(out.at(), "OpenVDB file"));
    std::memcpy(bytes.data(), room.data(), out.at());
    return Status::ok();
}

Status write_vdb_volume(const std::string& path, const Volume& volume) {
    PILEUS_TRY(can_write_file(path));
    Buffer<char> bytes;
    PILEUS_TRY(encode_vdb(volume, true, bytes));
    return write_file(path, bytes.span());
}

}  // namespace pileus
