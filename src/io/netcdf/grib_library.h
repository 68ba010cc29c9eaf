// SPDX-License-Identifier: Apache-2.0
// ecCodes, loaded at run time, and one message of it. For grib_file.cpp alone.
// in: the bytes of a message that grib_message.h has checked -> out: its keys and values.
// ecCodes 2.20 and later (ECMWF)
#pragma once
#include <eccodes.h>

#include <string>

#include "src/base/dynamic_library.h"
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/io/netcdf/grib_fields.h"

namespace pileus {

struct GribLibrary {
    decltype(&::codes_handle_new_from_message_copy) open = nullptr;
    decltype(&::codes_handle_delete) drop = nullptr;
    decltype(&::codes_get_long) get_long = nullptr;
    decltype(&::codes_get_double) get_double = nullptr;
    decltype(&::codes_get_string) get_string = nullptr;
    decltype(&::codes_get_size) get_size = nullptr;
    decltype(&::codes_get_double_array) get_doubles = nullptr;
    decltype(&::codes_set_double) set_double = nullptr;
    decltype(&::codes_context_get_default) context = nullptr;
    decltype(&::codes_context_set_logging_proc) set_log = nullptr;
    decltype(&::codes_set_codes_assertion_failed_proc) set_assertion = nullptr;

    /// kBadInput: not there, lacks a function, or gave a message up before.
    Status load(const std::string& name);
};

/// Whether a message made ecCodes fail an assertion of its own. It would have ended the process;
/// instead the call is left where it stands. Locks may still be held then, so it gets no other.
bool grib_gave_up();

/// One message, freed with its owner. One thread at a time.
class GribMessage {
public:
    GribMessage(const GribLibrary& library, Span<const unsigned char> bytes);
    GribMessage(const GribMessage&) = delete;
    GribMessage& operator=(const GribMessage&) = delete;
    ~GribMessage();

    bool is_there() const { return handle_ != nullptr; }
    long whole(const char* key, long fallback) const;
    double number(const char* key, double fallback) const;
    std::string text(const char* key) const;
    std::size_t size(const char* key) const;
    bool numbers(const char* key, Span<double> to) const;
    void mark_missing() const;

private:
    const GribLibrary& codes_;
    codes_handle* handle_ = nullptr;
};

}  // namespace pileus
