// SPDX-License-Identifier: Apache-2.0
// The end of a session whose memory is the caller's block.
// docs/flight.md, "Memory"
#include "include/pileus/pileus.h"

extern "C" void pileus_flight_close(pileus_session*) {}
