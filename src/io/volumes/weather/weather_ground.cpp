// SPDX-License-Identifier: Apache-2.0
// Footprints of columns from coordinates in degrees or metres.
// in: coordinate variables, attributes of WRF -> out: see weather_ground.h.
// docs/weather.md, "Place"
#include "src/io/volumes/weather/weather_ground.h"

#include <cmath>

#include "src/base/angles.h"
#include "src/io/netcdf/netcdf_packing.h"
#include "src/io/volumes/weather/weather_hints.h"
#include "src/io/volumes/weather/weather_units.h"

namespace pileus {
namespace {

constexpr double kLoneWidth = 10'000;  // metres, of a single column
constexpr double kEven = 0.01;         // of a step

double sine(double degrees) { return sincos_deg(degrees).sine; }
double absolute(double x) { return x < 0 ? -x : x; }

/// Mean cosine of the latitudes between two, so that a footprint has its true area.
double mean_cosine(double low_deg, double high_deg) {
    constexpr double kRadian = 57.295779513082320877;
    if (!(high_deg - low_deg > 1e-9)) return sincos_deg(low_deg).cosine;
    return (sine(high_deg) - sine(low_deg)) / (high_deg - low_deg) * kRadian;
}

class GroundSearch {
public:
    GroundSearch(const NcFile& file, const NcVariable& water, const WeatherAxes& axes,
                 const WeatherSettings& settings, Footprints& ground)
        : file_(file),
          head_(file.head()),
          water_(water),
          axes_(axes),
          settings_(settings),
          ground_(ground) {}

    Status run() {
        if (axes_.column != kNoDimension) return columns();
        std::vector<double> x, y;
        bool x_degrees = false, y_degrees = false, x_found = false, y_found = false;
        PILEUS_TRY(axis(axes_.x, true, x, x_degrees, x_found));
        PILEUS_TRY(axis(axes_.y, false, y, y_degrees, y_found));
        if (x_found && y_found && x_degrees == y_degrees)
            return x_degrees ? degrees(x, y) : metres(x, y, "metres of the file");
        if (x_found && y_found) return fault("one in degrees, one in metres");
        if (head_.attribute("DX") != nullptr && head_.attribute("MAP_PROJ") != nullptr)
            return wrf();
        // One of the two may be left out where it has no extent.
        if (x_found && axes_.ny == 1)
            return x_degrees ? degrees(x, {0}) : metres(x, {0}, "metres of the file");
        if (y_found && axes_.nx == 1)
            return y_degrees ? degrees({0}, y) : metres({0}, y, "metres of the file");
        if (axes_.nx == 1 && axes_.ny == 1) return metres({0}, {0}, "a single column");
        return fault(
            "none that are known, nothing, allowed: coordinate variables in degrees or metres "
            "along x and y, longitude and latitude of a list of columns, or DX, DY and MAP_PROJ "
            "of WRF");
    }

private:
    Status fault(const std::string& line) const {
        return nc_fault(file_.name(), water_, "coordinates: " + line);
    }

    Status read_line(const NcVariable& v, std::vector<double>& values) const {
        values.assign(std::size_t(head_.size(v, v.dimensions.size() - 1)), 0.0);
        NcBlock block = whole_block(head_, v);
        for (std::size_t k = 0; k + 1 < block.count.size(); ++k) block.count[k] = 1;
        PILEUS_TRY(read_unpacked(file_, v, block, {values.data(), values.size()}));
        for (const double value : values)
            if (!(value > -1e12 && value < 1e12))
                return nc_fault(file_.name(), v, "values: not finite or missing, allowed: numbers");
        return Status::ok();
    }

    /// The coordinate of a dimension: of those whose unit is known, the one that says most.
    Status axis(std::size_t dimension, bool along_x, std::vector<double>& values, bool& in_degrees,
                bool& found) const {
        found = false;
        if (dimension == kNoDimension) return Status::ok();
        const NcVariable* own = head_.find(head_.dimensions[dimension].name);
        for (const NcVariable* v :
             coordinates_of(head_, dimension, along_x ? AxisKind::kX : AxisKind::kY)) {
            UnitScale unit;
            std::string text;
            bool there = false;
            PILEUS_TRY(read_unit(file_, settings_, *v, text, there));
            in_degrees = find_unit(text, Quantity::kDegrees, unit);
            if (!in_degrees && !find_unit(text, Quantity::kHeight, unit)) continue;
            PILEUS_TRY(read_line(*v, values));
            for (double& value : values) value *= unit.factor;
            found = true;
            return Status::ok();
        }
        if (own == nullptr || own->dimensions.size() != 1 || head_.attribute("DX") != nullptr)
            return Status::ok();
        return nc_fault(
            file_.name(), *own,
            "units: " +
                (own->find("units") == nullptr ? std::string("missing, nothing")
                                               : "unknown, \"" + own->text("units") + '"') +
                ", allowed: degrees, m, km; or the key units of the density");
    }

    Status edges(const char* which, const std::vector<double>& places, double width,
                 std::vector<double>& to, bool& flipped) const {
        if (edges_of(places, width, to, flipped)) return Status::ok();
        return fault(std::string(which) +
                     " not monotonic, allowed: ascending or descending without equal ones");
    }

    double width_or(double fallback) const {
        return settings_.place.width_m > 0 ? settings_.place.width_m : fallback;
    }

    /// Widths of what has a single place: the scene's, or the mean step of the other direction.
    void widths(const std::vector<double>& x, const std::vector<double>& y, double x_metres,
                double y_metres, double& x_width, double& y_width) const {
        const auto step = [](const std::vector<double>& v) {
            return v.size() < 2 ? 0 : absolute(v.back() - v.front()) / double(v.size() - 1);
        };
        const double of_x = step(x) * x_metres, of_y = step(y) * y_metres;
        x_width = width_or(of_y > 0 ? of_y : kLoneWidth) / x_metres;
        y_width = width_or(of_x > 0 ? of_x : kLoneWidth) / y_metres;
    }

    Status metres(const std::vector<double>& x, const std::vector<double>& y, const char* text) {
        double x_width = 0, y_width = 0;
        widths(x, y, 1, 1, x_width, y_width);
        return metres(x, y, x_width, y_width, text);
    }

    Status metres(const std::vector<double>& x, const std::vector<double>& y, double x_width,
                  double y_width, const char* text) {
        if (settings_.place.origin_deg[0] < 1e8)
            return Status::bad_input(file_.name() +
                                     ": origin_deg: the file's coordinates are metres, allowed: "
                                     "left out");
        PILEUS_TRY(edges("x", x, x_width, ground_.x_edges, ground_.x_flipped));
        PILEUS_TRY(edges("y", y, y_width, ground_.y_edges, ground_.y_flipped));
        ground_.text = text;
        centre();
        return finish(std::vector<double>(y.size(), 1.0));
    }

    /// The middle of the data at x = y = 0.
    void centre() {
        double* origin = ground_.origin;
        for (std::vector<double>* e : {&ground_.x_edges, &ground_.y_edges}) {
            *origin = 0.5 * (e->front() + e->back());
            for (double& edge : *e) edge -= *origin;
            ++origin;
        }
    }

    Status degrees(std::vector<double> x, const std::vector<double>& y) {
        // Across the date line longitudes jump by 360.
        for (std::size_t i = 1; i < x.size(); ++i) {
            while (x[i] - x[i - 1] > 180) x[i] -= 360;
            while (x[i] - x[i - 1] < -180) x[i] += 360;
        }
        double x_width = 0, y_width = 0;
        const double middle_cosine = sincos_deg(0.5 * (y.front() + y.back())).cosine;
        const double squeeze =
            settings_.place.plain_degrees || middle_cosine < 1e-3 ? 1 : middle_cosine;
        widths(x, y, kMetresPerDegree * squeeze, kMetresPerDegree, x_width, y_width);
        PILEUS_TRY(edges("longitudes", x, x_width, ground_.x_edges, ground_.x_flipped));
        PILEUS_TRY(edges("latitudes", y, y_width, ground_.y_edges, ground_.y_flipped));
        if (ground_.x_edges.back() - ground_.x_edges.front() > 360.001)
            return fault("longitudes span more than 360 degrees");
        std::vector<double>& ye = ground_.y_edges;
        for (double& edge : ye) {
            if (edge < -91 || edge > 91) return fault("latitudes beyond a pole");
            if (edge < -90) edge = -90;
            if (edge > 90) edge = 90;
        }
        std::vector<double> scale(y.size(), 1.0);
        for (std::size_t j = 0; j < y.size() && !settings_.place.plain_degrees; ++j)
            scale[j] = mean_cosine(ye[j], ye[j + 1]);
        double lon = 0.5 * (ground_.x_edges.front() + ground_.x_edges.back());
        double lat = 0.5 * (ye.front() + ye.back());
        if (settings_.place.origin_deg[0] < 1e8) {
            lon = settings_.place.origin_deg[0];
            lat = settings_.place.origin_deg[1];
            // The turn of the file's longitudes that lies nearest.
            const double middle = 0.5 * (ground_.x_edges.front() + ground_.x_edges.back());
            while (lon < middle - 180) lon += 360;
            while (lon > middle + 180) lon -= 360;
        }
        ground_.in_degrees = true;
        ground_.origin[0] = lon;
        ground_.origin[1] = lat;
        if (x.size() == 1) {
            ground_.squeeze = squeeze;
            // A slice along a meridian is as wide everywhere.
            const double middle = (x[0] - lon) * kMetresPerDegree * squeeze;
            const double width = x_width * kMetresPerDegree * squeeze;
            ground_.x_edges = {middle - 0.5 * width, middle + 0.5 * width};
            scale.assign(y.size(), 1.0);
        } else {
            for (double& edge : ground_.x_edges) edge = (edge - lon) * kMetresPerDegree;
        }
        for (double& edge : ye) edge = (edge - lat) * kMetresPerDegree;
        ground_.text = settings_.place.plain_degrees
                           ? "degrees as metres, without the cosine of latitude"
                           : "degrees as metres, with the cosine of latitude";
        return finish(scale);
    }

    Status finish(std::vector<double> scale) {
        if (scale.size() != ground_.ny()) return fault("rows without a latitude");
        ground_.row_scale = std::move(scale);
        ground_.even = true;
        for (const double s : ground_.row_scale)
            ground_.even = ground_.even && s == ground_.row_scale[0];
        return Status::ok();
    }

    /// A list of columns is a slice along a meridian or a parallel, or a single one.
    Status columns() {
        std::vector<double> lat, lon;
        PILEUS_TRY(of_columns("latitude", {"lat", "latitude", "clat", "XLAT"}, lat));
        PILEUS_TRY(of_columns("longitude", {"lon", "longitude", "clon", "XLONG"}, lon));
        if (axes_.nx == 1 && (lat.empty() || lon.empty()))
            return metres({0}, {0}, "a single column");
        if (lat.empty() || lon.empty())
            return fault(
                "none of the columns, nothing, allowed: variables of longitude and latitude "
                "along dimension " +
                head_.dimensions[axes_.column].name);
        if (axes_.nx == 1) return degrees(lon, lat);
        double east = 0, north = 0;
        for (std::size_t i = 0; i < lon.size(); ++i) {
            double d = lon[i] - lon[0];
            while (d > 180) d -= 360;
            while (d < -180) d += 360;
            if (absolute(d) > east) east = absolute(d);
            if (absolute(lat[i] - lat[0]) > north) north = absolute(lat[i] - lat[0]);
        }
        if (east < 1e-3 * north) {
            PILEUS_TRY(degrees({lon[0]}, lat));
            along_y_ = true;
        } else if (north < 1e-3 * east) {
            PILEUS_TRY(degrees(lon, {lat[0]}));
        } else {
            return fault(
                "a list of columns that lie neither on a meridian nor on a parallel, "
                "allowed: a slice, or x and y");
        }
        ground_.text += along_y_ ? "; a slice along a meridian" : "; a slice along a parallel";
        return Status::ok();
    }

    Status of_columns(const char* standard, const std::vector<const char*>& names,
                      std::vector<double>& values) const {
        const NcVariable* found = nullptr;
        const auto fits = [&](const NcVariable& v) {
            return v.dimensions.size() == 1 && v.dimensions[0] == axes_.column;
        };
        for (const NcVariable& v : head_.variables)
            if (found == nullptr && fits(v) && v.text("standard_name") == standard) found = &v;
        for (const char* name : names)
            if (const NcVariable* v = head_.find(name))
                if (found == nullptr && fits(*v)) found = v;
        values.clear();
        if (found == nullptr) return Status::ok();
        UnitScale unit;
        std::string text;
        bool there = false;
        PILEUS_TRY(read_unit(file_, settings_, *found, text, there));
        if (!find_unit(text, Quantity::kDegrees, unit))
            return nc_fault(file_.name(), *found,
                            "units: unknown or missing, \"" + text +
                                "\", allowed: " + unit_names(Quantity::kDegrees));
        PILEUS_TRY(read_line(*found, values));
        for (double& value : values) value *= unit.factor;
        return Status::ok();
    }

    /// A global attribute of WRF: one finite number.
    Status attribute(const char* name, double& value) const {
        const NcAttribute* a = head_.attribute(name);
        if (a == nullptr || a->numbers.size() != 1 || !(a->numbers[0] - a->numbers[0] == 0))
            return fault(std::string(name) + ": not a number, allowed: one");
        value = a->numbers[0];
        return Status::ok();
    }

    /// Equal steps of a conformal projection: metres on the map. An idealized case has no map.
    Status wrf() {
        double dx = 0, dy = 0, map = 0;
        PILEUS_TRY(attribute("DX", dx));
        PILEUS_TRY(attribute("DY", dy));
        PILEUS_TRY(attribute("MAP_PROJ", map));
        bool found = false;
        if (map == 6) PILEUS_TRY(wrf_degrees(found));
        if (found) return Status::ok();
        if (!(dx > 0 && dx < 1e7 && dy > 0 && dy < 1e7))
            return fault("DX, DY: out of range, allowed: above 0 to 1e7 m");
        const char* name = map == 0   ? "an idealized case of WRF, metres without a map"
                           : map == 1 ? "Lambert conformal"
                           : map == 2 ? "polar stereographic"
                           : map == 3 ? "Mercator"
                           : map == 6 ? "longitude and latitude of WRF, metres at its equator"
                                      : nullptr;
        if (name == nullptr)
            return fault("MAP_PROJ: unknown, " +
                         std::to_string(int(map > -1e6 && map < 1e6 ? map : -1)) +
                         ", allowed: 0 (idealized), 1 (Lambert), 2 (polar), 3 (Mercator), 6 "
                         "(longitude and latitude)");
        std::vector<double> x, y;
        for (std::uint64_t i = 0; i < axes_.nx; ++i) x.push_back(double(i) * dx);
        for (std::uint64_t j = 0; j < axes_.ny; ++j) y.push_back(double(j) * dy);
        return metres(x, y, dx, dy, name);
    }

    /// Along one side of the map: `at` is the place along the other.
    Status wrf_side(const NcVariable& v, bool along_x, std::uint64_t at,
                    std::vector<double>& values) const {
        NcBlock block = whole_block(head_, v);
        for (std::size_t k = 0; k < block.count.size(); ++k) {
            const std::size_t d = v.dimensions[k];
            if (d == (along_x ? axes_.x : axes_.y)) continue;
            block.start[k] = d == axes_.time                ? axes_.time_index
                             : d == axes_.x || d == axes_.y ? at
                                                            : 0;
            block.count[k] = 1;
        }
        values.assign(std::size_t(along_x ? axes_.nx : axes_.ny), 0.0);
        return read_unpacked(file_, v, block, {values.data(), values.size()});
    }

    /// Longitudes and latitudes that are those of rows and columns: the pole is not turned.
    Status wrf_degrees(bool& found) {
        const NcVariable *lon = head_.find("XLONG"), *lat = head_.find("XLAT");
        found = false;
        for (const NcVariable* v : {lon, lat}) {
            std::size_t sides = 0;
            if (v == nullptr || v->type == NcType::kChar) return Status::ok();
            for (const std::size_t d : v->dimensions) sides += d == axes_.x || d == axes_.y;
            if (sides != 2 || axes_.nx < 2 || axes_.ny < 2) return Status::ok();
        }
        std::vector<double> x, y, last_x, last_y, edges;
        PILEUS_TRY(wrf_side(*lon, true, 0, x));
        PILEUS_TRY(wrf_side(*lon, true, axes_.ny - 1, last_x));
        PILEUS_TRY(wrf_side(*lat, false, 0, y));
        PILEUS_TRY(wrf_side(*lat, false, axes_.nx - 1, last_y));
        const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
            const double step = absolute(a.back() - a.front()) / double(a.size());
            for (std::size_t i = 0; i < a.size(); ++i)
                if (!(absolute(a[i] - b[i]) <= kEven * step)) return false;
            return true;
        };
        bool flipped = false;
        std::vector<double> turned = x;
        for (std::size_t i = 1; i < x.size(); ++i)
            while (turned[i] < turned[i - 1] && turned[i] > turned[i - 1] - 400) turned[i] += 360;
        if (!same(x, last_x) || !same(y, last_y) || !edges_of(turned, 0, edges, flipped) ||
            !edges_of(y, 0, edges, flipped))
            return Status::ok();
        found = true;
        return degrees(x, y);
    }

    const NcFile& file_;
    const NcHead& head_;
    const NcVariable& water_;
    const WeatherAxes& axes_;
    const WeatherSettings& settings_;
    Footprints& ground_;
    bool along_y_ = false;
};

}  // namespace

Status find_footprints(const NcFile& file, const NcVariable& water, const WeatherAxes& axes,
                       const WeatherSettings& settings, Footprints& ground) {
    ground = Footprints();
    return GroundSearch(file, water, axes, settings, ground).run();
}

}  // namespace pileus
