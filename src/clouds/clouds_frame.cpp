// SPDX-License-Identifier: Apache-2.0
// See clouds.h. What stands for each cloud in a frame, and the frame itself.
#include <algorithm>
#include <glm/geometric.hpp>

#include "platform/fp_mode.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/clouds/clouds.h"
#include "src/picture/air_view.h"
#include "src/picture/background.h"
#include "src/picture/march_view.h"
#include "src/world/camera/view.h"
#include "src/world/solids/camera_depth.h"

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

/// What composing reads of a picture of media alone.
Status copy_media(const Planes& from, Planes& to) {
    const auto copy = [](const Buffer<float>& a, Buffer<float>& b) -> Status {
        if (a.size() != b.size()) PILEUS_TRY(b.resize(a.size(), "picture of a near cloud"));
        std::copy(a.span().begin(), a.span().end(), b.span().begin());
        return Status::ok();
    };
    PILEUS_TRY(copy(from.transmittance, to.transmittance));
    PILEUS_TRY(copy(from.half_depth, to.half_depth));
    const std::size_t colours = 3 * from.transmittance.size();
    const Buffer<float>& light = from.cloud.empty() ? from.colour : from.cloud;
    if (to.colour.size() != colours)
        PILEUS_TRY(to.colour.resize(colours, "picture of a near cloud"));
    std::copy(light.span().begin(), light.span().begin() + std::ptrdiff_t(colours),
              to.colour.span().begin());
    return Status::ok();
}

}  // namespace

CloudShade Clouds::shade_of(const Cloud& cloud) const {
    CloudShade out;
    out.plane = &plane_;
    out.texels = cloud.shade.empty() ? nullptr : cloud.shade.data();
    out.ambient = groups_[cloud.group]->ambient();
    out.middle = cloud.box.middle;
    out.sky_left = sky_left(cloud.box.middle.z);
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
    cloud.newer.level = group.lit_level();
    cloud.newer.shading = shading_;
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
    if (cloud.newer.light != groups_[cloud.group]->lit() || cloud.newer.shading != shading_)
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

ShownCloud Clouds::show(const CloudView& view, const Cloud& cloud,
                        const MarchedCloud& marched) const {
    ShownCloud shown;
    const auto source = [&](const Impostor& impostor, bool is_marched) {
        CloudSource out;
        if (is_marched) {
            out.picture = &marched;
            out.gain = light_gain(groups_[cloud.group]->lit_level(), light_.level);
        } else {
            out.impostor = &impostor;
            out.gain = light_gain(impostor.level, light_.level);
        }
        const PixelRect rect =
            is_marched ? marched.rect
                       : covered(view, impostor.corners.data(), impostor.corners.size());
        PixelRect& all = shown.rect;
        if (all.empty()) {
            all = rect;
        } else if (!rect.empty()) {
            all.x0 = std::min(all.x0, rect.x0), all.x1 = std::max(all.x1, rect.x1);
            all.y0 = std::min(all.y0, rect.y0), all.y1 = std::max(all.y1, rect.y1);
        }
        return out;
    };
    shown.presence = float(cloud.place.presence);
    shown.newer = source(cloud.newer, cloud.newer_marched);
    if (!cloud.has_older) return shown;
    shown.older = source(cloud.older, cloud.older_marched);
    shown.share = float(cloud.faded) / float(detail_.blend_frames);
    return shown;
}

/// The clouds of the picture, each marched where it is to be, and its layers, by what is nearest.
Status Clouds::march_all(const CloudView& view, const Camera& camera, int frame,
                         const std::vector<LayerPicture>& layers, std::vector<ShownCloud>& shown) {
    const auto is_marched = [&](const Seen& s) {
        const Cloud& cloud = *clouds_[s.cloud];
        return cloud.newer_marched || (cloud.has_older && cloud.older_marched);
    };
    // Layers may begin anywhere.
    for (const LayerPicture& layer : layers) {
        ShownCloud all;
        all.layer = &layer;
        all.rect = {0, 0, view.width, view.height};
        shown.push_back(all);
    }
    marched_.assign(seen_.size(), MarchedCloud{});
    std::size_t copies = 0;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        const Seen& s = seen_[i];
        Cloud& cloud = *clouds_[s.cloud];
        if (is_marched(s)) {
            PILEUS_TRY(march(view, camera, frame, cloud, marched_[i]));
            // A group keeps its last picture alone.
            bool last = true;
            for (std::size_t j = i + 1; j < seen_.size() && last; ++j)
                last = !is_marched(seen_[j]) || clouds_[seen_[j].cloud]->group != cloud.group;
            if (!last) {
                if (copies == copies_.size()) copies_.push_back(std::make_unique<Planes>());
                PILEUS_TRY(copy_media(*marched_[i].planes, *copies_[copies]));
                marched_[i].planes = copies_[copies++].get();
            }
        }
        shown.push_back(show(view, cloud, marched_[i]));
        shown.back().near_m = float(std::max(s.distance - cloud.box.radius, 0.0));
    }
    std::stable_sort(shown.begin(), shown.end(),
                     [](const ShownCloud& a, const ShownCloud& b) { return a.near_m < b.near_m; });
    return Status::ok();
}

/// Each in its own session, to what hides it.
Status Clouds::draw_layers(std::vector<LayerPicture>& pictures) {
    const StageClock clock(sky_->context(), "layers of the sky");
    layer_sources_.resize(layers_.size());
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        LayerPicture picture;
        PILEUS_TRY(layers_[i]->draw(sky_->camera(), sky_->frame(), planes_.opaque_depth.span(),
                                    picture.planes));
        picture.layer = layers_[i].get();
        picture.plane = &plane_;
        picture.sky_left = sky_left(layers_[i]->middle_m());
        // What may stand between some of it and the sun.
        std::vector<ShadowSource>& above = layer_sources_[i];
        above.clear();
        for (std::size_t j = 0; j < sources_.size(); ++j) {
            const ShadowSource& s = sources_[j];
            const bool layer = j >= clouds_.size();
            if (j == clouds_.size() + i || (layer ? s.plane == nullptr : s.shadow == nullptr))
                continue;
            const double top = s.middle.z + (layer ? 0 : s.radius);
            if (top > layers_[i]->low_m()) above.push_back(s);
        }
        if (!above.empty() && light_.sun.present && light_.sun.elevation_deg > 0) {
            picture.sources = &above;
            const double sine = sincos_deg(light_.sun.elevation_deg).sine;
            for (std::size_t c = 0; c < 3; ++c) {
                const float sun = float(sine) * light_.sun.irradiance[c];
                picture.sun_share[c] = light_.level[c] > 0 ? sun / light_.level[c] : 0.0f;
            }
        }
        pictures.push_back(picture);
    }
    return Status::ok();
}

Status Clouds::compose(const CloudView& view, const Camera& camera, int frame) {
    const Context& context = sky_->context();
    std::vector<LayerPicture> layers;
    PILEUS_TRY(draw_layers(layers));
    std::vector<ShownCloud> shown;
    PILEUS_TRY(march_all(view, camera, frame, layers, shown));
    const StageClock clock(context, "clouds composed");
    compose_clouds(view, shown, context.threads, planes_);
    return Status::ok();
}

/// What of a host's own picture is not hidden by something of ours.
void Clouds::keep_host(const Lighting& lighting) {
    const std::size_t pixels = planes_.transmittance.size();
    parallel_each(sky_->context().threads, pixels, [&](std::size_t i) {
        const float metres = lighting.depth != nullptr ? lighting.depth->metres[i] : 0.0f;
        const bool host = lighting.depth != nullptr && metres < __builtin_inff() &&
                          metres == planes_.opaque_depth[i];
        for (std::size_t c = 0; c < 3 && !host; ++c) planes_.kept[c * pixels + i] = 0;
    });
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
    for (float& c : k.ground_diffuse) c *= sky_left(light_.ground.altitude_m);
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
    planes_.kept.truncate(0);
    if (over_host_) {
        PILEUS_TRY(planes_.kept.resize(planes_.colour.size(), "share of a host's pixels"));
        parallel_each(sky_->context().threads, planes_.kept.size(),
                      [&](std::size_t i) { planes_.kept[i] = 1; });
    }
    PILEUS_TRY(
        show_air(context, *around->scene, medium, lighting, seen, around->environment, planes_));
    if (over_host_) keep_host(lighting);
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
