// SPDX-License-Identifier: Apache-2.0
// Colours and emission of particles in method particles.
// in: balls that differ in colour, balls that shine -> out: pictures against equal ones, closed
// forms, paths. docs/particles.md, "Files"; docs/lights.md, "Media that emit"
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;
using namespace particle_test;

namespace {

const std::vector<std::vector<std::string>> kDisplays = {
    {"particles.display = \"march\""},
    {"particles.display = \"billboards\""},
    {"particles.display = \"march\"", "particles.light = \"linear\""},
};
const char* const kLamp =
    "[[light]]\ntype = \"point\"\nposition_m = [60, 0, 50]\nintensity = 3600\n";

/// Of particles in a table, under the harness's sun and sky.
Picture show(const std::string& table, const std::vector<std::string>& overrides,
             const std::string& more = "") {
    const test::TempFolder folder;
    folder.put("p.csv", table);
    Scene scene = scene_from(std::string(kText) + more, overrides);
    scene.directory = folder.path("");
    return render_one(scene);
}

/// Forty balls in a lattice, some over each other; `colour` of each follows its number.
template <class Colour>
std::string balls(const char* columns, Colour colour) {
    std::string text = "x y z radius density id" + std::string(columns) + "\n";
    for (int i = 0; i < 40; ++i) {
        char row[96];
        (void)std::snprintf(row, sizeof row, "%d %d %d %d 0.0%d %d", 12 * (i % 5) - 24,
                            9 * (i / 5 % 4) - 12, 30 + 25 * (i / 20), 8 + i % 7, 2 + i % 5, i);
        text += row + colour(i) + "\n";
    }
    return text;
}

double largest_difference(const Picture& a, const Picture& b, const char* channel) {
    double most = 0;
    for (int y = 0; y < a.image.height; ++y)
        for (int x = 0; x < a.image.width; ++x)
            most = std::max(most,
                            std::fabs(double(a.at(channel, x, y)) - double(b.at(channel, x, y))));
    return most;
}

}  // namespace

TEST_CASE("particles: a colour that all have is the medium's albedo") {
    const std::string white = balls("", [](int) { return std::string(); });
    const std::string tinted =
        balls(" red green blue", [](int) { return std::string(" 0.5 0.75 0.25"); });
    for (const auto& display : kDisplays)
        for (const char* scattering : {"single", "octaves"}) {
            CAPTURE(display.back());
            CAPTURE(scattering);
            auto overrides = display;
            overrides.push_back("particles.scattering = \"" + std::string(scattering) + "\"");
            auto same = overrides;
            overrides.push_back("medium.0.albedo = 0.8");
            same.push_back("medium.0.albedo = [0.4, 0.6, 0.2]");
            const Picture a = show(tinted, overrides, kLamp), b = show(white, same, kLamp);
            double most = 0;
            for (int i = 0; i < 24 * 24; ++i)
                most = std::max(most, double(b.at("G", i % 24, i / 24)));
            CHECK(most > 0.005);
            // Some roundings of products and means.
            for (const char* channel : {"R", "G", "B"})
                CHECK(largest_difference(a, b, channel) < 2e-6 * most);
        }
}

TEST_CASE("particles: two colours in one place mix by their depths") {
    // Thin, so that light and depth go together.
    const std::string mixed =
        "x y z radius density red green blue\n"
        "0 0 50 20 0.00001 1 0 0.5\n0 0 50 20 0.00003 0 1 0.5\n";
    const std::string white = "x y z radius density\n0 0 50 20 0.00004\n";
    for (const auto& overrides : kDisplays) {
        CAPTURE(overrides.back());
        const Picture a = show(mixed, overrides), b = show(white, overrides);
        const double whole = double(b.at("G", 12, 12));
        CHECK(whole > 0);
        // Billboards show the one behind through the other: a depth of 1e-3.
        CHECK(double(a.at("R", 12, 12)) == doctest::Approx(0.25 * whole).epsilon(2e-3));
        CHECK(double(a.at("G", 12, 12)) == doctest::Approx(0.75 * whole).epsilon(2e-3));
        CHECK(double(a.at("B", 12, 12)) == doctest::Approx(0.5 * whole).epsilon(2e-3));
    }
}

TEST_CASE("particles: one that absorbs and shines shows emission / extinction (1 - e^-tau)") {
    const std::string table =
        "x y z radius density emission_red emission_green emission_blue\n"
        "0 0 50 20 0.05 2 1 0\n";
    for (auto overrides : kDisplays) {
        CAPTURE(overrides.back());
        for (const char* key :
             {"sky.radiance = 0", "medium.0.albedo = 0", "medium.0.emission = [0.5, 0.25, 1]"})
            overrides.push_back(key);
        const Picture p = show(table, overrides);
        const double seen = 1 - std::exp(-double(p.at("tau", 12, 12)));
        CHECK(seen > 0.5);
        CHECK(double(p.at("R", 12, 12)) == doctest::Approx(1.0 * seen).epsilon(1e-5));
        CHECK(double(p.at("G", 12, 12)) == doctest::Approx(0.25 * seen).epsilon(1e-5));
        CHECK(p.at("B", 12, 12) == 0.0f);
    }
}

TEST_CASE("particles: emission is that of the grid by paths") {
    const std::string table = balls("", [](int) { return std::string(); });
    std::vector<std::string> dark = {"medium.0.albedo = 0", "medium.0.emission = 2",
                                     "medium.0.resolution = [80, 80, 80]", "particles.bins = 1024"};
    const Picture own = show(table, dark);
    for (const char* key :
         {"method.name = \"path\"", "path.pixel = \"centre\"", "path.samples_per_pixel = 400"})
        dark.push_back(key);
    const Picture path = show(table, dark);
    double a = 0, b = 0;
    for (int y = 0; y < own.image.height; ++y)
        for (int x = 0; x < own.image.width; ++x)
            a += double(own.at("G", x, y)), b += double(path.at("G", x, y));
    // Noise of 576 pixels of 400 samples: 0.1 %. Cells of 1.2 m and fewer, radii of 8 m and more.
    CHECK(b > 10);
    CHECK(a == doctest::Approx(b).epsilon(0.006));
}

TEST_CASE("particles: colours do not depend on the order of the file") {
    const auto colour = [](int i) {
        char text[48];
        (void)std::snprintf(text, sizeof text, " 0.%d 0.%d 1 %d 1 0", i % 10, 9 - i % 10, i % 3);
        return std::string(text);
    };
    const std::string table =
        balls(" red green blue emission_red emission_green emission_blue", colour);
    // The rows from the last to the first.
    std::vector<std::string> rows;
    for (std::size_t at = 0; at < table.size(); at += rows.back().size())
        rows.push_back(table.substr(at, table.find('\n', at) + 1 - at));
    std::string turned = rows[0];
    for (std::size_t i = rows.size() - 1; i > 0; --i) turned += rows[i];
    CHECK(turned.size() == table.size());
    for (auto overrides : kDisplays) {
        overrides.push_back("medium.0.emission = 0.001");
        const Picture a = show(table, overrides), b = show(turned, overrides);
        for (const char* channel : {"R", "G", "B"}) CHECK(largest_difference(a, b, channel) == 0);
    }
}

TEST_CASE("particles: colours that a grid has no place for are told") {
    const auto told = [](const std::string& table, const char* method) {
        const Picture p = show(table, {std::string("method.name = \"") + method + "\""});
        for (const std::string& line : p.report.warnings)
            if (line.find("particles_uncoloured") != std::string::npos) return true;
        return false;
    };
    const std::string red = balls(" red green blue", [](int) { return std::string(" 1 0 0"); });
    const std::string shining = balls(" emission_red emission_green emission_blue",
                                      [](int) { return std::string(" 1 1 1"); });
    for (const char* method : {"raymarch", "path", "collectors"}) {
        CAPTURE(method);
        CHECK(told(red, method));
        CHECK(told(shining, method));
        CHECK_FALSE(told(balls("", [](int) { return std::string(); }), method));
    }
    CHECK_FALSE(told(red, "particles"));
}
