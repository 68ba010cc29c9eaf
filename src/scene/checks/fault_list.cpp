// SPDX-License-Identifier: Apache-2.0
// Puts the collected faults into the order of the text and into one message.
// in: faults in the order of checking -> out: Status::bad_input, one line per fault.
// docs/scene.md, section Messages.
#include "src/scene/checks/fault_list.h"

#include <algorithm>
#include <tuple>

namespace pileus {

void FaultList::add(const Place& at, const std::string& key, const std::string& text) {
    if (full()) {
        ++not_listed_;
        return;
    }
    std::string line = place_text(at) + ": ";
    if (!key.empty()) line += key + ": ";
    faults_.push_back({at, line + text});
}

std::string FaultList::place_text(const Place& at) const {
    if (at.override_index >= 0) {
        const std::string shown =
            quote_text(overrides_[static_cast<std::size_t>(at.override_index)]);
        return "--set " + shown.substr(1, shown.size() - 2);
    }
    if (at.line == 0) return file_;
    return file_ + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
}

Status FaultList::status() const {
    if (faults_.empty()) return Status::ok();
    std::vector<std::size_t> order(faults_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    // Faults at one place keep the order of checking: the index makes the order total.
    std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
        const Place &p = faults_[a].at, &q = faults_[b].at;
        return std::tie(p.override_index, p.line, p.column, a) <
               std::tie(q.override_index, q.line, q.column, b);
    });
    std::string message;
    for (std::size_t i : order) {
        if (!message.empty()) message += '\n';
        message += faults_[i].line;
    }
    if (not_listed_ > 0)
        message += "\n" + file_ + ": " + std::to_string(not_listed_) + " more faults";
    return Status::bad_input(message);
}

}  // namespace pileus
