// SPDX-License-Identifier: Apache-2.0
// A sky of many clouds: prepared once each kind, placed as often as wanted, near ones marched, far
// ones shown by pictures of earlier frames.
// in: a session of the sky around them, kinds, places -> out: pictures of all of it.
// docs/clouds.md
#pragma once
#include "src/clouds/compose.h"
#include "src/session/session.h"

namespace pileus {

/// Of one picture.
struct CloudStats {
    std::uint32_t clouds = 0, visible = 0, marched = 0, captured = 0, lit = 0;
    std::uint64_t marched_pixels = 0, captured_pixels = 0;
    double worst_px = 0;  ///< largest error of a picture that was shown
};

class Clouds {
public:
    /// `sky`: a live session without media, whose camera, sun, sky or air, ground, depths and frame
    /// are those of the pictures; outlives this. kBadInput: one with media.
    Status open(Session& sky);
    /// kBadInput: a world of another scene, a method of no sessions, a medium without end.
    Status add_kind(const Scene& scene, std::shared_ptr<const World> world, std::size_t& kind);
    /// In place of all that there were. Those that stay where they were keep their pictures.
    /// kBadInput: an unknown kind; a place or size out of range.
    Status place(const std::vector<CloudPlace>& places);
    Status set_detail(const CloudDetail& detail);
    /// Forgets light and pictures: the next picture is what a new sky's first would be.
    void restart();
    /// Draws all, into a host's memory.
    Status render(const FrameTarget& target);
    /// Draws all; `planes` stay until the next picture. With `depths` half_depth is as layers have
    /// it: infinity where half of the light is never gone.
    Status draw(bool depths, const Planes*& planes);
    const CloudStats& stats() const { return stats_; }
    /// kBadInput, `where` first: at such a place a cloud would be below the ground.
    Status check_height(const std::string& where, const Ground& ground,
                        const CloudPlace& place) const;
    /// Corners of a kind's box, in its own metres.
    const CloudKind& kind(std::size_t number) const { return kinds_[number]; }

private:
    struct Cloud {
        CloudPlace place;
        CloudBox box;
        std::size_t group = 0;
        Buffer<float> shade;
        Impostor newer, older;
        bool newer_marched = false, older_marched = false, has_older = false, seen = false;
        int faded = 0;  ///< frames since `newer` came
    };
    /// A cloud of the picture. `error` of its picture, in what is allowed.
    struct Seen {
        std::size_t cloud = 0;
        double distance = 0, error = 0;
        PixelRect rect;
    };

    Status light_up(const Scenery& scenery);
    Status cast_shadows();
    Status group_of(const CloudPlace& place, std::size_t& group);
    Status check_memory(const CloudGroup& next, std::size_t kind) const;
    void set_anew(const CloudPlace& place, std::unique_ptr<Cloud>& cloud) const;
    void drop_groups();
    void judge(const CloudView& view, Cloud& cloud, Seen& seen) const;
    void look_for(const CloudView& view);
    Status renew(const CloudView& view);
    Status choose(const CloudView& view);
    Status compose(const CloudView& view, const Camera& camera, int frame);
    CloudShade shade_of(const Cloud& cloud) const;
    Status march(const CloudView& view, const Camera& camera, int frame, Cloud& cloud,
                 MarchedCloud& out);
    Status take_picture(const CloudView& view, Cloud& cloud);
    CloudLayer layer_of(const CloudView& view, const Cloud& cloud,
                        const MarchedCloud& marched) const;

    Session* sky_ = nullptr;
    std::shared_ptr<const void> in_sky_;
    RenderOptions options_;
    CloudDetail detail_;
    std::vector<CloudKind> kinds_;
    std::vector<std::unique_ptr<CloudGroup>> groups_;
    std::vector<std::unique_ptr<Cloud>> clouds_;
    CloudLight given_, light_;  ///< the sky's own, and what comes to the clouds' height
    Atmosphere air_;            ///< at the clouds' height
    Image air_map_;
    SunPlane plane_;
    CloudsOnGround on_ground_;
    bool lit_ = false, shaded_ = false;
    Planes planes_;
    CloudStats stats_;
    ThreadPool threads_;
    std::vector<Seen> seen_;
};

}  // namespace pileus
