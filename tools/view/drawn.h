// SPDX-License-Identifier: Apache-2.0
// A scene by one method, as a host has it: world and session by pileus.h.
// in: a scene's text, changes, a method -> out: a session to draw from.
// docs/view.md
#pragma once
#include <memory>

#include "include/pileus/pileus.h"
#include "src/base/status.h"
#include "tools/view/controls.h"
#include "tools/view/viewer.h"

namespace pileus::view {

template <class T>
T cleared() {
    T made;
    PILEUS_INIT(made);
    return made;
}

/// What the library said, as the program says it.
inline Status of(pileus_code code, const pileus_error& error) {
    if (code == PILEUS_OK) return Status::ok();
    if (code == PILEUS_ERROR_LIMIT) return Status::limit(error.message);
    return code == PILEUS_ERROR_IO ? Status::io(error.message) : Status::bad_input(error.message);
}

class Drawn {
public:
    /// `method`: null for the scene's own. kBadInput: a scene that it is not for.
    Status open(const Settings& settings, const char* method);

    pileus_session* get() const { return session_.get(); }
    const Box& box() const { return box_; }

private:
    struct Freed {
        void operator()(pileus_scene* p) const { pileus_scene_free(p); }
        void operator()(pileus_world* p) const { pileus_world_free(p); }
        void operator()(pileus_session* p) const { pileus_session_free(p); }
    };
    // The session goes before the world that it draws.
    std::unique_ptr<pileus_scene, Freed> scene_;
    std::unique_ptr<pileus_world, Freed> world_;
    std::unique_ptr<pileus_session, Freed> session_;
    Box box_;
};

}  // namespace pileus::view
