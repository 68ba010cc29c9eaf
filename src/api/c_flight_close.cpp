// SPDX-License-Identifier: Apache-2.0
// pileus.h in an ordinary library: small memory goes back to the C++ runtime.
#include "include/pileus/pileus.h"
#include "src/api/c_types.h"

extern "C" void pileus_flight_close(pileus_session* session) {
    if (session == nullptr) return;
    // The block is the caller's, who may have freed it: nothing is given back to it.
    const std::shared_ptr<const pileus::api::HostParts> host = session->host;
    if (host->block != nullptr) {
        auto& parts = const_cast<pileus::api::HostParts&>(*host);
        parts.allocator = {nullptr, [](void*, void*) {}, nullptr};
    }
    pileus::api::leave(session);
}
