// SPDX-License-Identifier: Apache-2.0
// A part of a picture with the bits that it has in the whole.
// in: a scene with camera.crop -> out: the window that is worked out for it; the image cut to it.
// docs/program.md, "A part of a picture"
#pragma once
#include "src/io/images/image.h"
#include "src/plan/budget.h"
#include "src/plan/part_light.h"
#include "src/plan/plan.h"
#include "src/scene/scene.h"

namespace pileus {

/// What of the window that is worked out is shown; x1 = 0: all of it.
struct Shown {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    bool all() const { return x1 == 0; }
    bool holds(int x, int y) const { return all() || (x >= x0 && x < x1 && y >= y0 && y < y1); }
};

/// Why a scene with camera.crop has all of its picture worked out; null: a window does.
const char* whole_for_crop(const Scene& scene);

/// Makes the scene's camera that of the window around camera.crop: its resolution is the window's,
/// which has the pixels that others look at and begins and ends where rows are divided. Without
/// camera.crop the scene stays as it is.
Shown take_window(Scene& scene);

/// The rows of the scene's window that are a part's, from the top; none where there are fewer bands
/// than parts.
std::vector<int> rows_of(const Camera& camera, const WorkPart& part);

/// The camera becomes that of these rows.
void take_rows(const WorkPart& part, Camera& camera);

/// What the plan says of it, after take_window.
void explain_crop(const Scene& scene, Plan& plan);

/// Whether light is traced until an error is reached, which no part of a picture knows.
bool aims_at_error(const Scene& scene, const Budget& budget);

/// kBadInput: what would look at other pixels, or at another number of samples, than all of the
/// picture does.
Status check_crop(const Scene& scene, const Budget& budget, bool is_view);

/// The shown pixels of an image of the window; `display` is the whole picture. kLimit: no memory.
Status cut_image(const Camera& camera, const Shown& shown, Image& image);

}  // namespace pileus
