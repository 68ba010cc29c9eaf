// SPDX-License-Identifier: Apache-2.0
// The phase function cloud: water clouds at 0.55 um from tables of Lorenz-Mie theory.
// in: an effective radius or a kind of cloud -> out: a table.
// docs/phase.md, "Mie" and "Kinds of clouds"; Hess, Koepke and Schult 1998.
#include "src/scene/rows/phase_row.h"
#include "src/world/phase/medium_phase.h"
#include "src/world/phase/mie_data.h"

namespace pileus {

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

constexpr PhaseNumber kRadius{
    "medium.N.phase.effective_radius_um", from_to(4, 20), "um",
    "effective radius of the droplets of a cloud; this or `phase.cloud` is required there"};

/// Kinds of water clouds and their effective radii, um.
constexpr const char* kClouds =
    "cumulus-clean|cumulus-polluted|cumulus-maritime|stratus-continental|stratus-maritime|fog";
constexpr double kCloudRadius[] = {5.77, 4, 12.68, 7.33, 11.3, 10.7};

constexpr KeyField kCloud{KeyKind::kChoice, [](const KeySource&) { return no_value(); },
                          [](const KeyTarget& t, const Node& n) {
                              t.medium.optics.phase.numbers[kRadius.name()] =
                                  kCloudRadius[n.integer];
                          }};

constexpr KeyRow kKeys[] = {
    phase_key<kRadius>,
    {"medium.N.phase.cloud", kCloud, one_of(kClouds), "",
     "kind of cloud, which sets the effective radius (docs/phase.md)", kNoNote}};

Status make(const std::string&, const PhaseSettings& settings, PhaseStore& store,
            PhaseParams& params) {
    PILEUS_TRY(make_cloud_phase(number_in(settings, kRadius), store));
    params = store.params();
    return Status::ok();
}

}  // namespace

extern const PhaseRow cloud_phase{keys_of(kKeys), make, true};

}  // namespace pileus
