// SPDX-License-Identifier: Apache-2.0
// The C++17 interface of skies of many clouds: an owner over the functions of pileus.h, by
// the rules of pileus.hpp. docs/clouds.md
#ifndef PILEUS_CLOUDS_HPP
#define PILEUS_CLOUDS_HPP

#include <pileus/pileus.h>

#include <memory>
#include <pileus/pileus.hpp>
#include <utility>
#include <vector>

namespace pileus::embed {

/// Where a cloud stands: turned about the z axis through its kind's origin (counter-clockwise seen
/// from above), made larger, then shifted.
struct Cloud {
    std::uint32_t kind = 0;
    glm::dvec3 offset_m{0};  ///< each within 1e7
    double yaw_deg = 0;      ///< -360 to 360; clouds of one kind and turn share their light
    double scale = 1;        ///< 0.01 to 100; the optical thickness stays as it is
};

/// How exact far clouds are. 0: what is in brackets.
struct CloudDetail {
    bool off = false;              ///< every cloud is marched whole in every picture
    double error_px = 0;           ///< that parts of a far cloud may be off, 0.001 to 16 [0.5]
    double near_px = 0;            ///< clouds of that size are marched in every picture [256]
    std::uint32_t near_scale = 0;  ///< of those one pixel of so many along x and y: 1, 2, 4 [2]
    std::uint32_t blend_frames =
        0;                 ///< over which one impostor cross-fades to the next, to 1000 [8]
    double sharpness = 0;  ///< texels of a far cloud for a pixel, 0.25 to 4 [1]
    std::uint64_t frame_pixels = 0;  ///< of far clouds that one picture may draw anew [60000]
    double sun_deg = 0;              ///< that the sun may move before clouds are lit anew [0.5]
};

/// Of the last picture.
struct CloudStats {
    std::uint32_t clouds = 0, visible = 0;  ///< in all; of them in the picture
    std::uint32_t marched = 0;              ///< drawn anew for this picture
    std::uint32_t captured = 0;             ///< far clouds whose picture was drawn anew
    std::uint32_t lit = 0;                  ///< kinds in a turn that were lit
    std::uint64_t marched_pixels = 0, captured_pixels = 0;
    double worst_px = 0;  ///< largest error of a far cloud's picture, in pixels
};

/// Clouds in a sky, which keep the session of the sky: its camera, sun, air, ground, depths and
/// frame number are those of the pictures, and are set in it.
class Clouds {
public:
    Clouds() = default;
    Clouds(Clouds&&) = default;
    /// What was owned goes before its sky does.
    Clouds& operator=(Clouds&& from) noexcept {
        handle_ = std::move(from.handle_);
        sky_ = std::move(from.sky_);
        return *this;
    }

    /// None at first; takes the sky where it succeeds. kBadInput: a session with media.
    static Result<Clouds> create(Session&& sky) {
        pileus_clouds* handle = nullptr;
        Status status = detail::status_of(
            [&](pileus_error* error) { return pileus_clouds_create(sky.get(), &handle, error); });
        if (!status) return status;
        Clouds clouds;
        clouds.handle_.reset(handle);
        clouds.sky_ = std::move(sky);
        return clouds;
    }

    /// A kind of cloud, and its number, from 0 on: media in boxes, with a method of sessions. World
    /// and scene may go afterwards. Errors: kBadInput, kLimit.
    Result<std::uint32_t> add_kind(const World& world, const Scene& scene) {
        std::uint32_t kind = 0;
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_clouds_add_kind(get(), world.get(), scene.get(), &kind, error);
        });
        if (!status) return status;
        return kind;
    }

    /// All clouds, up to 1000, in place of those that there were. One that has the number and the
    /// place that it had keeps its pictures. Errors: kBadInput, and all are as they were.
    Status place(const std::vector<Cloud>& clouds) {
        std::vector<pileus_cloud> given;
        for (const Cloud& cloud : clouds) {
            given.push_back(detail::cleared<pileus_cloud>());
            pileus_cloud& c = given.back();
            c.kind = cloud.kind;
            detail::store(cloud.offset_m, c.offset_m);
            c.yaw_deg = cloud.yaw_deg;
            c.scale = cloud.scale;
        }
        return detail::status_of([&](pileus_error* error) {
            return pileus_clouds_place(get(), given.data(), detail::count_of(given.size()), error);
        });
    }

    Status set_detail(const CloudDetail& d) {
        auto c = detail::cleared<pileus_cloud_detail>();
        c.off = d.off ? 1 : 0;
        c.error_px = d.error_px, c.near_px = d.near_px, c.near_scale = d.near_scale;
        c.blend_frames = d.blend_frames, c.sharpness = d.sharpness;
        c.frame_pixels = d.frame_pixels, c.sun_deg = d.sun_deg;
        return detail::status_of(
            [&](pileus_error* error) { return pileus_clouds_set_detail(get(), &c, error); });
    }

    /// Draws sky, ground and clouds for what the sky is set to now, as Session::render does.
    Status render(const Frame& frame) {
        const pileus_frame c = detail::frame_of(frame);
        return detail::status_of(
            [&](pileus_error* error) { return pileus_clouds_render(get(), &c, error); });
    }

    Result<CloudStats> stats() const {
        auto c = detail::cleared<pileus_cloud_stats>();
        Status status = detail::status_of(
            [&](pileus_error* error) { return pileus_clouds_stats(get(), &c, error); });
        if (!status) return status;
        return CloudStats{c.clouds, c.visible,        c.marched,         c.captured,
                          c.lit,    c.marched_pixels, c.captured_pixels, c.worst_px};
    }

    Session& sky() { return sky_; }

    explicit operator bool() const { return bool(handle_); }
    pileus_clouds* get() const { return handle_.get(); }  ///< for pileus.h; stays owned

private:
    struct Free {
        void operator()(pileus_clouds* clouds) const { pileus_clouds_free(clouds); }
    };
    Session sky_;  ///< outlives the handle
    std::unique_ptr<pileus_clouds, Free> handle_;
};

}  // namespace pileus::embed

#endif  // PILEUS_CLOUDS_HPP
