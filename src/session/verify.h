// SPDX-License-Identifier: Apache-2.0
// How wrong a finished picture is: some of its pixels against the path tracer.
// in: a scene, its world, a picture -> out: bias, its standard error and relMSE in the report.
// docs/report.md, "Verify"
#pragma once
#include "src/methods/path/path_method.h"
#include "src/methods/scenery.h"
#include "src/plan/crop.h"
#include "src/session/render.h"

namespace pileus {

class Verifier {
public:
    Verifier() = default;
    Verifier(const Verifier&) = delete;
    Verifier& operator=(const Verifier&) = delete;

    /// kBadInput: a device, a sky that is evaluated in place; else as path's plan.
    Status open(const Scene& scene, const FrameState& frame, std::uint64_t pixels,
                const Context& context, std::shared_ptr<const World> world);

    /// Traces pixels of a frame and fills the report's figures; none where no pixel shows media, or
    /// where the user ends it.
    Status check(int frame, const Context& context, const Image& image, const Shown& shown,
                 Report& report);

private:
    void place(int frame);
    Status set_view(int frame, const Context& context);
    Status see_through_air(int frame, const Context& context,
                           const std::vector<std::uint32_t>& pixels,
                           std::vector<PixelLight>& paths);
    Scene scene_;
    FrameState rest_;  ///< as it is but for keys
    std::uint64_t pixels_ = 0;
    Scenery scenery_;
    Plan plan_;
    MadeMethod made_;
    PathMethod* path_ = nullptr;  ///< the one that was made
    bool own_paths_ = false;      ///< the pictures are by paths themselves
};

}  // namespace pileus
