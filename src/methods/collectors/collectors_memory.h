// SPDX-License-Identifier: Apache-2.0
// Every array of method `collectors`: its bytes from sizes alone, and the stages it lives in.
// in: sizes, bounded before preparation or exact after it -> out: rows of the plan's table.
// docs/report.md, "Memory".
#pragma once
#include "src/methods/collectors/collectors_state.h"
#include "src/plan/memory_table.h"
#include "src/world/plan_parts.h"

namespace pileus {

/// What is prepared. Where an exact number is not known yet each of these holds an upper bound.
struct PreparedSizes {
    std::uint64_t samples = 0, leaves = 0, collectors = 0;
    std::uint64_t tracking_blocks = 0;  ///< majorants that photons meet
    bool cells = false;                 ///< closure "camera": no samples and no tree
    bool variance = false;              ///< placement "variance"
    bool rejection = false, paper = false;
};

/// Of the sums of photons.
struct SumsSizes {
    std::uint64_t channels = 1, coefficients = 1, lights = 0, slots = 1, ground_cells = 0;
    std::uint64_t private_sums = 0;  ///< bytes of all threads' own sums
    bool sums_ring = false;          ///< all slots are kept as one, too
};

/// Of nodes of light.
struct NodeSizes {
    std::uint64_t harmonics = 0;        ///< numbers per node, where nodes hold them
    std::uint64_t numbers_by_node = 0;  ///< of all nodes, with what fills them up
    std::uint64_t shadow_nodes = 0, beam_sets = 0, source_nodes = 0, lamp_depths = 0;
    std::uint64_t near_nodes = 0, near_levels = 0;      ///< around the camera; with coarser levels
    std::uint64_t near_harmonics = 0, near_stored = 0;  ///< numbers of such a node; as it is read
    std::uint64_t guided_nodes = 0;  ///< nodes of the finest level where they are filtered
    std::uint64_t planes_by_channel = 0, fine_nodes = 0;  ///< of a march that reads no quads
};

struct PictureSizes {
    std::uint64_t width = 0, height = 0;
    std::uint64_t planes = 3;        ///< of colour: 3 * (1 + batches)
    std::uint64_t layers = 4;        ///< of the image
    std::uint64_t extra_planes = 0;  ///< parts of the light, optical depth
    bool parts = false;              ///< some of the light is shown alone
    bool marched = true, ground = false, depth = false;
};

/// All that the bytes depend on.
struct CollectorsSizes {
    Grid grid{};
    MediumSource source;
    SkyMapBytes sky;
    std::uint64_t threads = 1, media = 1;
    std::uint64_t phases = 0;   ///< bytes of tables of phase functions
    bool shoots_again = false;  ///< an animation: what tracing needs stays until the end
    PreparedSizes prepared;
    SumsSizes photons;
    NodeSizes nodes;
    PictureSizes picture;
};

/// The sizes of a state: bounds before `prepare` has filled it, exact afterwards.
CollectorsSizes collectors_sizes(const FrameView& view, const CollectorsState& state,
                                 const Context& context);
/// Those of the display's grids; part of the same.
void collectors_size_display(const FrameView& view, const CollectorsState& state,
                             const Context& context, CollectorsSizes& sizes);

inline SlotSize collectors_slot(const CollectorsSizes& s) {
    return {s.prepared.collectors, s.photons.channels, s.photons.coefficients,
            s.photons.ground_cells};
}

/// Bytes of one thread's own sums, its distance to the next one's among them.
std::uint64_t bytes_of_sums(const CollectorsSizes& sizes);

/// The table of all arrays, in the order of the stages.
MemoryTable collectors_memory(const CollectorsSizes& sizes);
/// Its peak; 0 in a flight, where threads' own memory alone chooses the sums.
std::uint64_t collectors_peak(const CollectorsSizes& sizes);

/// The plan's memory and work, where the sums are chosen. kLimit: more than may be; a flight looks
/// at neither.
Status measure_memory(const Context& context, const FrameView& view, const CollectorsState& state,
                      const CollectorsSizes& measured, Plan& plan);

}  // namespace pileus
