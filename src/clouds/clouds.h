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
    /// A layer of the sky, drawn in each picture by its own method. Errors: a session's; kBadInput:
    /// more than kMaxCloudLayers.
    Status add_layer(const Scene& scene, std::shared_ptr<const World> world);
    /// In place of all that there were. Those that only moved keep their pictures.
    /// kBadInput: an unknown kind; a place or size out of range.
    Status place(const std::vector<CloudPlace>& places);
    /// Where all clouds and layers are beside their places: wind, or a host's own origin that
    /// moves. kBadInput: out of range, below the ground.
    Status move(const Double3& offset_m);
    Status set_detail(const CloudDetail& detail);
    const CloudDetail& detail() const { return detail_; }
    /// Forgets light and pictures: the next picture is what a new sky's first would be.
    Status restart();
    /// Draws all, into a host's memory.
    Status render(const FrameTarget& target);
    /// Draws all; `planes` stay until the next picture. With `depths` half_depth is as layers have
    /// it: infinity where half of the light is never gone.
    Status draw(bool depths, const Planes*& planes);
    /// Light and shadows of the sky as it is set now, without a picture.
    Status prepare();
    const Double3& offset() const { return moved_; }
    /// The next pictures say what of a host's own picture comes through: Planes::kept.
    void set_over_host(bool on) { over_host_ = on; }
    /// What comes between places and the sun, as it was in the last picture; empty before it.
    const std::vector<ShadowSource>& shadows() const { return sources_; }
    const SunPlane& sun_plane() const { return plane_; }
    /// Share of the sky's light that the layers above a height let through in the mean.
    float sky_left(double z) const;
    /// Extinction at a place of the world, 1/m.
    Status extinction_at(const Double3& at, double& extinction);
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

    Status take_light(const Scenery& scenery);
    Status light_up(const Scenery& scenery);
    Status light_groups();
    Status light_layers(const Scenery& scenery);
    Status cast_shadows();
    Status draw_layers(std::vector<LayerPicture>& pictures);
    Status group_of(const CloudPlace& place, std::size_t& group);
    Status check_memory(const CloudGroup& next, std::size_t kind) const;
    CloudLight no_light() const;
    void set_anew(const CloudPlace& place, std::unique_ptr<Cloud>& cloud) const;
    void shift(const Double3& by, Cloud& cloud) const;
    void drop_groups();
    double extinction_of_clouds(const Double3& at) const;
    void judge(const CloudView& view, Cloud& cloud, Seen& seen) const;
    void look_for(const CloudView& view);
    Status renew(const CloudView& view);
    Status choose(const CloudView& view);
    Status compose(const CloudView& view, const Camera& camera, int frame);
    Status march_all(const CloudView& view, const Camera& camera, int frame,
                     const std::vector<LayerPicture>& layers, std::vector<ShownCloud>& shown);
    void keep_host(const Lighting& lighting);
    CloudShade shade_of(const Cloud& cloud) const;
    Status march(const CloudView& view, const Camera& camera, int frame, Cloud& cloud,
                 MarchedCloud& out);
    Status take_picture(const CloudView& view, Cloud& cloud);
    ShownCloud show(const CloudView& view, const Cloud& cloud, const MarchedCloud& marched) const;

    Session* sky_ = nullptr;
    std::shared_ptr<const void> in_sky_;
    RenderOptions options_;
    CloudDetail detail_;
    std::vector<CloudKind> kinds_;
    std::vector<std::unique_ptr<SkyLayer>> layers_;
    std::vector<std::unique_ptr<CloudGroup>> groups_;
    std::vector<std::unique_ptr<Cloud>> clouds_;
    CloudLight given_, light_;  ///< the sky's own, and what comes to the clouds' height
    Atmosphere air_;            ///< at the clouds' height
    Image air_map_;
    SunPlane plane_;
    CloudsOnGround on_ground_;
    std::vector<ShadowSource> sources_;                     ///< clouds, then layers
    std::vector<std::vector<ShadowSource>> layer_sources_;  ///< of each layer those above it
    Double3 moved_{};
    std::uint64_t shading_ = 0;  ///< grows with each other layer, and shadow of one
    bool lit_ = false, shaded_ = false, over_host_ = false;
    Planes planes_;
    /// Pictures of near clouds of this frame, and those that another one of its group would
    /// overwrite.
    std::vector<MarchedCloud> marched_;
    std::vector<std::unique_ptr<Planes>> copies_;
    CloudStats stats_;
    ThreadPool threads_;
    std::vector<Seen> seen_;
};

}  // namespace pileus
