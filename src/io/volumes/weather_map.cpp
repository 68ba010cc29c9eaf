// SPDX-License-Identifier: Apache-2.0
// Finds the map of weather data and lays places on it.
// in: attributes of WRF or of a CF grid mapping -> out: see weather_file.h.
// docs/weather.md, "Places"; Snyder 1987, chapters 5 (rotation), 7, 15, 21; CF conventions 1.10,
// appendix F.

#include <fmt/format.h>

#include <cmath>

#include "src/base/angles.h"
#include "src/base/number_text.h"
#include "src/base/powers.h"
#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/volumes/volume_file.h"
#include "src/io/volumes/weather/weather_levels.h"
#include "src/io/volumes/weather_file.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr double kDegree = 57.295779513082320877;
constexpr double kEarthRadius = kMetresPerDegree * kDegree;

/// Angle of (x, y) in degrees, (-180, 180]: libm's bits differ between machines.
double direction_deg(double y, double x) {
    const double length = std::sqrt(x * x + y * y);
    if (!(length > 0)) return 0;
    if (x < 0 && !(y > 0 || y < 0)) return 180;
    // The tangent of half the angle, and of its halves until a short series does.
    double t = x < 0 ? (length - x) / y : y / (length + x);
    double factor = 2;
    for (int i = 0; i < 4; ++i) {
        t = t / (1 + std::sqrt(1 + t * t));
        factor *= 2;
    }
    double sum = 0;
    const double t2 = t * t;
    for (int n = 17; n >= 1; n -= 2) sum = 1.0 / n - t2 * sum;
    return factor * t * sum * kDegree;
}

double sine_angle_deg(double s) {
    const double c2 = 1 - s * s;
    return direction_deg(s, c2 > 0 ? std::sqrt(c2) : 0);
}

/// The turn of an angle that lies within half a turn of 0.
double turned(double degrees) {
    while (degrees > 180) degrees -= 360;
    while (degrees < -180) degrees += 360;
    return degrees;
}

/// ln tan(45 deg + latitude/2)
double stretch(double latitude) {
    const double s = sincos_deg(latitude).sine;
    return 0.5 * logarithm((1 + s) / (1 - s));
}

double exponent(double x) { return exp2_of(x * 1.4426950408889634074); }

struct Cone {
    double n, reach;  ///< radius on the map = reach * e^(-n stretch)
};

Cone cone_of(const WeatherMap& m) {
    const double a = m.parallel[0], b = m.parallel[1];
    const double difference = a > b ? a - b : b - a;
    Cone cone{};
    cone.n = difference < 1e-6
                 ? sincos_deg(a).sine
                 : (logarithm(sincos_deg(a).cosine) - logarithm(sincos_deg(b).cosine)) /
                       (stretch(b) - stretch(a));
    cone.reach = m.radius * sincos_deg(a).cosine * exponent(cone.n * stretch(a)) / cone.n;
    return cone;
}

void rotate(const WeatherMap& m, double& lon, double& lat) {
    const SineCosine pole = sincos_deg(m.pole_lat), l = sincos_deg(lon - m.pole_lon - 180),
                     p = sincos_deg(lat);
    lon = direction_deg(p.cosine * l.sine, pole.sine * p.cosine * l.cosine + pole.cosine * p.sine) +
          m.pole_turn;
    double s = pole.sine * p.sine - pole.cosine * p.cosine * l.cosine;
    if (s > 1) s = 1;
    if (s < -1) s = -1;
    lat = sine_angle_deg(s);
}

/// Width of a degree of longitude over that of one of latitude: that of the row, or beyond the
/// rows the cosine.
double row_scale(const WeatherMap& m, double y, double lat) {
    if (!m.by_rows) return m.squeeze;
    for (std::size_t j = 0; j + 1 < m.y_edges.size(); ++j)
        if (y >= m.y_edges[j] && y <= m.y_edges[j + 1]) return m.row_scale[j];
    return sincos_deg(lat).cosine;
}

/// x, y of the projection, without its shift.
void project(const WeatherMap& m, double lon, double lat, double& x, double& y) {
    if (m.kind == MapKind::kRotated) rotate(m, lon, lat);
    if (m.kind <= MapKind::kRotated) {
        y = (lat - m.origin[1]) * kMetresPerDegree;
        x = turned(lon - m.origin[0]) * kMetresPerDegree * row_scale(m, y, lat);
        return;
    }
    const double east = turned(lon - m.meridian);
    if (m.kind == MapKind::kMercator) {
        const double scale = m.radius * sincos_deg(m.parallel[0]).cosine;
        x = scale * east / kDegree;
        y = scale * stretch(lat);
        return;
    }
    if (m.kind == MapKind::kConic) {
        const Cone cone = cone_of(m);
        const SineCosine turn = sincos_deg(cone.n * east);
        const double far = cone.reach * exponent(-cone.n * stretch(lat));
        x = far * turn.sine;
        y = -far * turn.cosine;
        return;
    }
    // Polar: the plane that touches the pole of the true latitude's side.
    const double side = m.parallel[0] < 0 ? -1 : 1;
    const SineCosine turn = sincos_deg(east);
    const double far =
        m.radius * (1 + side * sincos_deg(m.parallel[0]).sine) * exponent(-side * stretch(lat));
    x = far * turn.sine;
    y = -side * far * turn.cosine;
}

class MapSearch {
public:
    MapSearch(const NcFile& file, const WeatherSource& source, WeatherMap& map)
        : file_(file), head_(file.head()), source_(source), map_(map) {}

    Status run() {
        const Footprints& g = source_.ground;
        map_.origin[0] = g.origin[0];
        map_.origin[1] = g.origin[1];
        map_.squeeze = g.squeeze;
        map_.vertical_scale = source_.settings->place.vertical_scale;
        PILEUS_TRY(g.in_degrees                             ? degrees()
                   : head_.attribute("MAP_PROJ") != nullptr ? wrf()
                                                            : grid_mapping());
        return wrong_.empty() ? Status::ok() : fault(wrong_ + ": not a number, allowed: one");
    }

private:
    Status fault(const std::string& line) const {
        return nc_fault(file_.name(), *source_.water, "map: " + line);
    }

    /// An attribute that is there and says no number is a fault, kept for the end.
    double number(const NcAttribute* a, double fallback, std::size_t i = 0) const {
        if (a == nullptr) return fallback;
        if (a->numbers.empty()) wrong_ = a->name;
        // WRF writes 1e20 for what it has not.
        const double value = a->numbers.size() > i ? a->numbers[i] : 1e20;
        return value > -1e9 && value < 1e9 ? value : fallback;
    }
    double global(const char* name, double fallback) const {
        return number(head_.attribute(name), fallback);
    }

    const NcVariable* mapping() const { return head_.find(source_.water->text("grid_mapping")); }

    Status degrees() {
        const Footprints& g = source_.ground;
        map_.kind = source_.settings->place.plain_degrees ? MapKind::kPlain : MapKind::kDegrees;
        map_.by_rows = map_.kind == MapKind::kDegrees && g.nx() > 1;
        map_.y_edges = g.y_edges;
        map_.row_scale = g.row_scale;
        bool rotated = false;
        for (const NcVariable& v : head_.variables)
            rotated = rotated || (v.text("standard_name") == "grid_longitude" &&
                                  v.dimensions.size() == 1 && v.dimensions[0] == source_.axes.x);
        if (!rotated) return Status::ok();
        const NcVariable* v = mapping();
        const NcAttribute* lat = v == nullptr ? nullptr : v->find("grid_north_pole_latitude");
        const NcAttribute* lon = v == nullptr ? nullptr : v->find("grid_north_pole_longitude");
        if (lat == nullptr || lon == nullptr)
            return fault(
                "a rotated pole that nothing tells, allowed: grid_mapping with "
                "grid_north_pole_latitude and grid_north_pole_longitude");
        if (map_.kind == MapKind::kPlain) map_.by_rows = false;
        map_.kind = MapKind::kRotated;
        map_.pole_lat = number(lat, 90);
        map_.pole_lon = number(lon, 180);
        map_.pole_turn = number(v->find("north_pole_grid_longitude"), 0);
        return Status::ok();
    }

    /// True latitudes that a projection can have; `polar`: which is none of a cone.
    Status parallels() const {
        for (const double p : map_.parallel)
            if (!(p > -90.001 && p < 90.001)) return fault("true latitude out of range");
        if (map_.kind != MapKind::kConic) return Status::ok();
        const double sum = map_.parallel[0] + map_.parallel[1];
        const bool inside = map_.parallel[0] > -89.9 && map_.parallel[0] < 89.9 &&
                            map_.parallel[1] > -89.9 && map_.parallel[1] < 89.9;
        if (!inside || (sum < 1e-3 && sum > -1e-3))
            return fault("true latitudes of no cone, allowed: not opposite, within 89.9 degrees");
        return Status::ok();
    }

    /// Longitude and latitude of the first column, which WRF writes beside the fields.
    Status first_place(const char* name, double& value, bool& found) const {
        const NcVariable* v = head_.find(name);
        found = v != nullptr && v->dimensions.size() >= 2 && v->type != NcType::kChar;
        if (!found) return Status::ok();
        NcBlock block = whole_block(head_, *v);
        for (std::size_t k = 0; k < block.count.size(); ++k) {
            if (block.count[k] == 0) found = false;
            if (v->dimensions[k] == source_.axes.time) block.start[k] = source_.axes.time_index;
            block.count[k] = 1;
        }
        if (!found) return Status::ok();
        PILEUS_TRY(read_unpacked(file_, *v, block, {&value, 1}));
        return value >= -360 && value <= 360 ? Status::ok()
                                             : nc_fault(file_.name(), *v, "values: no degrees");
    }

    /// Makes a place of the projection lie where it is in the medium.
    void anchor(double lon, double lat, double x, double y) {
        double at[2] = {0, 0};
        project(map_, lon, lat, at[0], at[1]);
        map_.shift[0] = x - at[0];
        map_.shift[1] = y - at[1];
    }

    Status wrf() {
        const double kind = global("MAP_PROJ", 0);
        if (kind != 1 && kind != 2 && kind != 3)
            return fault(kind == 0 ? "none, an idealized case of WRF, allowed: places in metres"
                                   : "longitudes and latitudes of WRF that no row or column has, "
                                     "allowed: places in metres");
        map_.kind = kind == 1 ? MapKind::kConic : kind == 2 ? MapKind::kPolar : MapKind::kMercator;
        map_.radius = 6370000;  // WRF's own
        map_.parallel[0] = global("TRUELAT1", 0);
        map_.parallel[1] = global("TRUELAT2", map_.parallel[0]);
        if (!(map_.parallel[1] > -90 && map_.parallel[1] < 90)) map_.parallel[1] = map_.parallel[0];
        map_.meridian = global("STAND_LON", global("CEN_LON", 0));
        PILEUS_TRY(parallels());
        double lon = 0, lat = 0;
        bool has_lon = false, has_lat = false;
        PILEUS_TRY(first_place("XLONG", lon, has_lon));
        PILEUS_TRY(first_place("XLAT", lat, has_lat));
        const bool known = has_lon && has_lat;
        if (!known &&
            (head_.attribute("CEN_LON") == nullptr || head_.attribute("CEN_LAT") == nullptr))
            return fault("no place of any column, allowed: XLAT and XLONG, or CEN_LAT and CEN_LON");
        if (!known) {
            lon = global("CEN_LON", 0);
            lat = global("CEN_LAT", 0);
        }
        if (!(lat > -90 && lat < 90)) return fault("a first column on a pole");
        anchor(lon, lat, known ? -map_.origin[0] : 0, known ? -map_.origin[1] : 0);
        return Status::ok();
    }

    Status grid_mapping() {
        const NcVariable* v = mapping();
        if (v == nullptr)
            return fault(
                "none, allowed: longitudes and latitudes, WRF, or a grid_mapping of the cloud's "
                "water");
        const std::string name = v->text("grid_mapping_name");
        const NcAttribute* parallel = v->find("standard_parallel");
        const double middle = number(v->find("latitude_of_projection_origin"), 0);
        map_.meridian = number(v->find("longitude_of_central_meridian"), 0);
        if (name == "lambert_conformal_conic") {
            map_.kind = MapKind::kConic;
        } else if (name == "mercator") {
            map_.kind = MapKind::kMercator;
            map_.meridian = number(v->find("longitude_of_projection_origin"), map_.meridian);
        } else if (name == "polar_stereographic") {
            map_.kind = MapKind::kPolar;
            map_.meridian = number(v->find("straight_vertical_longitude_from_pole"), map_.meridian);
        } else {
            return fault("projection: unknown, " + quote_text(name) +
                         ", allowed: lambert_conformal_conic, mercator, polar_stereographic");
        }
        map_.parallel[0] = number(parallel, map_.kind == MapKind::kPolar ? middle : 0);
        map_.parallel[1] = number(parallel, map_.parallel[0], 1);
        const double flattening = number(v->find("inverse_flattening"), 0);
        map_.radius = number(v->find("earth_radius"), number(v->find("semi_major_axis"), 6371229));
        const double minor = number(v->find("semi_minor_axis"), map_.radius);
        if (flattening != 0 || minor != map_.radius || !(map_.radius > 1e6))
            return fault("an ellipsoid, allowed: a sphere (earth_radius)");
        PILEUS_TRY(parallels());
        double x = 0, y = 0;
        if (map_.kind == MapKind::kConic) project(map_, map_.meridian, middle, x, y);
        map_.shift[0] = number(v->find("false_easting"), 0) - map_.origin[0];
        map_.shift[1] = number(v->find("false_northing"), 0) - y - map_.origin[1];
        return Status::ok();
    }

    const NcFile& file_;
    const NcHead& head_;
    const WeatherSource& source_;
    WeatherMap& map_;
    mutable std::string wrong_;  ///< name of an attribute that says no number
};

}  // namespace

Status WeatherMap::place(const std::string& where, const Double3& p, Double3& metres) const {
    const bool projected = kind > MapKind::kRotated;
    if (!is_on_map(p))
        return Status::bad_input(where + ": out of range, " + number_text(p[0]) + ", " +
                                 number_text(p[1]) + ", allowed: " + kPlacesOnMap);
    double x = 0, y = 0;
    if (!projected || (p[1] > -89.999 && p[1] < 89.999)) project(*this, p[0], p[1], x, y);
    // The pole of a polar map is its middle; elsewhere it is endless.
    const double side = parallel[0] < 0 ? -1 : 1;
    const bool endless = projected && !(p[1] > -89.999 && p[1] < 89.999) &&
                         (kind != MapKind::kPolar || side * p[1] < 0);
    if (endless || !(x > -1e9 && x < 1e9 && y > -1e9 && y < 1e9))
        return Status::bad_input(where + ": beyond the file's map, " + number_text(p[0]) + ", " +
                                 number_text(p[1]) + ", allowed: places that it shows");
    metres = {x + shift[0], y + shift[1], p[2] * vertical_scale};
    return Status::ok();
}

std::string WeatherMap::projection() const {
    const std::string sphere = fmt::format(" +R={:.10g} +units=m +no_defs", kEarthRadius);
    const double south = -origin[1] * kMetresPerDegree;
    const auto tail = [&](double add_y) {
        return fmt::format(" +lon_0={:.10g} +x_0={:.10g} +y_0={:.10g} +R={:.10g} +units=m +no_defs",
                           meridian, shift[0], shift[1] + add_y, radius);
    };
    switch (kind) {
        case MapKind::kDegrees:
            if (by_rows)
                return fmt::format("+proj=sinu +lon_0={:.10g} +x_0=0 +y_0={:.10g}",
                                   turned(origin[0]), south) +
                       sphere;
            break;
        case MapKind::kPlain:
            break;
        case MapKind::kRotated:
            return fmt::format(
                       "+proj=ob_tran +o_proj={} +o_lat_p={:.10g} +o_lon_p={:.10g} "
                       "+lon_0={:.10g} +x_0=0 +y_0={:.10g}",
                       by_rows ? "sinu" : "eqc", pole_lat, turned(pole_turn - origin[0]),
                       turned(pole_lon + 180), south) +
                   sphere;
        case MapKind::kMercator:
            return fmt::format("+proj=merc +lat_ts={:.10g}", parallel[0]) + tail(0);
        case MapKind::kConic: {
            // PROJ counts y from lat_0, we from the cone's tip.
            double x = 0, y = 0;
            project(*this, meridian, parallel[0], x, y);
            return fmt::format("+proj=lcc +lat_1={:.10g} +lat_2={:.10g} +lat_0={:.10g}",
                               parallel[0], parallel[1], parallel[0]) +
                   tail(y);
        }
        case MapKind::kPolar:
            return fmt::format("+proj=stere +lat_0={} +lat_ts={:.10g}", parallel[0] < 0 ? -90 : 90,
                               parallel[0]) +
                   tail(0);
    }
    // Degrees as metres; of a slice along a meridian with the cosine of its middle.
    const double true_lat =
        squeeze < 1 ? direction_deg(std::sqrt(1 - squeeze * squeeze), squeeze) : 0;
    return fmt::format("+proj=eqc +lat_ts={:.10g} +lon_0={:.10g} +x_0=0 +y_0={:.10g}", true_lat,
                       turned(origin[0]), south) +
           sphere;
}

Status find_map(const NcFile& file, const WeatherSettings& settings, WeatherMap& map) {
    map = WeatherMap();
    if (const NcVariable* grid = netcdf_grid(file.head(), settings))
        return nc_fault(file.name(), *grid, "map: none, a grid in metres, allowed: weather data");
    WeatherSource source;
    PILEUS_TRY(open_weather(file, settings, source));
    return MapSearch(file, source, map).run();
}

}  // namespace pileus
