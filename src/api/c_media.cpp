// SPDX-License-Identifier: Apache-2.0
// pileus.h: other optics of a session's media, which no flight takes.
#include "src/api/c_types.h"

using namespace pileus;
using namespace pileus::api;

extern "C" pileus_code pileus_session_set_media(pileus_session* session, const pileus_scene* scene,
                                                pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        if (scene == nullptr) return no_handle("scene");
        return session->session->set_media(scene->scene);
    });
}
