// SPDX-License-Identifier: Apache-2.0
// pileus_flight.h in an ordinary library: small memory goes back to the C++ runtime.
#include "include/pileus/pileus_flight.h"
#include "src/api/c_types.h"

extern "C" void pileus_flight_close(pileus_session* session) {
    if (session == nullptr) return;
    // What is freed lies in the block, of which it is lent.
    const std::shared_ptr<const pileus::api::HostParts> host = session->host;
    const pileus::HostGuard lent(host->host());
    delete session;
}
