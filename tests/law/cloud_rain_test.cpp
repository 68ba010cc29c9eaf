// SPDX-License-Identifier: Apache-2.0
// Procedural clouds: rain below, pouches under anvils, shelves, turning wind.
// in: procedural:cloud with these keys -> out: bits, boxes, extinction, faults.
// docs/generators.md, "Rain", "Anvil", "Shelf"
#include <cmath>
#include <string>

#include "src/scene/media/cloud_types.h"
#include "tests/law/cloud_texts.h"

using namespace cloud_test;

namespace {

/// Largest extinction in a layer of cells, 1/m, and the sum of densities.
struct LayerLook {
    double most = 0, sum = 0;
};
LayerLook layer_of(const Volume& v, int z, double per_m) {
    LayerLook out;
    const std::size_t cells = std::size_t(v.size[0]) * std::size_t(v.size[1]);
    for (std::size_t i = 0; i < cells; ++i) {
        const double d = double(v.density[std::size_t(z) * cells + i]);
        out.most = std::max(out.most, d * per_m), out.sum += d;
    }
    return out;
}

constexpr const char* kStorm = "type = \"cumulonimbus\", seed = 2";
const Size kSize{72, 60, 64};

}  // namespace

TEST_CASE("rain: the box reaches down to the ground, and heavy rain does") {
    const MediumSettings medium = medium_of(std::string(kStorm) + ", rain = 1");
    CHECK(medium.box.bounds_m[0].z == 0);
    CHECK(medium_of(std::string(kStorm) + ", rain = 1", "[ground]\naltitude_m = -50\n")
              .box.bounds_m[0]
              .z == -50);
    // Without rain as ever.
    CHECK(medium_of(kStorm).box.bounds_m[0].z > 500);
    const Volume v = made(medium, kSize);
    // 50 mm/h: 0.365/km R^0.63 = 4.3/km by Marshall and Palmer; streaks up to 1.3^2 of it.
    const LayerLook low = layer_of(v, 0, medium.optics.extinction_per_m);
    CHECK(low.most > 0.002);
    CHECK(low.most < 1.7 * 4.3e-3);
    // Below the base there is rain alone, and less of it farther down.
    const double cell = medium.box.bounds_m[1].z / kSize[2];
    const int under = int(500 / cell);
    CHECK(layer_of(v, under, 1).sum > layer_of(v, 0, 1).sum);
}

TEST_CASE("rain: a little ends in the air, none leaves the bits") {
    for (const char* type : {"cumulus-congestus", "cumulonimbus", "nimbostratus"}) {
        CAPTURE(type);
        const std::string cloud = "type = \"" + std::string(type) + "\", base_m = 2500";
        const MediumSettings little = medium_of(cloud + ", rain = 0.004");
        const Volume v = made(little, kSize);
        const double cell = (little.box.bounds_m[1].z - little.box.bounds_m[0].z) / kSize[2];
        CHECK(layer_of(v, 0, 1).sum == 0);
        CHECK(layer_of(v, int(2100 / cell), 1).sum > 0);
        CHECK(digest(made(medium_of(cloud + ", rain = 0"), kSize)) ==
              digest(made(medium_of(cloud), kSize)));
    }
}

TEST_CASE("rain, mamma, shelf, turn: the same bits in scalar code and by any threads") {
    for (const char* cloud :
         {"type = \"cumulonimbus\", rain = 0.6, mamma = 1, shelf = 1, turn_deg = 70",
          "type = \"cumulus-congestus\", rain = 0.2, shelf = 0.5, turn_deg = -360",
          "type = \"nimbostratus\", rain = 0.3", "type = \"cirrus-uncinus\", turn_deg = 360",
          "type = \"cumulus-field\", turn_deg = 90, shelf = 1"}) {
        CAPTURE(cloud);
        const MediumSettings medium = medium_of(cloud);
        const Size size{37, 35, 29};
        const std::string widest = digest(made(medium, size));
        CHECK(digest(made(medium, size, "scalar", 1)) == widest);
        CHECK(digest(made(medium, size, nullptr, 3)) == widest);
    }
}

TEST_CASE("rain: corners are sound clouds") {
    const std::string storm = kStorm;
    for (const auto& [cloud, lines] : std::initializer_list<std::array<std::string, 2>>{
             {storm + ", rain = 1, base_m = 0", ""},
             {storm + ", rain = 1, base_m = 100", "[ground]\naltitude_m = 0\n"},
             {storm + ", rain = 1, mamma = 1, shelf = 1, shear = 10, turn_deg = -360", ""},
             {storm + ", rain = 1", "bounds_m = [[0, 0, 2000], [30000, 30000, 14000]]\n"},
             {storm + ", rain = 1", "bounds_m = [[0, 0, 0], [30000, 30000, 14000]]\n"},
             {storm + ", rain = 1, height_m = 1, shelf = 1", ""},
             {"type = \"cumulus-congestus\", rain = 1, base_m = 9000, shear = 10", ""},
             {storm + ", rain = 1, height_m = 1, lifetime_s = 1e7, age_s = 5e6", ""},
             {storm + ", rain = 1, tall = 40, turrets = 40", ""},
             {storm + ", rain = 1, age_s = 1e6", ""},
             {storm + ", rain = 1, age_s = -5", ""},
             {"type = \"nimbostratus\", rain = 1, base_m = 0", ""},
             {"type = \"nimbostratus\", rain = 1, cover = 0", ""},
             {"type = \"nimbostratus\", rain = 1",
              "bounds_m = [[0, 0, 4000], [9000, 9000, 5000]]\n"}}) {
        CAPTURE(cloud);
        CAPTURE(lines);
        // The box comes before the ground's table.
        const bool box = lines.find("bounds_m") == 0;
        const MediumSettings medium = medium_of(cloud, lines);
        CHECK((box || medium.box.bounds_m[0].z <= 0));
        for (const Size& size : {Size{3, 3, 3}, Size{40, 37, 29}}) {
            const Volume v = made(medium, size);
            bool sound = true;
            for (const float d : v.density.span()) sound = sound && d >= 0.0f && d <= 1.0f;
            CHECK(sound);
        }
    }
}

TEST_CASE("rain comes with a grown storm and goes with it, without jumps") {
    const std::string cloud = std::string(kStorm) + ", rain = 1, lifetime_s = 1000, age_s = ";
    const Size small{32, 32, 24};
    const auto at = [&](double age) { return made(medium_of(cloud + std::to_string(age)), small); };
    CHECK(layer_of(at(150), 0, 1).sum == 0);
    CHECK(layer_of(at(550), 0, 1).sum > 0);
    CHECK(layer_of(at(990), 0, 1).sum == 0);
    double most = 0;
    for (const float d : at(550).density.span()) most += double(d);
    double least = 0;
    Volume before = at(200);
    for (double age = 205; age < 1000; age += 5) {
        Volume now = at(age);
        double change = 0;
        for (std::size_t i = 0; i < now.density.size(); ++i)
            change += std::fabs(double(now.density[i]) - double(before.density[i]));
        least = std::max(least, change / most);
        before = std::move(now);
    }
    CHECK(least < 0.1);
}

TEST_CASE("mamma hang below an anvil, a shelf below the base") {
    const MediumSettings flat = medium_of(kStorm);
    const Volume before = made(flat, kSize);
    const Volume hung = made(medium_of(std::string(kStorm) + ", mamma = 1"), kSize);
    double more = 0, less = 0, low = 0;
    const std::size_t layer = std::size_t(kSize[0]) * std::size_t(kSize[1]);
    for (std::size_t i = 0; i < before.density.size(); ++i) {
        const double d = double(hung.density[i]) - double(before.density[i]);
        (d > 0 ? more : less) += d > 0 ? d : -d;
        if (int(i / layer) < kSize[2] / 2) low += d != 0 ? 1 : 0;
    }
    CHECK(more > 0);
    CHECK(more > less);
    CHECK(low == 0);
    // The lip hangs down by 4 % of the height and more with shreds.
    const MediumSettings lip = medium_of(std::string(kStorm) + ", shelf = 1");
    CHECK(lip.box.bounds_m[0].z < flat.box.bounds_m[0].z);
    const Volume with = made(lip, {72, 60, 256});
    const double cell = (lip.box.bounds_m[1].z - lip.box.bounds_m[0].z) / 256;
    int lowest = 0;
    while (layer_of(with, lowest, 1).sum == 0) ++lowest;
    const double base = lip.box.bounds_m[0].z + lowest * cell;
    CHECK(base < 900 - 0.035 * 10200);
    CHECK(lowest > 1);
}

TEST_CASE("turning wind: the top keeps its place, what is lower is turned") {
    const auto middle = [](const std::string& cloud, float from, float to) {
        CloudHeap heap;
        REQUIRE(grow_cloud(resolved_cloud(medium_of(cloud).cloud), heap));
        double x = 0, y = 0, n = 0;
        for (std::size_t i = 0; i < heap.count; ++i)
            if (heap.balls[i].z > from && heap.balls[i].z < to)
                x += double(heap.balls[i].x), y += double(heap.balls[i].y), n += 1;
        return std::array<double, 2>{x / n, y / n};
    };
    const std::string cloud = "type = \"cumulus-congestus\", shear = 2";
    const auto calm = middle("type = \"cumulus-congestus\", shear = 0", 0.4f, 0.6f);
    const auto blown = middle(cloud + ", turn_deg = 180", 0.4f, 0.6f);
    const auto straight = middle(cloud, 0.4f, 0.6f);
    // Half of 180 degrees is left at half the height; it blew from east to west at the base.
    CHECK(straight[0] - calm[0] > 0.5);
    CHECK(std::fabs(blown[0] - calm[0]) < 0.4 * (straight[0] - calm[0]));
    CHECK(blown[1] - calm[1] > 0.5);
    const auto top = middle(cloud + ", turn_deg = 180", 0.9f, 2.0f);
    const auto top_straight = middle(cloud, 0.9f, 2.0f);
    CHECK(std::fabs(top[0] - top_straight[0]) < 0.3);
    CHECK(digest(made(medium_of(cloud + ", turn_deg = 0"), {40, 40, 30})) ==
          digest(made(medium_of(cloud), {40, 40, 30})));
}

TEST_CASE("rain, mamma, shelf, turn: bad numbers and types without them are one line") {
    for (const char* bad :
         {"rain = -0.1", "rain = 1.1", "rain = nan", "mamma = 2", "shelf = -1", "turn_deg = 400"}) {
        CAPTURE(bad);
        const std::string text = fault(std::string(kStorm) + ", " + bad);
        CHECK(text.find("allowed: ") != std::string::npos);
        CHECK(text.find('\n') == std::string::npos);
    }
    for (const char* other :
         {"type = \"cumulus-humilis\", rain = 0.5", "type = \"cumulus-field\", rain = 0.5",
          "type = \"cirrus\", rain = 0", "type = \"stratus\", shelf = 1", "mamma = 1",
          "type = \"altocumulus-lenticularis\", shelf = 1", "type = \"nimbostratus\", mamma = 0.5",
          "type = \"nimbostratus\", turn_deg = 5",
          "type = \"altocumulus-lenticularis\", turn_deg = 5"}) {
        CAPTURE(other);
        CHECK(fault(other).find("only, allowed: left out") != std::string::npos);
    }
}
