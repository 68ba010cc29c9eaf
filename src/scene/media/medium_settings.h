// SPDX-License-Identifier: Apache-2.0
// What absorbs and scatters, and what hides: media and solids.
// in: keys of [[medium]] and [[solid]] -> out: plain values. docs/scene.md
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "src/base/vectors.h"
#include "src/scene/media/cloud_settings.h"
#include "src/scene/media/particle_settings.h"
#include "src/scene/media/sky_settings.h"
#include "src/scene/media/solid_settings.h"

namespace pileus {

// What a scene says of a file of weather data: which variables, when, and how they become a cloud.
// docs/weather.md

/// Texts that are empty are left out: then the variable is looked for; "none": it is not used.
/// One of several times or members of a file: by an index from 0, or else by what the file calls
/// it.
struct WeatherChoice {
    bool by_name = false;
    std::string name;
    std::int64_t index = 0;
    bool operator==(const WeatherChoice& other) const {
        return by_name == other.by_name && name == other.name && index == other.index;
    }
    bool operator!=(const WeatherChoice& other) const { return !(*this == other); }
};

/// Names of variables, and what a file does not say of them. Empty: left out, as above.
struct WeatherNames {
    std::string liquid, ice, cloud_fraction, temperature, pressure, humidity, height;
    std::string liquid_radius, ice_radius, surface_pressure, surface_geopotential;
    std::string variable;  ///< any field, shown by medium.transfer; empty: the water above
    std::string axes;      ///< "x: ni, y: nj": what dimensions are that the file cannot tell
    std::string units;  ///< "ql: kg kg-1, x: km": of variables whose own unit is wrong or missing
};

/// Sizes of all droplets and crystals.
struct WeatherSizes {
    double liquid_radius_um = 0;  ///< effective; 0: of the file, or else 10
    double ice_radius_um = 0;     ///< effective; 0: of the file, or else 30
    double ice_dge_um = 0;        ///< Fu's generalized effective size; 0: the radius counts
};

/// How places on the map become metres.
struct WeatherPlace {
    bool plain_degrees = false;                  ///< geometry = "plain"
    std::array<double, 2> origin_deg{1e9, 1e9};  ///< longitude, latitude; 1e9: the middle
    double width_m = 0;                          ///< of a slice or a column, across; 0: a default
    double vertical_scale = 1;
};

struct WeatherSettings {
    WeatherNames names;
    WeatherChoice time, member;
    bool in_cloud = false;  ///< fraction = "in_cloud": water is divided by the cloud fraction
    bool missing_is_fault = false;
    WeatherSizes sizes;
    WeatherPlace place;
};

// Detail beyond a medium's grid: a tile of noise, how strong, and where. docs/detail.md

enum class DetailNoise { kPerlin, kWorley };

struct DetailSettings {
    double tile_m = 0;  ///< after which the noise repeats; 0: no detail
    double strength = 0.6;
    double dense = 0.25;  ///< share of the strength that is left at the largest density
    DetailNoise noise = DetailNoise::kPerlin;
    int octaves = 0;  ///< 0: as many as the cells show
    std::int64_t seed = 0;
    double age = 0;  ///< lives of the lumps that have passed: a whole one later all are others
    int cells = 64;  ///< of the tile, along each edge: a power of two
    int refine = 0;  ///< 0: made while marching; else cells that each cell becomes along an axis

    bool present() const { return tile_m > 0 && strength > 0; }
    bool is_marched() const { return present() && refine == 0; }
};

/// Lumps of the first octave along a tile.
constexpr int kDetailLumps = 4;

/// A phase function by its name, and its numbers by the names of their keys (docs/scene.md):
/// phase.type = "henyey-greenstein", phase.numbers["g"] = 0.85. One left out has its row's default.
struct PhaseSettings {
    std::string type = "isotropic";         ///< a name of phase_row.h
    std::map<std::string, double> numbers;  ///< those that the type asks for, and no others
    std::string file;                       ///< table, moments; as MediumFile::file

    bool operator==(const PhaseSettings& o) const {
        return type == o.type && numbers == o.numbers && file == o.file;
    }
};

/// What a medium is at one value of the field that it shows; linear in between.
struct TransferRow {
    double value = 0;
    double extinction_per_m = 0;  ///< >= 0
    Float3 albedo{1, 1, 1};

    bool operator==(const TransferRow& o) const {
        return value == o.value && extinction_per_m == o.extinction_per_m && albedo == o.albedo;
    }
};

enum class RawType { kUint8, kUint16, kFloat32 };

/// A medium's file, and what must be known to read it.
struct MediumFile {
    std::string file;     ///< as written, relative to the scene file
    int first_frame = 0;  ///< of a sequence: the number of the file of frame 0
    std::string format;   ///< a name of volume_format.h; empty: by extension
    std::string grid;     ///< of a file with several; empty: the first of floats
    RawType raw_type = RawType::kFloat32;
    std::array<int, 3> raw_size{0, 0, 0};
    bool raw_big_endian = false;
    bool y_up = false;
};

/// The box of a medium and its cells.
struct MediumBox {
    bool has_bounds = false;
    std::array<Double3, 2> bounds_m{};
    std::array<int, 3> resolution{0, 0, 0};  ///< procedural and uniform shapes; 0: a default
    bool periodic = false;  ///< boundary = "periodic": repeats without end along x and y
    bool constant = false;  ///< interpolation = "constant": a cell has one value
};

/// What a medium of density 1 does to light.
struct MediumOptics {
    double extinction_per_m = 0;
    double extinction_scale = 1;  ///< for files that hold extinction; >= 0
    Float3 albedo{1, 1, 1};
    Float3 emission{0, 0, 0};  ///< radiance per metre; >= 0
    PhaseSettings phase;
    std::vector<TransferRow> transfer;  ///< by rising values; none: extinction as the file has it

    bool operator==(const MediumOptics& o) const {
        return extinction_per_m == o.extinction_per_m && extinction_scale == o.extinction_scale &&
               albedo == o.albedo && emission == o.emission && phase == o.phase &&
               transfer == o.transfer;
    }
};

struct MediumSettings {
    /// A name of density_row.h; empty: a file.
    std::string density = "procedural:cumulus";
    MediumFile source;
    WeatherSettings weather;     ///< of a NetCDF file
    ParticleSettings particles;  ///< of a medium made of particles
    MediumBox box;
    std::int64_t shape_seed = 0;  ///< another cumulus for each; key `shape_seed`
    SkySettings sky;              ///< of a procedural sky
    CloudSettings cloud;          ///< of a procedural cloud
    MediumOptics optics;
    DetailSettings detail;

    // Long, and lists of media have each of them in several places: in medium_settings.cpp once.
    MediumSettings();
    MediumSettings(const MediumSettings&);
    MediumSettings& operator=(const MediumSettings&);
    ~MediumSettings();
};

}  // namespace pileus
