// SPDX-License-Identifier: Apache-2.0
// See grib_library.h.
#if PILEUS_WITH_ECCODES
#include "src/io/netcdf/grib_library.h"

#include <csetjmp>

namespace pileus {
namespace {

/// Where a failed assertion of ecCodes goes on; grib_file.cpp lets in one thread at a time.
std::jmp_buf way_out;
bool gave_up = false;

[[noreturn]] void on_assertion(const char*) { std::longjmp(way_out, 1); }

/// Makes a call of ecCodes; false where it gave up, now or before. No object of ours may live
/// between here and the library.
template <class Call>
[[gnu::noinline]] bool make_call(const Call& call) {
    if (gave_up) return false;
    if (setjmp(way_out) != 0) {
        gave_up = true;
        return false;
    }
    call();
    return true;
}

}  // namespace

bool grib_gave_up() { return gave_up; }

Status GribLibrary::load(const std::string& name) {
    if (gave_up)
        return Status::bad_input(name +
                                 ": GRIB: ecCodes gave up on a damaged file before, allowed: "
                                 "another process");
    DynamicLibrary library("libeccodes.so.0");
    if (!library.is_there())
        return Status::bad_input(name +
                                 ": GRIB: the library libeccodes.so.0 is not there, allowed: "
                                 "install it, or NetCDF (grib_to_netcdf)");
    library.find("codes_handle_new_from_message_copy", open);
    library.find("codes_handle_delete", drop);
    library.find("codes_get_long", get_long);
    library.find("codes_get_double", get_double);
    library.find("codes_get_string", get_string);
    library.find("codes_get_size", get_size);
    library.find("codes_get_double_array", get_doubles);
    library.find("codes_set_double", set_double);
    library.find("codes_context_get_default", context);
    library.find("codes_context_set_logging_proc", set_log);
    library.find("codes_set_codes_assertion_failed_proc", set_assertion);
    if (!library.is_whole())
        return Status::bad_input(name + ": GRIB: libeccodes.so.0 lacks a function");
    // A fault is one line, and it is ours.
    set_log(context(), [](const codes_context*, int, const char*) {});
    set_assertion(on_assertion);
    return Status::ok();
}

GribMessage::GribMessage(const GribLibrary& library, Span<const unsigned char> bytes)
    : codes_(library) {
    make_call([&] { handle_ = codes_.open(nullptr, bytes.data, bytes.size); });
    if (gave_up) handle_ = nullptr;
}
GribMessage::~GribMessage() {
    if (handle_ != nullptr) make_call([&] { codes_.drop(handle_); });
}

long GribMessage::whole(const char* key, long fallback) const {
    long value = 0;
    int code = 1;
    make_call([&] { code = codes_.get_long(handle_, key, &value); });
    return code == 0 ? value : fallback;
}
double GribMessage::number(const char* key, double fallback) const {
    double value = 0;
    int code = 1;
    make_call([&] { code = codes_.get_double(handle_, key, &value); });
    return code == 0 ? value : fallback;
}
std::string GribMessage::text(const char* key) const {
    char value[256] = {};
    std::size_t length = sizeof value;
    int code = 1;
    make_call([&] { code = codes_.get_string(handle_, key, value, &length); });
    return code == 0 ? printable_line(value) : "";
}
std::size_t GribMessage::size(const char* key) const {
    std::size_t count = 0;
    int code = 1;
    make_call([&] { code = codes_.get_size(handle_, key, &count); });
    return code == 0 ? count : 0;
}
bool GribMessage::numbers(const char* key, Span<double> to) const {
    std::size_t count = to.size;
    int code = 1;
    make_call([&] { code = codes_.get_doubles(handle_, key, to.data, &count); });
    return code == 0 && count == to.size;
}
void GribMessage::mark_missing() const {
    make_call([&] { (void)codes_.set_double(handle_, "missingValue", kGribMissing); });
}

}  // namespace pileus
#endif
