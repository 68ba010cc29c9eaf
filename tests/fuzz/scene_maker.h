// SPDX-License-Identifier: Apache-2.0
// Makes a valid scene out of any bytes, so that a fuzzer's every input reaches the renderer.
// in: bytes; after their end zeros -> out: scene text with few pixels, voxels and photons.
// docs/scene.md
#pragma once
#include <cstdint>
#include <string>

#include "src/base/number_text.h"
#include "src/scene/rows/phase_row.h"
#include "src/scene/toml/toml_tree.h"

namespace fuzz {

class SceneMaker {
    void photon_grid() {
        static const char* const closures[] = {"\"sh\"", "\"published\"", "\"mean\"", "\"camera\""};
        text_ += "[method]\nname = \"photon-grid\"\n[photon_grid]\n";
        line("photons", std::to_string(below(33)));
        line("generations", std::to_string(1 + below(4)));
        line("closure", pick(closures));
        line("bands", std::to_string(1 + below(8)));
        line("axis_degrees", std::to_string(below(17)));
        const int bits = below(16);
        line("tracking", (bits & 1) != 0 ? "\"global\"" : "\"local\"");
        line("first_order_split", (bits & 2) != 0 ? "false" : "true");
        line("ring", (bits & 4) != 0 ? "true" : "false");
        if ((bits & 8) == 0) return;
        const std::string x = std::to_string(1 + below(5)), y = std::to_string(1 + below(5));
        line("cells", "[" + x + ", " + y + ", " + std::to_string(1 + below(5)) + "]");
    }

public:
    SceneMaker(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

    std::string text() {
        // Few decimal powers cover the lengths a scene may have.
        static const double sides[] = {1, 0.001, 7.5, 1000, 1e6};
        const double side = sides[below(5)];
        camera(side);
        lights();
        if (below(8) > 0) medium(side);
        collectors();
        // Bytes that end before leave the method as it is.
        const int method = below(4);
        if (method == 1) path();
        if (method == 2) photon_grid();
        return text_;
    }

private:
    std::uint32_t byte() { return at_ < size_ ? data_[at_++] : 0; }
    int below(std::uint32_t n) { return int(byte() % n); }
    template <std::size_t N>
    const char* pick(const char* const (&words)[N]) {
        return words[byte() % N];
    }
    /// A whole number of 64ths in [0, 1].
    std::string share() { return pileus::number_text(double(below(65)) / 64); }
    void line(const std::string& key, const std::string& value) {
        text_ += key + " = " + value + '\n';
    }
    std::string color() {
        if (below(2) == 0) return share();
        return "[" + share() + ", " + share() + ", " + share() + "]";
    }

    void camera(double box) {
        const std::string side = pileus::number_text(box);
        // In sides of the box, so that the view is never nearly parallel to up.
        static const double away[] = {-2, -0.4, 0.1, -100};
        static const char* const fields[] = {"40", "1e-3", "179.9", "120"};
        line("seed", std::to_string(byte()));
        text_ += "[camera]\n";
        // The box has its foot at height 0 and the camera is never below it.
        const std::string x = pileus::number_text(away[below(4)] * box);
        const std::string y = pileus::number_text(away[below(4)] * box);
        line("position_m", "[" + x + ", " + y + ", " + side + "]");
        line("target_m", "[0.013, 0.25, 0.5]");
        line("up", below(2) == 0 ? "[0, 0, 1]" : "[0.3, 1, 0.2]");
        line("resolution",
             "[" + std::to_string(1 + below(8)) + ", " + std::to_string(1 + below(8)) + "]");
        if (below(3) == 0) {
            line("projection", "\"orthographic\"");
            line("height_m", side);
        } else {
            line("fov_deg", pick(fields));
        }
    }

    void lights() {
        static const char* const elevations[] = {"90", "35", "0", "-5", "-90", "1e-6"};
        static const char* const powers[] = {"1", "0", "1e12", "1e-12", "[1, 0, 2]"};
        const int which = below(16);
        if ((which & 1) != 0) {
            text_ += "[sun]\n";
            line("elevation_deg", pick(elevations));
            line("azimuth_deg", std::to_string(below(8) * 45));
            line("irradiance", pick(powers));
        }
        if ((which & 2) != 0) {
            text_ += "[sky]\n";
            line("radiance", pick(powers));
        }
        if ((which & 4) != 0) {
            text_ += "[ground]\n";
            line("altitude_m", below(2) == 0 ? "0" : "-3");
            line("albedo", share());
        }
    }

    void medium(double box) {
        const std::string side = pileus::number_text(box);
        static const char* const shapes[] = {"uniform:box", "uniform:sphere", "uniform:ellipsoid",
                                             "procedural:cumulus"};
        // Optical depths across the box of side 1; larger ones only where the first event absorbs.
        static const double depths[] = {1, 0, 1e-9, 0.05, 8, 2000};
        const std::string shape = pick(shapes);
        const int least = shape == "procedural:cumulus" ? 4 : 1;
        text_ += "[[medium]]\n";
        line("density", '"' + shape + '"');
        line("bounds_m", "[[-" + side + ", 0, 0], [" + side + ", " + side + ", " + side + "]]");
        line("resolution", "[" + std::to_string(least + below(5)) + ", " +
                               std::to_string(least + below(5)) + ", " +
                               std::to_string(least + below(5)) + "]");
        const double depth = depths[below(6)], extinction = depth / box;
        line("extinction_per_m", pileus::number_text(extinction < 1e12 ? extinction : 1e12));
        line("albedo", depth > 100 ? "0" : color());
        line("phase", "{ type = " + phase() + " }");
    }

    /// Any that needs no file, with any numbers that its row allows.
    std::string phase() {
        static const char* const cosines[] = {"0", "0.85", "-0.85", "1", "-1", "0.9999999"};
        const auto types = pileus::phase_rows();
        const pileus::NamedPhase& type = types[std::size_t(below(std::uint32_t(types.size)))];
        std::string text = '"' + std::string(type.name) + '"';
        for (const pileus::KeyRow& key : type.row->keys) {
            if (key.kind() == pileus::KeyKind::kText) return "\"isotropic\"";
            // Other keys say the same in another way.
            if (key.kind() != pileus::KeyKind::kNumber) continue;
            const pileus::KeyRange& r = key.allowed.range;
            const std::string name = std::string(key.path).substr(sizeof "medium.N.phase");
            const double value = r.low + double(below(65)) / 64 * (r.high - r.low);
            text += ", " + name + " = " +
                    (r.low == -1 && r.high == 1 ? pick(cosines) : pileus::number_text(value));
        }
        return text;
    }

    void collectors() {
        static const char* const closures[] = {"\"sh\"", "\"lobe\"", "\"camera\""};
        text_ += "[collectors]\n";
        line("photons", std::to_string(below(33)));
        line("generations", std::to_string(1 + below(4)));
        line("samples", std::to_string(1 + below(48)));
        line("bands", std::to_string(1 + below(8)));
        line("closure", pick(closures));
        line("cell_voxels", std::to_string(1 + below(3)));
        const int bits = below(256);
        line("tracking", (bits & 1) != 0 ? "\"global\"" : "\"local\"");
        line("variant", (bits & 2) != 0 ? "\"paper\"" : "\"best\"");
        line("display", (bits & 4) != 0 ? "\"billboards\"" : "\"march\"");
        line("sampler", (bits & 8) != 0 ? "\"rejection\"" : "\"stratified\"");
        line("placement", (bits & 16) != 0 ? "\"variance\"" : "\"gradient\"");
        line("first_order_split", (bits & 32) != 0 ? "false" : "true");
        line("window", (bits & 64) != 0 ? "true" : "false");
        line("density_range", share());
        line("axis_degrees", std::to_string(below(17)));
        text_ += "[output]\n";
        if ((bits & 128) != 0) line("layers", "[\"depth\", \"error\", \"cloud\"]");
    }

    void path() {
        text_ += "[method]\nname = \"path\"\n[path]\n";
        line("samples_per_pixel", std::to_string(1 + below(4)));
        line("max_depth", std::to_string(below(4)));
        line("pixel", below(2) == 0 ? "\"box\"" : "\"centre\"");
    }

    const std::uint8_t* data_;
    std::size_t size_, at_ = 0;
    std::string text_;
};

}  // namespace fuzz
