// SPDX-License-Identifier: Apache-2.0
// pileus.h: a session's density is replaced by the next one.
// in: two sessions -> out: their states exchanged. docs/living.md
#include "src/api/c_types.h"

using namespace pileus;
using namespace pileus::api;

extern "C" pileus_code pileus_session_hand_over(pileus_session* session, pileus_session* next,
                                                uint32_t frames, pileus_error* error) {
    if (session == nullptr) return no_session(error);
    return call(*session, error, [&]() -> Status {
        if (next == nullptr) return no_handle("next");
        // Before anything is exchanged, as it may find no memory.
        for (Session* own : {session->session.get(), next->session.get()}) {
            own->keep(session->host);
            own->keep(next->host);
        }
        PILEUS_TRY(next->session->take_over(*session->session, frames));
        session->session.swap(next->session);
        return Status::ok();
    });
}
