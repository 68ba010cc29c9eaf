// SPDX-License-Identifier: Apache-2.0
// NetCDF files on HDF5, by libnetcdf, which is loaded when a file asks for it.
// in: a path or bytes -> out: see netcdf_file.h.
// Unidata, "NetCDF C Library"; it runs for one thread at a time.
#include "src/io/netcdf/netcdf_file.h"

#if PILEUS_WITH_NETCDF
#include <netcdf.h>
#include <netcdf_mem.h>

#include <mutex>

#include "src/base/dynamic_library.h"
#endif

#include "src/base/buffer.h"
#include "src/base/reading_limit.h"
#include "src/io/netcdf/netcdf_values.h"

namespace pileus {

#if PILEUS_WITH_NETCDF

namespace {

std::mutex one_at_a_time;
using Turn = std::lock_guard<std::mutex>;

/// The library during one call.
struct Library {
    decltype(&::nc_strerror) strerror = nullptr;
    decltype(&::nc_inq_attname) inq_attname = nullptr;
    decltype(&::nc_inq_att) inq_att = nullptr;
    decltype(&::nc_get_att_text) get_att_text = nullptr;
    decltype(&::nc_get_att_string) get_att_string = nullptr;
    decltype(&::nc_free_string) free_string = nullptr;
    decltype(&::nc_get_att_double) get_att_double = nullptr;
    decltype(&::nc_inq_dimids) inq_dimids = nullptr;
    decltype(&::nc_inq_unlimdims) inq_unlimdims = nullptr;
    decltype(&::nc_inq_dim) inq_dim = nullptr;
    decltype(&::nc_inq_var) inq_var = nullptr;
    decltype(&::nc_inq_vardimid) inq_vardimid = nullptr;
    decltype(&::nc_open) open = nullptr;
    decltype(&::nc_open_mem) open_mem = nullptr;
    decltype(&::nc_close) close = nullptr;
    decltype(&::nc_inq) inq = nullptr;
    decltype(&::nc_get_vara_text) get_vara_text = nullptr;
    decltype(&::nc_get_vara_double) get_vara_double = nullptr;
    decltype(&::nc_set_var_chunk_cache) set_var_chunk_cache = nullptr;
    decltype(&::nc_inq_var_chunking) inq_var_chunking = nullptr;

    Status load(const std::string& name) {
        DynamicLibrary library("libnetcdf.so.19");
        if (!library.is_there())
            return Status::bad_input(name +
                                     ": NetCDF-4 on HDF5: the library libnetcdf.so.19 is not "
                                     "there, allowed: install it, or a classic file (nccopy -k "
                                     "cdf5)");
        library.find("nc_strerror", strerror);
        library.find("nc_inq_attname", inq_attname);
        library.find("nc_inq_att", inq_att);
        library.find("nc_get_att_text", get_att_text);
        library.find("nc_get_att_string", get_att_string);
        library.find("nc_free_string", free_string);
        library.find("nc_get_att_double", get_att_double);
        library.find("nc_inq_dimids", inq_dimids);
        library.find("nc_inq_unlimdims", inq_unlimdims);
        library.find("nc_inq_dim", inq_dim);
        library.find("nc_inq_var", inq_var);
        library.find("nc_inq_vardimid", inq_vardimid);
        library.find("nc_open", open);
        library.find("nc_open_mem", open_mem);
        library.find("nc_close", close);
        library.find("nc_inq", inq);
        library.find("nc_get_vara_text", get_vara_text);
        library.find("nc_get_vara_double", get_vara_double);
        library.find("nc_set_var_chunk_cache", set_var_chunk_cache);
        library.find("nc_inq_var_chunking", inq_var_chunking);
        if (!library.is_whole())
            return Status::bad_input(name +
                                     ": NetCDF-4 on HDF5: libnetcdf.so.19 lacks a function, "
                                     "allowed: version 4.6 or later");
        return Status::ok();
    }
};

Status library_fault(const Library& nc, const std::string& name, const std::string& what,
                     int code) {
    return Status::bad_input(name + ": " + printable_line(what) + ": damaged or unreadable, " +
                             printable_line(nc.strerror(code)));
}

#define PILEUS_NC(call, what)                                             \
    do {                                                                  \
        const int code = (call);                                          \
        if (code != NC_NOERR) return library_fault(nc, name, what, code); \
    } while (0)

Status read_attributes(const Library& nc, const std::string& name, int handle, int variable,
                       int count, std::vector<NcAttribute>& to) {
    for (int i = 0; i < count; ++i) {
        char text[NC_MAX_NAME + 1] = {};
        nc_type type = 0;
        std::size_t length = 0;
        PILEUS_NC(nc.inq_attname(handle, variable, i, text), "attribute");
        PILEUS_NC(nc.inq_att(handle, variable, text, &type, &length), "attribute");
        NcAttribute a;
        a.name = text;
        if (length > 65536) {
            // There all the same: whoever asks for it finds it unreadable.
        } else if (type == NC_CHAR) {
            a.type = NcType::kChar;
            a.is_text = true;
            a.text.resize(length);
            if (length > 0) PILEUS_NC(nc.get_att_text(handle, variable, text, &a.text[0]), text);
            while (!a.text.empty() && a.text.back() == '\0') a.text.pop_back();
        } else if (type == NC_STRING && length == 1) {
            char* string = nullptr;
            PILEUS_NC(nc.get_att_string(handle, variable, text, &string), text);
            a.is_text = true;
            a.type = NcType::kChar;
            if (string != nullptr) a.text = string;
            nc.free_string(1, &string);
        } else if (type >= NC_BYTE && type <= NC_UINT64) {
            a.type = NcType(type);
            a.numbers.resize(length);
            if (length > 0)
                PILEUS_NC(nc.get_att_double(handle, variable, text, a.numbers.data()), text);
        }
        to.push_back(std::move(a));
    }
    return Status::ok();
}

Status read_dimensions(const Library& nc, const std::string& name, int handle, int count,
                       NcHead& head) {
    int ids[NC_MAX_DIMS] = {}, open[NC_MAX_DIMS] = {}, found = 0, unlimited = 0;
    if (count > NC_MAX_DIMS) return library_fault(nc, name, "dimensions", NC_EMAXDIMS);
    PILEUS_NC(nc.inq_dimids(handle, &found, nullptr, 0), "dimensions");
    if (found != count) return library_fault(nc, name, "dimensions", NC_EBADDIM);
    PILEUS_NC(nc.inq_dimids(handle, &found, ids, 0), "dimensions");
    PILEUS_NC(nc.inq_unlimdims(handle, &unlimited, nullptr), "dimensions");
    if (unlimited > NC_MAX_DIMS) return library_fault(nc, name, "dimensions", NC_EMAXDIMS);
    PILEUS_NC(nc.inq_unlimdims(handle, &unlimited, open), "dimensions");
    for (int i = 0; i < count; ++i) {
        char text[NC_MAX_NAME + 1] = {};
        std::size_t size = 0;
        if (ids[i] != i) return library_fault(nc, name, "dimensions", NC_EBADDIM);
        PILEUS_NC(nc.inq_dim(handle, i, text, &size), "dimension");
        NcDimension d{text, size, false};
        for (int k = 0; k < unlimited; ++k) d.unlimited = d.unlimited || open[k] == i;
        head.dimensions.push_back(d);
    }
    return Status::ok();
}

Status read_variables(const Library& nc, const std::string& name, int handle, int count,
                      NcHead& head) {
    for (int i = 0; i < count; ++i) {
        char text[NC_MAX_NAME + 1] = {};
        int sides = 0, attributes = 0, ids[NC_MAX_VAR_DIMS] = {};
        nc_type type = 0;
        PILEUS_NC(nc.inq_var(handle, i, text, &type, &sides, nullptr, &attributes), "variable");
        if (sides > NC_MAX_VAR_DIMS) return library_fault(nc, name, text, NC_EMAXDIMS);
        PILEUS_NC(nc.inq_vardimid(handle, i, ids), text);
        NcVariable v;
        v.name = text;
        v.type = type >= NC_BYTE && type <= NC_UINT64 ? NcType(type) : NcType::kOther;
        for (int k = 0; k < sides; ++k) {
            if (ids[k] < 0 || std::size_t(ids[k]) >= head.dimensions.size())
                return library_fault(nc, name, text, NC_EBADDIM);
            v.dimensions.push_back(std::size_t(ids[k]));
        }
        PILEUS_TRY(read_attributes(nc, name, handle, i, attributes, v.attributes));
        v.begin = std::uint64_t(i);
        head.variables.push_back(std::move(v));
    }
    return Status::ok();
}

/// HDF5 holds a chunk whole, packed and unpacked, and a file of a kilobyte may state gigabytes.
Status check_chunk(const Library& nc, const std::string& name, int handle,
                   const NcVariable& variable) {
    int storage = NC_CONTIGUOUS;
    std::size_t sides[NC_MAX_VAR_DIMS] = {};
    PILEUS_NC(nc.inq_var_chunking(handle, int(variable.begin), &storage, sides),
              "variable " + variable.name);
    if (storage != NC_CHUNKED) return Status::ok();
    std::uint64_t bytes = 2 * nc_bytes(variable.type);
    for (std::size_t k = 0; k < variable.dimensions.size(); ++k)
        if (!checked_multiply(bytes, sides[k], bytes)) bytes = ~std::uint64_t{0};
    return check_reading(name + ": variable " + printable_line(variable.name) + ": chunk", bytes);
}

}  // namespace

Status open_hdf5(const std::string& path, int& handle) {
    const Turn turn(one_at_a_time);
    Library nc;
    const std::string& name = path;
    PILEUS_TRY(nc.load(name));
    // A name that begins with a folder is never taken for an address.
    const std::string place = path[0] == '/' ? path : "./" + path;
    PILEUS_NC(nc.open(place.c_str(), NC_NOWRITE, &handle), "head");
    return Status::ok();
}

Status open_hdf5_bytes(const std::string& name, Span<const char> bytes, int& handle) {
    const Turn turn(one_at_a_time);
    Library nc;
    PILEUS_TRY(nc.load(name));
    // The library asks for bytes that it might write to, and writes none without NC_WRITE.
    PILEUS_NC(
        nc.open_mem(name.c_str(), NC_NOWRITE, bytes.size, const_cast<char*>(bytes.data), &handle),
        "head");
    return Status::ok();
}

void close_hdf5(int handle) {
    const Turn turn(one_at_a_time);
    Library nc;
    if (nc.load("")) nc.close(handle);
}

Status read_hdf5_head(const std::string& name, int handle, NcHead& head) {
    const Turn turn(one_at_a_time);
    Library nc;
    PILEUS_TRY(nc.load(name));
    head = NcHead();
    head.kind = "NetCDF-4 on HDF5";
    head.on_hdf5 = true;
    int dimensions = 0, variables = 0, attributes = 0;
    PILEUS_NC(nc.inq(handle, &dimensions, &variables, &attributes, nullptr), "head");
    PILEUS_TRY(read_dimensions(nc, name, handle, dimensions, head));
    PILEUS_TRY(read_attributes(nc, name, handle, NC_GLOBAL, attributes, head.attributes));
    return read_variables(nc, name, handle, variables, head);
}

Status read_hdf5(const std::string& name, int handle, const NcVariable& variable,
                 const NcBlock& block, Span<double> to) {
    const Turn turn(one_at_a_time);
    Library nc;
    PILEUS_TRY(nc.load(name));
    const int id = int(variable.begin);
    PILEUS_TRY(check_chunk(nc, name, handle, variable));
    const std::vector<std::size_t> start(block.start.begin(), block.start.end()),
        count(block.count.begin(), block.count.end());
    if (variable.type == NcType::kChar) {
        Buffer<char> text;
        PILEUS_TRY(text.resize(to.size, "text of a NetCDF file"));
        PILEUS_NC(nc.get_vara_text(handle, id, start.data(), count.data(), text.data()),
                  "variable " + variable.name);
        for (std::size_t i = 0; i < to.size; ++i)
            to[i] = double(static_cast<unsigned char>(text[i]));
        return Status::ok();
    }
    nc.set_var_chunk_cache(handle, id, std::size_t{kNcCacheBytes}, 1009, 0.75f);
    PILEUS_NC(nc.get_vara_double(handle, id, start.data(), count.data(), to.data),
              "variable " + variable.name);
    return Status::ok();
}

std::string netcdf_library_text() { return "NetCDF-4 yes"; }

#else

namespace {
Status not_built(const std::string& name) {
    return Status::bad_input(name +
                             ": NetCDF-4 on HDF5: not part of this build, allowed: a build "
                             "with libnetcdf (PILEUS_NETCDF), or a classic file "
                             "(nccopy -k cdf5)");
}
}  // namespace

Status open_hdf5(const std::string& path, int&) { return not_built(path); }
Status open_hdf5_bytes(const std::string& name, Span<const char>, int&) { return not_built(name); }
void close_hdf5(int) {}
Status read_hdf5_head(const std::string& name, int, NcHead&) { return not_built(name); }
Status read_hdf5(const std::string& name, int, const NcVariable&, const NcBlock&, Span<double>) {
    return not_built(name);
}
std::string netcdf_library_text() { return "NetCDF-4 no"; }

#endif

}  // namespace pileus
