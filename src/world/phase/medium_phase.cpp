// SPDX-License-Identifier: Apache-2.0
// See medium_phase.h.
// in: settings -> out: parameters, tables.
// docs/phase.md.
#include "src/world/phase/medium_phase.h"

#include "src/base/exponential.h"
#include "src/scene/read_scene.h"
#include "src/world/phase/mie_data.h"

namespace pileus {

PhaseParams hg_draine(double d) {
    const double g_hg = exponential(-0.0990567 / (d - 1.67154));
    const double g_draine = exponential(-2.20679 / (d + 3.91029) - 0.428934);
    const double alpha = exponential(3.62489 - 8.29288 / (d + 5.52825));
    const double share = exponential(-0.599085 / (d - 0.641583) - 0.665888);
    return {kPhaseHgDraine, float(g_hg), float(g_draine), float(1 - share), float(alpha), nullptr};
}

Status cloud_phase_nodes(double radius, PhaseNodes& nodes) {
    int i = 0;
    while (i + 2 < kMieRadii && double(kMieRadius[i + 1]) <= radius) ++i;
    const double low = double(kMieRadius[i]), high = double(kMieRadius[i + 1]);
    // Effective radii add up by the share of the light that each population scatters.
    const double share = (radius - low) / (high - low);
    PILEUS_TRY(nodes.angle_deg.resize(kMieAngles, "phase table"));
    PILEUS_TRY(nodes.value.resize(kMieAngles, "phase table"));
    for (int k = 0; k < kMieAngles; ++k) {
        nodes.angle_deg[std::size_t(k)] = double(kMieAngle[k]) / 100;
        nodes.value[std::size_t(k)] = (1 - share) * mie_density(kMieDensity[i][k]) +
                                      share * mie_density(kMieDensity[i + 1][k]);
    }
    return Status::ok();
}

Status make_cloud_phase(double radius, PhaseStore& out) {
    PhaseNodes nodes;
    PILEUS_TRY(cloud_phase_nodes(radius, nodes));
    return make_phase_table("cloud", nodes, out);
}

namespace {

Status load_file(const std::string& directory, const PhaseSettings& phase, PhaseStore& store) {
    const std::string path = scene_path(directory, phase.file);
    PhaseNodes nodes;
    if (phase.kind == PhaseKind::kTable) {
        PILEUS_TRY(read_phase_table(path, nodes));
        return make_phase_table(path, nodes, store);
    }
    Buffer<double> moments;
    double clipped = 0;
    PILEUS_TRY(read_phase_moments(path, moments));
    PILEUS_TRY(make_phase_from_moments(path, moments.span(), store, clipped));
    if (clipped <= kMostClipped) return Status::ok();
    return Status::bad_input(path + ": moments: their sum is negative over " +
                             std::to_string(clipped) +
                             " of the light, allowed: at most 0.01; more moments, or a table");
}

}  // namespace

Status load_phase(const std::string& directory, const PhaseSettings& phase, PhaseStore& store,
                  PhaseParams& params) {
    params = {kPhaseHg, 0, 0, 1};
    switch (phase.kind) {
        case PhaseKind::kRayleigh:
            params = {kPhaseRayleigh, 0, 0, 1};
            return Status::ok();
        case PhaseKind::kTwoLobe:
            params = {kPhaseTwoLobe, float(phase.g1), float(phase.g2), float(phase.weight)};
            return Status::ok();
        case PhaseKind::kHenyeyGreenstein:
            params.g1 = float(phase.g);
            return Status::ok();
        case PhaseKind::kHgDraine:
            params = hg_draine(phase.droplet_diameter_um);
            return Status::ok();
        case PhaseKind::kCloud:
            PILEUS_TRY(make_cloud_phase(phase.effective_radius_um, store));
            break;
        case PhaseKind::kTable:
        case PhaseKind::kMoments:
            PILEUS_TRY(load_file(directory, phase, store));
            break;
        case PhaseKind::kIsotropic:
            return Status::ok();
    }
    params = store.params();
    return Status::ok();
}

}  // namespace pileus
