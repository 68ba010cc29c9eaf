// SPDX-License-Identifier: Apache-2.0
// See find_kernels.h.
// in: a name -> out: a table of constants.
// docs/program.md; docs/crosscheck.md
#include "src/run/find_kernels.h"

#include "platform/device.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"

namespace pileus {
namespace {

#if defined(PILEUS_WITH_CUDA)
constexpr DeviceTable kCudaDevice{&cuda_functions, &cuda_kernels};
constexpr KernelTable kCudaTable{"cuda", 1, &kCudaDevice};
constexpr const KernelTable* kCuda = &kCudaTable;
#else
constexpr const KernelTable* kCuda = nullptr;
#endif

/// Names of this machine, a device among them only where there is one.
std::string names_here() {
    std::string names, ignored;
    for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i)
        names += (i > 0 ? ", " : "") + std::string(table->name);
    return has_cuda_device(ignored) ? names + ", cuda" : names;
}

}  // namespace

Status find_kernels(const std::string& name, const KernelTable*& kernels) {
    const bool cuda = name == "cuda";
    std::string why;
    if (cuda && has_cuda_device(why)) {
        kernels = kCuda;
        return Status::ok();
    }
    kernels = cuda ? nullptr : kernel_table(name.empty() ? nullptr : name.c_str());
    if (kernels != nullptr) return Status::ok();
    if (!cuda) why = "no such instruction set here, \"" + printable_line(name) + "\"";
    return Status::bad_input("--isa: " + (cuda ? "\"cuda\": " + why : why) +
                             ", allowed: " + names_here());
}

Status test_kernels(const KernelTable& kernels) {
    std::uint64_t digest = 0;
    if (on_device(kernels.device))
        PILEUS_TRY(self_test_on_device(*kernels.device, digest));
    else
        digest = kernels.self_test();
    if (digest == expected_self_test()) return Status::ok();
    return Status{Code::kCheckFailed,
                  "self test: the kernels give other bits than they must on this machine"};
}

}  // namespace pileus
