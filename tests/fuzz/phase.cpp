// SPDX-License-Identifier: Apache-2.0
// Fuzz target: phase functions in files.
// in: bytes as a table and as moments -> out: a lawful phase function, or one line with its place.
// docs/phase.md, "Files".
#include "src/world/phase/phase_table.h"
#include "tests/fuzz/target.h"

namespace {

using namespace pileus;

void check_table(const Status& status, const PhaseStore& store) {
    if (!status) return fuzz::check_fault(status, "p.txt:", true);
    const PhaseTable& t = store.table[0];
    fuzz::require(t.share[0] >= 0 && t.share[t.cells] == 1.0f, "shares end at exactly 1");
    for (std::int32_t i = 0; i < t.cells; ++i) {
        fuzz::require(t.share[i] <= t.share[i + 1], "shares ascend");
        fuzz::require(t.density[i] >= 0 && t.density[i] <= t.peak, "densities are below the peak");
    }
    fuzz::require(t.peak <= 1e15f, "no peak is beyond 1e15 per steradian");
    for (const float u : {0x1p-24f, 0.1f, 0.5f, 0.9f, 1.0f - 0x1p-24f}) {
        const Turn<float> turn = phase_sample(store.params(), u);
        fuzz::require(turn.one_minus_cos >= 0 && turn.one_minus_cos <= 2, "turns are angles");
        fuzz::require(turn.sine >= 0 && turn.sine <= 1, "sines are sines");
        const float density = phase_density(store.params(), turn.one_minus_cos);
        fuzz::require(density >= 0 && density <= t.peak, "densities are finite");
    }
    // Floats add up to within their rounding.
    fuzz::require(t.moment[0] > 0.999999f && t.moment[0] < 1.000001f, "the light is 1");
    for (const float m : t.moment) fuzz::require(m >= -1.000001f && m <= 1.000001f, "moments");
}

}  // namespace

int fuzz::phase(const std::uint8_t* data, std::size_t size) {
    const Span<const char> text = fuzz::text_of(data, size);
    PhaseNodes nodes;
    PhaseStore store;
    Status status = decode_phase_table("p.txt", text, nodes);
    if (status) status = make_phase_table("p.txt", nodes, store);
    check_table(status, store);
    Buffer<double> moments;
    double clipped = 0;
    status = decode_phase_moments("p.txt", text, moments);
    if (status) status = make_phase_from_moments("p.txt", moments.span(), store, clipped);
    check_table(status, store);
    return 0;
}
