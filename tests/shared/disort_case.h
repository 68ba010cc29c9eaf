// SPDX-License-Identifier: Apache-2.0
// Layers of the published test problems of DISORT as media.
// in: a row of disort_cases.csv, a folder of phase moments -> out: a slab with its light.
// docs/validation.md; Stamnes, Tsay, Wiscombe, Laszlo 2000, "DISORT report v1.1".
#pragma once
#include <memory>

#include "src/world/phase/phase_table.h"
#include "tests/shared/published.h"
#include "tests/support/path_slab.h"
#include "tests/theory/isotropic_layers.h"

namespace disort {

using namespace path_slab;

/// Cuts of a layered slab; the albedo goes over from one layer to the next within one of them.
constexpr int kCuts = 1024;

struct Case {
    std::string name;
    Rig rig;
    PhaseStore phase;  ///< owns a table
    double tau = 0, beam = 0, mu0 = 0, sky = 0;
    std::vector<double> albedo;               ///< of equally thick layers from the top
    std::unique_ptr<isotropic::Field> exact;  ///< of thin layers that scatter isotropically

    /// Height of a level in the slab of one metre.
    double height(double level) const { return 1 - level / tau; }
    bool is_beam() const { return beam > 0; }
};

/// The phase function that a case names. `moments`: file of chi_l for "cloud C.1".
inline PhaseParams phase_of(const std::string& words, const std::string& moments, Case& c) {
    if (words == "isotropic") return {kPhaseHg, 0, 0, 1};
    if (words == "rayleigh") return {kPhaseRayleigh, 0, 0, 1};
    if (words.compare(0, 5, "HG g=") == 0)
        return {kPhaseHg, float(published::number(words.substr(5))), 0, 1};
    REQUIRE_MESSAGE(words.compare(0, 9, "cloud C.1") == 0, "a phase function: ", words);
    std::vector<double> chi;
    for (const published::Row& row : published::read_table(moments))
        chi.push_back(row.value("chi_l"));
    double clipped = 0;
    const Status made =
        make_phase_from_moments(moments, {chi.data(), chi.size()}, c.phase, clipped);
    REQUIRE_MESSAGE(made, made.message);
    std::printf("%s: %zu moments, %.2g of the phase function clipped\n", words.c_str(), chi.size(),
                clipped);
    return c.phase.params();
}

/// Layers of one optical thickness and several albedos: a medium for each, on one grid.
inline void set_layers(Case& c, const PhaseParams& phase) {
    const std::size_t layers = c.albedo.size();
    Medium& m = c.rig.medium;
    m.count = int(layers);
    for (std::size_t i = 0; i < layers; ++i) {
        const float a = float(c.albedo[i]);
        m.optics[i] = {{a, a, a}, a, phase};
    }
    if (layers == 1) return;
    REQUIRE(m.parts.resize((layers - 1) * std::size_t(kCuts), "parts"));
    for (std::size_t z = 0; z < std::size_t(kCuts); ++z) {
        const std::size_t layer = (std::size_t(kCuts) - 1 - z) * layers / std::size_t(kCuts);
        for (std::size_t i = 1; i < layers; ++i)
            m.parts.data()[(i - 1) * std::size_t(kCuts) + z] = layer == i ? 1.0f : 0.0f;
    }
}

/// Fills `c` from its row; a sky of uniform light stands above, black ground below.
inline void read_case(const published::Row& row, const std::string& moments, Case& c) {
    c.name = row.text("case");
    for (const std::string& t :
         published::split(row.text("layer_optical_thickness_top_to_bottom"), " "))
        c.tau += published::number(t);
    for (const std::string& a : published::split(row.text("layer_single_scattering_albedo"), " "))
        c.albedo.push_back(published::number(a));
    c.beam = row.value("beam_normal_flux");
    c.sky = row.value("isotropic_top_radiance");
    const int cuts = c.albedo.size() == 1 ? 1 : kCuts;
    c.rig = make_rig({1, 1, cuts}, {kSlabWidth, kSlabWidth, 1}, c.tau);
    set_layers(c, phase_of(row.text("phase_function"), moments, c));
    set_ground(c.rig, -1, 0);
    if (c.is_beam()) {
        c.mu0 = row.value("mu0");
        shine(c.rig, sun_at(c.mu0), c.beam);
    } else {
        set_sky(c.rig, c.sky);
    }
    if (row.text("phase_function") != "isotropic" || c.tau > 1) return;
    std::vector<isotropic::Layer> layers;
    for (double a : c.albedo) layers.push_back({c.tau / double(c.albedo.size()), a});
    c.exact = std::make_unique<isotropic::Field>(layers, isotropic::Light{c.beam, c.mu0, c.sky},
                                                 300 / int(layers.size()));
}

}  // namespace disort
