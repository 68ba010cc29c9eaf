// SPDX-License-Identifier: Apache-2.0
// Clouds by their age in seconds: they grow, live and are gone, without jumps.
// in: procedural:cloud with age_s -> out: water and tops by age, bits, faults.
// docs/generators.md, "Life"
#include <cmath>
#include <string>

#include "tests/law/cloud_texts.h"

using namespace cloud_test;

namespace {

Volume made(const std::string& cloud, double age_s, const Size& size, const char* isa = nullptr) {
    return cloud_test::made(medium_of(cloud + ", age_s = " + std::to_string(age_s)), size, isa);
}

struct Look {
    double water = 0;
    int top = 0;  ///< highest layer of cells with cloud
};
Look look(const Volume& v) {
    Look out;
    const std::size_t layer = std::size_t(v.size[0]) * std::size_t(v.size[1]);
    for (std::size_t i = 0; i < v.density.size(); ++i) {
        out.water += double(v.density[i]);
        if (v.density[i] > 0.02f) out.top = int(i / layer);
    }
    return out;
}

double change(const Volume& a, const Volume& b) {
    double out = 0;
    for (std::size_t i = 0; i < a.density.size(); ++i)
        out += std::fabs(double(a.density[i]) - double(b.density[i]));
    return out;
}

constexpr const char* kHumilis = "type = \"cumulus-humilis\"";  // 900 s
const Size kSmall{32, 32, 24};

}  // namespace

TEST_CASE("a cloud is not there before its first turret rises, nor after its life") {
    for (const double age : {-1e9, -1.0, 0.0, 900.0, 901.0, 1e9})
        CHECK(look(made(kHumilis, age, kSmall)).water == 0);
}

TEST_CASE("clouds of all heaped types rise, are full-grown, and fade") {
    for (const char* type :
         {"cumulus-humilis", "cumulus-mediocris", "cumulus-congestus", "cumulonimbus"}) {
        CAPTURE(type);
        const std::string cloud = std::string("type = \"") + type + "\", lifetime_s = 1000";
        const Look young = look(made(cloud, 100, kSmall)), grown = look(made(cloud, 450, kSmall)),
                   old = look(made(cloud, 800, kSmall)), last = look(made(cloud, 960, kSmall));
        CHECK(young.water > 0);
        CHECK(young.top < grown.top);
        CHECK(young.water < 0.6 * grown.water);
        CHECK(old.water < 0.7 * grown.water);
        CHECK(last.water < 0.1 * grown.water);
    }
}

TEST_CASE("clouds of all heaped types change without jumps") {
    for (const char* type :
         {"cumulus-humilis", "cumulus-mediocris", "cumulus-congestus", "cumulonimbus"}) {
        CAPTURE(type);
        const std::string cloud = std::string("type = \"") + type + "\", lifetime_s = 1000";
        const double most = look(made(cloud, 450, kSmall)).water;
        Volume before = made(cloud, 0, kSmall);
        // A step is 5 s of 1000: an edge moves by less than a cell.
        for (int step = 1; step <= 200; ++step) {
            Volume now = made(cloud, 5.0 * step, kSmall);
            CAPTURE(step);
            CHECK(change(before, now) < 0.1 * most);
            before = std::move(now);
        }
    }
}

TEST_CASE("an anvil comes out of its tower") {
    const std::string cloud = "type = \"cumulonimbus\", lifetime_s = 1000";
    const Look before = look(made(cloud, 250, kSmall));
    for (const double age : {250.00000001, 250.0001, 250.01, 250.5}) {
        CAPTURE(age);
        const Look now = look(made(cloud, age, kSmall));
        CHECK(std::fabs(now.water / before.water - 1) < 0.02);
    }
}

TEST_CASE("clouds of a field live one after the other") {
    const std::string field = "type = \"cumulus-field\", radius_m = 400, cover = 0.3, seed = 3";
    const Size wide{64, 64, 24};
    double least = 1e300, most = 0, jump = 0;
    Volume before = made(field, 0, wide);
    for (int step = 1; step <= 40; ++step) {
        Volume now = made(field, 20.0 * step, wide);
        const double water = look(now).water;
        least = std::min(least, water), most = std::max(most, water);
        jump = std::max(jump, change(before, now) / water);
        before = std::move(now);
    }
    CHECK(least > 0.3 * most);
    CHECK(jump < 0.35);
    CHECK(look(made(field, -1e6, wide)).water > 0);
}

TEST_CASE("a cloud of an age has the same bits on every instruction set") {
    const std::string cloud = "type = \"cumulus-congestus\", seed = 2";
    const std::string scalar = digest(made(cloud, 1111, kSmall, "scalar"));
    CHECK(digest(made(cloud, 1111, kSmall)) == scalar);
}

TEST_CASE("films move the age by their wind") {
    const std::string keys = "[animation]\nframes = 2\n[[animation.keys]]\nframe = 0\nwind_s = 5\n";
    const auto read = [&](const std::string& cloud) {
        Scene scene;
        return read_scene_text(text_of(cloud) + keys, "s.toml", "", {}, scene).message;
    };
    CHECK(read("age_s = 3").empty());
    CHECK(read("seed = 3").find("age_s") != std::string::npos);
}

TEST_CASE("what does not go with an age is one line") {
    CHECK(fault("type = \"stratus\", age_s = 3").find("age_s") != std::string::npos);
    CHECK(fault("age_s = 3, age = 0.5").find("conflicts with age_s") != std::string::npos);
    CHECK(fault("lifetime_s = 300").find("with age_s") != std::string::npos);
    CHECK(fault("age_s = 3, lifetime_s = 0").find("lifetime_s") != std::string::npos);
}
