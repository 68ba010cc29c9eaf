// SPDX-License-Identifier: Apache-2.0
// Collects every fault of a scene, so that a user sees all of them at once.
// in: place, key path and text of each fault -> out: one Status with a line for each, in order.
// docs/scene.md, section Messages.
#pragma once
#include <string>
#include <vector>

#include "src/base/status.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

class FaultList {
public:
    /// `file` names the scene in messages; `overrides` are the texts of the --set options.
    FaultList(std::string file, std::vector<std::string> overrides)
        : file_(std::move(file)), overrides_(std::move(overrides)) {}

    /// Adds `file:line:column: key: text`, or `--set ...: key: text` for an override. An empty key
    /// is left out. Beyond 1000 faults only their number is kept.
    void add(const Place& at, const std::string& key, const std::string& text);

    bool empty() const { return faults_.empty(); }
    bool full() const { return faults_.size() >= kMaxListed; }

    /// "file:line:column", "--set ...", or the file alone where there is no line.
    std::string place_text(const Place& at) const;

    /// ok, or kBadInput with the lines sorted by place: the file first, then the overrides.
    Status status() const;

private:
    static constexpr std::size_t kMaxListed = 1000;
    struct Fault {
        Place at;
        std::string line;
    };
    std::string file_;
    std::vector<std::string> overrides_;
    std::vector<Fault> faults_;
    std::size_t not_listed_ = 0;
};

}  // namespace pileus
