// SPDX-License-Identifier: Apache-2.0
// Laws of thick layers, of mean paths and of reciprocity, by path.
// in: slabs, boxes and a lumpy cloud -> out: a row for each law.
// docs/validation.md; van de Hulst 1980; Blanco & Fournier 2003, EPL 61, 168 (4V/S).
#include "tests/support/path_slab.h"
#include "tests/support/validation_rows.h"

using namespace path_slab;
using namespace validation;

namespace {

const double kPiExact = std::acos(-1.0);
const char* const kHead =
    "| law | case | the law's own error | reference | path | standard error | z | detectable bias "
    "|\n"
    "|---|---|---|---|---|---|---|---|";

/// Transmitted share of a slab over black: of uniform light, or of a sun.
Mean transmitted(double tau, float albedo, float g, double mu0, std::uint64_t count,
                 std::uint64_t seed) {
    Rig rig = make_slab(tau, albedo, g);
    set_ground(rig, -1, 0);
    if (mu0 > 0)
        shine(rig, sun_at(mu0), 1 / mu0);
    else
        set_sky(rig, 1 / kPiExact);
    return flux(rig, 0, false, count, seed);
}

/// A row of a law with `model` as its relative uncertainty.
template <class Measure>
void check_law(Section& section, const char* law, const std::string& what, double reference,
               double model, Measure measure) {
    section.check(text_of("path: %s, %s", law, what.c_str()),
                  text_of("%s | %s | %.2g %%", law, what.c_str(), 100 * model), reference,
                  model * std::fabs(reference), measure);
}

void thick_white_slabs(Section& section) {
    // T = (4/3) / ((1-g) tau + 1.4209) in uniform light, true to 0.3 % from (1-g) tau = 5 on;
    // sunlight of height mu0 enters like 1/2 + 3/4 mu0 of that, to 1 %.
    const double cases[][3] = {{0, 5, 0}, {0.85, 40, 0}, {-0.5, 8, 0}, {0, 10, 1}, {0.5, 20, 0.5}};
    for (const auto& c : cases) {
        const double entry = c[2] > 0 ? 0.5 + 0.75 * c[2] : 1;
        const double reference = 4.0 / 3.0 * entry / ((1 - c[0]) * c[1] + 1.4209);
        check_law(section, "thick limit", text_of("g %g, tau %g, mu0 %g", c[0], c[1], c[2]),
                  reference, c[2] > 0 ? 0.01 : 0.003, [&](int multiple, std::uint64_t seed) {
                      return transmitted(c[1], 1, float(c[0]), c[2],
                                         samples(20'000, 1'000'000) * std::uint64_t(multiple),
                                         seed);
                  });
    }
}

void absorbing_slabs(Section& section) {
    // Deep down light falls off as exp(-k tau), k^2 = 3 (1 - a)(1 - a g), to 2 % for 1 - a <= 0.01;
    // what the far border throws back, exp(-2 k tau), is under 1 % of that here.
    const double cases[][4] = {{0.99, 0, 16, 24}, {0.99, 0.85, 40, 60}, {0.999, 0.5, 70, 100}};
    for (const auto& c : cases) {
        const double k = std::sqrt(3 * (1 - c[0]) * (1 - c[0] * c[1]));
        check_law(
            section, "absorption slope",
            text_of("albedo %g, g %g, tau %g to %g", c[0], c[1], c[2], c[3]), k, 0.02,
            [&](int multiple, std::uint64_t seed) {
                const std::uint64_t n = samples(20'000, 1'000'000) * std::uint64_t(multiple);
                const Mean a = transmitted(c[2], float(c[0]), float(c[1]), 0, n, seed),
                           b = transmitted(c[3], float(c[0]), float(c[1]), 0, n, seed + 7);
                const double da = a.error / a.value, db = b.error / b.value, d = c[3] - c[2];
                return Mean{std::log(a.value / b.value) / d, std::sqrt(da * da + db * db) / d};
            });
    }
}

void similar_slabs(Section& section) {
    // White slabs of equal (1-g) tau pass equal light, to 1 % from 5 on.
    for (double g : {0.5, 0.85, -0.4}) {
        const double tau = 8 / (1 - g);
        check_law(
            section, "similarity", text_of("T of g %g, tau %.4g over T of g 0, tau 8", g, tau), 1,
            0.01, [&](int multiple, std::uint64_t seed) {
                const std::uint64_t n = samples(20'000, 1'000'000) * std::uint64_t(multiple);
                const Mean a = transmitted(tau, 1, float(g), 0, n, seed),
                           b = transmitted(8, 1, 0, 0, n, seed + 7);
                const double da = a.error / a.value, db = b.error / b.value;
                return Mean{a.value / b.value, a.value / b.value * std::sqrt(da * da + db * db)};
            });
    }
}

/// Collisions of a path that enters evenly and diffusely through the whole surface, over sigma:
/// metres of path. White media only, so that no path is thinned out.
Mean mean_path_of(Rig& rig, bool sides, std::uint64_t count, std::uint64_t seed) {
    constexpr int kParts = 64;
    set_sky(rig, 1);
    const auto& e = rig.medium.extent_m;
    std::array<double, kParts> found{};
    for (std::size_t part = 0; part < kParts; ++part) {
        double area = 0, collisions = 0;
        for (std::size_t face = sides ? 0 : 4; face < 6; ++face) {
            const std::size_t a = face / 2, b = (a + 1) % 3, d = (a + 2) % 3;
            CameraParams camera{};
            for (std::size_t i = 0; i < 3; ++i) camera.origin[i] = float(e[i] / 2);
            camera.origin[a] = face % 2 == 0 ? 0.0f : float(e[a]);
            camera.forward[a] = face % 2 == 0 ? 1.0f : -1.0f;
            camera.right[b] = camera.up[d] = 1;
            camera.half_width = float(e[b] / 2), camera.half_height = float(e[d] / 2);
            camera.width = camera.height = 1;
            camera.orthographic = camera.flux = 1;
            const Film film = trace_film(path_input(rig, camera, seed * 1024 + part * 8 + face),
                                         count / kParts / (sides ? 6 : 2));
            const double face_area = e[b] * e[d];
            area += face_area;
            collisions += face_area * double(film.tally.scatterings) / double(film.tally.paths);
        }
        found[part] = collisions / area / double(rig.medium.sigma);
    }
    Mean m;
    for (double f : found) m.value += f / kParts;
    for (double f : found) m.error += (f - m.value) * (f - m.value);
    m.error = std::sqrt(m.error / (kParts * (kParts - 1)));
    return m;
}

void mean_paths(Section& section) {
    for (double g : {0.0, 0.85})
        check_law(section, "2 tau", text_of("collisions in a white slab, g %g, tau 4", g), 8, 0,
                  [&](int multiple, std::uint64_t seed) {
                      Rig rig = make_slab(4, 1, float(g));
                      set_albedo(rig, {1, 1, 1});
                      Mean m = mean_path_of(
                          rig, false, samples(20'000, 1'000'000) * std::uint64_t(multiple), seed);
                      return Mean{4 * m.value, 4 * m.error};
                  });
    // Diffuse light stays 4V/S in any white body, whatever it scatters like.
    for (double g : {0.0, 0.85, -0.6})
        check_law(section, "4V/S", text_of("box of 1 x 2 x 3 m, g %g, 3 per metre", g),
                  2 * 1 * 2 * 3 / (1 * 2 + 2 * 3 + 3 * 1.0), 0,
                  [&](int multiple, std::uint64_t seed) {
                      Rig rig = make_rig({1, 1, 1}, {1, 2, 3}, 3);
                      set_albedo(rig, {1, 1, 1});
                      rig.medium.optics[0].phase.g1 = float(g);
                      return mean_path_of(
                          rig, true, samples(40'000, 2'000'000) * std::uint64_t(multiple), seed);
                  });
}

/// Light of a sun at `from` that the whole cloud sends towards `to`: radiance times area.
Mean sent_towards(Rig rig_of(), const std::array<float, 3>& from, const std::array<float, 3>& to,
                  std::uint64_t count, std::uint64_t seed) {
    Rig rig = rig_of();
    shine(rig, from);
    const float far = 20, edge = 8;
    const CameraParams camera = make_flat_view({1 + far * to[0], 1 + far * to[1], 1 + far * to[2]},
                                               {-to[0], -to[1], -to[2]}, edge, 1, 1);
    Mean m = film_average(trace_film(path_input(rig, camera, seed), count));
    return {m.value * double(edge * edge), m.error * double(edge * edge)};
}

/// Lumps in a box of 2 m: densities from 0 to 1 without any symmetry.
Rig make_lumps() {
    Rig rig = make_rig({9, 7, 8}, {2, 2, 2}, 5);
    std::uint32_t state = 12345;
    for (float& v : rig.medium.volume.density.span()) {
        state = state * 1664525u + 1013904223u;
        v = float(state >> 24) / 255;
        v = v * v;
    }
    set_albedo(rig, {0.95f, 0.95f, 0.95f});
    rig.medium.optics[0].phase.g1 = 0.6f;
    set_majorants(rig, 2);
    return rig;
}

void exchanged(Section& section) {
    // Sun and camera change places: the light that goes from one to the other is the same.
    const std::array<float, 3> a = {0.6f, 0.0f, 0.8f}, b = {-0.36f, -0.48f, 0.8f},
                               c = {0.0f, 0.8f, -0.6f};
    const struct {
        const char* name;
        const std::array<float, 3>&from, &to;
    } pairs[] = {{"to the side", a, b}, {"through", a, c}, {"forward", b, c}};
    for (const auto& p : pairs)
        check_law(
            section, "reciprocity",
            text_of("lumpy cloud, %s, minus the same with sun and camera exchanged", p.name), 0, 0,
            [&](int multiple, std::uint64_t seed) {
                const std::uint64_t n = samples(100'000, 4'000'000) * std::uint64_t(multiple);
                const Mean x = sent_towards(make_lumps, p.from, p.to, n, seed),
                           y = sent_towards(make_lumps, p.to, p.from, n, seed + 7);
                return Mean{x.value - y.value, std::sqrt(x.error * x.error + y.error * y.error)};
            });
}

}  // namespace

TEST_CASE("validation: laws by path") {
    Section section("laws", kHead);
    thick_white_slabs(section);
    absorbing_slabs(section);
    similar_slabs(section);
    mean_paths(section);
    exchanged(section);
}
