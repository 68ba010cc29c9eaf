// SPDX-License-Identifier: Apache-2.0
// See crop.h.
#include "src/plan/crop.h"

#include <algorithm>

#include "kernels_cpu/core/camera.h"
#include "src/io/images/picture_layers.h"
#include "src/scene/method_column.h"
#include "src/scene/read_scene.h"

namespace pileus {
namespace {

/// Columns that the kernels of air look at together, and rows that upsampling does: a window begins
/// and ends between them (kernels_cpu/display/air_rows.h).
constexpr int kColumns = 32, kRows = 4;

/// Few pixels of which are marched; null: by the method's name none.
const UpsampleSettings* thin_of(const Scene& scene) {
    switch (method_column(scene)) {
        case MethodColumn::kCollectors:
            return &scene.collectors.thin;
        case MethodColumn::kPhotonGrid:
            return &scene.photon_grid.thin;
        case MethodColumn::kRaymarch:
            return &scene.raymarch.thin;
        default:
            return nullptr;
    }
}

/// Pixels around that a pixel's own values depend on: those that its standard error is steadied by,
/// and marched ones that others are filled in from.
int margin_of(const Scene& scene) {
    const UpsampleSettings* thin = thin_of(scene);
    return thin != nullptr && thin->scale > 1 ? 2 * thin->scale + 1 : 1;
}

struct Range {
    int begin, end;
};
/// The pixels [begin, end) with those around, as they are divided.
Range widened(int begin, int end, int margin, int unit, int size) {
    const int low = std::max(begin - margin, 0) / unit * unit;
    const int high = (std::min(end + margin, size) + unit - 1) / unit * unit;
    return {low, std::min(high, size)};
}

}  // namespace

const char* whole_for_crop(const Scene& scene) {
    if (scene.clouds.present()) return "clouds are shown by impostors of the whole view";
    if (scene.filter.kind != FilterKind::kNone) return "a filter sees the whole picture";
    if (method_column(scene) == MethodColumn::kCollectorBillboards)
        return "billboards are blended in tiles of the whole picture";
    const UpsampleSettings* thin = thin_of(scene);
    if (thin != nullptr && thin->temporal > 0) return "pixels are taken from the frame before";
    return nullptr;
}

std::vector<int> rows_of(const Camera& camera, const WorkPart& part) {
    std::vector<int> rows;
    for (int y = 0; y < camera.resolution[1]; ++y)
        if (y / kPartRows % int(part.count) == int(part.index)) rows.push_back(y);
    return rows;
}

void take_rows(const WorkPart& part, Camera& camera) {
    const int own = int(rows_of(camera, part).size());
    camera.window.parts = int(part.count);
    camera.window.part = int(part.index);
    camera.window.more[1] += camera.resolution[1] - own;
    camera.resolution[1] = own;
}

void explain_crop(const Scene& scene, Plan& plan) {
    const std::array<int, 4>& c = scene.crop;
    if (c[2] == 0) return;
    if (const char* why = whole_for_crop(scene)) {
        plan.needed.push_back(std::string("the picture outside camera.crop: ") + why);
        return;
    }
    const Camera& camera = scene.camera;
    const auto size = [](int width, int height) {
        return std::to_string(width) + " x " + std::to_string(height);
    };
    plan.left_out.push_back({"the picture outside camera.crop",
                             size(camera.resolution[0], camera.resolution[1]) + " pixels of " +
                                 size(camera.resolution[0] + camera.window.more[0],
                                      camera.resolution[1] + camera.window.more[1]) +
                                 " are worked out"});
}

bool aims_at_error(const Scene& scene, const Budget& budget) {
    // So many samples, whatever the scene's error.
    const bool by_scene = method_column(scene) == MethodColumn::kPath &&
                          scene.path.target_error > 0 && budget.samples < 0;
    return budget.error > 0 || by_scene;
}

Status check_crop(const Scene& scene, const Budget& budget, bool is_view) {
    if (scene.crop[2] == 0) return Status::ok();
    if (is_view) return Status::bad_input("--show: together with camera.crop, allowed: without");
    if (aims_at_error(scene, budget))
        return at_key(
            scene, "camera.crop",
            Status::bad_input("together with an error to reach, for which its pixels would "
                              "have other samples than in the whole picture, allowed: "
                              "--budget samples=N or photons=N"));
    return Status::ok();
}

Shown take_window(Scene& scene) {
    const std::array<int, 4>& c = scene.crop;
    if (c[2] == 0) return {};
    if (whole_for_crop(scene) != nullptr) return {c[0], c[1], c[2], c[3]};
    Camera& camera = scene.camera;
    const int margin = margin_of(scene);
    const Range x = widened(c[0], c[2], margin, kColumns, camera.resolution[0]);
    const Range y = widened(c[1], c[3], margin, kRows, camera.resolution[1]);
    const std::array<int, 2> size{x.end - x.begin, y.end - y.begin};
    camera.window.at = {x.begin, y.begin};
    camera.window.more = {camera.resolution[0] - size[0], camera.resolution[1] - size[1]};
    camera.resolution = size;
    return {c[0] - x.begin, c[1] - y.begin, c[2] - x.begin, c[3] - y.begin};
}

Status cut_image(const Camera& camera, const Shown& shown, Image& image) {
    if (shown.all()) return Status::ok();
    PILEUS_TRY(cut_pixels(shown.x0, shown.y0, shown.x1, shown.y1, image));
    const PictureWindow& window = camera.window;
    image.display = {-(shown.x0 + window.at[0]), -(shown.y0 + window.at[1]),
                     camera.resolution[0] + window.more[0], camera.resolution[1] + window.more[1]};
    return Status::ok();
}

}  // namespace pileus
