// SPDX-License-Identifier: Apache-2.0
// See module.h.
#include "web/module.h"

#include <pileus/pileus.h>

#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

struct WebPicture {
    pileus_scene* scene = nullptr;
    pileus_world* world = nullptr;
    pileus_session* session = nullptr;
    pileus_error error;
    pileus_progress progress;
    uint32_t width = 0, height = 0;
    std::vector<unsigned char> pixels;
    char hash[17] = "";

    bool good() const { return error.code == PILEUS_OK; }
};

WebPicture* web_open(const char* text, const char* overrides) {
    auto* p = new WebPicture;
    PILEUS_INIT(p->error);
    PILEUS_INIT(p->progress);
    std::vector<std::string> lines;
    std::istringstream rest(overrides);
    for (std::string line; std::getline(rest, line);)
        if (!line.empty()) lines.push_back(line);
    std::vector<const char*> pointers;
    for (const std::string& line : lines) pointers.push_back(line.c_str());
    pileus_scene_parse(text, nullptr, pointers.data(), uint32_t(pointers.size()), &p->scene,
                       &p->error);
    if (p->good()) pileus_world_create(p->scene, nullptr, nullptr, 0, &p->world, &p->error);
    return p;
}

void web_close(WebPicture* picture) {
    pileus_session_free(picture->session);
    pileus_world_free(picture->world);
    pileus_scene_free(picture->scene);
    delete picture;
}

const char* web_fault(const WebPicture* picture) { return picture->error.message; }

void web_begin(WebPicture* picture, double elevation_deg, double azimuth_deg, double red,
               double green, double blue) {
    WebPicture& p = *picture;
    pileus_session_free(p.session);
    p.session = nullptr;
    pileus_sun sun;
    PILEUS_INIT(sun);
    sun.present = 1;
    sun.elevation_deg = elevation_deg;
    sun.azimuth_deg = azimuth_deg;
    sun.irradiance[0] = float(red);
    sun.irradiance[1] = float(green);
    sun.irradiance[2] = float(blue);
    if (p.good()) pileus_session_create(p.world, p.scene, nullptr, &p.session, &p.error);
    if (p.good()) pileus_session_set_sun(p.session, &sun, &p.error);
    if (p.good()) pileus_session_size(p.session, &p.width, &p.height, &p.error);
    if (p.good()) pileus_session_progress(p.session, &p.progress, &p.error);
}

int web_units(const WebPicture* picture) { return int(picture->progress.whole); }

void web_step(WebPicture* picture, int units) {
    if (picture->good())
        pileus_session_step(picture->session, uint32_t(units), nullptr, &picture->error);
}

void web_draw(WebPicture* picture) {
    WebPicture& p = *picture;
    if (!p.good()) return;
    p.pixels.resize(std::size_t(p.width) * p.height * 4);
    uint64_t hash = 0;
    pileus_frame frame;
    PILEUS_INIT(frame);
    frame.colour = p.pixels.data();
    frame.format = PILEUS_FORMAT_RGBA8_SRGB;
    frame.hash = &hash;
    pileus_session_render(p.session, &frame, &p.error);
    // Alpha is the media's, and the page shows what lies behind them, too.
    for (std::size_t i = 3; i < p.pixels.size(); i += 4) p.pixels[i] = 255;
    std::snprintf(p.hash, sizeof p.hash, "%016llx", static_cast<unsigned long long>(hash));
}

int web_width(const WebPicture* picture) { return int(picture->width); }
int web_height(const WebPicture* picture) { return int(picture->height); }
const unsigned char* web_pixels(const WebPicture* picture) { return picture->pixels.data(); }
const char* web_hash(const WebPicture* picture) { return picture->hash; }
