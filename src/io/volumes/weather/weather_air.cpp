// SPDX-License-Identifier: Apache-2.0
// The air of columns: pressures, temperatures, density, heights.
// in: fields of a block -> out: see weather_air.h.
// docs/weather.md, "Heights"
#include "src/io/volumes/weather/weather_air.h"

#include <algorithm>

#include "src/base/number_text.h"
#include "src/io/volumes/weather/weather_levels.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

bool missing(double value) { return value != value; }

std::size_t lowest_known(const std::vector<double>& values, std::size_t from) {
    while (missing(values[from])) --from;
    return from;
}

/// Whether the air's density is asked for, or its pressure tells the heights.
bool needs_air(const WeatherSource& s, bool by_pressure) {
    bool ratio = false;
    for (const Role role : {Role::kLiquid, Role::kIce})
        ratio = ratio || (s.has(role) && s.fields[role].quantity == Quantity::kRatio);
    return ratio || by_pressure;
}

}  // namespace

Status FieldBlock::read(const WeatherSource& from, std::uint64_t row, std::uint64_t count,
                        FieldRoom& to) {
    source = &from;
    room = &to;
    first_row = row;
    rows = count;
    for (std::size_t r = 0; r < std::size_t(Role::kCount); ++r)
        if (from.fields.of[r].there())
            PILEUS_TRY(read_field(from, Role(r), row, count, to.raw, to.values[r]));
    return Status::ok();
}

Status FieldBlock::fault(Role role, std::size_t column, const std::string& line) const {
    const WeatherField& field = source->fields[role];
    const std::string name = field.there() ? field.name() : std::string(role_key(role));
    const std::size_t nx = source->row_columns();
    return Status::bad_input(source->file->name() + ": variable " + printable_line(name) + ": " +
                             column_name(*source, first_row + column / nx, column % nx) + ": " +
                             printable_line(line));
}

WeatherAirColumn::WeatherAirColumn(const FieldBlock& block, WeatherCounts& counts)
    : density(block.source->levels(), 0.0),
      humidity(density),
      block_(block),
      s_(*block.source),
      counts_(counts),
      n_(block.source->levels()),
      needs_air_(needs_air(s_, by_pressure())),
      kelvin_(n_, 0.0),
      virtual_(n_, 0.0),
      pressure_(n_, 0.0),
      faces_pa_(n_ + 1, 0.0),
      logarithms_(n_, 0.0) {}

bool WeatherAirColumn::by_pressure() const {
    return s_.vertical == Vertical::kPressureFaces || s_.vertical == Vertical::kPressureLevels;
}

Status WeatherAirColumn::check() const {
    if (!needs_air_) return Status::ok();
    const char* lacks = !s_.has(Role::kTemperature) ? "temperature" : nullptr;
    const bool hybrid = !s_.hybrid_b.empty() && !s_.hybrid_heights;
    if (!s_.has(Role::kPressure) && !hybrid) lacks = "pressure";
    if (lacks == nullptr) return Status::ok();
    return Status::bad_input(s_.file->name() + ": " + lacks +
                             ": no such variable, nothing, allowed: one with a standard_name or "
                             "name of docs/weather.md, or the key " +
                             lacks + " of the density; it is needed for the air's density");
}

/// Mean of two faces where a field stands on faces; missing ones from the nearest level above,
/// then below.
Status WeatherAirColumn::on_levels(Role role, std::size_t c, std::vector<double>& to) {
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
            to[k] = to[lowest_known(to, k)];
            ++counts_.filled;
        }
    return Status::ok();
}

Status WeatherAirColumn::monotonic(Role role, std::size_t c, Span<const double> values,
                                   bool ascends) const {
    const std::size_t n = values.size;
    for (std::size_t k = 0; k < n; ++k) {
        if (missing(values[k])) return fault(role, c, "missing value on a level");
        if (k == 0) continue;
        if (ascends ? values[k] > values[k - 1] : values[k] < values[k - 1]) continue;
        const bool turned = ascends ? values[0] > values[n - 1] : values[0] < values[n - 1];
        return fault(role, c,
                     std::string(turned ? "levels upside down" : "levels not monotonic") + ", " +
                         number_text(values[k - 1]) + " then " + number_text(values[k]) +
                         " upwards, allowed: " + (ascends ? "rising" : "falling") +
                         " in every column as in the first");
    }
    return Status::ok();
}

/// Pressures of faces, from below.
Status WeatherAirColumn::pressure_faces(std::size_t c) {
    const Span<double> faces{faces_pa_.data(), faces_pa_.size()};
    const double ground = s_.has(Role::kSurfacePressure) ? of(Role::kSurfacePressure).at(c) : -1;
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

Status WeatherAirColumn::air_column(std::size_t c) {
    PILEUS_TRY(on_levels(Role::kTemperature, c, kelvin_));
    if (s_.has(Role::kHumidity)) PILEUS_TRY(on_levels(Role::kHumidity, c, humidity));
    if (by_pressure()) {
        PILEUS_TRY(pressure_faces(c));
        for (std::size_t k = 0; k < n_; ++k) {
            logarithms_[k] = layer_logarithm(faces_pa_[k], faces_pa_[k + 1]);
            pressure_[k] = layer_pressure(faces_pa_[k], faces_pa_[k + 1], logarithms_[k]);
        }
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
        if (!(humidity[k] >= -1e-3 && humidity[k] <= 0.2))
            return fault(Role::kHumidity, c,
                         "out of range, " + number_text(humidity[k]) +
                             " kg/kg, allowed: 0 to 0.2; is its unit right?");
        if (humidity[k] < 0) humidity[k] = 0;
        if (q.meaning == Meaning::kPerDryAir) humidity[k] /= 1 + humidity[k];
        virtual_[k] = virtual_temperature(kelvin_[k], humidity[k]);
        density[k] = pressure_[k] / (kDryAir * virtual_[k]);
    }
    return Status::ok();
}

/// Heights of levels or faces over the file's datum, from below.
Status WeatherAirColumn::heights(std::size_t c, std::vector<double>& to) const {
    const std::size_t m = to.size();
    const bool above = s_.hybrid_heights || s_.fields[Role::kHeight].above_ground;
    double ground = 0;
    if (above && s_.has(Role::kSurfaceHeight)) ground = of(Role::kSurfaceHeight).at(c);
    if (missing(ground)) return fault(Role::kSurfaceHeight, c, "missing value");
    for (std::size_t k = 0; k < m; ++k) {
        const std::size_t i = s_.top_down ? m - 1 - k : k;
        to[k] = s_.hybrid_heights ? s_.hybrid_a[i] + s_.hybrid_b[i] * ground
                                  : of(Role::kHeight).at(c * m + k) + ground;
    }
    return Status::ok();
}

bool WeatherAirColumn::lacks_values(std::size_t c) const {
    for (const Role role : {Role::kTemperature, Role::kPressure, Role::kHeight, Role::kHumidity,
                            Role::kSurfacePressure, Role::kSurfaceHeight}) {
        if (!s_.has(role)) continue;
        const bool surface = role == Role::kSurfacePressure || role == Role::kSurfaceHeight;
        const std::size_t n = surface ? 1 : n_ + (s_.fields[role].on_faces ? 1 : 0);
        bool any = false;
        for (std::size_t k = 0; k < n; ++k) any = any || !missing(of(role).at(c * n + k));
        if (!any) return true;
    }
    return false;
}

/// Density of air and heights of faces.
Status WeatherAirColumn::place_column(std::size_t c, const Span<double>& faces) {
    if (needs_air_) PILEUS_TRY(air_column(c));
    if (by_pressure()) {
        double lowest = 0;
        if (s_.has(Role::kSurfaceHeight))
            lowest = of(Role::kSurfaceHeight).at(c);
        else if (s_.vertical == Vertical::kPressureLevels && !s_.has(Role::kSurfacePressure))
            lowest = standard_height(faces_pa_[0]);
        if (missing(lowest)) return fault(Role::kSurfaceHeight, c, "missing value");
        // Pressure levels may begin above the ground.
        if (s_.vertical == Vertical::kPressureLevels && ground_pa_ > faces_pa_[0])
            lowest += kDryAir * virtual_[0] / kGravity * layer_logarithm(ground_pa_, faces_pa_[0]);
        sum_heights({logarithms_.data(), n_}, {virtual_.data(), n_}, lowest, faces);
    } else {
        const std::size_t m = s_.vertical == Vertical::kHeightFaces ? n_ + 1 : n_;
        std::vector<double> own(m, 0.0);
        PILEUS_TRY(heights(c, own));
        const Span<const double> z{own.data(), m};
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

}  // namespace pileus
