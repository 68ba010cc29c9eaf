// SPDX-License-Identifier: Apache-2.0
// GRIB by ecCodes, which is loaded when a file asks for it.
// in: a path -> out: see netcdf_file.h.
// ecCodes 2.20 and later (ECMWF); WMO, Manual on Codes, FM 92 GRIB
#include "src/io/netcdf/netcdf_file.h"

#if PILEUS_WITH_ECCODES
#include <mutex>

#include "src/base/file.h"
#include "src/base/reading_limit.h"
#include "src/io/netcdf/grib_fields.h"
#include "src/io/netcdf/grib_library.h"
#include "src/io/netcdf/grib_message.h"
#include "src/scene/calendar.h"
#endif

namespace pileus {

#if PILEUS_WITH_ECCODES

namespace {

std::mutex one_at_a_time;

constexpr std::uint64_t kMaxValues = std::uint64_t{1} << 31;  // of all fields together
constexpr std::size_t kMaxFields = std::size_t{1} << 18;
/// What ecCodes takes for each value while it unpacks a field, and we beside it.
constexpr std::uint64_t kBytesUnpacking = 48;
/// A field is held until it is laid out, and again as a variable.
constexpr std::uint64_t kBytesHeld = 2 * sizeof(float);

class Reader {
public:
    explicit Reader(const std::string& name) : name_(name) {}

    Status run(GribWalk& walk, Buffer<char>& bytes) {
        PILEUS_TRY(codes_.load(name_));
        PILEUS_TRY(fields_of(walk));
        PILEUS_TRY(check_reading(name_, count_ * kBytesHeld));
        return encode_grib_fields(name_, fields_, bytes);
    }

private:
    Status fault(const std::string& line) const {
        return Status::bad_input(name_ + ": GRIB: " + printable_line(line));
    }

    Status fields_of(GribWalk& walk) {
        bool more = false;
        for (std::size_t count = 0;; ++count) {
            PILEUS_TRY(walk.next(more));
            if (!more) break;
            if (count >= kMaxFields)
                return Status::limit(name_ + ": GRIB: too many fields, allowed: at most " +
                                     std::to_string(kMaxFields));
            PILEUS_TRY(field_of(walk));
        }
        if (fields_.list.empty())
            return fault(
                "no field on levels, nothing, allowed: typeOfLevel hybrid, isobaricInhPa or "
                "surface");
        return Status::ok();
    }

    Status field_of(const GribWalk& walk) {
        const std::string where = "message " + std::to_string(walk.number()) + ": ";
        const GribMessage message(codes_, walk.message());
        if (!message.is_there() && !grib_gave_up()) return fault(where + "damaged or cut short");
        const Status status =
            message.is_there() ? take(message, walk.sections(), where) : Status::ok();
        // What came of a message that the library gave up is not used, and it gets no other.
        return grib_gave_up() ? fault(where + "damaged or cut short, ecCodes gave it up") : status;
    }

    Status grid_of(const GribMessage& m, const std::string& where, GribGrid& grid) const {
        const std::string type = m.text("gridType");
        if (type != "regular_ll")
            return fault(where + "gridType: " + type + ", allowed: regular_ll (cdo remapbil)");
        if (m.whole("iScansNegatively", 0) != 0 || m.whole("jPointsAreConsecutive", 0) != 0 ||
            m.whole("alternativeRowScanning", 0) != 0)
            return fault(where + "scanning mode, allowed: rows from west to east");
        grid.nx = m.whole("Ni", 0);
        grid.ny = m.whole("Nj", 0);
        grid.first_lon = m.number("longitudeOfFirstGridPointInDegrees", 1e9);
        grid.last_lon = m.number("longitudeOfLastGridPointInDegrees", 1e9);
        grid.first_lat = m.number("latitudeOfFirstGridPointInDegrees", 1e9);
        grid.last_lat = m.number("latitudeOfLastGridPointInDegrees", 1e9);
        const bool known = grid.first_lon > -1e3 && grid.first_lon < 1e3 && grid.last_lon > -1e3 &&
                           grid.last_lon < 1e3 && grid.first_lat > -91 && grid.first_lat < 91 &&
                           grid.last_lat > -91 && grid.last_lat < 91;
        constexpr long kMax = 1 << 20;
        if (!known || grid.nx < 1 || grid.ny < 1 || grid.nx > kMax || grid.ny > kMax)
            return fault(where + "grid of no sizes or places");
        if (grid.last_lon < grid.first_lon) grid.last_lon += 360;
        return Status::ok();
    }

    /// Keeps the field of a message, or passes it over.
    Status take(const GribMessage& m, const GribSections& sections, const std::string& where) {
        const std::string type = m.text("typeOfLevel");
        const bool hybrid = type == "hybrid", pressure = type == "isobaricInhPa";
        std::string name = m.text("shortName");
        // ECMWF keeps what lies at the ground on hybrid level 1.
        const bool ground = type == "surface" || (hybrid && (name == "lnsp" || name == "z"));
        if (!ground && !hybrid && !pressure) return Status::ok();
        if (name.empty() || name == "unknown") return Status::ok();
        if (ground && name != "lnsp" && name != "sp" && name != "z" && name != "orog")
            return Status::ok();
        if (ground && name == "z") name = "surface_z";
        GribGrid grid;
        PILEUS_TRY(grid_of(m, where, grid));
        if (fields_.list.empty()) fields_.grid = grid;
        if (!(grid == fields_.grid))
            return fault(where + "grid: another than before, allowed: one");
        if (hybrid && !ground) PILEUS_TRY(coefficients(m, where));
        if (!ground) {
            if (any_levels_ && fields_.hybrid != hybrid)
                return fault(where + "levels: hybrid and pressure in one file, allowed: one kind");
            any_levels_ = true;
            fields_.hybrid = hybrid;
        }
        const std::uint64_t cells = std::uint64_t(grid.nx) * std::uint64_t(grid.ny);
        // The library takes what these sections count at its word, so they are counted first.
        std::string wrong =
            grib_values_fault(sections, std::uint64_t(grid.nx), std::uint64_t(grid.ny));
        if (wrong.empty()) wrong = grib_time_fault(sections);
        if (!wrong.empty()) return fault(where + wrong);
        PILEUS_TRY(check_reading(name_, count_ * sizeof(float) + cells * kBytesUnpacking));
        if (m.size("values") != cells) return fault(where + "values: not as many as the grid's");
        count_ += cells;
        if (count_ > kMaxValues)
            return Status::limit(name_ + ": GRIB: too many values, allowed: at most 2^31");
        GribField field;
        field.variable = name;
        field.level = ground ? -1 : m.whole("level", 0);
        field.member = m.whole("number", 0);
        const long date = m.whole("validityDate", 19700101), time = m.whole("validityTime", 0);
        field.seconds = days_from_civil(date / 10000, date / 100 % 100, date % 100) * 86400 +
                        time / 100 * 3600 + time % 100 * 60;
        fields_.units[name] = name == "lnsp" ? "1" : m.text("units");
        return values_of(m, where, std::size_t(cells), field);
    }

    Status values_of(const GribMessage& m, const std::string& where, std::size_t cells,
                     const GribField& field) {
        m.mark_missing();
        Buffer<double> values;
        PILEUS_TRY(values.resize(cells, "values of a GRIB field"));
        if (!m.numbers("values", values.span())) return fault(where + "values: damaged");
        fields_.list.push_back(field);
        fields_.values.emplace_back();
        PILEUS_TRY(fields_.values.back().resize(cells, "values of a GRIB field"));
        for (std::size_t i = 0; i < cells; ++i) fields_.values.back()[i] = float(values[i]);
        return Status::ok();
    }

    /// a and b of the faces, a pair for each level of the model and one more.
    Status coefficients(const GribMessage& m, const std::string& where) {
        const std::size_t count = m.size("pv");
        if (count < 4 || count % 2 != 0 || count > 20002)
            return fault(where +
                         "pv: no coefficients of hybrid levels, allowed: two for each face");
        std::vector<double> pv(count);
        if (!m.numbers("pv", {pv.data(), pv.size()})) return fault(where + "pv: damaged");
        if (fields_.pv.empty()) fields_.pv = pv;
        return pv == fields_.pv ? Status::ok() : fault(where + "pv: other than before");
    }

    const std::string& name_;
    GribLibrary codes_;
    GribFields fields_;
    std::uint64_t count_ = 0;
    bool any_levels_ = false;
};

}  // namespace

Status read_grib(const std::string& path, Buffer<char>& bytes) {
    const std::lock_guard<std::mutex> turn(one_at_a_time);
    InputFile file;
    PILEUS_TRY(open_file(path, file));
    GribWalk walk(path, file);
    return Reader(path).run(walk, bytes);
}

Status decode_grib(const std::string& name, Span<const char> from, Buffer<char>& bytes) {
    const std::lock_guard<std::mutex> turn(one_at_a_time);
    GribWalk walk(name, from);
    return Reader(name).run(walk, bytes);
}

std::string grib_library_text() { return "GRIB yes"; }

#else

Status read_grib(const std::string& path, Buffer<char>&) {
    return Status::bad_input(path +
                             ": GRIB: not part of this build, allowed: a build with ecCodes "
                             "(PILEUS_ECCODES), or NetCDF (grib_to_netcdf)");
}
Status decode_grib(const std::string& name, Span<const char>, Buffer<char>& bytes) {
    return read_grib(name, bytes);
}
std::string grib_library_text() { return "GRIB no"; }

#endif

}  // namespace pileus
