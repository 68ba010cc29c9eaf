// SPDX-License-Identifier: Apache-2.0
// GRIB by ecCodes, which is loaded when a file asks for it.
// in: a path -> out: see grib_file.h.
// ecCodes 2.20 and later (ECMWF); WMO, Manual on Codes, FM 92 GRIB
#include "src/io/netcdf/grib_file.h"

#if PILEUS_WITH_ECCODES
#include <eccodes.h>

#include <cstdio>
#include <memory>
#include <mutex>

#include "src/base/dynamic_library.h"
#include "src/io/netcdf/civil_days.h"
#include "src/io/netcdf/grib_fields.h"
#endif

namespace pileus {

#if PILEUS_WITH_ECCODES

namespace {

std::mutex one_at_a_time;

constexpr std::uint64_t kMostValues = std::uint64_t{1} << 31;  // of all fields together
constexpr std::size_t kMostFields = std::size_t{1} << 18;

struct Library {
    decltype(&::codes_handle_new_from_file) next = nullptr;
    decltype(&::codes_handle_delete) drop = nullptr;
    decltype(&::codes_get_long) get_long = nullptr;
    decltype(&::codes_get_double) get_double = nullptr;
    decltype(&::codes_get_string) get_string = nullptr;
    decltype(&::codes_get_size) get_size = nullptr;
    decltype(&::codes_get_double_array) get_doubles = nullptr;
    decltype(&::codes_set_double) set_double = nullptr;
    decltype(&::codes_context_get_default) context = nullptr;
    decltype(&::codes_context_set_logging_proc) set_log = nullptr;

    Status load(const std::string& name) {
        DynamicLibrary library("libeccodes.so.0");
        if (!library.is_there())
            return Status::bad_input(name +
                                     ": GRIB: the library libeccodes.so.0 is not there, allowed: "
                                     "install it, or NetCDF (grib_to_netcdf)");
        library.find("codes_handle_new_from_file", next);
        library.find("codes_handle_delete", drop);
        library.find("codes_get_long", get_long);
        library.find("codes_get_double", get_double);
        library.find("codes_get_string", get_string);
        library.find("codes_get_size", get_size);
        library.find("codes_get_double_array", get_doubles);
        library.find("codes_set_double", set_double);
        library.find("codes_context_get_default", context);
        library.find("codes_context_set_logging_proc", set_log);
        if (!library.is_whole())
            return Status::bad_input(name + ": GRIB: libeccodes.so.0 lacks a function");
        // A fault is one line, and it is ours.
        set_log(context(), [](const codes_context*, int, const char*) {});
        return Status::ok();
    }
};

/// One message, freed with its owner.
class Message {
public:
    Message(const Library& library, codes_handle* handle) : codes_(library), handle_(handle) {}
    Message(const Message&) = delete;
    Message& operator=(const Message&) = delete;
    ~Message() { codes_.drop(handle_); }

    long whole(const char* key, long fallback) const {
        long value = 0;
        return codes_.get_long(handle_, key, &value) == 0 ? value : fallback;
    }
    double number(const char* key, double fallback) const {
        double value = 0;
        return codes_.get_double(handle_, key, &value) == 0 ? value : fallback;
    }
    std::string text(const char* key) const {
        char value[256] = {};
        std::size_t length = sizeof value;
        return codes_.get_string(handle_, key, value, &length) == 0 ? printable_line(value) : "";
    }
    std::size_t size(const char* key) const {
        std::size_t count = 0;
        return codes_.get_size(handle_, key, &count) == 0 ? count : 0;
    }
    bool numbers(const char* key, Span<double> to) const {
        std::size_t count = to.size;
        return codes_.get_doubles(handle_, key, to.data, &count) == 0 && count == to.size;
    }
    void mark_missing() const { codes_.set_double(handle_, "missingValue", kGribMissing); }

private:
    const Library& codes_;
    codes_handle* handle_;
};

class Reader {
public:
    explicit Reader(const std::string& name) : name_(name) {}

    Status run(Buffer<char>& bytes) {
        PILEUS_TRY(codes_.load(name_));
        PILEUS_TRY(messages());
        return encode_grib_fields(name_, fields_, bytes);
    }

private:
    Status fault(const std::string& line) const {
        return Status::bad_input(name_ + ": GRIB: " + printable_line(line));
    }

    Status messages() {
        const std::unique_ptr<FILE, int (*)(FILE*)> stream(std::fopen(name_.c_str(), "rb"),
                                                           std::fclose);
        if (stream == nullptr) return fault("cannot be opened");
        for (std::size_t count = 0;; ++count) {
            int code = 0;
            codes_handle* handle = codes_.next(nullptr, stream.get(), PRODUCT_GRIB, &code);
            if (handle == nullptr && code == 0) break;
            if (handle == nullptr)
                return fault("message " + std::to_string(count) + ": damaged or cut short");
            const Message message(codes_, handle);
            if (count >= kMostFields)
                return Status::limit(name_ + ": GRIB: too many messages, allowed: at most " +
                                     std::to_string(kMostFields));
            PILEUS_TRY(take(message, count));
        }
        if (fields_.list.empty())
            return fault(
                "no field on levels, nothing, allowed: typeOfLevel hybrid, isobaricInhPa or "
                "surface");
        return Status::ok();
    }

    Status grid_of(const Message& m, const std::string& where, GribGrid& grid) const {
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
        constexpr long kMost = 1 << 20;
        if (!known || grid.nx < 1 || grid.ny < 1 || grid.nx > kMost || grid.ny > kMost)
            return fault(where + "grid of no sizes or places");
        if (grid.last_lon < grid.first_lon) grid.last_lon += 360;
        return Status::ok();
    }

    /// Keeps the field of a message, or passes it over.
    Status take(const Message& m, std::size_t count) {
        const std::string where = "message " + std::to_string(count) + ": ";
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
        if (m.size("values") != cells) return fault(where + "values: not as many as the grid's");
        count_ += cells;
        if (count_ > kMostValues)
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

    Status values_of(const Message& m, const std::string& where, std::size_t cells,
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
    Status coefficients(const Message& m, const std::string& where) {
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
    Library codes_;
    GribFields fields_;
    std::uint64_t count_ = 0;
    bool any_levels_ = false;
};

}  // namespace

Status read_grib(const std::string& path, Buffer<char>& bytes) {
    const std::lock_guard<std::mutex> turn(one_at_a_time);
    return Reader(path).run(bytes);
}

std::string grib_library_text() { return "GRIB yes"; }

#else

Status read_grib(const std::string& path, Buffer<char>&) {
    return Status::bad_input(path +
                             ": GRIB: not part of this build, allowed: a build with ecCodes "
                             "(PILEUS_ECCODES), or NetCDF (grib_to_netcdf)");
}
std::string grib_library_text() { return "GRIB no"; }

#endif

}  // namespace pileus
