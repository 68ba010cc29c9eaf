// SPDX-License-Identifier: Apache-2.0
// How the numbers of a variable are packed, and which of them are missing.
// in: a variable's attributes -> out: see netcdf_packing.h.
// CF conventions 1.10, sections 2.5.1 (missing data), 8.1 (packed data).
#include "src/io/netcdf/netcdf_packing.h"

namespace pileus {
namespace {

/// Takes the first number of an attribute, where there is one.
void take(const NcVariable& v, const char* name, double& value) {
    const NcAttribute* a = v.find(name);
    if (a != nullptr && !a->numbers.empty()) value = a->numbers[0];
}

}  // namespace

NcPacking::NcPacking(const NcVariable& v) : single(v.type == NcType::kFloat) {
    for (const char* name : {"_FillValue", "missing_value"})
        if (const NcAttribute* a = v.find(name))
            for (const double number : a->numbers) add(number);
    if (v.find("_FillValue") == nullptr) add_default(v.type);
    if (const NcAttribute* a = v.find("valid_range"))
        if (a->numbers.size() == 2) {
            least = a->numbers[0];
            most = a->numbers[1];
        }
    take(v, "valid_min", least);
    take(v, "valid_max", most);
    take(v, "scale_factor", scale);
    take(v, "add_offset", offset);
}

void NcPacking::add(double number) {
    constexpr double kMostFloat = 3.4028234663852886e38;
    if (number != number) {
        nan_is_missing = true;
        return;
    }
    // A mark that is written as a double stands for the float nearest to it.
    const bool rounds = single && number >= -kMostFloat && number <= kMostFloat;
    missing.push_back(rounds ? double(float(number)) : number);
}

/// What the library fills in where nothing was written.
void NcPacking::add_default(NcType type) {
    if (type == NcType::kFloat || type == NcType::kDouble) add(9.9692099683868690e+36);
    if (type == NcType::kShort) add(-32767);
    if (type == NcType::kInt) add(-2147483647);
}

bool NcPacking::is_missing(double number) const {
    if (number != number) return nan_is_missing;
    for (const double mark : missing)
        if (number == mark) return true;
    return number < least || number > most;
}

}  // namespace pileus
