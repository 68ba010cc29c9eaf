// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of one medium.
// in: keys that passed their own checks -> out: density kind, file and format; faults.
// docs/scene.md, section Media.
#include <algorithm>

#include "src/scene/above_ground.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/method_column.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/density_row.h"
#include "src/scene/rows/volume_format.h"

namespace pileus {
namespace {

class MediumCheck {
public:
    MediumCheck(SceneCheck& check, std::size_t index)
        : check_(check),
          medium_(check.scene.media[index]),
          index_(index),
          path_("medium." + std::to_string(index) + ".") {}

    void run() {
        const Node* density = check_.valid_key(path_ + "density");
        if (density != nullptr && set_density(*density)) {
            if (const DensityRow* made = density_row(medium_.density)) {
                shape_keys(*made, *density);
            } else {
                file_keys(*density);
            }
            grid_name();
            weather_keys_of();
            particle_keys_of();
        }
        own_keys();
        extinction();
        emission();
        check_phase(check_, index_);
        check_detail(check_, index_);
        bounds();
    }

private:
    void fault(const Node& node, const std::string& key, const std::string& text) {
        check_.faults.add(node.at, path_ + key, text);
    }

    /// The key has set the density's name and the path; this sees to the path.
    bool set_density(const Node& node) {
        if (density_row(medium_.density) != nullptr) return true;
        // Of a struct: what a text says that is no name has become the path.
        if (!medium_.density.empty()) {
            fault(node, "density",
                  "unknown value, " + value_text(node) + ", allowed: " + density_names() +
                      ", or nothing beside the path of a file");
            return false;
        }
        if (!node.is_table()) return set_file(node, "density");
        const Node* file = check_.valid_key(path_ + "density.file");
        return file != nullptr && set_file(*file, "density.file");
    }

    bool set_file(const Node& node, const char* key) {
        if (!node.text.empty())
            return check_path(check_, node, (path_ + key).c_str(), medium_.source.file);
        fault(node, key, "empty, \"\", allowed: the path of a file");
        return false;
    }

    /// Keys of a file: its format must be known, and raw numbers need a type, a size and a place.
    void file_keys(const Node& density) {
        if (check_.key(path_ + "format") == nullptr) format_by_name(density);
        const VolumeFormat* format = volume_format_named(medium_.source.format);
        const Node* first = check_.key(path_ + "density.first_frame");
        if (first != nullptr && !is_sequence(medium_.source.file))
            fault(*first, "density.first_frame",
                  "for a sequence only, " + value_text(*first) +
                      ", allowed: with a # in the file's name");
        const bool celled = format != nullptr && (format->is_weather || format->is_particles);
        for (const char* key : {"resolution", "shape_seed"})
            if (const Node* node = check_.key(path_ + key))
                if (!celled || key[0] == 's')
                    fault(*node, key,
                          "not for a file, " + value_text(*node) + ", allowed: left out");
        if (format != nullptr && format->bare) {
            for (const char* key : {"density.type", "density.size"})
                if (check_.lacks(path_ + key))
                    fault(density, key,
                          "missing, nothing, allowed: density = { file = \"...\", "
                          "type = \"float32\", size = [nx, ny, nz] }");
            need_bounds(density);
        } else {
            for (const char* key : {"density.type", "density.size", "density.endian"})
                if (const Node* node = check_.key(path_ + key))
                    fault(*node, key,
                          "for raw files only, " + value_text(*node) + ", allowed: left out");
        }
    }

    /// Weather data alone has variables, times and a geometry.
    void weather_keys_of() {
        const VolumeFormat* format = volume_format_named(medium_.source.format);
        if (format != nullptr && format->is_weather) {
            check_weather();
            return;
        }
        refuse(weather_keys(), "NetCDF files");
    }

    void refuse(Span<const KeyRow> keys, const char* owner) {
        for (const KeyRow& row : keys) {
            const std::string key = std::string(row.path).substr(sizeof "medium.N." - 1);
            if (const Node* node = check_.key(path_ + key))
                fault(*node, key,
                      std::string("for ") + owner + " only, " + value_text(*node) +
                          ", allowed: left out");
        }
    }

    /// Particles alone have a unit and radii; their box is as large as they are.
    void particle_keys_of() {
        if (!is_particle_format(medium_.source.format)) {
            refuse(particle_keys(), "files of particles");
            return;
        }
        const auto refused = [&](const char* key, const Node* node) {
            if (node != nullptr)
                fault(*node, key,
                      "not for particles, " + value_text(*node) + ", allowed: left out");
        };
        refused("bounds_m", check_.key(path_ + "bounds_m"));
        refused("transfer", check_.key(path_ + "transfer"));
        if (medium_.box.periodic) refused("boundary", check_.key(path_ + "boundary"));
    }

    /// One size of ice crystals, in one way.
    void check_weather() {
        const Node* dge = check_.valid_key(path_ + "density.ice_dge_um");
        for (const char* key : {"density.ice_radius_um", "density.ice_radius"})
            if (const Node* node = check_.valid_key(path_ + key))
                if (dge != nullptr)
                    fault(
                        *node, key,
                        "given twice, " + value_text(*node) + ", allowed: a radius or ice_dge_um");
        check_variable();
    }

    /// Only a transfer function tells what a variable of any kind looks like, and water is not
    /// asked for beside it.
    void check_variable() {
        const Node* variable = check_.valid_key(path_ + "density.variable");
        if (variable == nullptr) return;
        if (check_.key(path_ + "transfer") == nullptr)
            fault(*variable, "density.variable",
                  "shown by a transfer function only, " + value_text(*variable) +
                      ", allowed: left out, or the key transfer");
        for (const char* key : {"liquid", "ice", "cloud_fraction", "liquid_radius", "ice_radius",
                                "fraction", "liquid_radius_um", "ice_radius_um", "ice_dge_um"}) {
            const std::string name = std::string("density.") + key;
            if (const Node* node = check_.key(path_ + name))
                fault(*node, name,
                      "of water, conflicts with variable, " + value_text(*node) +
                          ", allowed: left out");
        }
    }

    /// A grid has a name in OpenVDB and NanoVDB files only, and it is said once.
    void grid_name() {
        const Node* beside = check_.valid_key(path_ + "grid");
        const Node* within = check_.valid_key(path_ + "density.grid");
        const VolumeFormat* format = volume_format_named(medium_.source.format);
        for (const Node* node : {beside, within})
            if (node != nullptr && (format == nullptr || !format->has_grids))
                fault(*node, node == beside ? "grid" : "density.grid",
                      "for " + grid_format_titles() + " files only, " + value_text(*node) +
                          ", allowed: left out");
        if (beside != nullptr && within != nullptr)
            fault(*within, "density.grid",
                  "given twice, " + value_text(*within) + ", allowed: grid or density.grid");
    }

    void format_by_name(const Node& density) {
        const bool raw_keys = check_.key(path_ + "density.type") != nullptr ||
                              check_.key(path_ + "density.size") != nullptr;
        if (raw_keys) {
            medium_.source.format = "raw";
            return;
        }
        if (const VolumeFormat* format = volume_format_of(medium_.source.file)) {
            medium_.source.format = format->name;
            return;
        }
        // Bare numbers are told by no ending, only by what the scene says of them.
        fault(density, "density",
              "unknown kind of file, " + quote_text(medium_.source.file) +
                  ", allowed: a name that ends in " + volume_format_extensions() +
                  "; or beside it the key format, one of " + volume_format_names() +
                  "; or density = { file = \"...\", type = \"float32\", size = [nx, ny, nz] } "
                  "for a raw file");
    }

    /// Keys that one density alone has; they may bring extinction and phase function.
    void own_keys() {
        const DensityRow* mine = density_row(medium_.density);
        for (const DensityRow* other : density_rows()) {
            if (other == mine || other->table == nullptr) continue;
            if (const Node* table = check_.key(path_ + other->table))
                fault(*table, other->table,
                      std::string("for ") + other->name + " only, a table, allowed: left out");
        }
        if (mine != nullptr && mine->check != nullptr) mine->check(check_, index_);
    }

    /// A file in physical units takes a factor; everything else takes the extinction at density 1.
    void extinction() {
        const VolumeFormat* format = volume_format_named(medium_.source.format);
        const bool physical = format != nullptr && format->in_extinction;
        const Node* per_m = check_.key(path_ + "extinction_per_m");
        const Node* scale = check_.key(path_ + "extinction_scale");
        if (check_.key(path_ + "transfer") != nullptr) return transfer();
        // Both keys are a factor on particles.
        if (format != nullptr && format->is_particles) {
            if (per_m != nullptr && scale != nullptr)
                fault(*scale, "extinction_scale",
                      "given twice, " + value_text(*scale) +
                          ", allowed: extinction_per_m or extinction_scale");
            if (per_m != nullptr) medium_.optics.extinction_scale = medium_.optics.extinction_per_m;
            medium_.optics.extinction_per_m = 0;
            return;
        }
        if (physical && per_m != nullptr)
            fault(*per_m, "extinction_per_m",
                  "the file holds extinction in 1/m, " + value_text(*per_m) +
                      ", allowed: left out, or the key extinction_scale");
        if (!physical && scale != nullptr)
            fault(*scale, "extinction_scale",
                  "for files that hold extinction only, " + value_text(*scale) +
                      ", allowed: left out, and the key extinction_per_m");
        // A kind of cloud has brought it.
        const bool known = medium_.optics.extinction_per_m > 0;
        if (!physical && check_.lacks(path_ + "extinction_per_m") && !known)
            fault(*check_.key(path_.substr(0, path_.size() - 1)), "extinction_per_m",
                  "missing, nothing, allowed: number in [0, 1e+12]");
    }

    /// Emission is kept over extinction: the two go together.
    void emission() {
        const Node* node = check_.valid_key(path_ + "emission");
        if (node == nullptr || medium_.optics.emission == Float3{0, 0, 0}) return;
        const auto refuse = [&](const std::string& what, const std::string& allowed) {
            fault(*node, "emission",
                  what + ", " + value_text(*node) + ", allowed: left out, or " + allowed);
        };
        const Scene& scene = check_.scene;
        const VolumeFormat* format = volume_format_named(medium_.source.format);
        const bool physical = format != nullptr && (format->in_extinction || format->is_particles);
        const double per_m =
            physical ? medium_.optics.extinction_scale : medium_.optics.extinction_per_m;
        const auto most = std::max(
            {medium_.optics.emission[0], medium_.optics.emission[1], medium_.optics.emission[2]});
        constexpr const char* kNotYet = " in this version";
        const Support* no = refused(scene, Feature::kEmission);
        if (no != nullptr && !has_camera_closure(scene))
            refuse(no->text, no->allowed);
        else if (check_.key(path_ + "transfer") != nullptr)
            refuse(std::string("not beside transfer") + kNotYet, "extinction_per_m");
        else if (medium_.sky.evaluate == SkyEvaluation::kDirect)
            refuse(std::string("not with a sky that is not on a grid") + kNotYet,
                   "sky.evaluate = \"grid\"");
        else if (!(double(most) <= 1e18 * per_m))
            refuse("over 1e+18 times the extinction",
                   physical ? "an extinction_scale above 0" : "an extinction_per_m above 0");
    }

    /// Its rows say what the medium is; nothing else does.
    void transfer() {
        for (const char* key : {"extinction_per_m", "extinction_scale", "albedo"})
            if (const Node* node = check_.key(path_ + key))
                fault(*node, key,
                      "conflicts with transfer, " + value_text(*node) + ", allowed: left out");
    }

    void shape_keys(const DensityRow& made, const Node& density) {
        if (const Node* node = check_.key(path_ + "format"))
            fault(*node, "format", "for files only, " + value_text(*node) + ", allowed: left out");
        if (const Node* node = check_.valid_key(path_ + "y_up"))
            if (node->flag)
                fault(*node, "y_up", "for files only, true, allowed: false or left out");
        if (const Node* node = check_.key(path_ + "shape_seed"))
            if (!made.takes_seed)
                fault(*node, "shape_seed",
                      "for " + density_names([](const DensityRow& row) { return row.takes_seed; }) +
                          " only, " + value_text(*node) + ", allowed: left out");
        if (const Node* node = check_.valid_key(path_ + "resolution"))
            if (least(medium_.box.resolution) < made.least_cells)
                fault(*node, "resolution",
                      std::string("too coarse for ") + made.name + ", " + value_text(*node) +
                          ", allowed: at least " + std::to_string(made.least_cells) +
                          " along each axis");
        if (made.needs_bounds) need_bounds(density);
    }

    static int least(const std::array<int, 3>& cells) {
        return std::min({cells[0], cells[1], cells[2]});
    }

    void need_bounds(const Node& density) {
        if (check_.lacks(path_ + "bounds_m"))
            fault(density, "bounds_m",
                  "missing, nothing, allowed: [[x, y, z], [x, y, z]], the "
                  "lowest and highest corner in metres");
    }

    void bounds() {
        const Node* node = check_.valid_key(path_ + "bounds_m");
        const Ground& ground = check_.scene.ground;
        if (node == nullptr || !ground.present) return;
        const double lowest = medium_.box.bounds_m[0][2];
        if (is_below_ground(ground, lowest, 0))
            fault(*node, "bounds_m", below_ground_text(ground, lowest, 0));
    }

    SceneCheck& check_;
    MediumSettings& medium_;
    std::size_t index_;
    std::string path_;
};

}  // namespace

void check_medium(SceneCheck& check, std::size_t index) { MediumCheck(check, index).run(); }

}  // namespace pileus
