// SPDX-License-Identifier: Apache-2.0
// A tree of boxes over triangles, split where the surface area heuristic finds it cheapest.
// in: triangles -> out: nodes from the root down, triangles in the order of the leaves.
// Wald 2007, "On fast construction of SAH-based bounding volume hierarchies" (bins);
// docs/solids.md. One thread, floats in one order: the same tree everywhere. Hits do not depend on
// it.
#include <algorithm>

#include "src/world/solids/solids.h"

namespace pileus {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kMaxInLeaf = 4;
constexpr int kSahDepth = 40;  // below: halves by number, at most 27 levels more
constexpr float kNodeCost = 1.0f;

struct Box {
    float low[3] = {3e38f, 3e38f, 3e38f}, high[3] = {-3e38f, -3e38f, -3e38f};

    void add(const float* p) {
        for (int a = 0; a < 3; ++a) {
            low[a] = p[a] < low[a] ? p[a] : low[a];
            high[a] = p[a] > high[a] ? p[a] : high[a];
        }
    }
    void add(const Box& b) {
        for (int a = 0; a < 3; ++a) {
            low[a] = b.low[a] < low[a] ? b.low[a] : low[a];
            high[a] = b.high[a] > high[a] ? b.high[a] : high[a];
        }
    }
    float area() const {
        const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
        return x < 0 ? 0 : x * y + y * z + z * x;
    }
};

/// What sorting moves about: a triangle's box and its place in the list.
struct Item {
    Box box;
    std::uint32_t triangle;

    float middle(int axis) const { return 0.5f * box.low[axis] + 0.5f * box.high[axis]; }
};

/// Items [begin, end), to become the node `at`.
struct Task {
    std::uint32_t begin, end;
    std::int32_t parent;  ///< whose second child this is; -1: none, it follows its parent
    int depth;
};

struct Split {
    int axis = -1;  ///< none: a leaf costs less
    int bin = 0;    ///< first of the second half
    float low = 0, per_unit = 0;

    int bin_of(const Item& item) const {
        const int i = int((item.middle(axis) - low) * per_unit);
        return i < 0 ? 0 : (i >= kBins ? kBins - 1 : i);
    }
};

/// The cheapest of all planes between bins along one axis, if it costs less than `best`.
void try_axis(Span<const Item> items, const Box& middles, int axis, float& best, Split& split) {
    const float extent = middles.high[axis] - middles.low[axis];
    if (!(extent > 0)) return;
    Split own;
    own.axis = axis;
    own.low = middles.low[axis];
    own.per_unit = float(kBins) / extent;
    if (!(own.per_unit < 3e38f)) return;
    Box boxes[kBins];
    std::uint32_t counts[kBins] = {};
    for (std::size_t i = 0; i < items.size; ++i) {
        const int bin = own.bin_of(items.data[i]);
        boxes[bin].add(items.data[i].box);
        ++counts[bin];
    }
    float right_cost[kBins] = {};
    Box sum;
    std::uint32_t count = 0;
    for (int i = kBins - 1; i > 0; --i) {
        sum.add(boxes[i]);
        count += counts[i];
        right_cost[i] = sum.area() * float(count);
    }
    sum = Box();
    count = 0;
    for (int i = 1; i < kBins; ++i) {
        sum.add(boxes[i - 1]);
        count += counts[i - 1];
        const float cost = sum.area() * float(count) + right_cost[i];
        if (count == 0 || count == items.size || !(cost < best)) continue;
        best = cost;
        split = own;
        split.bin = i;
    }
}

/// Where the first half ends; `end` makes a leaf of all.
std::uint32_t part(Span<Item> items, const Box& box, int depth, int& axis) {
    const std::uint32_t n = std::uint32_t(items.size);
    axis = 0;
    if (n <= 1) return n;
    Box middles;
    for (std::size_t i = 0; i < items.size; ++i) {
        const Item& item = items.data[i];
        const float p[3] = {item.middle(0), item.middle(1), item.middle(2)};
        middles.add(p);
    }
    float best = 3e38f;
    Split split;
    if (depth < kSahDepth)
        for (int a = 0; a < 3; ++a) try_axis({items.data, items.size}, middles, a, best, split);
    const float leaf = box.area() * (float(n) - kNodeCost);
    if (n <= kMaxInLeaf && (split.axis < 0 || !(best < leaf))) return n;
    if (split.axis < 0) return n / 2;  // all in one place, or too deep: halves by number
    axis = split.axis;
    Item* end = std::stable_partition(items.data, items.data + items.size,
                                      [&](const Item& i) { return split.bin_of(i) < split.bin; });
    return std::uint32_t(end - items.data);
}

Status gather_items(const Solids& solids, Buffer<Item>& items) {
    PILEUS_TRY(items.resize(solids.triangles.size(), "boxes of triangles"));
    for (std::size_t i = 0; i < items.size(); ++i) {
        Box box;
        for (const auto& corner : solids.triangles[i].corner) box.add(corner);
        items[i] = {box, std::uint32_t(i)};
    }
    return Status::ok();
}

/// Nodes in the order of a walk that takes the first child first; returns their number.
std::uint64_t make_nodes(Span<Item> items, Span<SolidNode> nodes) {
    Task stack[kSolidDepth + 2];
    int waiting = 0;
    std::uint64_t count = 0;
    stack[waiting++] = {0, std::uint32_t(items.size), -1, 0};
    while (waiting > 0) {
        const Task task = stack[--waiting];
        const std::int32_t at = std::int32_t(count++);
        if (task.parent >= 0) nodes.data[task.parent].next = at;
        const Span<Item> own{items.data + task.begin, task.end - task.begin};
        Box box;
        for (std::size_t i = 0; i < own.size; ++i) box.add(own.data[i].box);
        SolidNode& node = nodes.data[at];
        for (int a = 0; a < 3; ++a) node.low[a] = box.low[a], node.high[a] = box.high[a];
        int axis = 0;
        const std::uint32_t half = part(own, box, task.depth, axis);
        if (half == own.size) {
            node.next = std::int32_t(task.begin);
            node.count = std::int32_t(own.size);
            continue;
        }
        node.count = -axis;
        stack[waiting++] = {task.begin + half, task.end, at, task.depth + 1};
        stack[waiting++] = {task.begin, task.begin + half, -1, task.depth + 1};
    }
    return count;
}

}  // namespace

Status build_solid_tree(Solids& solids) {
    const std::uint64_t n = solids.triangles.size();
    if (n == 0) return Status::ok();
    Buffer<Item> items;
    PILEUS_TRY(gather_items(solids, items));
    PILEUS_TRY(solids.nodes.resize(2 * n - 1, "tree of solids"));
    solids.nodes.truncate(std::size_t(make_nodes(items.span(), solids.nodes.span())));
    Buffer<SolidTriangle> sorted;
    PILEUS_TRY(sorted.resize(n, "triangles"));
    for (std::size_t i = 0; i < items.size(); ++i) sorted[i] = solids.triangles[items[i].triangle];
    solids.triangles.swap(sorted);
    return Status::ok();
}

}  // namespace pileus
