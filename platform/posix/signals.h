// SPDX-License-Identifier: Apache-2.0
// What a SignalMask is to the system.
#pragma once
#include <signal.h>

#include <cstring>

#include "platform/signal_mask.h"

namespace pileus {

static_assert(sizeof(sigset_t) <= sizeof(SignalMask));

inline SignalMask mask_of(const sigset_t& signals) {
    SignalMask mask;
    std::memcpy(mask.bytes, &signals, sizeof signals);
    return mask;
}
inline sigset_t signals_of(const SignalMask& mask) {
    sigset_t signals;
    std::memcpy(&signals, mask.bytes, sizeof signals);
    return signals;
}

}  // namespace pileus
