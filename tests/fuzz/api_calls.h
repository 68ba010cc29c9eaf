// SPDX-License-Identifier: Apache-2.0
// What targets share that call functions of pileus.h in any order.
// in: bytes, read as calls -> out: the promises of every call.
// docs/embedding.md
#pragma once
#include <cstring>

#include "include/pileus/pileus.h"
#include "tests/fuzz/arguments.h"
#include "tests/fuzz/target.h"

namespace fuzz {

class ApiCalls : public Arguments {
public:
    using Arguments::Arguments;

protected:
    pileus_error* fault() {
        error_ = pileus_error_default();
        return &error_;
    }
    /// What every call promises.
    void check(pileus_code code) const {
        require(code >= PILEUS_OK && code <= PILEUS_ERROR_IO, "a code of the header");
        require(error_.code == code, "the error has the code");
        require((code == PILEUS_OK) == (error_.message[0] == 0), "a fault has a line");
        require(std::memchr(error_.message, 0, sizeof error_.message) != nullptr, "a line ends");
    }
    /// One of these, by the next byte.
    template <class Own, std::size_t N>
    void call_one(Own& own, void (Own::*const (&calls)[N])()) {
        (own.*calls[byte() % N])();
    }

private:
    pileus_error error_{};
};

/// Calls until the bytes end, or there were so many.
template <class Calls>
int run_calls(const std::uint8_t* data, std::size_t size, int most) {
    Calls calls(data, size);
    for (int i = 0; i < most && !calls.done(); ++i) calls.next();
    return 0;
}

}  // namespace fuzz
