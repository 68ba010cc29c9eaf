// SPDX-License-Identifier: Apache-2.0
// The table of limits, and the words about them.
// in: names and numbers -> out: see limits.h.
// docs/program.md, "Limits".
#include "src/base/limits.h"

#include <charconv>

namespace pileus {
namespace {

constexpr std::uint64_t two_to(int power) { return std::uint64_t{1} << power; }

constexpr LimitRow kRows[kLimitCount] = {
    {"text", two_to(20), two_to(20), "bytes", "text of the scene"},
    {"media", 8, 8, "", "media in a scene, each colour of a transfer function one"},
    {"file", two_to(34), two_to(46), "bytes", "length of one file of a medium"},
    {"side", 4096, 4096, "cells", "cells along one side of a medium"},
    {"voxels", two_to(31), two_to(31), "cells", "cells of all media together"},
    {"samples", 10'000'000, 10'000'000, "", "sample points of the collectors"},
    {"leaves", 0, two_to(31) - 1, "", "leaves of the tree; 0: what the plan expects at most"},
    {"photons", two_to(30), two_to(31) - 1, "", "photons in all, those of every frame added up"},
    {"generations", 1000, 1000, "", "generations in the ring"},
    {"pixels", two_to(26), two_to(28), "", "pixels of one picture"},
    {"frames", 100'000, 1'000'000, "", "frames of an animation"},
    {"memory", two_to(33), two_to(46), "bytes", "peak of the planned arrays"},
    {"scatterings", 2000, two_to(40), "", "expected scatterings of one photon"},
    {"work", 1'000'000'000'000, two_to(60), "", "expected scatterings of all photons"},
    {"triangles", 10'000'000, 100'000'000, "", "triangles of all solid meshes"},
};

std::string with_unit(std::uint64_t number, const char* unit) {
    return std::to_string(number) + (unit[0] != '\0' ? " " : "") + unit;
}

std::string all_names() {
    std::string names;
    for (const LimitRow& row : kRows) names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names;
}

/// What a suffix stands for; 0: no such suffix.
std::uint64_t factor_of(const std::string& suffix) {
    static const char letters[] = {'k', 'M', 'G', 'T'};
    if (suffix.empty()) return 1;
    const bool binary = suffix.size() == 2 && suffix[1] == 'i';
    if (suffix.size() > 2 || (suffix.size() == 2 && !binary)) return 0;
    std::uint64_t factor = 1;
    for (const char letter : letters) {
        factor *= binary ? 1024 : 1000;
        if (suffix[0] == letter || (binary && letter == 'k' && suffix[0] == 'K')) return factor;
    }
    return 0;
}

}  // namespace

const LimitRow& limit_row(LimitId id) { return kRows[std::size_t(id)]; }

Limits::Limits() : value{} {
    for (std::size_t i = 0; i < kLimitCount; ++i) value[i] = kRows[i].fallback;
}

Status check_limit(const Limits& limits, LimitId id, std::uint64_t needed,
                   const std::string& where) {
    const LimitRow& row = limit_row(id);
    if (needed <= limits[id]) return Status::ok();
    const std::string remedy = limits[id] < row.most
                                   ? std::string(" (--limit ") + row.name + "=...)"
                                   : std::string(" (no switch raises it)");
    return Status::limit(where + ": limits." + row.name + ": needs " + with_unit(needed, row.unit) +
                         ", allowed: at most " + with_unit(limits[id], row.unit) + remedy);
}

Status set_limit(const std::string& text, Limits& limits) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    for (std::size_t i = 0; i < kLimitCount; ++i) {
        const LimitRow& row = kRows[i];
        if (name != row.name) continue;
        const std::string amount = equals == std::string::npos ? "" : text.substr(equals + 1);
        std::uint64_t number = 0, product = 0;
        const char* end = amount.data() + amount.size();
        const std::from_chars_result read = std::from_chars(amount.data(), end, number);
        const std::uint64_t factor = factor_of(std::string(read.ptr, end));
        const bool good = read.ec == std::errc() && factor > 0 &&
                          !__builtin_mul_overflow(number, factor, &product) && product <= row.most;
        if (!good)
            return Status::bad_input("--limit " + name + ": no number in range, \"" + amount +
                                     "\", allowed: 0 to " + std::to_string(row.most));
        limits.value[i] = product;
        return Status::ok();
    }
    return Status::bad_input("--limit: no such limit, \"" + name + "\", allowed: " + all_names());
}

std::string describe_limits() {
    std::string lines;
    for (const LimitRow& row : kRows) {
        std::string line = std::string("  ") + row.name;
        line.resize(16, ' ');
        lines += line + std::to_string(row.fallback) + " (at most " + std::to_string(row.most) +
                 "): " + row.what + "\n";
    }
    return lines;
}

}  // namespace pileus
