// SPDX-License-Identifier: Apache-2.0
// See solid_shadow.h.
#include "src/picture/nodes/solid_shadow.h"

#include "kernels_cpu/solids/solids.h"

namespace pileus {

Status solid_visibility(const Context& context, const Solids& solids, const NodeGrid& nodes,
                        const std::array<float, 3>& to_sun, Buffer<float>& out) {
    if (solids.triangles.empty()) return Status::ok();
    const StageClock clock(context, "solid shadow");
    const std::int64_t nx = nodes.size[0], ny = nodes.size[1], nz = nodes.size[2];
    PILEUS_TRY(out.resize(std::uint64_t(nx * ny * nz), "shadow of solids"));
    const SolidsView view = solids.view();
    const float d[3] = {to_sun[0], to_sun[1], to_sun[2]};
    parallel_for(context.threads, ny * nz, [&](std::int64_t row, int) {
        for (std::int64_t x = 0; x < nx; ++x) {
            const std::int64_t at[3] = {x, row % ny, row / ny};
            int seen = 0;
            for (int eighth = 0; eighth < 8; ++eighth) {
                float o[3];
                for (int a = 0; a < 3; ++a) {
                    const float part = (eighth >> a & 1) != 0 ? 0.75f : 0.25f;
                    o[a] = (float(at[a]) + part) / nodes.per_metre[a];
                }
                seen += solid_between(view, o, d, 3e38f) ? 0 : 1;
            }
            out[std::size_t(row * nx + x)] = float(seen) * 0.125f;
        }
    });
    return Status::ok();
}

}  // namespace pileus
