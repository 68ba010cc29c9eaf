// SPDX-License-Identifier: Apache-2.0
// pileus.h: light, pictures, and what a session tells.
#include "src/api/c_types.h"
#include "src/base/number_text.h"
#include "src/flight/flight.h"
#include "src/plan/report_json.h"
#include "src/session/warnings.h"

namespace pileus::api {
namespace {

constexpr float kMaxStops = 100;
constexpr std::uint32_t kMaxLayers = 256;

Status take_colour(const pileus_frame& f, const Camera& camera, FrameTarget& target) {
    if (f.format > PILEUS_FORMAT_RGB10A2_SRGB)
        return Status::bad_input(
            "frame.format: " + std::to_string(f.format) +
            ", allowed: a pileus_format, PILEUS_FORMAT_RGBA8_SRGB to PILEUS_FORMAT_RGB10A2_SRGB");
    if (f.blend > PILEUS_BLEND_MEDIA)
        return Status::bad_input(
            "frame.blend: " + std::to_string(f.blend) +
            ", allowed: PILEUS_BLEND_REPLACE, PILEUS_BLEND_OVER, PILEUS_BLEND_MEDIA");
    if (!(f.exposure_stops >= -kMaxStops && f.exposure_stops <= kMaxStops))
        return Status::bad_input("frame.exposure_stops: " + number_text(double(f.exposure_stops)) +
                                 ", allowed: -100 to 100");
    target.has_colour = f.colour != nullptr;
    if (!target.has_colour) return Status::ok();
    PixelTarget& colour = target.colour;
    colour.format = PixelFormat(f.format);
    colour.blend = PixelBlend(f.blend);
    colour.stops = f.exposure_stops;
    colour.rows.first = static_cast<unsigned char*>(f.colour);
    colour.rows.bottom_up = f.bottom_up != 0;
    const auto width =
        std::int64_t(camera.resolution[0]) * std::int64_t(pixel_bytes(colour.format));
    return take_stride("frame.colour", f.colour_stride, width, std::uint32_t(camera.resolution[1]),
                       colour.rows);
}

Status take_depth(const pileus_frame& f, const Camera& camera, FrameTarget& target) {
    if (f.depth_kind > PILEUS_DEPTH_BUFFER)
        return Status::bad_input(
            "frame.depth_kind: " + std::to_string(f.depth_kind) +
            ", allowed: PILEUS_DEPTH_DISTANCE, PILEUS_DEPTH_VIEW_Z, PILEUS_DEPTH_BUFFER");
    if (f.depth_format > PILEUS_DEPTH_R16F)
        return Status::bad_input("frame.depth_format: " + std::to_string(f.depth_format) +
                                 ", allowed: PILEUS_DEPTH_R32F, PILEUS_DEPTH_R16F");
    target.has_depth = f.depth != nullptr;
    target.depth_halves = f.depth_format == PILEUS_DEPTH_R16F;
    if (!target.has_depth) return Status::ok();
    target.depth_kind = DepthKind(f.depth_kind);
    target.depth.first = reinterpret_cast<unsigned char*>(f.depth);
    target.depth.bottom_up = f.bottom_up != 0;
    const auto width = std::int64_t(camera.resolution[0]) * (target.depth_halves ? 2 : 4);
    return take_stride("frame.depth", f.depth_stride, width, std::uint32_t(camera.resolution[1]),
                       target.depth);
}

Status take_layers(const pileus_frame& f, const Camera& camera, FrameTarget& target) {
    if (f.layer_count > kMaxLayers)
        return Status::bad_input("frame.layer_count: " + std::to_string(f.layer_count) +
                                 ", allowed: up to " + std::to_string(kMaxLayers));
    if (f.layer_count > 0 && f.layers == nullptr) return no_struct("frame.layers");
    target.layers.resize(f.layer_count);
    for (std::uint32_t i = 0; i < f.layer_count; ++i) {
        pileus_layer given;
        if (!take_element(f.layers, i, given)) return no_element("frame.layers", i);
        const std::string key = "frame.layers[" + std::to_string(i) + "]";
        if (given.name == nullptr || given.values == nullptr)
            return Status::bad_input(key + (given.name == nullptr ? ".name" : ".values") +
                                     ": null, allowed: a pointer");
        LayerTarget& layer = target.layers[i];
        layer.name = given.name;
        layer.rows.first = reinterpret_cast<unsigned char*>(given.values);
        layer.rows.bottom_up = f.bottom_up != 0;
        PILEUS_TRY(take_stride(key.c_str(), given.stride,
                               std::int64_t(camera.resolution[0]) * std::int64_t(sizeof(float)),
                               std::uint32_t(camera.resolution[1]), layer.rows));
    }
    return Status::ok();
}

/// A line for each accident, the first time that it happens.
void tell_accidents(pileus_session& session) {
    const pileus_host& host = session.host->given;
    if (host.log == nullptr) return;
    for (const auto& counter : session.session->counters())
        for (const Accident& accident : accidents()) {
            if (counter.second == 0 || counter.first != accident.counter) continue;
            bool told = false;
            for (const std::string& name : session.told) told |= name == counter.first;
            if (told) continue;
            session.told.emplace_back(counter.first);
            host.log(host.user, accident_line(accident, counter.second).c_str());
        }
}

}  // namespace

Status take_target(const pileus_frame& f, const Camera& camera, FrameTarget& target) {
    PILEUS_TRY(take_colour(f, camera, target));
    PILEUS_TRY(take_depth(f, camera, target));
    return take_layers(f, camera, target);
}

Status render_frame(const pileus_frame& f, pileus_session& session) {
    FrameTarget target;
    // Flights take no memory for them.
    if (f.layer_count > 0 && session.host->block != nullptr)
        return Status::bad_input("frame.layers: of no flight, allowed: none");
    PILEUS_TRY(take_target(f, session.session->camera(), target));
    std::uint64_t hash = 0;
    target.hash = f.hash != nullptr ? &hash : nullptr;
    PILEUS_TRY(session.session->render(target));
    if (f.hash != nullptr) *f.hash = hash;
    tell_accidents(session);
    return Status::ok();
}

}  // namespace pileus::api

using namespace pileus;
using namespace pileus::api;

extern "C" {

pileus_code pileus_session_progress(const pileus_session* session, pileus_progress* info,
                                    pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        const LightUnits light = session->session->light();
        pileus_progress out{};
        out.whole = std::uint32_t(light.whole < UINT32_MAX ? light.whole : UINT32_MAX);
        out.unit_photons = light.unit_photons;
        out.units = light.held;
        copy_cut(light.unit, out.unit, sizeof out.unit);
        return give(out, info, "info");
    });
}

pileus_code pileus_session_step(pileus_session* session, uint32_t units, uint32_t* done,
                                pileus_error* error) {
    if (session == nullptr) return no_session(error);
    const CancelEnd end(*session);
    return call(*session, error, [&]() -> Status {
        std::uint64_t traced = 0;
        const Status status = session->session->step(units, traced);
        if (done != nullptr) *done = std::uint32_t(traced);
        return status;
    });
}

void pileus_session_cancel(pileus_session* session) {
    if (session != nullptr) session->cancelled = true;
}

pileus_code pileus_session_render(pileus_session* session, const pileus_frame* frame,
                                  pileus_error* error) {
    if (session == nullptr) return no_session(error);
    const CancelEnd end(*session);
    return call(*session, error, [&]() -> Status {
        pileus_frame f;
        if (!take(frame, f)) return no_struct("frame");
        return render_frame(f, *session);
    });
}

pileus_code pileus_session_stats(const pileus_session* session, pileus_stats* stats,
                                 pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        const SessionStats& counted = session->session->stats();
        pileus_stats out{};
        out.prepared = counted.prepared;
        out.pictures = counted.pictures;
        out.units = counted.units;
        out.render_s = counted.render_s;
        out.stages_s = counted.stages_s;
        out.shared_bytes = bytes_of_world(session->session->world());
        out.own_bytes = own_bytes(*session->session, session->host->block, session->flight.get(),
                                  out.shared_bytes);
        return give(out, stats, "stats");
    });
}

pileus_code pileus_session_report(const pileus_session* session, char* text, size_t size,
                                  size_t* needed, pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        return give_text(report_json(session->session->told()), "report", text, size, needed);
    });
}

}  // extern "C"
