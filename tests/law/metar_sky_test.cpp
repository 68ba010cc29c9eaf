// SPDX-License-Identifier: Apache-2.0
// A METAR becomes scenes that the reader of scenes takes, with heights, cover, wind and visibility
// as reported. in: reports -> out: pass or fail. docs/metar.md
#include "src/scene/metar/metar_sky.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "src/scene/read_scene.h"
#include "tests/law/metar_reports.h"

using namespace metar_test;

namespace {

MetarSky sky_of(const std::string& text, const MetarSkySettings& settings = {}) {
    Metar report;
    const Status read = read_metar(text, report);
    INFO(read.message);
    REQUIRE(bool(read));
    MetarSky sky;
    const Status made = metar_sky(report, settings, sky);
    INFO(made.message);
    REQUIRE(bool(made));
    return sky;
}

Scene scene_of(const MetarScene& made) {
    Scene scene;
    const Status status = read_scene_text(made.text, made.name, "", {}, scene);
    CAPTURE(made.text);
    INFO(status.message);
    REQUIRE(bool(status));
    REQUIRE(scene.media.size() == 1);
    return scene;
}

MediumSettings medium_of(const MetarScene& made) { return scene_of(made).media[0]; }

/// The first layer whose name begins so.
MediumSettings layer(const MetarSky& sky, const std::string& name) {
    for (const MetarScene& made : sky.layers)
        if (made.name.compare(0, name.size(), name) == 0) return medium_of(made);
    FAIL("no layer " << name);
    return {};
}

bool has_layer(const MetarSky& sky, const std::string& name) {
    for (const MetarScene& made : sky.layers)
        if (made.name.compare(0, name.size(), name) == 0) return true;
    return false;
}

bool has_note(const MetarSky& sky, const std::string& part) {
    for (const std::string& note : sky.notes)
        if (note.find(part) != std::string::npos) return true;
    return false;
}

/// Texts have nine digits.
doctest::Approx near(double value) { return doctest::Approx(value).epsilon(1e-8); }

/// Extinction at the ground by the air's haze and a layer of mean density 1/2 there.
double at_ground(const MetarSky& sky, const std::string& name) {
    const double haze = 0.0972 * (sky.turbidity - 1) / 1200;
    const MediumSettings medium = layer(sky, name);
    return haze + 0.5 * medium.optics.extinction_per_m * medium.sky.base_density;
}

}  // namespace

TEST_CASE("metar sky: every text is a scene, and lies above the field") {
    std::set<std::string> kinds;
    for (const Report& report : kReports)
        for (const double elevation_m : {0.0, 1650.0}) {
            CAPTURE(report.text);
            MetarSkySettings settings;
            settings.field_elevation_m = elevation_m;
            const MetarSky sky = sky_of(report.text, settings);
            std::set<std::string> names;
            for (const MetarScene& made : sky.layers) {
                const Scene scene = scene_of(made);
                const MediumSettings& medium = scene.media[0];
                kinds.insert(made.name.substr(0, made.name.rfind('_')));
                CHECK(names.insert(made.name).second);
                CHECK(scene.method == "raymarch");
                CHECK(medium.density == "procedural:sky");
                CHECK(medium.sky.base_m >= elevation_m);
                CHECK(medium.sky.top_m > medium.sky.base_m);
                CHECK(medium.optics.extinction_per_m > 0);
                // To the horizon, over the ground.
                CHECK(!medium.box.has_bounds);
                CHECK(scene.ground.altitude_m == elevation_m);
            }
            for (const MetarScene& made : sky.kinds) {
                CHECK(names.insert(made.name).second);
                CHECK(medium_of(made).density == "procedural:cloud");
            }
            for (const MetarScatter& row : sky.scatter) {
                CHECK(names.count(row.kind) == 1);
                CHECK(row.count >= 1);
                CHECK(row.base_m > elevation_m);
                CHECK(row.near_m < row.far_m);
                CHECK(row.seed >= 0);
            }
            CHECK(sky.turbidity >= 1);
            CHECK(sky.turbidity <= 10);
            for (const std::string& note : sky.notes) CHECK(note.find('\n') == std::string::npos);
        }
    for (const char* kind : {"cumulus", "stratocumulus", "stratus", "nimbostratus", "altocumulus",
                             "altostratus", "cirrus", "cirrostratus", "cumulonimbus", "fog", "mist",
                             "haze", "dust", "rain", "snow", "blowing_snow"}) {
        CAPTURE(kind);
        CHECK(kinds.count(kind) == 1);
    }
}

TEST_CASE("metar sky: height, cover and wind of a layer") {
    MetarSkySettings settings;
    settings.field_elevation_m = 100;
    const MetarSky sky = sky_of("EDDF 121845Z 24012KT 9999 FEW020 12/08 Q1013", settings);
    REQUIRE(sky.layers.size() == 1);
    const MediumSettings cumulus = layer(sky, "cumulus_1");
    CHECK(cumulus.sky.type == "cumulus");
    CHECK(cumulus.sky.base_m == near(709.6));
    CHECK(cumulus.sky.top_m == near(1109.6));
    CHECK(cumulus.sky.coverage == near(1.5 / 8));
    CHECK(cumulus.sky.planet_radius_m == 6371000);
    CHECK(!cumulus.box.has_bounds);
    const double speed = 12 * 1852.0 / 3600 * 1.6096,
                 from = (240 + 25 * 0.6096) / 57.29577951308232;
    CHECK(cumulus.sky.wind_m_per_s[0] == near(-std::sin(from) * speed));
    CHECK(cumulus.sky.wind_m_per_s[1] == near(-std::cos(from) * speed));
    CHECK(sky.day == 12);
    CHECK(sky.utc_hours == near(18.75));
    CHECK(sky.turbidity == 2);
    settings.southern = true;
    const double backed = (240 - 25 * 0.6096) / 57.29577951308232;
    const MetarSky south = sky_of("EDDF 121845Z 24012KT 9999 FEW020 12/08 Q1013", settings);
    CHECK(layer(south, "cumulus").sky.wind_m_per_s[0] == near(-std::sin(backed) * speed));
    for (const char* still : {"VRB03KT", "00000KT", "/////KT"}) {
        const MetarSky calm = sky_of("EDDF 121845Z " + std::string(still) + " 9999 FEW020");
        CHECK(layer(calm, "cumulus").sky.wind_m_per_s == std::array<double, 2>{0, 0});
    }
    CHECK(layer(sky_of("EDDF 121845Z SCT020"), "cumulus").sky.coverage == near(3.5 / 8));
    CHECK(layer(sky_of("EDDF 121845Z BKN020"), "strato").sky.coverage == near(6.0 / 8));
    CHECK(layer(sky_of("EDDF 121845Z OVC020"), "strato").sky.coverage == 1);
}

TEST_CASE("metar sky: kinds of sheets by height, cover and rain") {
    const struct {
        const char* groups;
        const char* name;
    } kRows[] = {
        {"FEW020", "cumulus"},          {"SCT050", "cumulus"},         {"SCT005", "stratus"},
        {"BKN005", "stratus"},          {"BKN030", "stratocumulus"},   {"OVC030", "stratocumulus"},
        {"-RA OVC030", "nimbostratus"}, {"SN OVC080", "nimbostratus"}, {"SHRA OVC030", "strato"},
        {"-DZ OVC005", "stratus"},      {"FEW080", "altocumulus"},     {"BKN120", "altocumulus"},
        {"OVC120", "altostratus"},      {"-RA OVC120", "altostratus"}, {"FEW250", "cirrus"},
        {"OVC250", "cirrostratus"},     {"BKN030CB", "cumulonimbus"},  {"BKN030TCU", "cumulus"}};
    for (const auto& row : kRows) {
        CAPTURE(row.groups);
        const MetarSky sky = sky_of("EDDF 121845Z 9999 " + std::string(row.groups));
        REQUIRE(!sky.layers.empty());
        CHECK(sky.layers[0].name.compare(0, std::string(row.name).size(), row.name) == 0);
        CHECK(has_note(sky, "assumed"));
    }
    const MediumSettings cirrus = layer(sky_of("EDDF 121845Z FEW250"), "cirrus");
    CHECK(cirrus.optics.phase.type == "henyey-greenstein");
    CHECK(cirrus.optics.extinction_per_m < 0.002);
    // Sheets end below the next one.
    const MetarSky two = sky_of("EDDF 121845Z FEW020 BKN030");
    CHECK(layer(two, "cumulus").sky.top_m == near(30 * 30.48 - 30));
}

TEST_CASE("metar sky: towers become kinds and places") {
    const MetarSky sky = sky_of("EDDF 121845Z 24012KT 9999 FEW030CB SCT040TCU SCT050CB BKN080");
    REQUIRE(sky.kinds.size() == 2);
    REQUIRE(sky.scatter.size() == 3);
    CHECK(sky.layers.size() == 1);
    CHECK(medium_of(sky.kinds[0]).cloud.type == "cumulonimbus");
    CHECK(medium_of(sky.kinds[1]).cloud.type == "cumulus-congestus");
    CHECK(sky.scatter[0].base_m == near(914.4));
    CHECK(sky.scatter[0].far_m == 40000);
    // The widest first: places are taken in this order.
    CHECK(sky.scatter[1].kind == "cumulonimbus");
    CHECK(sky.scatter[2].kind == "congestus");
    CHECK(sky.scatter[1].seed != sky.scatter[0].seed);
    CHECK(sky.scatter[1].count > sky.scatter[0].count);
    CHECK(sky.scatter[2].count == 4);
    CHECK(sky_of("EDDF 121845Z 9999 SCT040TCU").scatter[0].count == 24);
    const MetarSky many = sky_of("EDDF 121845Z SCT030CB SCT040CB SCT050CB");
    CHECK(many.scatter[0].count + many.scatter[1].count == 3);
    CHECK(many.scatter.size() == 2);
    CHECK(sky_of("EDDF 121845Z 9999 TS FEW030").kinds.size() == 1);
    CHECK(sky_of("EDDF 121845Z 9999 VCTS FEW030").kinds.empty());
    MetarSkySettings small;
    small.scale_radius_km = 1;
    const MetarSky narrow = sky_of("EDDF 121845Z 9999 SCT030CB", small);
    CHECK(narrow.scatter[0].count == 1);
    CHECK(narrow.scatter[0].far_m > narrow.scatter[0].near_m);
}

TEST_CASE("metar sky: the reported visibility is that of the air and its layers") {
    // Koschmieder: extinction 3.912 / visibility, of air alone down to 5.36 km.
    for (const double m : {6000.0, 8000.0, 9000.0}) {
        const MetarSky sky = sky_of("EDDF 121845Z " + std::to_string(int(m)) + " HZ NSC");
        CHECK(sky.layers.empty());
        CHECK(0.0972 * (sky.turbidity - 1) / 1200 == near(3.912 / m));
    }
    const struct {
        const char* groups;
        const char* name;
        double m;
    } kRows[] = {{"0200 FG VV001", "fog", 200},
                 {"0800 FG NSC", "fog", 800},
                 {"3000 BR NSC", "mist", 3000},
                 {"2000 HZ NSC", "haze", 2000},
                 {"1500 FU NSC", "smoke", 1500},
                 {"0500 +DS NSC", "dust", 500},
                 {"4000 NSC", "mist", 4000},
                 {"1/2SM FG OVC002", "fog", 804.672},
                 {"0600 FU FG NSC", "fog", 600},
                 {"0400 +SN VV004", "snow", 400},
                 {"1500 SN OVC010", "snow", 1500},
                 {"FG VV002", "fog", 60.96},
                 {"FG", "fog", 500},
                 {"5000 SN OVC010", "snow", 5000}};
    for (const auto& row : kRows) {
        CAPTURE(row.groups);
        const MetarSky sky = sky_of("EDDF 121845Z " + std::string(row.groups));
        // base_density has six digits.
        CHECK(at_ground(sky, row.name) == doctest::Approx(3.912 / row.m).epsilon(1e-5));
        CHECK(layer(sky, row.name).sky.base_m == 0);
    }
    CHECK(sky_of("EDDF 121845Z CAVOK").layers.empty());
    CHECK(has_note(sky_of("EDDF 121845Z 4000 NSC"), "mist assumed"));
    // An obscured sky: a depth of 3.912 up to the vertical visibility, where that is not too dense.
    const MediumSettings fog = layer(sky_of("EDDF 121845Z 1000 FG VV010"), "fog");
    const double h = fog.sky.top_m, v = 304.8, e = fog.optics.extinction_per_m / 2;
    const double g = e * fog.sky.base_density, haze = 0.0972 / 1200;
    CHECK(g + haze == doctest::Approx(3.912 / 1000).epsilon(1e-5));  // six digits
    CHECK(g * v + (e - g) * v * v / (2 * h) == doctest::Approx(3.912).epsilon(1e-5));
    CHECK(has_layer(sky_of("EDDF 121845Z 9999 BCFG NSC"), "fog"));
    CHECK(layer(sky_of("EDDF 121845Z 9999 MIFG NSC"), "fog").sky.top_m == 2);
}

TEST_CASE("metar sky: precipitation from the ground to the clouds") {
    const struct {
        const char* groups;
        double per_km, top_m, coverage;
    } kRows[] = {// 0.365 R^0.63 at 1, 5 and 20 mm/h, in shafts; three digits in the table.
                 {"9999 -SHRA SCT020 BKN030", 0.365, 914.4, 0.25},
                 {"9999 SHRA SCT030", 0.365 * std::pow(5.0, 0.63), 914.4, 0.4},
                 {"9999 +TSRA FEW020 SCT040CB", 0.365 * std::pow(20.0, 0.63), 1219.2, 0.6},
                 {"9999 -SHSN OVC010", 2.6, 304.8, 0.25},
                 {"9999 -SHRA NCD", 0.365, 1500, 0.25},
                 {"9999 -SHRA OVC250", 0.365, 1500, 0.25}};
    for (const auto& row : kRows) {
        CAPTURE(row.groups);
        const MetarSky sky = sky_of("EDDF 121845Z 24012KT " + std::string(row.groups) + " 02/01");
        const MediumSettings fall = layer(sky, has_layer(sky, "rain") ? "rain" : "snow");
        CHECK(fall.optics.extinction_per_m * 1000 == doctest::Approx(row.per_km).epsilon(0.002));
        CHECK(fall.sky.base_m == 0);
        CHECK(fall.sky.top_m == near(row.top_m));
        CHECK(fall.sky.coverage == row.coverage);
        CHECK(fall.optics.albedo == Float3{1, 1, 1});
        CHECK(fall.sky.wind_m_per_s[0] > 0);  // from the south-west
    }
    // All around it dims no more than is reported: 1 /km in 10 km becomes 0.31 /km.
    const MetarSky wide = sky_of("EDDF 121845Z 9999 RA OVC010");
    CHECK(layer(wide, "rain").optics.extinction_per_m / 2 == near(3.912 / 10000 - 0.0972 / 1200));
    CHECK(has_layer(sky_of("EDDF 121845Z 5000 UP OVC010 M02/M03"), "snow"));
    CHECK(has_layer(sky_of("EDDF 121845Z 5000 UP OVC010 05/03"), "rain"));
    CHECK(!has_layer(sky_of("EDDF 121845Z 9999 VCSH BKN030"), "rain"));
    CHECK(!has_layer(sky_of("EDDF 121845Z 9999 DRSN BKN030"), "snow"));
}

TEST_CASE("metar sky: what is not reported is assumed with a note") {
    CHECK(has_note(sky_of("EDDF 121845Z 9999 NCD"), "NCD"));
    CHECK(has_note(sky_of("KJFK 121845Z 10SM CLR"), "CLR"));
    CHECK(has_note(sky_of("EDDF 121845Z CAVOK"), "CAVOK"));
    CHECK(has_note(sky_of("EDDF 121845Z 9999 BKN///"), "base of BKN"));
    CHECK(has_note(sky_of("EDDF 121845Z 9999 ///020"), "amount of clouds"));
    CHECK(has_note(sky_of("EDDF 121845Z 9999 //////"), "clouds: not reported"));
    CHECK(has_note(sky_of("EDDF 121845Z 9999"), "clouds: not reported"));
    CHECK(has_note(sky_of("EDDF 121845Z FEW020"), "visibility: not reported"));
    CHECK(has_note(sky_of("EDDF 24010KT FEW020"), "time: not reported"));
    CHECK(has_note(sky_of("EDDF 121845Z FEW020"), "wind: not reported"));
    CHECK(has_note(sky_of("EDDF 121845Z 9999 VCFG +FC FEW020"), "FC: left out"));
}

TEST_CASE("metar sky: seeds choose, settings are checked") {
    const char* const text = "EDDF 121845Z 24012KT 9999 FEW020 SCT040CB";
    MetarSkySettings one, two;
    two.seed = 1;
    CHECK(sky_of(text, one).layers[0].text == sky_of(text, one).layers[0].text);
    CHECK(sky_of(text, one).layers[0].text != sky_of(text, two).layers[0].text);
    two.seed = -5;
    scene_of(sky_of(text, two).layers[0]);
    const auto refused = [](const MetarSkySettings& settings) {
        MetarSky sky;
        sky.day = 99;
        const Status status = metar_sky(Metar{}, settings, sky);
        return !status && sky.day == 99 && status.message.find('\n') == std::string::npos;
    };
    const double nan = std::nan("");
    for (const double bad : {-501.0, 9001.0, nan}) {
        MetarSkySettings settings;
        settings.field_elevation_m = bad;
        CHECK(refused(settings));
    }
    for (const double bad : {0.5, 1001.0, nan}) {
        MetarSkySettings settings;
        settings.scale_radius_km = bad;
        CHECK(refused(settings));
    }
}
