// SPDX-License-Identifier: Apache-2.0
// Particles of Houdini and Maya: the same ones from each kind of file, and each fault a line.
// in: files made here, after what Partio reads and writes -> out: pass or fail.
// docs/particles.md, "Files"; docs/testing.md, label io
#include <doctest/doctest.h>

#include <cstring>
#include <fstream>

#include "src/io/particles/placed_particles.h"
#include "src/scene/rows/volume_format.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

std::string number_bytes(std::uint64_t bits, unsigned bytes, bool big) {
    std::string text;
    for (unsigned i = 0; i < bytes; ++i) text += char(bits >> 8 * (big ? bytes - 1 - i : i) & 0xff);
    return text;
}
std::string float_bytes(float v, bool big) {
    std::uint32_t bits;
    std::memcpy(&bits, &v, sizeof bits);
    return number_bytes(bits, 4, big);
}

/// Two particles, by columns.
constexpr float kPlaces[2][3] = {{1, 2, 3}, {-4, 5.5f, 600}};
constexpr float kSpeeds[2][3] = {{0.25f, 0, -1}, {7, 8, 9}};
constexpr float kColours[2][3] = {{1, 0.5f, 0}, {0, 0.25f, 1}};
constexpr float kRadii[2] = {2, 0.5f}, kDensities[2] = {0.125f, 3};
constexpr int kIds[2] = {7, 123456};

/// A classic file of Houdini: attributes, an index and one that nobody knows among them, then a
/// primitive, which is not looked at.
std::string bgeo(std::uint32_t points = 2, std::uint32_t attributes = 7) {
    const auto whole = [](std::uint64_t v, unsigned bytes = 4) {
        return number_bytes(v, bytes, true);
    };
    std::string text = "BgeoV" + whole(5) + whole(points) + whole(1) + whole(0) + whole(0) +
                       whole(attributes) + whole(0) + whole(0) + whole(0);
    const auto head = [&](const std::string& name, unsigned size, unsigned type) {
        text += whole(name.size(), 2) + name + whole(size, 2) + whole(type);
        if (type != 4) text += std::string(4 * size, '\0');
    };
    head("v", 3, 5);
    head("pscale", 1, 0);
    head("group", 1, 4);
    text += whole(2) + whole(3, 2) + "ash" + whole(0, 2);
    head("Cd", 3, 0);
    head("density", 1, 0);
    head("uv", 2, 0);
    head("id", 1, 1);
    for (int i = 0; i < 2; ++i) {
        for (const float v : kPlaces[i]) text += float_bytes(v, true);
        text += float_bytes(1, true);
        for (const float v : kSpeeds[i]) text += float_bytes(v, true);
        text += float_bytes(kRadii[i], true) + whole(1);
        for (const float v : kColours[i]) text += float_bytes(v, true);
        text += float_bytes(kDensities[i], true) + float_bytes(0, true) + float_bytes(0, true) +
                whole(std::uint64_t(kIds[i]));
    }
    return text + whole(0x8000);
}

const std::string kGeo =
    "PGEOMETRY V5\nNPoints 2 NPrims 1\nNPointGroups 0 NPrimGroups 0\n"
    "NPointAttrib 6 NVertexAttrib 0 NPrimAttrib 1 NAttrib 0\nPointAttrib\n"
    "v 3 vector 0 0 0\npscale 1 float 0\ngroup 1 index 2 \"ash \\\" # (\" fire\n"
    "Cd 3 float 1 1 1\ndensity 1 float 0\nid 1 int -1\n"
    "1 2 3 1 (0.25 0 -1\t2\t1\t1 0.5 0\t0.125\t7)\n"
    "-4 5.5 6e2 1 (7 8 9\t0.5\t0\t0 0.25 1\t3\t123456)\nPrimitiveAttrib\n";

const std::string kPda =
    "ATTRIBUTES\n position velocity radiusPP rgbPP density lifespan particleId\nTYPES\n"
    " V V R V R R I\nNUMBER_OF_PARTICLES: 2\nBEGIN DATA\n"
    "1 2 3 0.25 0 -1 2 1 0.5 0 0.125 9 7 \n-4 5.5 600 7 8 9 0.5 0 0.25 1 3 9 123456 \n";

std::string pdb(std::uint32_t particles = 2, std::uint32_t channels = 7) {
    const auto whole = [](std::uint64_t v, unsigned bytes = 4) {
        return number_bytes(v, bytes, false);
    };
    std::string text = whole(670) + whole(1) + float_bytes(1, false) + float_bytes(0, false) +
                       whole(particles) + whole(channels) + std::string(36, '\0');
    const auto head = [&](const std::string& name, unsigned type, unsigned bytes) {
        text += whole(0, 2) + whole(1, 2) + whole(0, 2);
        text += whole(0) + whole(type) + whole(0) + whole(0) + whole(1) + std::string(16, '\0');
        text += name + '\0' + whole(type) + whole(bytes) + whole(2) + whole(1) + whole(0);
    };
    const auto vectors = [&](const std::string& name, const float(&v)[2][3]) {
        head(name, 1, 12);
        for (const auto& row : v)
            for (const float x : row) text += float_bytes(x, false);
    };
    const auto reals = [&](const std::string& name, const float(&v)[2]) {
        head(name, 2, 4);
        for (const float x : v) text += float_bytes(x, false);
    };
    reals("radiusPP", kRadii);
    vectors("position", kPlaces);
    head("ghost", 5, 8);
    text += std::string(16, 'x');
    vectors("velocity", kSpeeds);
    vectors("rgbPP", kColours);
    reals("density", kDensities);
    head("particleId", 3, 4);
    for (const int id : kIds) text += whole(std::uint64_t(id));
    return text;
}

Status decode(const std::string& text, const char* extension, ParticleSet& set) {
    ParticleReading reading;
    reading.most = 1000;
    return decode_particles("p.x", extension, {text.data(), text.size()}, reading, set);
}

std::string fault_of(const std::string& text, const char* extension) {
    ParticleSet set;
    const Status status = decode(text, extension, set);
    CHECK(!status);
    CHECK(status.message.find('\n') == std::string::npos);
    CHECK(status.message.find("p.x:") == 0);
    return status.message;
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
    REQUIRE(text.find(from) != std::string::npos);
    return text.replace(text.find(from), from.size(), to);
}

struct Made {
    const char* extension;
    std::string bytes;
    std::size_t behind;  ///< bytes that are not looked at
};

std::vector<Made> all_made() {
    return {{".bgeo", bgeo(), 4},
            {".geo", kGeo, std::strlen("\nPrimitiveAttrib\n")},
            {".bhclassic", bgeo(), 4},
            {".pdb", pdb(), 0},
            {".pda", kPda, 2}};
}

}  // namespace

TEST_CASE("particle attributes: the same two particles from Houdini's and Maya's files") {
    for (const Made& made : all_made()) {
        CAPTURE(std::string(made.extension));
        ParticleSet set;
        const Status status = decode(made.bytes, made.extension, set);
        REQUIRE_MESSAGE(bool(status), status.message);
        REQUIRE(set.count == 2);
        REQUIRE(set.colour.size() == 6);
        REQUIRE(set.velocity.size() == 6);
        REQUIRE(set.id.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t a = 0; a < 3; ++a) {
                CHECK(set.origin[int(a)] + double(set.position[3 * i + a]) ==
                      double(kPlaces[i][a]));
                CHECK(set.velocity[3 * i + a] == kSpeeds[i][a]);
                CHECK(set.colour[3 * i + a] == kColours[i][a]);
            }
            CHECK(set.radius[i] == kRadii[i]);
            CHECK(set.density[i] == kDensities[i]);
            CHECK(set.id[i] == std::uint64_t(kIds[i]));
        }
    }
}

TEST_CASE(
    "particle attributes: a file cut anywhere is a fault, and one changed anywhere is read or "
    "a line") {
    for (const Made& made : all_made()) {
        CAPTURE(std::string(made.extension));
        const std::size_t needed = made.bytes.size() - made.behind;
        // A number in text is one when its end is cut off, too.
        const bool text = made.extension == std::string(".pda");
        for (std::size_t n = 0; n < needed - (text ? 6 : 0); ++n)
            fault_of(made.bytes.substr(0, n), made.extension);
        ParticleSet set;
        CHECK(decode(made.bytes.substr(0, needed), made.extension, set));
        for (std::size_t n = 0; n < needed; ++n) {
            std::string other = made.bytes;
            other[n] = char(other[n] ^ 0xff);
            const Status status = decode(other, made.extension, set);
            if (!status) CHECK(status.message.find("p.x:") == 0);
        }
    }
}

TEST_CASE("particle attributes: heads that lie are faults before memory is taken") {
    CHECK(holds(fault_of(bgeo(1000000000), ".bgeo"), "points: more than the file can hold"));
    CHECK(holds(fault_of(bgeo(0xffffffff), ".bgeo"), "points: more than the file can hold"));
    CHECK(holds(fault_of(bgeo(2, 1000000000), ".bgeo"), "attribute"));
    CHECK(holds(fault_of(changed(kGeo, "NPoints 2", "NPoints 1000000000"), ".geo"),
                "points: more than the file can hold"));
    CHECK(holds(fault_of(changed(kGeo, "NPoints 2", "NPoints -2"), ".geo"), "out of range"));
    CHECK(holds(fault_of(changed(kGeo, "NPointAttrib 6", "NPointAttrib 1000000000"), ".geo"),
                "no such type"));
    CHECK(holds(fault_of(changed(kGeo, "index 2", "index 1000000000"), ".geo"), "ends too early"));
    CHECK(holds(fault_of(changed(kGeo, "v 3", "v 1000000000"), ".geo"), "too long"));
    CHECK(holds(fault_of(pdb(0xffffffff), ".pdb"), "more than the file can hold"));
    CHECK(holds(fault_of(pdb(2, 1000000000), ".pdb"), "ends too early"));
    CHECK(holds(fault_of(changed(kPda, "PARTICLES: 2", "PARTICLES: 1000000000"), ".pda"),
                "more than the file can hold"));
    // Endless lists of attributes.
    std::string names = "ATTRIBUTES";
    for (int i = 0; i < 300; ++i) names += " a";
    CHECK(holds(fault_of(names + " TYPES", ".pda"), "attributes: too many"));
    std::string many = bgeo(2, 1000).substr(0, 41);
    for (int i = 0; i < 1000; ++i) many += number_bytes(0, 4, true) + number_bytes(1, 4, true);
    CHECK(holds(fault_of(many, ".bgeo"), "attributes: too many"));
}

TEST_CASE("particle attributes: what is not read says so") {
    for (const char* newer : {"\x7fNSJb\x01", "[\n\t\"fileversion\",\"18.0.1\""})
        CHECK(holds(fault_of(newer, ".bgeo"), "Houdini 12 or later, allowed: saved as classic"));
    CHECK(holds(fault_of("ply\n", ".geo"), "not Houdini's classic geometry"));
    CHECK(holds(
        fault_of(changed(bgeo(), std::string("V\0\0\0\x05", 5), std::string("V\0\0\0\x04", 5)),
                 ".bgeo"),
        "version: unknown, 4, allowed: 5"));
    CHECK(holds(fault_of(changed(kGeo, "float 0", "text 0"), ".geo"), "no such type"));
    CHECK(holds(fault_of(changed(kGeo, "pscale 1", "pscale 2"), ".geo"), "wrong size, 2"));
    CHECK(holds(fault_of(changed(kGeo, "(0.25", "0.25"), ".geo"), "point: no '('"));
    CHECK(holds(fault_of(changed(kGeo, "pscale", "size"), ".geo"), "radius: missing"));
    CHECK(holds(fault_of(changed(kGeo, "-1\t2\t", "-1\t-2\t"), ".geo"), "particle 0: radius"));
    CHECK(holds(fault_of(changed(kPda, "V V R", "V V X"), ".pda"), "no such type"));
    CHECK(holds(fault_of(number_bytes(670, 4, true), ".pdb"), "magic: not a PDB file"));
    CHECK(holds(fault_of(changed(pdb(), "position", "nowheres"), ".pdb"), "x: missing"));
}

TEST_CASE("particle attributes: files packed by gzip, by their names") {
    // gzip of "x y z radius\n1 2 3 4\n5 6 7 8\n".
    const std::string packed(
        "\037\213\010\000\000\000\000\000\002\003\253\120\250\124\250\122\050\112\114\311\054"
        "\055\346\062\124\060\122\060\126\060\341\062\125\060\123\060\127\260\340\002\000\150"
        "\136\337\004\035\000\000\000",
        49);
    ParticleSet set;
    const Status status = decode(packed, ".csv", set);
    if (holds(status.message, "is not in this build")) return;
    REQUIRE_MESSAGE(bool(status), status.message);
    REQUIRE(set.count == 2);
    CHECK(set.radius[1] == 8.0f);
    for (std::size_t n = 2; n < packed.size(); ++n)
        CHECK(holds(fault_of(packed.substr(0, n), ".csv"), "gzip: damaged"));
    for (std::size_t n = 10; n < packed.size(); ++n) {
        std::string other = packed;
        other[n] = char(other[n] ^ 0xff);
        fault_of(other, ".csv");
    }
    ParticleReading few;
    few.most_unpacked = 28;
    CHECK(holds(decode_particles("p.x", ".csv", {packed.data(), packed.size()}, few, set).message,
                "too large, allowed: at most 28"));
    few.most_unpacked = 29;
    CHECK(decode_particles("p.x", ".csv", {packed.data(), packed.size()}, few, set));
    CHECK(volume_format_of("a/Smoke.BGEO.gz") == volume_format_named("bgeo"));
    CHECK(volume_format_of("a.vdb.gz") == nullptr);
    CHECK(volume_format_of(".gz") == nullptr);
    const test::TempFolder folder;
    const std::string path = folder.path("p.csv.gz");
    std::ofstream(path, std::ios::binary) << packed;
    MediumSettings medium;
    REQUIRE(read_placed_particles(medium, path, set));
    CHECK(set.count == 2);
}
