// SPDX-License-Identifier: Apache-2.0
// See particle_tree.h.
#include "src/world/particles/particle_tree.h"

#include <algorithm>
#include <cstring>

#include "platform/threads.h"

namespace pileus {
namespace {

constexpr int kDigit = 11, kDigits = 1 << kDigit;

/// A particle's place along a curve that visits boxes within boxes, and its number.
struct Item {
    std::uint64_t code;
    std::uint32_t number;
};

/// Bits of v, two zeros between each.
std::uint64_t spread(std::uint64_t v) {
    v &= 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffffull;
    v = (v | v << 16) & 0x1f0000ff0000ffull;
    v = (v | v << 8) & 0x100f00f00f00f00full;
    v = (v | v << 4) & 0x10c30c30c30c30c3ull;
    return (v | v << 2) & 0x1249249249249249ull;
}

class Builder {
public:
    Builder(const ParticleSet& set, const Double3& low, int most_in_leaf, int threads,
            ParticleTree& tree)
        : set_(set),
          low_(low),
          threads_(threads),
          most_in_leaf_(std::uint32_t(most_in_leaf)),
          tree_(tree) {}

    Status build() {
        PILEUS_TRY(items_.resize(set_.count, "order of particles"));
        PILEUS_TRY(other_.resize(set_.count, "order of particles"));
        set_codes();
        sort_by_code();
        sort_equal_codes();
        other_ = Buffer<Item>();
        PILEUS_TRY(merge());
        PILEUS_TRY(allocate(arrays::particle_balls(count_), tree_.balls));
        parallel_each(threads_, count_, [&](std::size_t i) { tree_.balls[i] = ball_of(i); });
        PILEUS_TRY(sort_vectors(set_.velocity, tree_.velocity));
        PILEUS_TRY(sort_vectors(set_.colour, tree_.colour));
        PILEUS_TRY(sort_vectors(set_.emission, tree_.emission));
        if (!set_.id.empty()) {
            PILEUS_TRY(allocate(arrays::particle_numbers(count_), tree_.id));
            parallel_each(threads_, count_,
                          [&](std::size_t i) { tree_.id[i] = set_.id[items_[i].number]; });
        }
        PILEUS_TRY(count_nodes());
        make_boxes();
        return Status::ok();
    }

private:
    /// In the order of the balls.
    Status sort_vectors(const Buffer<float>& from, Buffer<float>& to) const {
        if (from.empty()) return Status::ok();
        PILEUS_TRY(allocate(arrays::particle_vectors(count_), to));
        parallel_each(threads_, count_, [&](std::size_t i) {
            for (std::size_t a = 0; a < 3; ++a) to[3 * i + a] = from[3 * items_[i].number + a];
        });
        return Status::ok();
    }
    double place(std::size_t i, int axis) const {
        return set_.origin[axis] + double(set_.position[3 * i + std::size_t(axis)]) - low_[axis];
    }
    ParticleBall ball_of(std::size_t item) const {
        const std::size_t i = items_[item].number;
        const float radius = set_.radius[i];
        const float density = merged_.empty() ? set_.density[i] : merged_[item];
        return {{float(place(i, 0)), float(place(i, 1)), float(place(i, 2))},
                1.0f / radius,
                density * radius};
    }
    /// Particles that differ in nothing but their density are one: as they are sorted, a million in
    /// one place would else meet each other.
    Status merge() {
        count_ = set_.count;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < set_.count; ++i)
            kept += i == 0 || compare(items_[i - 1].number, items_[i].number) != 0 ? 1 : 0;
        if (kept == set_.count) return Status::ok();
        PILEUS_TRY(merged_.resize(kept, "order of particles"));
        std::size_t to = 0;
        for (std::size_t i = 0; i < set_.count; ++to) {
            double sum = 0;
            const std::size_t first = i;
            do sum += double(set_.density[items_[i++].number]);
            while (i < set_.count && compare(items_[first].number, items_[i].number) == 0);
            items_[to] = items_[first];
            merged_[to] = float(sum);
        }
        count_ = kept;
        return Status::ok();
    }
    /// Below 0, 0, above 0: how vectors of two particles compare.
    int compare(const Buffer<float>& vectors, std::uint32_t a, std::uint32_t b) const {
        for (std::size_t k = 0; k < 3 && !vectors.empty(); ++k)
            if (vectors[3 * a + k] != vectors[3 * b + k])
                return vectors[3 * a + k] < vectors[3 * b + k] ? -1 : 1;
        return 0;
    }
    /// The same of all but their densities.
    int compare(std::uint32_t a, std::uint32_t b) const {
        if (const int order = compare(set_.position, a, b)) return order;
        if (set_.radius[a] != set_.radius[b]) return set_.radius[a] < set_.radius[b] ? -1 : 1;
        for (const Buffer<float>* vectors : {&set_.velocity, &set_.colour, &set_.emission})
            if (const int order = compare(*vectors, a, b)) return order;
        return 0;
    }
    void set_codes() {
        double side = 0;
        for (int a = 0; a < 3; ++a) side = std::max(side, set_.high[a] - set_.low[a]);
        constexpr double kCells = 1 << kParticleLevels;
        const double scale = side > 0 ? kCells / side : 0;
        parallel_each(threads_, set_.count, [&](std::size_t i) {
            std::uint64_t code = 0;
            for (int a = 0; a < 3; ++a) {
                const double at = (place(i, a) + (low_[a] - set_.low[a])) * scale;
                const double cell = std::min(std::max(at, 0.0), kCells - 1);
                code |= spread(std::uint64_t(cell)) << a;
            }
            items_[i] = {code, std::uint32_t(i)};
        });
    }
    /// Digit by digit, the lowest first; each pass keeps the order of the one before.
    void sort_by_code() {
        std::vector<std::size_t> begin(kDigits);
        for (int shift = 0; shift < 3 * kParticleLevels; shift += kDigit) {
            const auto digit = [&](const Item& item) {
                return std::size_t(item.code >> shift) & (kDigits - 1);
            };
            std::fill(begin.begin(), begin.end(), 0);
            for (const Item& item : items_.span()) ++begin[digit(item)];
            std::size_t sum = 0;
            for (std::size_t& b : begin) {
                const std::size_t count = b;
                b = sum;
                sum += count;
            }
            for (const Item& item : items_.span()) other_[begin[digit(item)]++] = item;
            items_.swap(other_);
        }
    }
    /// By the particles' own numbers, so that the order in the file is forgotten.
    void sort_equal_codes() {
        for (std::size_t i = 0; i < set_.count;) {
            std::size_t end = i + 1;
            while (end < set_.count && items_[end].code == items_[i].code) ++end;
            if (end > i + 1)
                std::sort(items_.data() + i, items_.data() + end,
                          [&](const Item& a, const Item& b) { return before(a.number, b.number); });
            i = end;
        }
    }
    bool before(std::uint32_t a, std::uint32_t b) const {
        const int order = compare(a, b);
        if (order != 0) return order < 0;
        if (set_.density[a] != set_.density[b]) return set_.density[a] < set_.density[b];
        return !set_.id.empty() && set_.id[a] < set_.id[b];
    }

    /// Nodes in the order of a walk: first counted, then made.
    Status count_nodes() {
        std::uint64_t count = 0;
        walk([&](std::uint32_t, std::uint32_t, int) { return count++; }, [](std::uint64_t) {});
        PILEUS_TRY(tree_.nodes.resize(count + 1, arrays::particle_nodes(0).name));
        std::uint64_t made = 0;
        walk(
            [&](std::uint32_t first, std::uint32_t, int level) {
                tree_.nodes[made].first = std::int32_t(first);
                tree_.depth = std::max(tree_.depth, kParticleLevels - level);
                return made++;
            },
            [&](std::uint64_t node) { tree_.nodes[node].skip = std::int32_t(made); });
        tree_.nodes[count].first = std::int32_t(count_);
        tree_.nodes[count].skip = std::int32_t(count);
        return Status::ok();
    }

    struct Open {
        std::uint32_t begin, end;  ///< items not yet handed to children
        std::uint64_t node;
        int level;  ///< bits of a place that are left
    };
    /// Calls enter(first item, end, bits left), which returns the node's number, and leave(number).
    template <class Enter, class Leave>
    void walk(Enter enter, Leave leave) const {
        Open stack[kParticleLevels + 2];
        int depth = 0;
        const std::uint32_t all = std::uint32_t(count_);
        stack[depth++] = {0, all, enter(0, all, kParticleLevels), kParticleLevels};
        if (all <= most_in_leaf_) stack[0].begin = all;
        part(stack[0]);
        while (depth > 0) {
            Open& top = stack[depth - 1];
            if (top.begin == top.end) {
                leave(top.node);
                --depth;
                continue;
            }
            const std::uint32_t end = child_end(top);
            Open child{top.begin, end, 0, top.level - 1};
            top.begin = end;
            child.node = enter(child.begin, child.end, child.level);
            if (child.end - child.begin <= most_in_leaf_) child.begin = child.end;
            part(child);
            stack[depth++] = child;
        }
    }
    /// Goes down to the level at which the items differ; none: a leaf.
    void part(Open& node) const {
        while (node.begin < node.end && node.level > 0 && child_end(node) == node.end) --node.level;
        if (node.level == 0) node.begin = node.end;
    }
    /// Where the items of the first child end.
    std::uint32_t child_end(const Open& node) const {
        const int shift = 3 * (node.level - 1);
        const std::uint64_t digits = items_[node.begin].code >> shift;
        if (items_[node.end - 1].code >> shift == digits) return node.end;
        const Item* found =
            std::partition_point(items_.data() + node.begin, items_.data() + node.end,
                                 [&](const Item& i) { return i.code >> shift <= digits; });
        return std::uint32_t(found - items_.data());
    }

    /// From the last to the first, so that children come before their parents.
    void make_boxes() {
        for (std::int32_t at = tree_.count() - 1; at >= 0; --at) {
            ParticleNode& node = tree_.nodes[std::size_t(at)];
            for (int a = 0; a < 3; ++a) node.low[a] = 3e38f, node.high[a] = -3e38f;
            if (node.skip == at + 1) {
                ++tree_.leaves;
                const std::int32_t end = tree_.nodes[std::size_t(at) + 1].first;
                for (std::int32_t i = node.first; i < end; ++i)
                    add(tree_.balls[std::size_t(i)], node);
                continue;
            }
            for (std::int32_t child = at + 1; child < node.skip;
                 child = tree_.nodes[std::size_t(child)].skip)
                add(tree_.nodes[std::size_t(child)], node);
        }
    }
    static void add(const ParticleNode& child, ParticleNode& node) {
        for (int a = 0; a < 3; ++a) {
            node.low[a] = std::min(node.low[a], child.low[a]);
            node.high[a] = std::max(node.high[a], child.high[a]);
        }
    }
    static void add(const ParticleBall& ball, ParticleNode& node) {
        // A millionth more than rounding can take.
        const float radius = 1.000001f / ball.per_radius;
        for (int a = 0; a < 3; ++a) {
            node.low[a] = std::min(node.low[a], ball.centre[a] - radius);
            node.high[a] = std::max(node.high[a], ball.centre[a] + radius);
        }
    }

    const ParticleSet& set_;
    Double3 low_;
    int threads_;
    std::uint32_t most_in_leaf_;
    ParticleTree& tree_;
    Buffer<Item> items_, other_;
    std::size_t count_ = 0;  ///< of items that are left
    Buffer<float> merged_;   ///< [item]: densities; empty: each its own
};

}  // namespace

Status make_particle_tree(const ParticleSet& set, const Double3& low, int most_in_leaf, int threads,
                          ParticleTree& tree) {
    tree = ParticleTree();
    if (set.count > kMaxTreeParticles)
        return Status::limit("particles: " + std::to_string(set.count) + ", allowed: at most " +
                             std::to_string(kMaxTreeParticles));
    if (set.count == 0) return tree.nodes.resize(1, arrays::particle_nodes(0).name);
    return Builder(set, low, most_in_leaf, threads, tree).build();
}

}  // namespace pileus
