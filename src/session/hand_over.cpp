// SPDX-License-Identifier: Apache-2.0
// From one density to the next: a lit session draws on in place of another, whose last picture
// fades. in: two live sessions of one method -> out: the next one with the first one's view.
// Elek 2011, 4.2; docs/living.md
#include <glm/geometric.hpp>

#include "platform/fp_mode.h"
#include "src/picture/background.h"
#include "src/picture/fading.h"
#include "src/picture/march_view.h"
#include "src/session/session.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

/// The most pictures that a hand-over may take.
constexpr std::uint32_t kMaxFrames = 10000;
/// How far an eye goes, in parts of its way to the media, before what fades is the last mixture in
/// place of the first picture: 4 degrees about the media.
constexpr double kRetakeAt = 0.07;
/// And how far in one picture before it is another view, of which no earlier picture tells.
constexpr double kCutAt = 0.35;

/// How far the eye went from one camera to the other, as above. Turning it in place is no way, but
/// for parallel rays, which then see another side.
double way_between(const Camera& a, const Camera& b, const Medium& medium) {
    if (a.orthographic != b.orthographic || a.flux != b.flux) return kCutAt + 1;
    // A flat detector sees along no single ray.
    if (a.flux && (a.position_m != b.position_m || a.target_m != b.target_m)) return kCutAt + 1;
    if (a.orthographic)
        return glm::distance(glm::normalize(a.target_m - a.position_m),
                             glm::normalize(b.target_m - b.position_m));
    const Double3 extent{medium.extent_m[0], medium.extent_m[1], medium.extent_m[2]};
    const double reach = glm::distance(b.position_m, medium.low_m + 0.5 * extent);
    // Within the media things are near, but not at no distance.
    const double least = 0.25 * glm::length(extent);
    return glm::distance(a.position_m, b.position_m) / (reach > least ? reach : least);
}

class FadingLast final : public Fading {
public:
    FadingPicture old;
    Camera camera;              ///< that saw it
    bool had_surfaces = false;  ///< solid things that are not the ground's
    std::uint32_t frames = 0;

    Status begin(const Context& context, const Scenery& scenery, Planes* shown,
                 bool& goes_on) override {
        const Scene& scene = *scenery.scene;
        const Medium& medium = scenery.world->medium;
        goes_on = !gone_ && next_ < frames &&
                  way_between(next_ > 1 ? last_ : camera, scene.camera, medium) <= kCutAt;
        if (!goes_on || next_ == 1 || way_between(camera, scene.camera, medium) <= kRetakeAt)
            return Status::ok();
        const auto& size = last_.resolution;
        if (shown == nullptr || !are_whole(*shown, size[0], size[1])) return Status::ok();
        const StageClock clock(context, "hand-over");
        PILEUS_TRY(keep_picture(context, size[0], size[1], nullptr, *shown, old));
        held_ = double(next_ - 1) / double(frames);
        camera = last_;
        return Status::ok();
    }

    Status mix(const Context& context, const Scenery& scenery, bool leave,
               Planes*& planes) override {
        const StageClock clock(context, "hand-over");
        const Scene& scene = *scenery.scene;
        const Medium& medium = scenery.world->medium;
        FadeInput in;
        in.before = make_camera(camera, 0, medium.low_m);
        in.camera = make_camera(scene.camera, 0, medium.low_m);
        in.medium = make_medium_view(medium, Majorants{});
        in.share = float((double(next_) / double(frames) - held_) / (1 - held_));
        in.solids = had_surfaces || has_surfaces(scenery.lighting);
        gone_ = !can_mix(in, old, *planes);
        if (gone_) return Status::ok();
        if (leave) {
            PILEUS_TRY(copy_picture(context, *planes, mixed_));
            planes = &mixed_;
        }
        mix_pictures(context, in, old, *planes);
        last_ = scene.camera;
        ++next_;
        return Status::ok();
    }

private:
    Planes mixed_;  ///< where a picture's own planes are left alone
    Camera last_;   ///< of the last picture
    std::uint32_t next_ = 1;
    double held_ = 0;  ///< of the new density, in the picture that fades
    bool gone_ = false;
};

Status refuse(const std::string& what, const std::string& allowed) {
    return Status::bad_input("hand_over: " + what + ", allowed: " + allowed);
}

std::string size_of(const Camera& camera) {
    return std::to_string(camera.resolution[0]) + " x " + std::to_string(camera.resolution[1]);
}

}  // namespace

void Session::keep(const std::shared_ptr<const void>& lent) {
    for (const std::shared_ptr<const void>& own : lent_)
        if (own == lent) return;
    lent_.push_back(lent);
}

Status Session::check_take_over(const Session& from, std::uint32_t frames) const {
    if (&from == this) return refuse("next is the session itself", "another");
    if (frames > kMaxFrames)
        return refuse("frames: " + std::to_string(frames), "0 to " + std::to_string(kMaxFrames));
    if (seal_.on || from.seal_.on)
        return refuse("a flight keeps its density", "sessions of pileus_session_create");
    // Skies of many clouds (src/clouds) hold their session, which has none.
    if (world().media == 0 || from.world().media == 0)
        return refuse("a world without media", "one with a density that gives way to another");
    if (scene_.method != from.scene_.method)
        return refuse("next has method \"" + scene_.method + "\"",
                      "\"" + from.scene_.method + "\", as the session");
    if (host_.camera.resolution != from.host_.camera.resolution)
        return refuse("next has pictures of " + size_of(host_.camera),
                      size_of(from.host_.camera) + ", as the session");
    if (context_.threads != from.context_.threads)
        return refuse("next has " + std::to_string(context_.threads) + " threads",
                      std::to_string(from.context_.threads) + ", as the session");
    return Status::ok();
}

Status Session::fade_from(Session& from, std::uint32_t frames, std::unique_ptr<Fading>& fading) {
    const auto& size = from.last_.camera.resolution;
    if (frames < 2 || from.last_.planes == nullptr ||
        !are_whole(*from.last_.planes, size[0], size[1]))
        return Status::ok();
    const StageClock clock(from.context_, "hand-over");
    auto made = std::make_unique<FadingLast>();
    made->camera = from.last_.camera;
    made->had_surfaces = has_surfaces(from.scenery_.lighting);
    made->frames = frames;
    Planes own, *planes = from.last_.planes;
    if (from.made_.method->keeps_planes()) {
        PILEUS_TRY(copy_picture(from.context_, *planes, own));
        planes = &own;
    }
    PILEUS_TRY(keep_picture(from.context_, size[0], size[1],
                            from.late_.ready ? &from.late_ : nullptr, *planes, made->old));
    fading = std::move(made);
    return Status::ok();
}

/// What is refused leaves this session's own view.
Status Session::take_view(const Session& from) {
    const Placement before = host_.placement;
    PILEUS_TRY(set_placement(from.host_.placement.offset_m, from.host_.placement.yaw_deg));
    const Camera camera = host_.camera;
    Status status = set_camera(from.host_.camera);
    if (status && whole_work_ == from.whole_work_) status = set_work(from.work_);
    if (status) return status;
    host_.camera = camera;
    host_.placement = before;
    return status;
}

Status Session::take_over(Session& from, std::uint32_t frames) {
    const FpModeGuard guard;
    PILEUS_TRY(check_take_over(from, frames));
    const Placement placement = host_.placement;
    const Camera camera = host_.camera;
    PILEUS_TRY(take_view(from));
    std::unique_ptr<Fading> fading;
    const PoolGuard lent(*from.threads_);
    const Status kept = fade_from(from, frames, fading);
    if (!kept) {
        host_.placement = placement;
        host_.camera = camera;
        return kept;
    }
    // Nothing is refused from here on.
    fading_ = std::move(fading);
    from.fading_.reset();
    from.last_.planes = nullptr;
    depth_scale_ = from.depth_scale_;
    changed_.stale = changed_.stale || host_.number != from.host_.number;
    host_.number = from.host_.number;
    CameraDepth &own = scenery_.environment.depth, &given = from.scenery_.environment.depth;
    if (own.present || given.present) {
        std::swap(own, given);
        changed_.stale = from.changed_.stale = true;
    }
    threads_.swap(from.threads_);
    std::swap(context_.progress, from.context_.progress);
    std::swap(context_.interrupted, from.context_.interrupted);
    return Status::ok();
}

}  // namespace pileus
