// SPDX-License-Identifier: Apache-2.0
// GRIB by ecCodes: a file made by its own tools is the same cloud as NetCDF; faults in a line.
// in: messages made by grib_set -> out: pass or fail; left out, with a line, where there is no
// ecCodes. docs/weather.md, "Files"; docs/testing.md, label weather
#include <cmath>
#include <cstdlib>

#include "src/io/netcdf/netcdf_file.h"
#include "src/io/volumes/volume_file.h"
#include "tests/io/temp_folder.h"
#include "tests/weather/weather_case.h"

using namespace pileus;

namespace {

bool has_eccodes() {
    if (grib_library_text() == "GRIB no") {
        MESSAGE("left out: GRIB is not part of this build");
        return false;
    }
    if (std::system("command -v grib_set >/dev/null && command -v codes_info >/dev/null") == 0)
        return true;
    MESSAGE("left out: no grib_set of ecCodes here");
    return false;
}

struct GribMaker {
    const pileus::test::TempFolder folder;

    /// Appends a message of one value everywhere, of ecCodes' sample of 16 x 31 columns 2 degrees
    /// apart, 60 N to the equator and 0 to 30 E. `levels`: "hybrid" gives pv of three levels.
    void add(const std::string& keys, const std::string& value, const char* to = "w.grib") {
        const std::string one = folder.path("one.grib"), out = folder.path(to);
        folder.put("rules", hybrid
                                ? "set typeOfLevel=\"hybrid\"; set level=1; set PVPresent=1; set "
                                  "pv={0,5000,10000,0,0,0.2,0.5,1}; write;"
                                : "write;");
        const std::string base = folder.path("base.grib");
        const std::string line =
            "s=$(codes_info -s)/regular_ll_pl_grib2.tmpl && grib_filter -o '" + base + "' '" +
            folder.path("rules") + "' \"$s\" >/dev/null 2>&1 && grib_set -s " + keys +
            ",dataDate=20260621,bitsPerValue=24 -d " + value + " '" + base + "' '" + one +
            "' >/dev/null 2>&1 && cat '" + one + "' >> '" + out + "'";
        REQUIRE_MESSAGE(std::system(line.c_str()) == 0, line);
    }
    bool hybrid = false;

    std::string path() const { return folder.path("w.grib"); }
};

Status load(const std::string& path, const MediumSettings& medium, WeatherSurvey& survey,
            Volume& volume) {
    NcFile file;
    PILEUS_TRY(file.open(path));
    CHECK(file.head().kind == "GRIB");
    WeatherSource source;
    PILEUS_TRY(open_weather(file, medium.weather, source));
    PILEUS_TRY(survey_weather(source, survey));
    VolumeHead head;
    PILEUS_TRY(read_volume_head(medium, path, head));
    PILEUS_TRY(read_volume(medium, path, volume));
    CHECK(head.size == volume.size);
    return Status::ok();
}

}  // namespace

TEST_CASE("grib: pressure levels: water path is q dp/g; times and places") {
    if (!has_eccodes()) return;
    GribMaker grib;
    for (const char* hour : {"600", "1200"})
        for (const char* level : {"700", "800", "900"}) {
            const std::string where = std::string(",level=") + level + ",dataTime=" + hour;
            grib.add("shortName=t" + where, "280");
            grib.add("shortName=q" + where, "0.004");
            grib.add("shortName=clwc" + where, hour[0] == '6' ? "0.0002" : "0.0004");
        }
    MediumSettings medium;
    medium.source.format = "grib";
    medium.weather.time = {true, "2026-06-21T12", 0};
    WeatherSurvey survey;
    Volume volume;
    const Status status = load(grib.path(), medium, survey, volume);
    REQUIRE_MESSAGE(status, status.message);
    CHECK(volume.size[0] == 16);
    CHECK(volume.size[1] == 31);
    // Faces at geometric means, the outer ones mirrored: 654.65 to 954.59 hPa.
    const double low = 900.0 * 900 / std::sqrt(900.0 * 800),
                 high = 700.0 * 700 / std::sqrt(700.0 * 800);
    const double path = 4e-4 * (low - high) * 100 / 9.80665;
    // A message keeps its value to 2^-24 of its range, and a float to 6e-8.
    CHECK(survey.liquid_kg / survey.area_m2 == doctest::Approx(path).epsilon(1e-6));
    CHECK(volume.bounds_m[1][1] - volume.bounds_m[0][1] == doctest::Approx(62 * 40030173.0 / 360));
}

TEST_CASE("grib: hybrid levels by pv and the logarithm of the pressure at the ground") {
    if (!has_eccodes()) return;
    GribMaker grib;
    grib.hybrid = true;
    const std::string level = ",level=";
    for (const char* number : {"1", "2", "3"}) {
        grib.add("shortName=t" + level + number, "270");
        grib.add("shortName=q" + level + number, "0");
        grib.add("shortName=ciwc" + level + number, "0.00001");
    }
    grib.add("shortName=lnsp" + level + "1", "11.5");
    grib.add("shortName=z" + level + "1", "980.665");
    MediumSettings medium;
    medium.source.format = "grib";
    WeatherSurvey survey;
    Volume volume;
    const Status status = load(grib.path(), medium, survey, volume);
    REQUIRE_MESSAGE(status, status.message);
    NcFile file;
    REQUIRE(file.open(grib.path()));
    std::vector<double> a(4), b(4);
    for (auto* v : {&a, &b}) {
        const NcVariable* of = file.head().find(v == &a ? "hyai" : "hybi");
        REQUIRE((of != nullptr));
        REQUIRE(file.read(*of, whole_block(file.head(), *of), {v->data(), v->size()}));
    }
    const double ground = std::exp(11.5);
    const double thick = a[3] + b[3] * ground - a[0] - b[0] * ground;
    REQUIRE(thick > 0);
    // ln p as a float is good to 5e-7.
    CHECK(survey.ice_kg / survey.area_m2 == doctest::Approx(1e-5 * thick / 9.80665).epsilon(3e-6));
    CHECK(volume.bounds_m[0][2] == doctest::Approx(100).epsilon(1e-6));
}

TEST_CASE("grib: faults are one line each") {
    if (!has_eccodes()) return;
    const auto fault = [](const std::string& path) {
        NcFile file;
        const Status status = file.open(path);
        CHECK(status.message.find('\n') == std::string::npos);
        return status.message;
    };
    const auto has = [&](const std::string& path, const char* line) {
        const std::string text = fault(path);
        CHECK_MESSAGE(text.find(line) != std::string::npos, text);
    };
    GribMaker grib;
    const std::string t = "shortName=t,level=";
    grib.add(t + "700", "280");
    grib.add(t + "800", "280");
    grib.add("shortName=q,level=800", "0.001");
    has(grib.path(), "w.grib: GRIB: q: fields: 1, allowed: 2, one for each time, member and level");
    grib.add("shortName=q,level=800", "0.002");
    has(grib.path(), "w.grib: GRIB: q: a field is given twice");
    grib.add(t + "900,latitudeOfLastGridPointInDegrees=2", "280");
    has(grib.path(), "GRIB: message 4: grid: another than before, allowed: one");
    const std::string bytes = grib.folder.get("w.grib");
    grib.folder.put("cut.grib", bytes.substr(0, bytes.size() / 8));
    has(grib.folder.path("cut.grib"), "GRIB: message 0: damaged or cut short");
    grib.folder.put("head.grib", "GRIB");
    has(grib.folder.path("head.grib"), "head.grib: GRIB: ");
    grib.add("shortName=2t", "280", "ground.grib");
    has(grib.folder.path("ground.grib"), "GRIB: no field on levels");
}
