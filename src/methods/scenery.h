// SPDX-License-Identifier: Apache-2.0
// A scene with its world and what lights it, and the opening of a method over it.
// in: a placed scene, a method that was made for it -> out: a prepared method with its plan.
// docs/architecture.md, "Methods"
#pragma once
#include <memory>
#include <string>

#include "src/methods/method.h"
#include "src/picture/nodes/sun_slices.h"
#include "src/scene/frames.h"

namespace pileus {

class WeatherFiles;

/// What sessions, verification and flux draw with.
struct Scenery {
    Scenery() = default;
    /// A scene that stays as it is.
    explicit Scenery(const Scene& still) { show(still, still); }
    /// Of `scene` from now on, whose frame at rest is `rest`; both outlive this.
    void show(const Scene& shown, const FrameState& at_rest) {
        scene = &shown;
        rest = &at_rest;
        depths = shown.output.layer_depth;
    }

    const Scene* scene = nullptr;           ///< its frame is in the media's coordinates
    const FrameState* rest = nullptr;       ///< of it, but for keys
    const HostMedia* media = nullptr;       ///< in place of the scene's; null: none
    std::shared_ptr<WeatherFiles> weather;  ///< that the scene is read with; null: none is kept
    bool keyed = false;                     ///< keys move it; opened at frame 0
    bool depths = false;                    ///< as FrameView's
    std::shared_ptr<const World> world;
    Environment environment;
    Lighting lighting;  ///< of the frame that was lit last

    /// The lights of a frame, as the scene is now.
    void light(int frame) {
        lighting = light_of(*scene, sun_at(*scene, rest->sun, frame), *world, environment);
    }
    /// A frame as methods see it; points into this.
    FrameView view(int frame) {
        const Double3& low_m = world->medium.low_m;
        return {*scene,
                *world,
                environment,
                lighting,
                frame,
                rest,
                make_camera(scene->camera, orbit_at(*scene, frame), low_m),
                depths};
    }
};

/// Fills the world and the environment of a scenery that has its scene, then prepares the method;
/// `exact` false: as far as sizes tell. `world`: a loaded one to share, or null for its own. `sky`:
/// in place of the sky map's file, or null. Errors: those of the readers and of the method.
Status open_method(const MethodRow& row, const MadeMethod& made, const Context& context, bool exact,
                   const Image* sky, std::shared_ptr<const World> world, Scenery& scenery,
                   Plan& plan);

/// The plan of an open method: again where its sums have been laid out anew. kLimit: over the limit
/// of memory or of work.
Status make_plan(const MadeMethod& made, const Context& context, Scenery& scenery, Plan& plan);

/// A picture of the view as it is seen through the air, in its planes. kLimit: out of memory.
Status show_air(const Context& context, const FrameView& view, Planes& planes);

/// A world of the scene alone, as far as sizes tell.
Status outline_own_world(const Scene& scene, WorldUse use, const HostMedia& given,
                         const Context& context, std::shared_ptr<World>& world);
/// Of all frames of its film.
Status check_all_frames(const Scenery& scenery);
/// Places of media that hosts and files may not give them, of a frame of a scene whose ground is
/// `rest` where no key moves it.
Status check_placed_media(const Scenery& scenery, const Ground& rest, int frame);

/// The fault of a budget of a kind that the method does not know.
inline Status unknown_budget(const char* option, const std::string& method, const char* allowed) {
    return Status::bad_input(std::string(option) + ": not for method " + method +
                             ", allowed: " + allowed);
}

/// Frame `turn`, whose sun is the view's. Frames of an animation are what they are wherever it
/// begins; those before its first have that one's sun. A host's are counted.
SunTurn turn_of_sun(const FrameView& view, int slices, std::int64_t turn);

}  // namespace pileus
