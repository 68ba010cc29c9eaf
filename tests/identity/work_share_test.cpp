// SPDX-License-Identifier: Apache-2.0
// The runs of all parts are each number once, in order, and a run is found from any number in it.
// in: counts, widths, numbers of parts -> out: exact ranges. docs/farm.md
#include "src/run/work_share.h"

#include <doctest/doctest.h>

#include <vector>

using namespace pileus;

TEST_CASE("every number is in one run of one part, and a run is found from each number in it") {
    for (const std::uint64_t width : {0u, 1u, 3u, 16u})
        for (const std::uint64_t count : {0u, 1u, 5u, 255u, 256u, 384u, 1000u})
            for (const std::uint32_t parts : {1u, 2u, 3u, 7u}) {
                CAPTURE(width);
                CAPTURE(count);
                CAPTURE(parts);
                std::vector<int> taken(count, 0);
                for (std::uint32_t p = 0; p < parts; ++p) {
                    const WorkPart part{p, parts, true};
                    std::uint64_t last = 0;
                    each_owned_run(count, width, part, [&](const PartRange& own) {
                        REQUIRE(own.begin >= last);
                        REQUIRE(own.end <= count);
                        last = own.end;
                        for (std::uint64_t i = own.begin; i < own.end; ++i) {
                            ++taken[i];
                            const PartRange from = owned_run(count, width, part, i);
                            REQUIRE(from.begin == own.begin);
                            REQUIRE(from.end == own.end);
                        }
                    });
                }
                for (const int times : taken) REQUIRE(times == 1);
                const PartRange none = owned_run(count, width, {parts, parts, true}, 0);
                CHECK(none.begin == none.end);
            }
}
