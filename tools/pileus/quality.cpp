// SPDX-License-Identifier: Apache-2.0
// See quality.h.
#include "tools/pileus/quality.h"

#include "src/methods/registry.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

Status quality_sets(const std::string& quality, const Scene& scene,
                    const std::vector<std::string>& sets, std::vector<std::string>& out) {
    std::vector<std::string> all;
    const MethodTools tools = method_tools(scene.method);
    const bool draft = quality == "draft";
    if (!draft && quality != "final")
        return Status::bad_input("--quality: unknown, " + quote_text(quality) +
                                 ", allowed: draft, final");
    if (!draft) all.push_back("filter.kind=\"none\"");
    const auto add = draft ? tools.draft : tools.whole;
    if (add != nullptr) add(scene, all);
    for (const std::string& set : all) {
        bool typed = false;
        const std::string key = set.substr(0, set.find('=') + 1);
        for (const std::string& own : sets) typed = typed || own.compare(0, key.size(), key) == 0;
        if (!typed) out.push_back(set);
    }
    return Status::ok();
}

}  // namespace pileus
