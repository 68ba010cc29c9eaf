// SPDX-License-Identifier: Apache-2.0
// The kernels that a user names: an instruction set of this processor, or a device beside it.
// in: what --isa says, or nothing -> out: a table whose self test has passed, or a line.
// docs/program.md; docs/crosscheck.md
#pragma once
#include "kernels_cpu/isa/kernels.h"
#include "src/base/status.h"

namespace pileus {

/// `name` empty: the widest instruction set. kBadInput: not in this build or on this machine.
Status find_kernels(const std::string& name, const KernelTable*& kernels);

/// kCheckFailed: the kernels give other bits than they must. Others: a device failed.
Status test_kernels(const KernelTable& kernels);

}  // namespace pileus
