// SPDX-License-Identifier: Apache-2.0
// The kernels that every library has, and the table of all. Compiled once per instruction set.
// in: the objects isa_GROUP.cpp of the same set -> out: kernel_table_ISA, null where a library is
// built without a group. docs/architecture.md, "Kernels: written once".
#include "kernels_cpu/display/march_background.h"
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/display/pixel_rows.h"
#include "kernels_cpu/media/self_test.h"
#define PILEUS_GROUP_Always 1
#include "kernels_cpu/isa/kernel_group.h"

#define PILEUS_QUOTE(name) #name
#define PILEUS_NAME(name) PILEUS_QUOTE(name)

namespace pileus {
namespace {

/// C++17 names no members in a list of values. Internal: an inline function would be a weak symbol.
constexpr KernelTable all_kernels() {
    KernelTable table{PILEUS_NAME(PILEUS_ISA), PILEUS_WIDTH};
#define PILEUS_CALL(name, Result, parameters, names, group, where) \
    PILEUS_UNLESS(PILEUS_WITHOUT_##group, table.name = PILEUS_OF_ISA(name);)
#define PILEUS_RANGE(name, Params, Buffers, group, where) \
    PILEUS_UNLESS(PILEUS_WITHOUT_##group, table.name = PILEUS_OF_ISA(name);)
#include "kernels_cpu/isa/kernel_list.h"
    return table;
}

}  // namespace

extern const KernelTable PILEUS_OF_ISA(kernel_table);
constexpr KernelTable PILEUS_OF_ISA(kernel_table) = all_kernels();

}  // namespace pileus
