// SPDX-License-Identifier: Apache-2.0
// See clouds.h. What stands for each cloud in a frame, and the frame itself.
#include <algorithm>
#include <glm/geometric.hpp>

#include "platform/fp_mode.h"
#include "src/clouds/clouds.h"
#include "src/picture/air_view.h"
#include "src/picture/background.h"
#include "src/picture/march_view.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

/// Balls around a cloud within which the eye sees no picture of it.
constexpr double kNearRadii = 1.5;
/// Share of near_px by which a cloud must be smaller before it is no longer marched, and larger.
constexpr double kSizeSlack = 0.1;
/// A picture as wrong as so many times what is allowed does not wait until the last has faded.
constexpr double kUrgent = 4;
/// By which the light of the sky in a near cloud may be another camera's.
constexpr double kSlackDeg = 1;
/// Parts of the picture begin at multiples of it: the coarsest near_scale.
constexpr int kLattice = 4;

}  // namespace

CloudShade Clouds::shade_of(const Cloud& cloud) const {
    CloudShade out;
    out.plane = &plane_;
    out.texels = cloud.shade.empty() ? nullptr : cloud.shade.data();
    out.ambient = groups_[cloud.group]->ambient();
    out.middle = cloud.box.middle;
    out.radius = groups_[cloud.group]->shadow_radius() * cloud.place.scale;
    return out;
}

Status Clouds::march(const CloudView& view, const Camera& camera, int frame, Cloud& cloud,
                     MarchedCloud& out) {
    const StageClock clock(sky_->context(), "clouds marched");
    out.rect = covered(view, cloud.box.corners.data(), cloud.box.corners.size());
    // Marched pixels stay where they are in the picture while the cloud's part of it moves.
    out.rect.x0 -= out.rect.x0 % kLattice, out.rect.y0 -= out.rect.y0 % kLattice;
    out.scale = float(cloud.place.scale);
    out.metres = float(glm::length(cloud.box.middle - view.eye));
    out.shade = shade_of(cloud);
    CloudGroup::Work work;
    work.frame = frame;
    if (detail_.on) work.scale = detail_.near_scale, work.slack_deg = kSlackDeg;
    ++stats_.marched;
    stats_.marched_pixels += out.rect.pixels();
    return groups_[cloud.group]->draw(part_camera(camera, view, out.rect, cloud.place), work,
                                      out.planes);
}

Status Clouds::take_picture(const CloudView& view, Cloud& cloud) {
    cloud.has_older = cloud.seen && (cloud.newer_marched || cloud.newer.made);
    cloud.older_marched = cloud.has_older && cloud.newer_marched;
    cloud.faded = 0;
    std::swap(cloud.older, cloud.newer);
    cloud.newer_marched = false;
    CloudGroup& group = *groups_[cloud.group];
    PILEUS_TRY(capture(view, cloud.place, cloud.box, shade_of(cloud), detail_.sharpness, group,
                       cloud.newer));
    cloud.newer.light = group.lit();
    ++stats_.captured;
    stats_.captured_pixels += std::uint64_t(cloud.newer.width) * std::uint64_t(cloud.newer.height);
    return Status::ok();
}

/// Whether a cloud is marched in this frame, or how wrong its picture is.
void Clouds::judge(const CloudView& view, Cloud& cloud, Seen& seen) const {
    const Double3 to = cloud.box.middle - view.eye;
    seen.distance = view.parallel ? glm::dot(to, view.forward) : glm::length(to);
    const double radius = cloud.box.radius;
    const double size = 2 * radius / seen.distance * view.pixels_per_unit();
    const double most = detail_.near_px * (cloud.newer_marched ? 1 - kSizeSlack : 1 + kSizeSlack);
    if (!detail_.on || view.parallel || seen.distance < kNearRadii * radius || size > most) {
        seen.error = 0;
        if (cloud.newer_marched) return;
        cloud.has_older = cloud.seen && cloud.newer.made && detail_.on;
        cloud.older_marched = false;
        cloud.faded = 0;
        std::swap(cloud.older, cloud.newer);
        cloud.newer.made = false;
        cloud.newer_marched = true;
        return;
    }
    if (cloud.newer_marched || !cloud.newer.made) {
        seen.error = 1e300;
        return;
    }
    seen.error = impostor_error(cloud.newer, view, cloud.box) / detail_.error_px;
    if (cloud.newer.light != groups_[cloud.group]->lit())
        seen.error = std::max(seen.error, 1.0) + 0.5;
}

/// The clouds of this picture.
void Clouds::look_for(const CloudView& view) {
    seen_.clear();
    for (std::size_t i = 0; i < clouds_.size(); ++i) {
        Cloud& cloud = *clouds_[i];
        Seen seen;
        seen.cloud = i;
        seen.rect = covered(view, cloud.box.corners.data(), cloud.box.corners.size());
        if (!seen.rect.empty()) {
            judge(view, cloud, seen);
            if (!detail_.on) cloud.has_older = false;
            seen_.push_back(seen);
            continue;
        }
        cloud.seen = cloud.has_older = false;
        // It may come back after many frames: what was marched is no picture of it.
        if (cloud.newer_marched) cloud.newer.made = cloud.newer_marched = false;
    }
}

/// Makes new pictures where old ones are too wrong: the most wrong first, as many as a frame may.
Status Clouds::renew(const CloudView& view) {
    const StageClock clock(sky_->context(), "clouds' pictures");
    const auto cannot_wait = [&](const Seen& s) {
        const Cloud& cloud = *clouds_[s.cloud];
        return !cloud.newer_marched && (!cloud.newer.made || (!cloud.seen && s.error > 1));
    };
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        if (!(seen_[i].error > 1)) continue;
        if (clouds_[seen_[i].cloud]->has_older && seen_[i].error < kUrgent) continue;
        wanted.push_back(i);
    }
    std::sort(wanted.begin(), wanted.end(), [&](std::size_t a, std::size_t b) {
        const Seen &x = seen_[a], &y = seen_[b];
        const bool first = cannot_wait(x), second = cannot_wait(y);
        if (first != second) return first;
        return x.error != y.error ? x.error > y.error : x.cloud < y.cloud;
    });
    std::uint64_t taken = 0;
    for (const std::size_t i : wanted) {
        Seen& s = seen_[i];
        const std::uint64_t before = stats_.captured_pixels;
        if (!cannot_wait(s) && taken > 0 &&
            taken + s.rect.pixels() > std::uint64_t(detail_.frame_pixels))
            continue;
        PILEUS_TRY(take_picture(view, *clouds_[s.cloud]));
        s.error = 0;
        taken += stats_.captured_pixels - before;
    }
    return Status::ok();
}

/// What stands for each cloud, from near to far.
Status Clouds::choose(const CloudView& view) {
    look_for(view);
    PILEUS_TRY(renew(view));
    for (const Seen& s : seen_) {
        Cloud& cloud = *clouds_[s.cloud];
        if (cloud.has_older && ++cloud.faded >= detail_.blend_frames) cloud.has_older = false;
        cloud.seen = true;
        if (cloud.newer_marched) continue;
        stats_.worst_px = std::max(stats_.worst_px, s.error * detail_.error_px);
    }
    std::sort(seen_.begin(), seen_.end(), [](const Seen& a, const Seen& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.cloud < b.cloud;
    });
    stats_.visible = std::uint32_t(seen_.size());
    return Status::ok();
}

CloudLayer Clouds::layer_of(const CloudView& view, const Cloud& cloud,
                            const MarchedCloud& marched) const {
    CloudLayer layer;
    const auto source = [&](const Impostor& impostor, bool is_marched) {
        CloudSource out;
        if (is_marched)
            out.picture = &marched;
        else
            out.impostor = &impostor;
        const PixelRect rect =
            is_marched ? marched.rect
                       : covered(view, impostor.corners.data(), impostor.corners.size());
        PixelRect& all = layer.rect;
        if (all.empty()) {
            all = rect;
        } else if (!rect.empty()) {
            all.x0 = std::min(all.x0, rect.x0), all.x1 = std::max(all.x1, rect.x1);
            all.y0 = std::min(all.y0, rect.y0), all.y1 = std::max(all.y1, rect.y1);
        }
        return out;
    };
    layer.newer = source(cloud.newer, cloud.newer_marched);
    if (!cloud.has_older) return layer;
    layer.older = source(cloud.older, cloud.older_marched);
    layer.share = float(cloud.faded) / float(detail_.blend_frames);
    return layer;
}

/// The clouds of the picture, each marched where it is to be.
Status Clouds::compose(const CloudView& view, const Camera& camera, int frame) {
    const Context& context = sky_->context();
    begin_clouds(context.threads, planes_);
    for (const Seen& s : seen_) {
        Cloud& cloud = *clouds_[s.cloud];
        MarchedCloud marched;
        if (cloud.newer_marched || (cloud.has_older && cloud.older_marched))
            PILEUS_TRY(march(view, camera, frame, cloud, marched));
        const StageClock clock(context, "clouds composed");
        add_cloud(view, layer_of(view, cloud, marched), context.threads, planes_);
    }
    end_clouds(context.threads, planes_);
    return Status::ok();
}

Status Clouds::draw(bool depths, const Planes*& planes) {
    const FpModeGuard guard;
    const PoolGuard lent(threads_);
    stats_ = CloudStats{};
    stats_.clouds = std::uint32_t(clouds_.size());
    Scenery* around = nullptr;
    PILEUS_TRY(sky_->lit(around));
    PILEUS_TRY(light_up(*around));
    PILEUS_TRY(cast_shadows());
    const Camera& camera = sky_->camera();
    const CloudView view = view_of(camera);
    PILEUS_TRY(choose(view));

    const Context& context = sky_->context();
    const Lighting& lighting = around->lighting;
    const Medium& medium = around->world->medium;
    const CameraParams seen = make_camera(around->scene->camera, 0, medium.low_m);
    PILEUS_TRY(allocate_planes(view.width, view.height, 3, lighting.opaque(), true, planes_));
    const MediumView nothing = make_medium_view(medium, Majorants{});
    BackgroundParams k = background_params(nothing, seen, lighting);
    BackgroundBuffers b{nullptr, planes_.background.data(), planes_.opaque_depth.data()};
    const float none = 0;
    k.shadow = NodeGrid{{1, 1, 1}, {1e-9f, 1e-9f, 1}};
    b.ground_depth = &none;
    if (on_ground_.nodes.size[0] > 0) {
        k.shadow = on_ground_.nodes;
        for (int a = 0; a < 2; ++a) k.shadow_origin[a] = float(on_ground_.low[a] - medium.low_m[a]);
        b.ground_depth = on_ground_.depth.data();
    }
    {
        const StageClock clock(context, "background");
        PILEUS_TRY(show_background(context, lighting, k, b));
    }
    PILEUS_TRY(compose(view, camera, sky_->frame()));
    PILEUS_TRY(
        show_air(context, *around->scene, medium, lighting, seen, around->environment, planes_));
    for (std::size_t i = 0; depths && i < planes_.half_depth.size(); ++i)
        if (planes_.transmittance[i] > 0.5f) planes_.half_depth[i] = __builtin_inff();
    planes = &planes_;
    return Status::ok();
}

Status Clouds::render(const FrameTarget& target) {
    const FpModeGuard guard;
    const PoolGuard lent(threads_);
    if (target.has_depth && target.depth_kind == DepthKind::kBuffer && !sky_->depth_scale().known)
        return Status::bad_input(
            "frame.depth: a depth buffer without a camera's near_m, allowed: a camera with it, or "
            "another kind");
    const Planes* planes = nullptr;
    PILEUS_TRY(draw(target.has_depth, planes));
    const Context& context = sky_->context();
    const Camera& camera = sky_->camera();
    std::uint64_t broken = 0;
    if (target.has_colour) {
        const StageClock clock(context, "pixels");
        PILEUS_TRY(write_pixels(*planes, camera.resolution[0], camera.resolution[1], target.colour,
                                context.kernels, context.threads, broken));
    }
    if (target.has_depth)
        write_depths(*planes, make_camera(camera, 0, sky_->world().medium.low_m), target.depth_kind,
                     target.depth_halves, sky_->depth_scale(), target.depth);
    if (target.hash != nullptr) *target.hash = hash_planes(*planes);
    return Status::ok();
}

}  // namespace pileus
