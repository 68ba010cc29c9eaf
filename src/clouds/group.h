// SPDX-License-Identifier: Apache-2.0
// Clouds of one kind that are turned alike towards the sun: one session, whose light they share.
// in: a kind's scene and world, the light around -> out: pictures of it, its shadow.
// docs/clouds.md, "Shared light"
#pragma once
#include <memory>

#include "src/clouds/place.h"
#include "src/session/session.h"

namespace pileus {

/// A cloud as it was prepared.
struct CloudKind {
    Scene scene;  ///< without air and solids, which are the sky's
    std::shared_ptr<const World> world;
    Double3 low_m{}, high_m{};
};

/// What shines on clouds: sun and sky at their height, the ground below.
struct CloudLight {
    Sun sun;
    Sky sky;
    const Image* map = nullptr;  ///< null: the constant sky
    Ground ground;
    std::array<float, 3> level{};  ///< irradiance of sun and sky on level ground
    std::uint64_t version = 0;     ///< grows with each change
};

/// What light of `then` is to be multiplied with to be nearly that of `now`: 1 where it is the
/// same.
std::array<float, 3> light_gain(const std::array<float, 3>& then, const std::array<float, 3>& now);

/// Texels along a side of a shadow.
constexpr int kSunTexels = 64;

class CloudGroup {
public:
    /// `ground_m`: of the ground, in the kind's metres; see stand_over. Errors: those of a session.
    Status open(const CloudKind& kind, std::size_t number, double yaw_deg, const CloudLight& light,
                double ground_m, const RenderOptions& options);
    bool is(std::size_t kind, double yaw_deg) const { return kind_ == kind && yaw_deg_ == yaw_deg; }
    std::uint64_t lit() const { return lit_; }
    /// The sun and the irradiance on level ground that it was lit by.
    const Sun& lit_sun() const { return lit_sun_; }
    const std::array<float, 3>& lit_level() const { return lit_level_; }
    /// Light from below is that of a ground without end, wherever it lies: it lies lower than all
    /// cameras, and where a cloud needs it lower it goes there.
    Status stand_over(double ground_m);
    /// Takes up the light; traces what it needs.
    Status light(const CloudLight& light);

    /// What a picture of the cloud alone may cost and lack.
    struct Work {
        int scale = 1;         ///< as FrameWork's, where the method has it
        int frame = 0;         ///< number of the picture
        double slack_deg = 0;  ///< as Session::draw_alone's
    };
    /// With a camera in the kind's metres, in which depths are, too. The group keeps the planes
    /// until its next picture.
    Status draw(const Camera& camera, const Work& work, const Planes*& planes);

    /// [y][x], share of sunlight that comes through, seen from the sun; rows from the top, which is
    /// SunPlane::up's side. The square's half side is `shadow_radius()` of the kind's metres.
    const Buffer<float>& shadow() const { return shadow_; }
    double shadow_radius() const { return radius_; }
    /// Mean radiance of what the cloud shows, for an alpha of 1, that did not come straight from
    /// the sun.
    const std::array<float, 3>& ambient() const { return ambient_; }
    /// Most that it takes beside its kind's world, by its plan.
    std::uint64_t own_bytes() const {
        const std::uint64_t all = session_->plan().memory.peak();
        const std::uint64_t shared = bytes_of_world(session_->world());
        return all > shared ? all - shared : 0;
    }
    int threads() const { return session_->context().threads; }

private:
    Status trace();
    Camera parallel_camera(int pixels, const Double3& from) const;
    Status draw_shadow(const CloudLight& light);
    Status mean_radiance(std::array<double, 3>& mean);

    std::size_t kind_ = 0;
    double yaw_deg_ = 0;
    Double3 middle_{};
    double radius_ = 0;
    Ground ground_;
    bool has_scale_ = false;
    std::unique_ptr<Session> session_;
    Buffer<float> shadow_;
    std::array<float, 3> ambient_{};
    std::uint64_t lit_ = 0;
    Sun lit_sun_;
    std::array<float, 3> lit_level_{};
};

/// Axes of the plane that the sun looks at, right and up as it sees them.
struct SunPlane {
    Double3 to_sun{}, right{}, up{};
};
SunPlane sun_plane(const Sun& sun);

}  // namespace pileus
