// SPDX-License-Identifier: Apache-2.0
// A sheet of clouds over all of the sky: a session whose media alone are drawn, between the clouds
// of a sky, and what of the sun comes through it.
// in: a scene with media that have a place, light, a camera -> out: planes; a shadow map.
// docs/clouds.md, "Layers"
#pragma once
#include "src/clouds/shade.h"
#include "src/session/session.h"

namespace pileus {

/// Texels along a side of a layer's shadow, of which so many rows are drawn in a frame.
constexpr int kLayerTexels = 256, kLayerRows = 16;

class SkyLayer {
public:
    /// kBadInput: solids, a method of one camera's light alone, a sky of clouds itself.
    static Status check(const Scene& scene, const World& world);
    /// Errors: those of a session.
    Status open(const Scene& scene, std::shared_ptr<const World> world, const CloudLight& light,
                const Camera& camera, const RenderOptions& options);
    /// As if it were new: another film's frame begins.
    Status restart(const CloudLight& light, const Camera& camera);

    /// Takes up sun, sky and ground; `sun`: at the layer's height. `camera`: of the next picture.
    Status light(const CloudLight& light, const Sun& sun, const Camera& camera);
    /// kBadInput, `where` first: moved by this it would reach below the ground.
    Status check_height(const std::string& where, const Ground& ground,
                        const Double3& offset_m) const;
    /// Moves all of it; the shadow with it.
    Status move(const Double3& offset_m);
    /// `opaque`: metres along each ray of the camera to what hides; empty: nothing.
    Status draw(const Camera& camera, int frame, Span<const float> opaque, const Planes*& planes);

    /// Draws the next rows of the shadow around `eye`, or all of it where there is none. `changed`:
    /// another one is ready.
    /// `at_once`: another shadow is drawn in one frame. `sun`: there is one.
    Status follow_shadow(const SunPlane& plane, bool sun, const Double3& eye, double sun_deg,
                         bool at_once, bool& changed);
    /// Extinction around a place of the world, 1/m.
    Status extinction_at(const Double3& at, double& extinction);
    /// What it throws; no texels: what it leaves in the mean.
    ShadowSource shadow() const;
    /// Share of the light from straight above that comes through in the mean; of one in a box 1, as
    /// its box is not all of the sky.
    float mean_left() const { return boxed_ ? 1.0f : mean_; }
    /// Whether something that is so low may lie in its shadow.
    double low_m() const { return low_m_ + offset_.z; }

    /// Altitude of the middle, m.
    double middle_m() const { return 0.5 * (low_m_ + high_m_) + offset_.z; }
    /// Where less than half is hidden: metres along a ray to the middle of its way through the
    /// layer.
    double way_to_middle(const Double3& eye, const Double3& ray) const;
    std::uint64_t own_bytes() const;
    const Session& session() const { return *session_; }

private:
    /// A shadow map, or one that is drawn in parts.
    struct Map {
        bool made = false;
        SunPlane plane;
        Double3 middle{};
        int rows = 0;  ///< done
        Buffer<float> texels;
    };
    Status draw_shadow_rows(Map& map, int rows);
    Status draw_next(const SunPlane& plane, const Double3& eye, int rows);

    Scene scene_;
    std::shared_ptr<const World> world_;
    RenderOptions options_;
    std::unique_ptr<Session> session_, sunward_;
    double low_m_ = 0, high_m_ = 0;  ///< altitudes
    bool boxed_ = false;             ///< it ends at the sides, too
    float mean_ = -1;                ///< of a sun at the zenith; below 0: not known
    Double3 offset_{};
    std::uint64_t version_ = 0;
    bool stepped_ = false;
    Map shown_, next_;
};

}  // namespace pileus
