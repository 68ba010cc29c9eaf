// SPDX-License-Identifier: Apache-2.0
// Small skies with clouds of one kind, by pileus.h.
// in: places -> out: pictures of them, and how far two are apart.
// docs/clouds.md
#pragma once
#include "include/pileus/pileus.h"
#include "tests/embed/host_harness.h"

namespace clouds_test {

using namespace host_test;
using render_test::kSmallCumulus;

struct FreeClouds {
    void operator()(pileus_clouds* p) const { pileus_clouds_free(p); }
};

/// The small cumulus's surroundings, without it.
inline std::string sky_text(bool air = false) {
    std::string text = kSmallCumulus;
    const std::size_t from = text.find("[[medium]]"), to = text.find("[photon_grid]");
    text.erase(from, to - from);
    if (air) {
        const std::string sky = "[sky]\nradiance = [0.0625, 0.125, 0.25]";
        text.replace(text.find(sky), sky.size(), "[atmosphere]\nturbidity = 2");
    }
    return text;
}

inline const Overrides kMarch{"method.name=raymarch", "raymarch.steps=40", "raymarch.jitter=none"};

inline Overrides add(Overrides a, const Overrides& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgba, depth;
    std::uint64_t hash = 0;

    Picture() = default;
    Picture(std::uint32_t columns, std::uint32_t rows, float fill = 0)
        : width(columns),
          height(rows),
          rgba(4 * std::size_t(columns) * rows, fill),
          depth(std::size_t(columns) * rows) {}

    /// Colours and depths are written here.
    pileus_frame frame(pileus_blend blend) {
        auto made = cleared<pileus_frame>();
        made.colour = rgba.data();
        made.format = PILEUS_FORMAT_RGBA32F;
        made.blend = blend;
        made.depth = depth.data();
        made.hash = &hash;
        return made;
    }
    double sum(std::size_t channel) const {
        double all = 0;
        for (std::size_t i = channel; i < rgba.size(); i += 4) all += double(rgba[i]);
        return all;
    }
};

/// A sky with one kind of cloud.
struct CloudySky {
    Hosted sky, kind;
    std::unique_ptr<pileus_clouds, FreeClouds> clouds;
    Outcome out;

    explicit CloudySky(const std::vector<pileus_cloud>& places, const Overrides& more = {},
                       bool air = false, const pileus_host* host = nullptr)
        : sky(sky_text(air), {"method.name=raymarch"}, host),
          kind(kSmallCumulus, add(kMarch, more)) {
        REQUIRE_MESSAGE(sky.code == PILEUS_OK, sky.out.line());
        pileus_clouds* made = nullptr;
        check(pileus_clouds_create(sky.session.get(), &made, &out.error));
        clouds.reset(made);
        check(pileus_clouds_add_kind(clouds.get(), kind.world.get(), kind.scene.get(), nullptr,
                                     &out.error));
        place(places);
        // Tests ask for what they need.
        detail(true);
    }
    void check(pileus_code code) { REQUIRE_MESSAGE(code == PILEUS_OK, out.line()); }
    void place(const std::vector<pileus_cloud>& places) {
        check(pileus_clouds_place(clouds.get(), places.data(), std::uint32_t(places.size()),
                                  &out.error));
    }
    void detail(bool off, double near_px = 0, std::uint32_t near_scale = 1) {
        auto d = cleared<pileus_cloud_detail>();
        d.off = off ? 1 : 0;
        d.near_px = near_px;
        d.near_scale = near_scale;
        check(pileus_clouds_set_detail(clouds.get(), &d, &out.error));
    }
    Picture draw(pileus_blend blend = PILEUS_BLEND_REPLACE) {
        std::uint32_t width = 0, height = 0;
        check(pileus_session_size(sky.session.get(), &width, &height, &out.error));
        Picture p(width, height);
        const pileus_frame frame = p.frame(blend);
        check(pileus_clouds_render(clouds.get(), &frame, &out.error));
        return p;
    }
    pileus_cloud_stats stats() {
        auto s = cleared<pileus_cloud_stats>();
        check(pileus_clouds_stats(clouds.get(), &s, &out.error));
        return s;
    }
};

inline pileus_cloud at(double x, double y, double z, double yaw_deg = 0, double scale = 1) {
    auto c = cleared<pileus_cloud>();
    c.offset_m[0] = x, c.offset_m[1] = y, c.offset_m[2] = z;
    c.yaw_deg = yaw_deg;
    c.scale = scale;
    return c;
}

inline double relative_error(const Picture& a, const Picture& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        // Colours: alpha is 0 where a cloud just ends.
        if (i % 4 == 3) continue;
        const double x = double(a.rgba[i]), y = double(b.rgba[i]);
        sum += (x - y) * (x - y) / (y * y + 1e-4);
    }
    return sum / (0.75 * double(a.rgba.size()));
}

/// As a session draws the media alone.
inline Picture session_picture(Hosted& host) {
    std::uint32_t width = 0, height = 0;
    host.check(pileus_session_size(host.session.get(), &width, &height, &host.out.error));
    Picture p(width, height);
    pileus_frame frame = p.frame(PILEUS_BLEND_MEDIA);
    frame.hash = nullptr;
    host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
    return p;
}

}  // namespace clouds_test
