// SPDX-License-Identifier: Apache-2.0
// Files of particles: known answers, each fault once, order, far places, lots.
// in: small files -> out: pass or fail.
// docs/particles.md, "Data"; docs/testing.md, label io
#include <doctest/doctest.h>

#include "src/io/particles/placed_particles.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

const std::string kHead = "ply\nformat ascii 1.0\nelement vertex ";
const std::string kPlaces = "\nproperty float x\nproperty float y\nproperty float z\n";

Status decode(const std::string& text, const char* extension, ParticleSet& set, double radius = 0) {
    ParticleReading reading;
    reading.radius = radius;
    reading.most = 1000;
    return decode_particles("p.x", extension, {text.data(), text.size()}, reading, set);
}

std::string fault_of(const std::string& text, const char* extension, double radius = 0) {
    ParticleSet set;
    const Status status = decode(text, extension, set, radius);
    CHECK(!status);
    CHECK(status.message.find('\n') == std::string::npos);
    return status.message;
}

Double3 place_of(const ParticleSet& set, std::size_t i) {
    return set.origin + Double3(double(set.position[3 * i]), double(set.position[3 * i + 1]),
                                double(set.position[3 * i + 2]));
}

}  // namespace

TEST_CASE("particles: a PLY file with all columns, others and lists passed") {
    ParticleSet set;
    const std::string text =
        kHead + "2" + kPlaces +
        "property list uchar int tags\nproperty float radius\nproperty float density\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int id\n"
        "property float nx\nend_header\n"
        "1 2 3 2 7 8 0.5 4 255 0 51 12 0\n-1 -2 -3 0 1.5 0 0 0 0 13 0\n";
    REQUIRE_MESSAGE(decode(text, ".ply", set), "decodes");
    CHECK(set.count == 2);
    CHECK(place_of(set, 0) == Double3(1, 2, 3));
    CHECK(place_of(set, 1) == Double3(-1, -2, -3));
    CHECK(set.radius[1] == 1.5f);
    CHECK(set.density[0] == 4.0f);
    CHECK(set.colour[0] == 1.0f);
    CHECK(set.colour[2] == 0.2f);
    CHECK(set.id[1] == 13);
    CHECK(set.low == Double3(-2.5, -3.5, -4.5));
    CHECK(set.high == Double3(1.5, 2.5, 3.5));
}

TEST_CASE("particles: text with names, whatever parts the columns") {
    for (const char* text : {"x,y,z,radius\n1,2,3,4\n5,6,7,8\n", "x;y;z;radius\n1;2;3;4\n5;6;7;8\n",
                             "# made by hand\n X Y Z pscale\n1 2 3 4\n\n5\t6 7 8 # last\n",
                             "\"x\", \"y\", \"z\", \"radius\"\n1, 2, 3, 4\n5, 6, 7, 8"}) {
        ParticleSet set;
        CAPTURE(text);
        REQUIRE(decode(text, ".csv", set));
        CHECK(set.count == 2);
        CHECK(place_of(set, 1) == Double3(5, 6, 7));
        CHECK(set.radius[1] == 8.0f);
        CHECK(set.density.empty());
    }
}

TEST_CASE("particles: none, one and a thousand, and not one more") {
    ParticleSet set;
    REQUIRE(decode("x,y,z,radius\n", ".csv", set));
    CHECK(set.count == 0);
    CHECK(decode(kHead + "0" + kPlaces + "end_header\n", ".ply", set, 1));
    CHECK(decode("x y z\n1 2 3", ".csv", set, 2));
    CHECK(set.radius[0] == 2.0f);
    std::string many = "x y z\n";
    for (int i = 0; i < 1000; ++i) many += "0 0 0\n";
    CHECK(decode(many, ".csv", set, 1));
    CHECK(decode(many + "0 0 0\n", ".csv", set, 1).code == Code::kLimit);
}

TEST_CASE("particles: far places keep their digits, whatever the order") {
    // A float at 1e7 knows whole metres.
    ParticleSet one, other;
    REQUIRE(decode("x y z radius\n10000000.25 0 0 1\n10000003.5 0 0 1\n", ".csv", one));
    REQUIRE(decode("x y z radius\n10000003.5 0 0 1\n10000000.25 0 0 1\n", ".csv", other));
    CHECK(place_of(one, 0)[0] == 10000000.25);
    CHECK(one.origin == other.origin);
    CHECK(one.position[0] == other.position[3]);
}

TEST_CASE("particles: each fault is a line with its place") {
    const auto csv = [](const std::string& row) { return "x,y,z,radius,density\n" + row + "\n"; };
    for (const char* row :
         {"0,0,0,0,1", "0,0,0,-1,1", "0,0,0,nan,1", "0,0,0,inf,1", "0,0,0,1e30,1", "0,0,0,1e-60,1",
          "0,0,0,1,-1", "0,0,0,1,nan", "0,0,0,1,1e13", "2e12,0,0,1,1", "nan,0,0,1,1"}) {
        CAPTURE(row);
        CHECK(holds(fault_of(csv(row), ".csv"), "p.x: particle 0: "));
    }
    CHECK(holds(fault_of(csv("0,0,0,1"), ".csv"), "p.x:2:"));
    CHECK(holds(fault_of(csv("0,0,,1,1"), ".csv"), "not a number"));
    CHECK(holds(fault_of(csv("0,0,0,1,1,1"), ".csv"), "more numbers than columns"));
    CHECK(holds(fault_of("", ".csv"), "no line"));
    CHECK(holds(fault_of("x,y\n", ".csv"), "z: missing"));
    CHECK(holds(fault_of("x,y,z\n", ".csv"), "radius: missing"));
    CHECK(holds(fault_of("x,y,z,x\n", ".csv", 1), "x: given twice"));
    CHECK(holds(fault_of("x,y,z,red\n", ".csv", 1), "colour: not whole"));
    CHECK(holds(fault_of("x,y,z,vx\n", ".csv", 1), "velocity: not whole"));
    const std::string end = kPlaces + "end_header\n";
    CHECK(holds(fault_of(kHead + "3" + end + "1 2 3\n", ".ply", 1), "value"));
    CHECK(holds(fault_of(kHead + "1000000000" + end, ".ply", 1), "more than the file can hold"));
    CHECK(holds(fault_of(kHead + "1" + kPlaces, ".ply", 1), "no end_header"));
    CHECK(holds(fault_of("ply\nend_header\n", ".ply", 1), "no element vertex"));
    CHECK(holds(fault_of(kHead + "1\nproperty list int int a\nproperty float x\nproperty float y\n"
                                 "property float z\nend_header\n1000000000 1 1\n",
                         ".ply", 1),
                "list: no such length"));
}

TEST_CASE("particles: reading tells how far it is, from nothing up, and seldom") {
    constexpr int kMany = 600000;
    std::string text = "x y z\n";
    for (int i = 0; i < kMany; ++i) text += "0 0 0\n";
    std::vector<double> told;
    ParticleReading reading;
    reading.radius = 1;
    reading.progress = [&](double share) { told.push_back(share); };
    ParticleSet set;
    REQUIRE(decode_particles("p", ".csv", {text.data(), text.size()}, reading, set));
    REQUIRE(told.size() == 6);
    CHECK(told[0] == 0);
    CHECK(told[3] == 0.5);
    for (std::size_t i = 1; i < told.size(); ++i) CHECK(told[i] > told[i - 1]);
    CHECK(told.back() < 1);
}

TEST_CASE("particles: a written file is read again to the bit") {
    ParticleSet set, again;
    REQUIRE(decode(
        "x y z radius density red green blue id VX vy velocity_z\n10000000.25 1 2 3 0.1 0.5 0.25 1 "
        "9007199254740991 5 -6 0.1\n-7 1.5 0 2 0 0 0 0 4 0 1e9 2\n",
        ".csv", set));
    const test::TempFolder folder;
    const std::string path = folder.path("p.ply");
    REQUIRE(write_particle_ply(path, set));
    REQUIRE(read_particles(path, ".ply", {}, again));
    REQUIRE(again.count == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(place_of(again, i) == place_of(set, i));
        CHECK(again.radius[i] == set.radius[i]);
        CHECK(again.density[i] == set.density[i]);
        CHECK(again.colour[3 * i + 1] == set.colour[3 * i + 1]);
        CHECK(again.id[i] == set.id[i]);
        for (std::size_t a = 0; a < 3; ++a)
            CHECK(again.velocity[3 * i + a] == set.velocity[3 * i + a]);
    }
    CHECK(set.velocity[1] == -6.0f);
    CHECK(set.velocity[5] == 2.0f);
}

TEST_CASE("particles: unit, radii and cross-sections in metres") {
    ParticleSet set;
    REQUIRE(decode("x y z radius density\n1 2 3 2 5\n", ".csv", set));
    ParticleSettings s;
    s.unit_m = 10;
    s.radius_scale = 2;
    s.cross_section = true;
    REQUIRE(place_particles("p", s, set));
    CHECK(place_of(set, 0) == Double3(10, 20, 30));
    CHECK(set.radius[0] == 40.0f);
    // What the ball holds is the cross-section: to a rounding of the float.
    CHECK(double(set.density[0]) * kBallMass * 64000 == doctest::Approx(5).epsilon(1e-7));
    turn_particles_y_up(set);
    CHECK(place_of(set, 0) == Double3(10, -30, 20));
}

TEST_CASE("particles: a share keeps the same ones in any order, and the mass within its noise") {
    std::string text[2] = {"x y z radius id\n", "x y z radius id\n"};
    constexpr int kMany = 1000;
    for (int i = 0; i < kMany; ++i) {
        const int j[2] = {i, (i * 337) % kMany};
        for (int k = 0; k < 2; ++k)
            text[k] += std::to_string(j[k]) + " 0 0 1 " + std::to_string(j[k]) + "\n";
    }
    ParticleSettings s;
    s.share = 0.25;
    ParticleSet set[2];
    std::uint64_t sum[2] = {};
    for (int k = 0; k < 2; ++k) {
        REQUIRE(decode(text[k], ".csv", set[k]));
        REQUIRE(place_particles("p", s, set[k]));
        CHECK(set[k].density[0] == 4.0f);
        for (const std::uint64_t id : set[k].id.span()) sum[k] += id * id;
    }
    CHECK(set[0].count == set[1].count);
    CHECK(sum[0] == sum[1]);
    // Binomial, standard deviation 13.7: five of them.
    CHECK(set[0].count > 250 - 69);
    CHECK(set[0].count < 250 + 69);
}

namespace {

/// Two particles after Krakatoa's specification: Position of floats, Density of halves, Radius of
/// doubles, ID of 64 bits, Normal of 16 bits.
constexpr char kPrt[] =
    "c05052540d0a1a0a38000000457874656e7369626c65205061727469636c6520466f726d6174000000000000"
    "01000000020000000000000004000000050000002c000000506f736974696f6e000000000000000000000000"
    "00000000000000000000000004000000030000000000000044656e7369747900000000000000000000000000"
    "00000000000000000000000003000000010000000c0000005261646975730000000000000000000000000000"
    "00000000000000000000000005000000010000000e0000004944000000000000000000000000000000000000"
    "0000000000000000000000000200000001000000160000004e6f726d616c0000000000000000000000000000"
    "00000000000000000000000000000000030000001e000000789c636068b067606070002207060b0630f861cf"
    "0e613030323031303340e441b801490d078a1a00ecdf05b9";

}  // namespace

TEST_CASE("particles: Krakatoa's channels of any type, and the file cut or changed anywhere") {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < sizeof kPrt; i += 2) {
        const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
        bytes += char(digit(kPrt[i]) * 16 + digit(kPrt[i + 1]));
    }
    ParticleSet set;
    const Status status = decode(bytes, ".prt", set);
    if (holds(status.message, "is not in this build")) return;
    REQUIRE_MESSAGE(bool(status), status.message);
    REQUIRE(set.count == 2);
    CHECK(set.radius[0] == 1.5f);
    CHECK(set.density[1] == 0.5f);
    CHECK(set.id[1] == 8);
    CHECK(place_of(set, 1)[0] - place_of(set, 0)[0] != 0);
    for (std::size_t n = 0; n < bytes.size(); ++n)
        CHECK_FALSE(bool(decode(bytes.substr(0, n), ".prt", set)));
    std::string lying = bytes;
    lying[48] = lying[49] = lying[50] = char(0xff);
    CHECK(holds(decode(lying, ".prt", set).message, "more than the file can hold"));
    lying[54] = lying[55] = char(0xff);
    CHECK(holds(decode(lying, ".prt", set).message, "more than the file can hold"));
    lying = bytes;
    lying[60] = char(0xff), lying[61] = char(0xff);
    CHECK(holds(decode(lying, ".prt", set).message, "channels: out of range"));
}
