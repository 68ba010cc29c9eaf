// SPDX-License-Identifier: Apache-2.0
// See processors.h. Windows has no groups of that kind.
#include "platform/team/processors.h"

#include <windows.h>

namespace pileus {

int allowed_processors() {
    DWORD_PTR own = 0, all = 0;
    int count = 0;
    // Both are 0 where a process has threads in several groups of 64 processors.
    if (::GetProcessAffinityMask(::GetCurrentProcess(), &own, &all))
        for (; own != 0; own &= own - 1) ++count;
    return count;
}

int group_processors(const std::string&) { return 0; }

}  // namespace pileus
