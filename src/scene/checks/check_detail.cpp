// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of detail beyond a medium's grid, and who can show it.
// in: keys that passed their own checks -> out: faults.
// docs/detail.md, "Methods"
#include "src/scene/checks/check_keys.h"
#include "src/scene/method_column.h"

namespace pileus {
namespace {

class DetailCheck {
public:
    DetailCheck(SceneCheck& check, std::size_t index)
        : check_(check),
          medium_(check.scene.media[index]),
          detail_(medium_.detail),
          path_("medium." + std::to_string(index) + ".detail.") {}

    void run() {
        const Node* tile = check_.key(path_ + "tile_m");
        if (tile == nullptr) return needs_tile();
        // What is out of its range has its own fault.
        if (!is_sound("cells") || !is_sound("octaves")) return;
        if ((detail_.cells & (detail_.cells - 1)) != 0)
            fault(*tile, "cells",
                  "not a power of two, " + std::to_string(detail_.cells) +
                      ", allowed: 16, 32, 64, 128");
        if (kDetailLumps << detail_.octaves > detail_.cells)
            fault(*tile, "octaves",
                  "too fine for the cells, " + std::to_string(detail_.octaves) +
                      ", allowed: 0, or such that 4 * 2^octaves is at most cells, " +
                      std::to_string(detail_.cells));
        if (!detail_.present()) return;
        if (!medium_.optics.transfer.empty())
            return fault(*tile, "tile_m",
                         "not beside transfer, " + value_text(*tile) + ", allowed: left out");
        if (const Support* no = refused(check_.scene, Feature::kDetailBaked))
            return fault(
                *tile, "tile_m",
                std::string(no->text) + ", " + value_text(*tile) + ", allowed: " + no->allowed);
        if (detail_.is_marched()) marched(*tile);
    }

private:
    /// Faults point at the key, or where that is left out at the tile.
    void fault(const Node& tile, const char* key, const std::string& text) {
        const Node* node = check_.key(path_ + key);
        check_.faults.add(node != nullptr ? node->at : tile.at, path_ + key, text);
    }

    bool is_sound(const char* key) const {
        return check_.key(path_ + key) == nullptr || check_.valid_key(path_ + key) != nullptr;
    }

    void needs_tile() {
        for (const KeyRow& row : detail_keys()) {
            const std::string key = std::string(row.path).substr(sizeof "medium.N.detail." - 1);
            const Node* node = check_.key(path_ + key);
            if (node == nullptr) continue;
            check_.faults.add(node->at, path_ + "tile_m",
                              "missing, nothing, allowed: number in [1e-09, 1e+09], metres");
            return;
        }
    }

    /// The kernels that march with detail know one medium, linear between its cells.
    void marched(const Node& tile) {
        const Scene& scene = check_.scene;
        const Support* no = refused(scene, Feature::kDetailMarched);
        const char* why = nullptr;
        if (no != nullptr)
            why = no->text;
        else if (scene.media.size() > 1)
            why = "only one medium can be marched with detail";
        else if (medium_.box.constant)
            why = "cells of constant density are not marched with detail";
        else if (!scene.lights.empty())
            why = "the light of [[light]] is not marched with detail";
        if (why != nullptr) fault(tile, "refine", std::string(why) + ", 0, allowed: 1 to 16");
    }

    SceneCheck& check_;
    const MediumSettings& medium_;
    const DetailSettings& detail_;
    std::string path_;
};

}  // namespace

void check_detail(SceneCheck& check, std::size_t index) { DetailCheck(check, index).run(); }

}  // namespace pileus
