// SPDX-License-Identifier: Apache-2.0
// From fields to layers of cloud.
// in: a block of rows -> out: see weather_layers.h.
// docs/weather.md, "From water to extinction"; Fu 1996 for D_ge.
#include "src/io/volumes/weather/weather_layers.h"

#include <algorithm>

#include "src/io/volumes/weather/weather_levels.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr std::uint64_t kBlockValues = std::uint64_t{1} << 19;
constexpr double kUndershoot = -1e-6;    // kg/kg; below it water is a fault
constexpr double kLeastFraction = 0.01;  // clouds in less are as dense as in this
constexpr double kLeastExtinction =
    1e-12;  // 1/m; models write traces such as 1e-24 kg/kg everywhere
constexpr double kLiquidRadius = 10e-6, kIceRadius = 30e-6;

bool missing(double value) { return value != value; }

/// A block while it is made into layers.
class Block {
public:
    Block(const WeatherSource& source, std::uint64_t first_row, std::uint64_t rows,
          CloudLayers& layers, WeatherCounts& counts)
        : s_(source),
          first_row_(first_row),
          rows_(rows),
          n_(source.levels()),
          columns_(std::size_t(rows) * source.row_columns()),
          layers_(layers),
          counts_(counts) {}

    Status run() {
        for (std::size_t r = 0; r < std::size_t(Role::kCount); ++r)
            if (s_.fields.of[r].there())
                PILEUS_TRY(read_field(s_, Role(r), first_row_, rows_, values_[r]));
        PILEUS_TRY(layers_.faces_m.resize(columns_ * (n_ + 1), "faces of layers"));
        PILEUS_TRY(layers_.extinction.resize(columns_ * n_, "extinction of layers"));
        for (auto* water : {&layers_.liquid, &layers_.ice})
            PILEUS_TRY(water->resize(columns_ * n_, "water of layers"));
        density_.assign(n_, 0.0);
        kelvin_.assign(n_, 0.0);
        virtual_.assign(n_, 0.0);
        humidity_.assign(n_, 0.0);
        pressure_.assign(n_, 0.0);
        faces_pa_.assign(n_ + 1, 0.0);
        const bool air = needs_air();
        if (air) PILEUS_TRY(require_air());
        for (std::size_t c = 0; c < columns_; ++c) {
            PILEUS_TRY(place_column(c, air));
            PILEUS_TRY(cloud_column(c));
        }
        return Status::ok();
    }

private:
    const Buffer<double>& of(Role role) const { return values_[std::size_t(role)]; }
    bool by_pressure() const {
        return s_.vertical == Vertical::kPressureFaces || s_.vertical == Vertical::kPressureLevels;
    }

    std::string place(std::size_t c) const {
        return column_name(s_, first_row_ + c / s_.row_columns(), c % s_.row_columns());
    }
    Status fault(Role role, std::size_t c, const std::string& line) const {
        const WeatherField& field = s_.fields[role];
        const std::string name = field.there() ? field.name() : std::string(role_key(role));
        return Status::bad_input(s_.file->name() + ": variable " + printable_line(name) + ": " +
                                 place(c) + ": " + printable_line(line));
    }

    bool needs_air() const {
        bool ratio = false;
        for (const Role role : {Role::kLiquid, Role::kIce})
            ratio = ratio || (s_.has(role) && s_.fields[role].quantity == Quantity::kRatio);
        return ratio || by_pressure();
    }

    Status require_air() const {
        const char* lacks = !s_.has(Role::kTemperature) ? "temperature" : nullptr;
        if (!s_.has(Role::kPressure) && s_.hybrid_b.empty()) lacks = "pressure";
        if (lacks == nullptr) return Status::ok();
        return Status::bad_input(
            s_.file->name() + ": " + lacks +
            ": no such variable, nothing, allowed: one with a standard_name or "
            "name of docs/weather.md, or the key " +
            lacks + " of the density; it is needed for the air's density");
    }

    /// Mean of two faces where a field stands on faces; missing ones from the nearest level above,
    /// then below.
    Status on_levels(Role role, std::size_t c, std::vector<double>& to) {
        const Buffer<double>& from = of(role);
        const bool faces = s_.fields[role].on_faces;
        std::size_t known = n_;
        for (std::size_t k = n_; k-- > 0;) {
            to[k] = faces ? 0.5 * (from.at(c * (n_ + 1) + k) + from.at(c * (n_ + 1) + k + 1))
                          : from.at(c * n_ + k);
            if (missing(to[k]) && known < n_) {
                to[k] = to[known];
                ++counts_.filled;
            }
            if (!missing(to[k])) known = k;
        }
        if (known == n_) return fault(role, c, "all values missing, allowed: some");
        for (std::size_t k = n_; k-- > 0;)
            if (missing(to[k])) {
                to[k] = to[k + 1 < n_ && !missing(to[k + 1]) ? k + 1 : lowest_known(to, k)];
                ++counts_.filled;
            }
        return Status::ok();
    }
    std::size_t lowest_known(const std::vector<double>& values, std::size_t from) const {
        while (missing(values[from])) --from;
        return from;
    }

    Status monotonic(Role role, std::size_t c, Span<const double> values, bool ascends) const {
        const std::size_t n = values.size;
        for (std::size_t k = 0; k < n; ++k) {
            if (missing(values[k])) return fault(role, c, "missing value on a level");
            if (k == 0) continue;
            if (ascends ? values[k] > values[k - 1] : values[k] < values[k - 1]) continue;
            const bool turned = ascends ? values[0] > values[n - 1] : values[0] < values[n - 1];
            return fault(role, c,
                         std::string(turned ? "levels upside down" : "levels not monotonic") +
                             ", " + number_text(values[k - 1]) + " then " + number_text(values[k]) +
                             " upwards, allowed: " + (ascends ? "rising" : "falling") +
                             " in every column as in the first");
        }
        return Status::ok();
    }

    /// Pressures of faces, from below.
    Status pressure_faces(std::size_t c) {
        const Span<double> faces{faces_pa_.data(), faces_pa_.size()};
        const double ground =
            s_.has(Role::kSurfacePressure) ? of(Role::kSurfacePressure).at(c) : -1;
        if (missing(ground)) return fault(Role::kSurfacePressure, c, "missing value");
        if (s_.hybrid_b.empty()) {
            const Buffer<double>& p = of(Role::kPressure);
            const std::size_t m = s_.vertical == Vertical::kPressureFaces ? n_ + 1 : n_;
            const Span<const double> values = p.span().part(c * m, m);
            PILEUS_TRY(monotonic(Role::kPressure, c, values, false));
            if (m > n_)
                std::copy(values.begin(), values.end(), faces_pa_.begin());
            else
                faces_in_logarithm(values, faces);
        } else {
            const std::size_t m = s_.hybrid_b.size();
            std::vector<double> values(m);
            for (std::size_t k = 0; k < m; ++k) {
                const std::size_t i = s_.top_down ? m - 1 - k : k;
                values[k] = s_.hybrid_a[i] + s_.hybrid_b[i] * ground;
            }
            PILEUS_TRY(monotonic(Role::kSurfacePressure, c, {values.data(), m}, false));
            if (m > n_)
                faces_pa_ = values;
            else
                faces_in_logarithm({values.data(), m}, faces);
        }
        for (std::size_t k = 0; k <= n_; ++k) {
            const bool last = k == n_;
            if (!(faces_pa_[k] > 0 || (last && faces_pa_[k] == 0)) || faces_pa_[k] > 1e7)
                return fault(
                    Role::kPressure, c,
                    "out of range, " + number_text(faces_pa_[k]) + " Pa, allowed: above 0 to 1e7");
            // Of levels in the ground nothing is left; the lowest model level reaches down to it.
            const bool lowest = k == 0 && !s_.hybrid_b.empty();
            if (s_.vertical == Vertical::kPressureLevels && ground > faces_pa_[n_] &&
                (faces_pa_[k] > ground || lowest))
                faces_pa_[k] = ground;
        }
        ground_pa_ = ground;
        return Status::ok();
    }

    Status air_column(std::size_t c) {
        PILEUS_TRY(on_levels(Role::kTemperature, c, kelvin_));
        if (s_.has(Role::kHumidity)) PILEUS_TRY(on_levels(Role::kHumidity, c, humidity_));
        if (by_pressure()) {
            PILEUS_TRY(pressure_faces(c));
            for (std::size_t k = 0; k < n_; ++k)
                pressure_[k] = layer_pressure(faces_pa_[k], faces_pa_[k + 1]);
        } else if (s_.has(Role::kPressure)) {
            PILEUS_TRY(on_levels(Role::kPressure, c, pressure_));
        }
        const WeatherField& q = s_.fields[Role::kHumidity];
        const bool potential = s_.fields[Role::kTemperature].meaning == Meaning::kPotential;
        for (std::size_t k = 0; k < n_; ++k) {
            if (!(pressure_[k] > 0 && pressure_[k] < 1e7))
                return fault(
                    Role::kPressure, c,
                    "out of range, " + number_text(pressure_[k]) + " Pa, allowed: above 0 to 1e7");
            if (potential) kelvin_[k] = temperature_of(kelvin_[k], pressure_[k]);
            if (!(kelvin_[k] >= 100 && kelvin_[k] <= 400))
                return fault(Role::kTemperature, c,
                             "out of range, " + number_text(kelvin_[k]) +
                                 " K, allowed: 100 to 400; is its unit right?");
            if (!(humidity_[k] >= -1e-3 && humidity_[k] <= 0.2))
                return fault(Role::kHumidity, c,
                             "out of range, " + number_text(humidity_[k]) +
                                 " kg/kg, allowed: 0 to 0.2; is its unit right?");
            if (humidity_[k] < 0) humidity_[k] = 0;
            if (q.meaning == Meaning::kPerDryAir) humidity_[k] /= 1 + humidity_[k];
            virtual_[k] = virtual_temperature(kelvin_[k], humidity_[k]);
            density_[k] = pressure_[k] / (kDryAir * virtual_[k]);
        }
        return Status::ok();
    }

    /// Density of air and heights of faces.
    Status place_column(std::size_t c, bool air) {
        if (air) PILEUS_TRY(air_column(c));
        const Span<double> faces = layers_.faces_m.span().part(c * (n_ + 1), n_ + 1);
        if (by_pressure()) {
            double lowest = 0;
            if (s_.has(Role::kSurfaceHeight))
                lowest = of(Role::kSurfaceHeight).at(c);
            else if (s_.vertical == Vertical::kPressureLevels && !s_.has(Role::kSurfacePressure))
                lowest = standard_height(faces_pa_[0]);
            if (missing(lowest)) return fault(Role::kSurfaceHeight, c, "missing value");
            // Pressure levels may begin above the ground.
            if (s_.vertical == Vertical::kPressureLevels && ground_pa_ > faces_pa_[0])
                lowest +=
                    kDryAir * virtual_[0] / kGravity * layer_logarithm(ground_pa_, faces_pa_[0]);
            integrate_heights({faces_pa_.data(), n_ + 1}, {virtual_.data(), n_}, lowest, faces);
        } else {
            const std::size_t m = s_.vertical == Vertical::kHeightFaces ? n_ + 1 : n_;
            const Span<const double> z = values_[std::size_t(Role::kHeight)].span().part(c * m, m);
            PILEUS_TRY(monotonic(Role::kHeight, c, z, true));
            if (n_ == 1 && m == 1)
                return fault(Role::kHeight, c, "one level alone, so that its thickness is unknown");
            if (m > n_)
                for (std::size_t k = 0; k <= n_; ++k) faces[k] = z[k];
            else
                faces_midway(z, faces);
        }
        for (const double z : faces)
            if (!(z > -1e5 && z < 1e6))
                return fault(by_pressure() ? Role::kPressure : Role::kHeight, c,
                             "height out of range, " + number_text(z) + " m, allowed: -1e5 to 1e6");
        return Status::ok();
    }

    /// Content of one kind of water in kg/m3 of cloud; 0 for what is missing or an undershoot.
    Status content(Role role, std::size_t c, std::size_t k, double& value) {
        const WeatherField& field = s_.fields[role];
        value = of(role).at(c * n_ + k);
        ++counts_.values;
        if (missing(value)) {
            ++counts_.missing;
            value = 0;
            if (s_.settings->missing_is_fault)
                return fault(role, c,
                             "level " + level_text(k) +
                                 ": missing value, allowed: none (missing = \"fault\")");
            return Status::ok();
        }
        const bool ratio = field.quantity == Quantity::kRatio;
        if (value < 0) {
            ++counts_.clamped;
            if (value < (ratio ? kUndershoot : kUndershoot * 1.3))
                return fault(role, c,
                             "level " + level_text(k) + ": negative water, " + number_text(value) +
                                 (ratio ? " kg/kg" : " kg/m3") +
                                 ", allowed: at least -1e-6 kg/kg, which counts as 0");
            value = 0;
        }
        if (value > (ratio ? 0.5 : 0.5))
            return fault(role, c,
                         "level " + level_text(k) + ": out of range, " + number_text(value) +
                             (ratio ? " kg/kg" : " kg/m3") +
                             ", allowed: up to 0.5; is its unit right?");
        if (ratio) value *= density_[k];
        // Per kg of dry air: its density is lower by the vapour's share.
        if (ratio && field.meaning == Meaning::kPerDryAir) value *= 1 - humidity_[k];
        return Status::ok();
    }
    std::string level_text(std::size_t k) const {
        return std::to_string(s_.top_down ? n_ - 1 - k : k);
    }

    /// The scene's radius, the file's, or a usual one.
    Status radius(Role role, double of_scene_um, double usual, std::size_t c, std::size_t k,
                  double& value) const {
        value = usual;
        if (of_scene_um > 0) {
            value = of_scene_um * 1e-6;
        } else if (s_.has(role)) {
            value = of(role).at(c * n_ + k);
            if (missing(value) || !(value > 1e-7 && value < 1e-2))
                return fault(
                    role, c,
                    "level " + level_text(k) + ": no radius for its cloud, " +
                        (missing(value) ? std::string("missing") : number_text(value) + " m") +
                        ", allowed: 1e-7 to 0.01 m, or a radius of the scene");
        }
        return Status::ok();
    }

    Status cloud_column(std::size_t c) {
        const WeatherSettings& w = *s_.settings;
        for (std::size_t k = 0; k < n_; ++k) {
            double liquid = 0, ice = 0, extinction = 0, size = 0;
            if (s_.has(Role::kLiquid)) PILEUS_TRY(content(Role::kLiquid, c, k, liquid));
            if (s_.has(Role::kIce)) PILEUS_TRY(content(Role::kIce, c, k, ice));
            if (w.in_cloud && liquid + ice > 0 && s_.has(Role::kFraction)) {
                const double f = of(Role::kFraction).at(c * n_ + k);
                if (missing(f) || !(f >= -1e-3 && f <= 1.001))
                    return fault(
                        Role::kFraction, c,
                        "level " + level_text(k) + ": " + number_text(f) + ", allowed: 0 to 1");
                const double share = f < kLeastFraction ? kLeastFraction : f > 1 ? 1 : f;
                liquid /= share;
                ice /= share;
            }
            if (liquid > 0) {
                PILEUS_TRY(
                    radius(Role::kLiquidRadius, w.liquid_radius_um, kLiquidRadius, c, k, size));
                extinction += radius_extinction(liquid, kWaterDensity, size);
            }
            if (ice > 0 && w.ice_dge_um > 0) {
                extinction += dge_extinction(ice, w.ice_dge_um * 1e-6);
            } else if (ice > 0) {
                PILEUS_TRY(radius(Role::kIceRadius, w.ice_radius_um, kIceRadius, c, k, size));
                extinction += radius_extinction(ice, kIceDensity, size);
            }
            if (extinction < kLeastExtinction) liquid = ice = extinction = 0;
            layers_.liquid[c * n_ + k] = liquid;
            layers_.ice[c * n_ + k] = ice;
            layers_.extinction[c * n_ + k] = extinction;
        }
        return Status::ok();
    }

    const WeatherSource& s_;
    std::uint64_t first_row_, rows_;
    std::size_t n_, columns_;
    CloudLayers& layers_;
    WeatherCounts& counts_;
    Buffer<double> values_[std::size_t(Role::kCount)];
    double ground_pa_ = -1;  ///< of the column; below 0: not known
    std::vector<double> density_, kelvin_, virtual_, humidity_, pressure_, faces_pa_;
};

}  // namespace

std::uint64_t block_rows(const WeatherSource& s) {
    const std::uint64_t row = s.axes.nx * (s.axes.levels + 1);
    const std::uint64_t rows = kBlockValues / row;
    return rows < 1 ? 1 : rows < s.axes.ny ? rows : s.axes.ny;
}

std::uint64_t block_bytes(const WeatherSource& s) {
    std::uint64_t fields = 5;  // what is made, and one as it stands in the file
    for (const WeatherField& field : s.fields.of) fields += field.there() ? 1 : 0;
    return fields * sizeof(double) * block_rows(s) * s.axes.nx * (s.axes.levels + 1);
}

Status read_layers(const WeatherSource& source, std::uint64_t first_row, std::uint64_t rows,
                   CloudLayers& layers, WeatherCounts& counts) {
    return Block(source, first_row, rows, layers, counts).run();
}

}  // namespace pileus
