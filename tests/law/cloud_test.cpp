// SPDX-License-Identifier: Apache-2.0
// Procedural clouds by type: bits, shortened lists, bases, boxes.
// in: scenes with procedural:cloud -> out: pass or fail.
// docs/generators.md

#include <cmath>
#include <cstdio>
#include <string>

#include "src/scene/keys/key_row.h"
#include "src/scene/media/cloud_types.h"
#include "tests/law/cloud_texts.h"

using namespace cloud_test;

namespace {

const char* const kHeaps[] = {"cumulus-humilis", "cumulus-mediocris", "cumulus-congestus"};

const char* const kLayers[] = {"stratocumulus", "stratocumulus-open", "altocumulus",
                               "stratus",       "nimbostratus",       "fog",
                               "cirrus",        "cirrus-uncinus",     "cirrostratus"};

}  // namespace

TEST_CASE("clouds: a shortened list of balls gives the bits of all balls") {
    for (const char* type : kHeaps) {
        CAPTURE(type);
        const MediumSettings medium = medium_of("type = \"" + std::string(type) + "\", seed = 7");
        const Size size{70, 66, 50};
        CHECK(digest(made(medium, size)) == digest(made(medium, size, nullptr, 0, true)));
    }
}

TEST_CASE("clouds: scalar code and the widest lanes give the same bits") {
    const MediumSettings medium = medium_of("type = \"cumulus-congestus\", seed = 2, age = 0.4");
    const Size size{61, 55, 47};
    CHECK(digest(made(medium, size, "scalar")) == digest(made(medium, size)));
}

TEST_CASE("clouds: every type has the same bits in scalar code, by the widest lanes, any threads") {
    for (const std::string_view name : split_list(kCloudTypes)) {
        CAPTURE(std::string(name));
        const MediumSettings medium = medium_of("type = \"" + std::string(name) + "\", seed = 5");
        const Size size{37, 35, 21};
        const std::string widest = digest(made(medium, size));
        CHECK(digest(made(medium, size, "scalar")) == widest);
        Volume volume;
        REQUIRE(make_cloud(medium, {size, *kernel_table(nullptr), 3}, volume));
        CHECK(digest(volume) == widest);
        bool some = false, sound = true;
        for (const float v : volume.density.span())
            some = some || v > 0.02f, sound = sound && v >= 0.0f && v <= 1.0f;
        CHECK(some);
        CHECK(sound);
    }
}

TEST_CASE("clouds: layers repeat without a seam, and cover what is asked") {
    for (const char* type : kLayers)
        for (const double cover : {0.0, 0.4, 0.8, 1.0}) {
            CAPTURE(type);
            CAPTURE(cover);
            const MediumSettings medium =
                medium_of("type = \"" + std::string(type) + "\", cover = " + std::to_string(cover));
            const Size size{96, 96, 24};
            const Volume volume = made(medium, size);
            double within = 0, across = 0, covered = 0;
            const auto at = [&](int x, int y, int z) {
                return double(volume.density[std::size_t((z * 96 + y) * 96 + x)]);
            };
            for (int y = 0; y < 96; ++y)
                for (int x = 0; x < 96; ++x) {
                    double depth = 0;
                    for (int z = 0; z < 24; ++z) depth += at(x, y, z);
                    covered += depth > 0.01 ? 1.0 / (96 * 96) : 0;
                    if (x == 95)
                        for (int z = 0; z < 24; ++z)
                            across += std::fabs(at(95, y, z) - at(0, y, z)) +
                                      std::fabs(at(y, 95, z) - at(y, 0, z)),
                                within += std::fabs(at(47, y, z) - at(48, y, z)) +
                                          std::fabs(at(y, 47, z) - at(y, 48, z));
                }
            std::printf(
                "clouds: %s, cover %.1f: %.3f covered, steps across the seam %.2f, within "
                "%.2f\n",
                type, cover, covered, across, within);
            if (cover == 0) CHECK(covered == 0);
            if (cover == 1) CHECK(covered > 0.85);
            if (cover == 0.4) CHECK(covered < 0.75);
            CHECK(across < 3 * within + 5);
        }
}

TEST_CASE("clouds: left out, the box holds the cloud, which stands on a flat base") {
    for (const char* type : kHeaps) {
        CAPTURE(type);
        for (const char* more : {"", ", base_m = 2500, position_m = [3000, -100]", ", shear = 1"}) {
            CAPTURE(more);
            const MediumSettings medium = medium_of("type = \"" + std::string(type) + "\"" + more);
            REQUIRE(medium.box.has_bounds);
            CHECK(medium.optics.extinction_per_m > 0.04);
            CHECK(medium.optics.phase.type == "cloud");
            const CloudSettings cloud = resolved_cloud(medium.cloud);
            const Size size{80, 80, 80};
            const Volume volume = made(medium, size);
            const double cell = (medium.box.bounds_m[1].z - medium.box.bounds_m[0].z) / 80;
            int lowest = 80, highest = 0, rim = 0;
            for (int z = 0; z < 80; ++z)
                for (int y = 0; y < 80; ++y)
                    for (int x = 0; x < 80; ++x) {
                        if (!(volume.density[std::size_t((z * 80 + y) * 80 + x)] > 0)) continue;
                        lowest = std::min(lowest, z), highest = std::max(highest, z);
                        rim += x < 2 || y < 2 || x > 77 || y > 77 ? 1 : 0;
                    }
            CHECK(rim == 0);
            const double base = medium.box.bounds_m[0].z + lowest * cell;
            CHECK(std::fabs(base - cloud.base_m) < 0.03 * cloud.height_m + cell);
            const double top = medium.box.bounds_m[0].z + (highest + 1) * cell - cloud.base_m;
            CHECK(top > 0.85 * cloud.height_m);
            CHECK(top < 1.3 * cloud.height_m);
        }
    }
}

TEST_CASE("clouds: a box of its own sets the size, unless the scene asks for one that fits") {
    const std::string box = "bounds_m = [[0, 0, 0], [3000, 3000, 1000]]\n";
    const MediumSettings filled = medium_of("seed = 3", box);
    CloudHeap heap;
    CloudInGrid place;
    REQUIRE(place_cloud(filled, heap, place));
    CHECK(place.cloud.height_m == doctest::Approx(place.allowed_m));
    CHECK(place.cloud.height_m > 500);
    CHECK(fault("height_m = 300", box) == "");
    CHECK(fault("height_m = 5000", box)
              .find("cloud.height_m: does not fit bounds_m, 5000, "
                    "allowed: at most ") != std::string::npos);
    CHECK(fault("radius_m = 5000", box).find("cloud.radius_m: does not fit") != std::string::npos);
    CHECK(fault("base_m = 2000", box).find("cloud.base_m: outside bounds_m") != std::string::npos);
    CHECK(fault("position_m = [-9, 0]", box).find("outside bounds_m") != std::string::npos);
    CHECK(fault("base_m = 0", "[ground]\naltitude_m = 100\n").find("below the ground") !=
          std::string::npos);
}

TEST_CASE("clouds: bad numbers are one line, extremes a sound cloud") {
    for (const char* bad : {"height_m = 0",
                            "height_m = -5",
                            "height_m = nan",
                            "height_m = 1e6",
                            "age = -0.1",
                            "age = 2",
                            "turrets = 0",
                            "turrets = 1000",
                            "slimness = 0",
                            "dilution = -1",
                            "erosion = 3",
                            "shear = inf",
                            "seed = -1",
                            "type = \"cumulus\"",
                            "cover = 1.5",
                            "outline = -1",
                            "base_m = 1e9",
                            "entrainment_per_km = -1",
                            "entrainment_per_km = nan",
                            "type = \"altocumulus-lenticularis\", plates = 0"}) {
        CAPTURE(bad);
        const std::string text = fault(bad);
        CHECK(text.find("allowed: ") != std::string::npos);
        CHECK(text.find('\n') == std::string::npos);
    }
    // What a type does not have.
    for (const char* other :
         {"type = \"stratus\", turrets = 3", "type = \"fog\", age = 0.5",
          "type = \"cirrus\", radius_m = 300", "type = \"stratocumulus\", shear = 1",
          "type = \"altocumulus\", wind_deg = 90", "type = \"stratus\", anvil = 1", "cover = 0.5",
          "cell_m = 500", "type = \"cumulus-field\", cell_m = 500", "plates = 3",
          "type = \"stratus\", entrainment_per_km = 1", "type = \"cirrus\", erosion = 0.1",
          "type = \"altocumulus-lenticularis\", turrets = 3",
          "type = \"altocumulus-lenticularis\", entrainment_per_km = 1",
          "type = \"altocumulus-lenticularis\", cover = 0.5",
          "type = \"altocumulus-lenticularis\", erosion = 0.1"}) {
        CAPTURE(other);
        CHECK(fault(other).find("only, allowed: left out") != std::string::npos);
    }
    for (const char* extreme :
         {"height_m = 1", "height_m = 1e5", "age = 1", "turrets = 40, slimness = 1", "turrets = 1",
          "slimness = 0.08, turrets = 40", "dilution = 2, age = 1", "erosion = 0", "erosion = 0.5",
          "shear = 3, wind_deg = -360", "outline = 2", "height_m = 1e5, radius_m = 1",
          "height_m = 1, radius_m = 1e5", "tall = 40", "entrainment_per_km = 20, height_m = 1e5",
          "entrainment_per_km = 0",
          "type = \"altocumulus-lenticularis\", plates = 12, outline = 2, shear = 10",
          "type = \"altocumulus-lenticularis\", plates = 1, height_m = 1e5, radius_m = 1"}) {
        CAPTURE(extreme);
        const MediumSettings medium = medium_of(extreme);
        for (const Size& size : {Size{3, 3, 3}, Size{40, 37, 19}}) {
            const Volume volume = made(medium, size);
            bool sound = true;
            for (const float v : volume.density.span()) sound = sound && v >= 0.0f && v <= 1.0f;
            CHECK(sound);
        }
    }
}

TEST_CASE("clouds: the wind's direction is where tops drift") {
    const auto middle = [](const char* cloud) {
        const MediumSettings medium = medium_of(cloud);
        CloudHeap heap;
        CloudInGrid place;
        REQUIRE(place_cloud(medium, heap, place));
        double x = 0, y = 0, n = 0;
        for (std::size_t i = 0; i < heap.count; ++i)
            if (heap.balls[i].z > 0.7f)
                x += double(heap.balls[i].x), y += double(heap.balls[i].y), n += 1;
        REQUIRE(n > 0);
        return std::array<double, 2>{x / n, y / n};
    };
    const auto calm = middle("shear = 0");
    for (const double deg : {0.0, 90.0, -135.0, 300.0}) {
        CAPTURE(deg);
        const auto blown = middle(("shear = 1, wind_deg = " + std::to_string(deg)).c_str());
        const double x = blown[0] - calm[0], y = blown[1] - calm[1];
        const double turn = deg / 360 * 6.283185307179586;
        CHECK(std::hypot(x, y) > 0.5);
        CHECK((x * std::cos(turn) + y * std::sin(turn)) / std::hypot(x, y) > 0.99);
    }
}

// 1.5 q/(rho r), of 2.2 g/m^3 per km: extinction grows as q^(2/3) and the drops as q^(1/3).
TEST_CASE("clouds: extinction, water and the radius of the drops agree") {
    for (const double middle_m : {100.0, 300.0, 600.0, 1000.0, 1200.0}) {
        CAPTURE(middle_m);
        const double water = 2.2 * middle_m / 1000;
        const double extinction = cloud_extinction_per_m(middle_m / 1.15);
        const double radius = cloud_radius_um(middle_m / 0.6);
        CHECK(extinction == doctest::Approx(1.5 * water / radius).epsilon(0.005));
    }
}
