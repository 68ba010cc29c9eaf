// SPDX-License-Identifier: Apache-2.0
// See drawn.h.
#include "tools/view/drawn.h"

#include <fmt/format.h>

#include "src/scene/method_column.h"

namespace pileus::view {

Status Drawn::open(const Settings& s, const char* method) {
    std::vector<std::string> sets = s.sets;
    sets.push_back(fmt::format("camera.resolution=[{}, {}]", s.width, s.height));
    if (method != nullptr) {
        sets.push_back(std::string("method.name=\"") + method + '"');
        Scene named;
        named.method = method;
        if (refused(named, Feature::kFilter) != nullptr) sets.push_back("filter.kind=none");
    }
    std::vector<const char*> texts;
    for (const std::string& t : sets) texts.push_back(t.c_str());
    auto error = cleared<pileus_error>();
    const auto count = std::uint32_t(texts.size());
    pileus_scene* scene = nullptr;
    const pileus_code read =
        s.path.empty()
            ? pileus_scene_parse(s.text.c_str(), nullptr, texts.data(), count, &scene, &error)
            : pileus_scene_read(s.path.c_str(), texts.data(), count, &scene, &error);
    PILEUS_TRY(of(read, error));
    scene_.reset(scene);
    auto host = cleared<pileus_host>();
    host.threads = std::uint32_t(s.threads);
    auto plan = cleared<pileus_plan>();
    PILEUS_TRY(of(pileus_plan_scene(scene, &host, &plan, &error), error));
    for (std::size_t a = 0; a < 3; ++a) box_.low[a] = plan.low_m[a], box_.high[a] = plan.high_m[a];
    pileus_world* world = nullptr;
    PILEUS_TRY(of(pileus_world_create(scene, &host, nullptr, 0, &world, &error), error));
    world_.reset(world);
    pileus_session* session = nullptr;
    PILEUS_TRY(of(pileus_session_create(world, scene, &host, &session, &error), error));
    session_.reset(session);
    return Status::ok();
}

}  // namespace pileus::view
