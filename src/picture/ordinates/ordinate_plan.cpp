// SPDX-License-Identifier: Apache-2.0
// See ordinate_plan.h.
#include "src/picture/ordinates/ordinate_plan.h"

namespace pileus {

OrdinateSizes ordinate_sizes(const Medium& medium, const OrdinateNodes& made) {
    OrdinateSizes out;
    const bool known = !made.density.empty();
    out.nodes = known ? made.density.size() : max_ordinate_nodes(medium);
    out.filled = known ? made.filled.size() : out.nodes;
    out.samples = known ? made.samples.size() : max_ordinate_samples(medium);
    out.media = medium.count;
    out.channels = medium.channels;
    return out;
}

void add_ordinate_rows(const OrdinateSizes& s, MemoryTable& t) {
    add(t, arrays::ordinate_solution(s.filled, s.sets));
    add(t, arrays::ordinate_light(s.nodes, s.sets, s.numbers));
    add(t, arrays::ordinate_work(s.nodes));
    add(t, arrays::ordinate_parts(s.nodes, s.media));
    add(t, renamed(arrays::ordinate_parts(s.nodes, s.media), "ordinates: parts of the sun",
                   Stage::kShadow, Stage::kWrite));
    add(t, arrays::ordinate_part_work(s.filled, s.media));
    add(t, arrays::ordinate_densities(s.samples));
    add(t, arrays::ordinate_depths(s.sunlit ? s.samples : 0));
    add(t, arrays::ordinate_nodes(s.nodes, Stage::kWrite));
    add(t, renamed(arrays::ordinate_nodes(s.nodes, Stage::kShadow), "ordinates: numbers at work",
                   Stage::kShadow, Stage::kShadow));
    add(t, arrays::ordinate_places(s.filled, Stage::kWrite));
    add(t, renamed(arrays::ordinate_places(s.filled, Stage::kShadow), "ordinates: places at work",
                   Stage::kShadow, Stage::kShadow));
    add(t, arrays::ordinate_seen(s.solids ? s.nodes : 0));
    add(t, arrays::ordinate_own(s.filled, s.own));
    add(t, arrays::beam_tables(std::uint64_t(s.channels) * (s.points ? 2 : 1), Stage::kShadow));
}

}  // namespace pileus
