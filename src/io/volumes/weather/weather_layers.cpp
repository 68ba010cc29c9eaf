// SPDX-License-Identifier: Apache-2.0
// From fields to layers of cloud.
// in: a block of rows -> out: see weather_grid.h.
// docs/weather.md, "From water to extinction"; Fu 1996 for D_ge.
#include <limits>

#include "src/base/number_text.h"
#include "src/io/volumes/weather/weather_air.h"
#include "src/io/volumes/weather/weather_grid.h"
#include "src/io/volumes/weather/weather_levels.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr std::uint64_t kBlockValues = std::uint64_t{1} << 19;
constexpr double kUndershoot = -1e-6;     // kg/kg; below it water is a fault
constexpr double kMaxWater = 0.5;         // kg/kg or kg/m3
constexpr double kMaxShownValue = 1e30;   // as the values of a transfer function
constexpr double kMinFraction = 0.1;      // clouds in less are as dense as in this
constexpr double kNoFraction = 0.01;      // below it the fraction knows nothing of the water
constexpr double kMinExtinction = 1e-12;  // 1/m; models write traces such as 1e-24 kg/kg everywhere
constexpr double kLiquidRadius = 10e-6, kIceRadius = 30e-6;

bool missing(double value) { return value != value; }

/// A block while it is made into layers.
class Block {
public:
    Block(const FieldBlock& fields, CloudLayers& layers, WeatherCounts& counts)
        : fields_(fields),
          s_(*fields.source),
          n_(s_.levels()),
          air_(fields, counts),
          layers_(layers),
          counts_(counts) {}

    Status run() {
        const std::size_t columns = fields_.columns();
        PILEUS_TRY(make_room(columns * (n_ + 1), "faces of layers", layers_.faces_m));
        PILEUS_TRY(make_room(columns * n_, "extinction of layers", layers_.extinction));
        for (auto* water : {&layers_.liquid, &layers_.ice})
            PILEUS_TRY(make_room(columns * n_, "water of layers", *water));
        PILEUS_TRY(air_.check());
        for (std::size_t c = 0; c < columns; ++c) {
            if (is_blank(c)) {
                PILEUS_TRY(blank_column(c));
                continue;
            }
            PILEUS_TRY(air_.place_column(c, layers_.faces_m.span().part(c * (n_ + 1), n_ + 1)));
            PILEUS_TRY(cloud_column(c));
        }
        return Status::ok();
    }

private:
    const Buffer<double>& of(Role role) const { return fields_.of(role); }
    Status fault(Role role, std::size_t c, const std::string& line) const {
        return fields_.fault(role, c, line);
    }

    /// A column outside a turned or cut domain: nothing that is shown has a value, or there is no
    /// water and the air has none.
    bool is_blank(std::size_t c) const {
        bool any = false, wet = false;
        for (const Role role : {Role::kShown, Role::kLiquid, Role::kIce})
            for (std::size_t k = 0; k < n_ && s_.has(role); ++k) {
                const double value = of(role).at(c * n_ + k);
                any = any || !missing(value);
                wet = wet || (!missing(value) && (role == Role::kShown || value != 0));
            }
        return !any || (!wet && air_.lacks_values(c));
    }

    Status blank_column(std::size_t c) {
        ++counts_.blank;
        for (std::size_t k = 0; k <= n_; ++k)
            layers_.faces_m[c * (n_ + 1) + k] = std::numeric_limits<double>::quiet_NaN();
        if (s_.has(Role::kShown)) return shown_column(c);
        double none = 0;
        for (std::size_t k = 0; k < n_; ++k) {
            for (const Role role : {Role::kLiquid, Role::kIce})
                if (s_.has(role)) PILEUS_TRY(content(role, c, k, none));
            const std::size_t i = c * n_ + k;
            layers_.extinction[i] = layers_.liquid[i] = layers_.ice[i] = 0;
        }
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
        if (value > kMaxWater)
            return fault(role, c,
                         "level " + level_text(k) + ": out of range, " + number_text(value) +
                             (ratio ? " kg/kg" : " kg/m3") +
                             ", allowed: up to 0.5; is its unit right?");
        if (ratio) value *= air_.density[k];
        // Per kg of dry air: its density is lower by the vapour's share.
        if (ratio && field.meaning == Meaning::kPerDryAir) value *= 1 - air_.humidity[k];
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

    /// The values of a variable as they are.
    Status shown_column(std::size_t c) {
        for (std::size_t k = 0; k < n_; ++k) {
            const double value = of(Role::kShown).at(c * n_ + k);
            ++counts_.values;
            if (missing(value)) {
                ++counts_.missing;
                if (s_.settings->missing_is_fault)
                    return fault(Role::kShown, c,
                                 "level " + level_text(k) +
                                     ": missing value, allowed: none (missing = \"fault\")");
            } else if (!(value >= -kMaxShownValue && value <= kMaxShownValue)) {
                return fault(Role::kShown, c,
                             "level " + level_text(k) + ": out of range, " + number_text(value) +
                                 ", allowed: -1e30 to 1e30");
            }
            layers_.extinction[c * n_ + k] = value;
        }
        return Status::ok();
    }

    Status cloud_column(std::size_t c) {
        if (s_.has(Role::kShown)) return shown_column(c);
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
                // A fraction too small for the water in it is not of that water: it counts as the
                // mean, or is ten times as dense at most.
                const double share = f < kNoFraction    ? 1
                                     : f < kMinFraction ? kMinFraction
                                     : f > 1            ? 1
                                                        : f;
                if (f < kMinFraction) ++counts_.capped;
                liquid /= share;
                ice /= share;
            }
            if (liquid > 0) {
                PILEUS_TRY(radius(Role::kLiquidRadius, w.sizes.liquid_radius_um, kLiquidRadius, c,
                                  k, size));
                extinction += radius_extinction(liquid, kWaterDensity, size);
            }
            if (ice > 0 && w.sizes.ice_dge_um > 0) {
                extinction += dge_extinction(ice, w.sizes.ice_dge_um * 1e-6);
            } else if (ice > 0) {
                PILEUS_TRY(radius(Role::kIceRadius, w.sizes.ice_radius_um, kIceRadius, c, k, size));
                extinction += radius_extinction(ice, kIceDensity, size);
            }
            if (extinction < kMinExtinction) liquid = ice = extinction = 0;
            layers_.liquid[c * n_ + k] = liquid;
            layers_.ice[c * n_ + k] = ice;
            layers_.extinction[c * n_ + k] = extinction;
        }
        return Status::ok();
    }

    const FieldBlock& fields_;
    const WeatherSource& s_;
    std::size_t n_;
    WeatherAirColumn air_;
    CloudLayers& layers_;
    WeatherCounts& counts_;
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
    FieldBlock fields;
    PILEUS_TRY(fields.read(source, first_row, rows, layers.room));
    return Block(fields, layers, counts).run();
}

}  // namespace pileus
