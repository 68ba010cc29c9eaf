// SPDX-License-Identifier: Apache-2.0
// The signals that a thread holds back, without the headers of the system. Windows has none.
// in: nothing -> out: what was held back before.
#pragma once
#include <cstddef>

namespace pileus {

/// Room for a sigset_t.
struct SignalMask {
    alignas(std::max_align_t) unsigned char bytes[128] = {};
};

/// Both for this thread alone.
SignalMask block_all_signals();
void set_signals(const SignalMask& mask);

}  // namespace pileus
