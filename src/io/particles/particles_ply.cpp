// SPDX-License-Identifier: Apache-2.0
// Particles from and to PLY files.
// in: element vertex (x, y, z, radius, density, red, green, blue, id) among others -> out: a set.
// Turk 1994, "The PLY polygon file format"; docs/formats.md, "Particles".
#include <cstring>

#include "src/base/file.h"
#include "src/io/particles/particle_rows.h"
#include "src/io/text/ply_file.h"

namespace pileus {
namespace {

constexpr const char* kNoLength = "list: no such length";

class Reader : private PlyFile {
public:
    Reader(const std::string& file, Span<const char> text) : PlyFile(file, text) {}

    Status read(const ParticleReading& reading, ParticleSet& set);

private:
    Status item(const PlyElement& element, std::vector<double>& row);
    Status pass(bool keep, ParticleRows& rows);
};

/// The numbers of one item; lists are passed.
Status Reader::item(const PlyElement& element, std::vector<double>& row) {
    std::size_t column = 0;
    for (const PlyProperty& p : element.properties) {
        double v = 0;
        if (p.count == PlyType::kNone) {
            PILEUS_TRY(value(p.type, v));
            row[column++] = v;
            continue;
        }
        std::uint64_t length = 0;
        PILEUS_TRY(index(p.count, text_.size + 1, kNoLength, length));
        for (std::uint64_t i = 0; i < length; ++i) PILEUS_TRY(value(p.type, v));
    }
    return Status::ok();
}

/// Up to the last particle; what stands behind is not looked at.
Status Reader::pass(bool keep, ParticleRows& rows) {
    rewind();
    for (const PlyElement& e : elements()) {
        if (e.properties.empty()) continue;
        std::vector<double> row(e.properties.size());
        const bool particles = e.name == "vertex";
        for (std::uint64_t i = 0; i < e.count; ++i) {
            PILEUS_TRY(item(e, row));
            const Span<const double> numbers{row.data(), row.size()};
            if (particles) PILEUS_TRY(keep ? rows.keep(i, numbers) : rows.measure(i, numbers));
        }
        if (particles) break;
    }
    return Status::ok();
}

Status Reader::read(const ParticleReading& reading, ParticleSet& set) {
    PILEUS_TRY(read_head());
    const PlyElement* vertices = nullptr;
    for (const PlyElement& e : elements())
        if (e.name == "vertex") vertices = &e;
    if (vertices == nullptr) return fault(0, "header: no element vertex, allowed: one");
    PILEUS_TRY(need_axes(*vertices));
    std::vector<ParticleColumn> columns;
    for (const PlyProperty& p : vertices->properties)
        if (p.count == PlyType::kNone)
            columns.push_back({p.name, p.type == PlyType::kUint8 || p.type == PlyType::kInt8});
    ParticleRows rows(file_, set);
    PILEUS_TRY(rows.begin(columns, vertices->count, reading));
    PILEUS_TRY(pass(false, rows));
    rows.measured();
    return pass(true, rows);
}

template <class Number>
void append(Number v, Buffer<char>& bytes, std::size_t& at) {
    unsigned char raw[sizeof v];
    std::uint64_t bits = 0;
    std::uint32_t half = 0;
    if (sizeof v == 4) {
        std::memcpy(&half, &v, sizeof half);
        bits = half;
    } else {
        std::memcpy(&bits, &v, sizeof v);
    }
    for (std::size_t i = 0; i < sizeof v; ++i) raw[i] = static_cast<unsigned char>(bits >> (8 * i));
    std::memcpy(bytes.data() + at, raw, sizeof v);
    at += sizeof v;
}

}  // namespace

Status decode_particle_ply(const std::string& name, Span<const char> bytes,
                           const ParticleReading& reading, ParticleSet& set) {
    return Reader(name, bytes).read(reading, set);
}

Status write_particle_ply(const std::string& path, const ParticleSet& set) {
    const bool numbered = !set.id.empty(), coloured = !set.colour.empty();
    const bool moving = !set.velocity.empty(), glowing = !set.emission.empty();
    std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string(set.count) +
                       "\nproperty double x\nproperty double y\nproperty double z\n"
                       "property float radius\nproperty float density\n";
    if (coloured) head += "property float red\nproperty float green\nproperty float blue\n";
    if (numbered) head += "property double id\n";
    if (moving) head += "property float vx\nproperty float vy\nproperty float vz\n";
    if (glowing)
        head +=
            "property float emission_red\nproperty float emission_green\n"
            "property float emission_blue\n";
    head += "end_header\n";
    const std::size_t item = 32 + (coloured ? 12u : 0u) + (numbered ? 8u : 0u) +
                             (moving ? 12u : 0u) + (glowing ? 12u : 0u);
    Buffer<char> bytes;
    PILEUS_TRY(bytes.resize(head.size() + item * set.count, "particle file"));
    std::memcpy(bytes.data(), head.data(), head.size());
    std::size_t at = head.size();
    for (std::size_t i = 0; i < set.count; ++i) {
        for (std::size_t a = 0; a < 3; ++a)
            append(set.origin[int(a)] + double(set.position[3 * i + a]), bytes, at);
        append(set.radius[i], bytes, at);
        append(set.density_of(i), bytes, at);
        for (std::size_t c = 0; c < 3 && coloured; ++c) append(set.colour[3 * i + c], bytes, at);
        if (numbered) append(double(set.id[i]), bytes, at);
        for (std::size_t a = 0; a < 3 && moving; ++a) append(set.velocity[3 * i + a], bytes, at);
        for (std::size_t c = 0; c < 3 && glowing; ++c) append(set.emission[3 * i + c], bytes, at);
    }
    return write_file(path, {bytes.data(), bytes.size()});
}

}  // namespace pileus
