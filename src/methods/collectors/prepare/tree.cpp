// SPDX-License-Identifier: Apache-2.0
// See tree.h.
// in: samples, densities -> out: leaves as boxes of whole voxels that tile the grid.
// Elek 2011, section 5.3: three presorted lists kept sorted by stable partition.
#include "src/methods/collectors/prepare/tree.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "platform/threads.h"
#include "src/methods/collectors/prepare/leaf_list.h"

namespace pileus {
namespace {

struct Node {
    VoxelBox box;
    std::uint32_t begin, end;  ///< of the samples in every one of the three lists
};

struct Split {
    int axis = -1;
    std::int32_t face = 0;
    std::uint32_t middle = 0;  ///< first sample of the upper half in the list of `axis`
    double cost = 0;           ///< summed squared deviation of both halves
    double edge_m = 0;         ///< breaks ties: the longer edge is split
};

struct SortKey {
    std::uint32_t bits, sample;
};

template <class T>
Array<T> sorted_list(std::uint64_t count) {
    return {"sorted lists of samples", count, Stage::kTree, Stage::kTree};
}

/// Two for each axis: radix sort moves from one to the other.
Array<SortKey> sort_keys(std::uint64_t samples) {
    return sorted_list<SortKey>(bytes_of(2, samples));
}

/// A split shortens one edge by a voxel or more, so depth is bounded by the sum of the edges; the
/// walk keeps one waiting half per level.
Array<Node> node_stack(const Grid& grid) {
    std::uint64_t depth = 2;
    for (int n : grid.size) depth += std::uint64_t(n);
    return {"stack of the tree", depth, Stage::kTree, Stage::kTree};
}

/// Lists the samples by coordinate, then by index: by the bits of the coordinate, which rise with
/// any number >= 0, eleven at a time from the lowest. `keys` has room for 2 `count`.
void sort_axis(const float* x, std::uint32_t count, SortKey* keys, std::uint32_t* order) {
    constexpr int kBits = 11, kDigits = 3;
    constexpr std::uint32_t kValues = 1u << kBits;
    std::uint32_t start[kDigits][kValues] = {};
    SortKey *from = keys, *to = keys + count;
    for (std::uint32_t s = 0; s < count; ++s) {
        std::memcpy(&from[s].bits, x + s, sizeof from[s].bits);
        from[s].sample = s;
        for (int d = 0; d < kDigits; ++d) ++start[d][from[s].bits >> (d * kBits) & (kValues - 1)];
    }
    for (int d = 0; d < kDigits; ++d) {
        std::uint32_t sum = 0;
        for (std::uint32_t& n : start[d]) n = std::exchange(sum, sum + n);
        for (std::uint32_t s = 0; s < count; ++s)
            to[start[d][from[s].bits >> (d * kBits) & (kValues - 1)]++] = from[s];
        std::swap(from, to);
    }
    for (std::uint32_t s = 0; s < count; ++s) order[s] = from[s].sample;
}

/// The samples by axis, and the three lists of their indices sorted along each axis.
class SampleLists {
public:
    Status sort(Span<const Sample> samples, int threads);
    Status build(const Grid& grid, float density_range, LeafList& leaves);

private:
    bool wants_split(const Node& node, float density_range) const;
    SampleBounds bounds(const Node& node) const;
    Split best_split(const Node& node, const Grid& grid) const;
    Split split_on(const Node& node, int axis, double sum, double square) const;
    void partition(const Node& node, const Split& split);

    std::uint32_t count_ = 0;
    Buffer<float> x_[3], density_;
    Buffer<std::uint32_t> order_[3], scratch_;
    Buffer<std::uint8_t> upper_;
};

Status SampleLists::sort(Span<const Sample> samples, int threads) {
    if (samples.size > 0x7fffffffu) return Status::limit("kD-tree: more than 2147483647 samples");
    count_ = std::uint32_t(samples.size);
    Buffer<SortKey> keys[3];
    PILEUS_TRY(allocate(sorted_list<float>(count_), density_));
    PILEUS_TRY(allocate(sorted_list<std::uint32_t>(count_), scratch_));
    PILEUS_TRY(allocate(sorted_list<std::uint8_t>(count_), upper_));
    for (int a = 0; a < 3; ++a) {
        PILEUS_TRY(allocate(sorted_list<float>(count_), x_[a]));
        PILEUS_TRY(allocate(sorted_list<std::uint32_t>(count_), order_[a]));
        PILEUS_TRY(allocate(sort_keys(count_), keys[a]));
    }
    for (std::uint32_t s = 0; s < count_; ++s) density_[s] = samples[s].density;
    parallel_for(threads, 3, [&](std::int64_t a, int) {
        for (std::uint32_t s = 0; s < count_; ++s) x_[a][s] = samples[s].x[a];
        sort_axis(x_[a].data(), count_, keys[a].data(), order_[a].data());
    });
    return Status::ok();
}

bool SampleLists::wants_split(const Node& node, float density_range) const {
    if (node.end - node.begin < 2) return false;
    float low = density_[order_[0][node.begin]], high = low;
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const float d = density_[order_[0][i]];
        low = d < low ? d : low;
        high = d > high ? d : high;
    }
    return !(high - low < density_range);
}

SampleBounds SampleLists::bounds(const Node& node) const {
    SampleBounds b{};
    for (int a = 0; a < 3; ++a) {
        b.lo[a] = x_[a][order_[a][node.begin]];
        b.hi[a] = x_[a][order_[a][node.end - 1]];
    }
    return b;
}

/// Splits at the median of one axis, snapped to the nearest voxel face strictly inside.
Split SampleLists::split_on(const Node& node, int axis, double sum, double square) const {
    const std::uint32_t* list = order_[axis].data();
    const float* x = x_[axis].data();
    const std::uint32_t half = (node.end - node.begin) / 2;
    const float above = x[list[node.begin + half]];
    const float below = x[list[node.end - 1 - half]];
    const float median = 0.5f * (below + above);
    Split split;
    split.axis = axis;
    split.face = std::int32_t(median + 0.5f);
    split.face = std::max(split.face, node.box.lo[axis] + 1);
    split.face = std::min(split.face, node.box.hi[axis] - 1);
    const float face = float(split.face);
    const std::uint32_t* middle = std::partition_point(
        list + node.begin, list + node.end, [&](std::uint32_t s) { return x[s] < face; });
    split.middle = std::uint32_t(middle - list);

    // Variance times count of a half is the sum of squares less the square of the sum over count.
    double low_sum = 0, low_square = 0;
    for (std::uint32_t i = node.begin; i < split.middle; ++i) {
        const double d = double(density_[list[i]]);
        low_sum += d;
        low_square += d * d;
    }
    const double low = double(split.middle - node.begin), high = double(node.end - split.middle);
    const double high_sum = sum - low_sum, high_square = square - low_square;
    if (low > 0) split.cost += low_square - low_sum * low_sum / low;
    if (high > 0) split.cost += high_square - high_sum * high_sum / high;
    return split;
}

Split SampleLists::best_split(const Node& node, const Grid& grid) const {
    double sum = 0, square = 0;
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const double d = double(density_[order_[0][i]]);
        sum += d;
        square += d * d;
    }
    Split best;
    for (int a = 0; a < 3; ++a) {
        const std::int32_t edge = node.box.hi[a] - node.box.lo[a];
        if (edge < 2) continue;
        Split split = split_on(node, a, sum, square);
        split.edge_m = double(edge) * double(grid.cell_m[a]);
        const bool better =
            split.cost < best.cost || (!(best.cost < split.cost) && split.edge_m > best.edge_m);
        if (best.axis < 0 || better) best = split;
    }
    return best;
}

/// Moves the samples beyond the plane to the end of each list, keeping the order on both sides.
void SampleLists::partition(const Node& node, const Split& split) {
    for (std::uint32_t i = node.begin; i < node.end; ++i)
        upper_[order_[split.axis][i]] = i >= split.middle;
    for (int a = 0; a < 3; ++a) {
        if (a == split.axis) continue;
        std::uint32_t* list = order_[a].data();
        std::uint32_t low = node.begin, high = 0;
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const std::uint32_t s = list[i];
            const std::uint32_t up = upper_[s];
            // Write both ways, advance one: no branch to mispredict.
            list[low] = s;
            scratch_[high] = s;
            low += 1u - up;
            high += up;
        }
        std::copy(scratch_.data(), scratch_.data() + high, list + low);
    }
}

Status SampleLists::build(const Grid& grid, float density_range, LeafList& leaves) {
    Buffer<Node> stack;
    PILEUS_TRY(allocate(node_stack(grid), stack));
    std::size_t waiting = 0;
    stack[waiting++] = {{{0, 0, 0}, {grid.size[0], grid.size[1], grid.size[2]}}, 0, count_};
    while (waiting > 0) {
        const Node node = stack[--waiting];
        Split split;
        if (wants_split(node, density_range)) split = best_split(node, grid);
        if (split.axis < 0) {
            PILEUS_TRY(node.begin == node.end ? leaves.add(node.box)
                                              : leaves.add_with_samples(node.box, bounds(node)));
            continue;
        }
        partition(node, split);
        Node low = node, high = node;
        low.box.hi[split.axis] = high.box.lo[split.axis] = split.face;
        low.end = high.begin = split.middle;
        stack[waiting++] = high;
        stack[waiting++] = low;
    }
    return Status::ok();
}

}  // namespace

void add_tree_rows(const Grid& grid, std::uint64_t samples, std::uint64_t leaves,
                   MemoryTable& table) {
    // Three lists of coordinates, indices and keys; densities, scratch and sides once.
    add(table, several(4, sorted_list<float>(samples)),
        several(4, sorted_list<std::uint32_t>(samples)), several(3, sort_keys(samples)),
        sorted_list<std::uint8_t>(samples));
    add(table, arrays::growing_leaves(2 * leaves + 1024));
    add(table, node_stack(grid));
}

Status build_tree(Span<const Sample> samples, Span<const float> density, const Grid& grid,
                  const TreeOptions& options, int threads, Buffer<Leaf>& leaves) {
    assert(density.size == voxel_count(grid));
    SampleLists lists;
    PILEUS_TRY(lists.sort(samples, threads));
    LeafList list(density, grid, options);
    PILEUS_TRY(lists.build(grid, options.density_range, list));
    return list.take(leaves);
}

}  // namespace pileus
