// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of one procedural sky, and what its kind of cloud brings.
// in: keys that passed their own checks -> out: a whole SkySettings; faults.
// docs/skies.md, "Keys" and "Kinds of clouds".
#include <cmath>

#include "src/base/number_text.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/method_column.h"

namespace pileus {
namespace {

class SkyCheck {
public:
    SkyCheck(SceneCheck& check, std::size_t index)
        : check_(check),
          medium_(check.scene.media[index]),
          sky_(medium_.sky),
          path_("medium." + std::to_string(index) + ".") {}

    void run() {
        if (check_.written) fill_in();
        thresholds();
        layer();
        sizes();
        evaluation();
        if (medium_.box.periodic && medium_.box.has_bounds) periods();
    }

private:
    const Node* sky_key(const std::string& name) { return check_.key(path_ + "sky." + name); }

    /// Faults point at the key, or where that is left out at the density.
    void fault(const std::string& name, const std::string& text) {
        const Node* node = sky_key(name);
        if (node == nullptr) node = check_.key(path_ + "density");
        check_.faults.add(node->at, path_ + "sky." + name, text);
    }

    void set(const char* name, double& value, double of_type) {
        if (sky_key(name) == nullptr) value = of_type;
    }

    void fill_in() {
        const SkyType& type = sky_type(sky_.type);
        const bool own_thresholds =
            sky_key("threshold_low") != nullptr || sky_key("threshold_high") != nullptr;
        set("perlin_m", sky_.perlin.tile_m, type.perlin_m);
        set("worley_m", sky_.worley.tile_m, type.worley_m);
        set("blend", sky_.blend, type.blend);
        set("threshold_low", sky_.threshold_low, type.threshold_low);
        set("threshold_high", sky_.threshold_high, type.threshold_high);
        set("coverage", sky_.coverage, own_thresholds ? -1 : type.coverage);
        set("base_m", sky_.base_m, type.base_m);
        set("top_m", sky_.top_m, type.top_m);
        set("base_rise", sky_.base_rise, type.base_rise);
        set("top_fall", sky_.top_fall, type.top_fall);
        set("rounding", sky_.rounding, type.rounding);
        set("base_density", sky_.base_density, type.base_density);
        if (check_.key(path_ + "extinction_per_m") == nullptr && medium_.optics.transfer.empty())
            medium_.optics.extinction_per_m = type.extinction_per_m;
        if (check_.key(path_ + "phase") == nullptr && type.effective_radius_um > 0) {
            medium_.optics.phase.type = "cloud";
            medium_.optics.phase.numbers["effective_radius_um"] = type.effective_radius_um;
        }
    }

    void thresholds() {
        if (!(float(sky_.threshold_low) < float(sky_.threshold_high)))
            fault("threshold_high", "not above threshold_low, " + number_text(sky_.threshold_high) +
                                        ", allowed: more than " + number_text(sky_.threshold_low));
        if (!sky_.has_perlin() && !sky_.has_worley())
            fault("blend", "no noise is left, " + number_text(sky_.blend) +
                               ", allowed: a blend and gains that leave one of both");
    }

    void layer() {
        const double thinnest = least_width(sky_.base_m, sky_.top_m);
        if (!(sky_.top_m - sky_.base_m >= thinnest))
            fault("top_m", "not above base_m, " + number_text(sky_.top_m) +
                               ", allowed: more than " + number_text(sky_.base_m) + ", by " +
                               number_text(thinnest) + " m at least");
        const double radius = sky_.planet_radius_m;
        if (radius > 0 && !(radius >= 10 * (std::fabs(sky_.base_m) + std::fabs(sky_.top_m))))
            fault("planet_radius_m", "too small for the layer, " + number_text(radius) +
                                         ", allowed: 0, or at least ten times its altitudes");
    }

    void sizes() {
        // Kinds of clouds bring them; a struct may lack them.
        if (sky_.has_perlin() && check_.lacks(path_ + "sky.perlin_m") && !check_.written)
            fault("perlin_m", "missing, nothing, allowed: number above 0");
        if (sky_.has_worley() && check_.lacks(path_ + "sky.worley_m") && !check_.written)
            fault("worley_m", "missing, nothing, allowed: number above 0");
        if ((sky_.size & (sky_.size - 1)) != 0)
            fault("size", "not a power of two, " + std::to_string(sky_.size) +
                              ", allowed: 16, 32, 64, 128, 256, 512");
        tile_size("perlin_m", sky_.has_perlin(), sky_.perlin);
        tile_size("worley_m", sky_.has_worley(), sky_.worley);
        noise_size("perlin_cells", sky_.perlin);
        noise_size("worley_cells", sky_.worley);
    }

    void tile_size(const char* key, bool used, const SkyNoise& noise) {
        const double tile = noise.tile_m * sky_.scale;
        if (used && tile > 0 && !(tile >= kMinPositive))
            fault(key, "too short with sky.scale, " + number_text(tile) + " m, allowed: at least " +
                           number_text(kMinPositive) + " m");
    }

    void noise_size(const char* key, const SkyNoise& noise) {
        const int octaves = noise.octaves > 0 ? noise.octaves : 1;
        if (std::int64_t{noise.cells} << octaves > sky_.size)
            fault(key, "too fine for the texels, " + std::to_string(noise.cells) + " lumps in " +
                           std::to_string(octaves) + " octaves, allowed: at most half of size " +
                           std::to_string(sky_.size) + " in the last octave");
    }

    /// The noise itself is marched where one sky is all there is; nodes of sunlight have a box.
    void evaluation() {
        const Scene& scene = check_.scene;
        const RaymarchLightKind light = scene.raymarch.light.kind;
        const bool marched =
            light == RaymarchLightKind::kAuto || light == RaymarchLightKind::kMarch;
        const bool boxed = medium_.box.has_bounds && !medium_.box.periodic;
        const bool can = refused(scene, Feature::kSkyInPlace) == nullptr &&
                         scene.media.size() == 1 && (marched || boxed) &&
                         medium_.optics.transfer.empty() && !medium_.box.constant &&
                         !medium_.detail.present();
        if (sky_.evaluate == SkyEvaluation::kDirect && !can)
            fault("evaluate",
                  "not here, \"direct\", allowed: \"grid\", or method raymarch with this medium "
                  "alone, without transfer, detail or constant cells, and with raymarch.light "
                  "\"auto\" or "
                  "\"march\" or an "
                  "open box");
        if (sky_.evaluate == SkyEvaluation::kAuto)
            sky_.evaluate = can ? SkyEvaluation::kDirect : SkyEvaluation::kGrid;
        if (sky_.evaluate == SkyEvaluation::kGrid && check_.key(path_ + "bounds_m") == nullptr)
            check_.faults.add(check_.key(path_ + "density")->at, path_ + "bounds_m",
                              "missing, nothing, allowed: [[x, y, z], [x, y, z]], the lowest and "
                              "highest corner in metres; a sky on a grid has a box");
    }

    /// What repeats must fit its box a whole number of times.
    void periods() {
        if (sky_.has_perlin()) period("perlin_m", sky_.perlin.tile_m * sky_.scale);
        if (sky_.has_worley()) period("worley_m", sky_.worley.tile_m * sky_.scale);
    }

    void period(const char* key, double tile_m) {
        for (std::size_t a = 0; a < 2; ++a) {
            const double edge = medium_.box.bounds_m[1][a] - medium_.box.bounds_m[0][a];
            const double times = edge / tile_m, whole = std::floor(times + 0.5);
            if (whole >= 1 && std::fabs(times - whole) <= 1e-6 * whole) continue;
            return fault(key, "does not divide the box of boundary \"periodic\", " +
                                  number_text(tile_m) + " m, allowed: " + number_text(edge) +
                                  " m over a whole number");
        }
    }

    SceneCheck& check_;
    MediumSettings& medium_;
    SkySettings& sky_;
    std::string path_;
};

}  // namespace

void check_sky(SceneCheck& check, std::size_t index) { SkyCheck(check, index).run(); }

}  // namespace pileus
