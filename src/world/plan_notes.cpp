// SPDX-License-Identifier: Apache-2.0
// What laying the media on one grid says, in a method's plan: words, which a flight has none of.
// in: a world's plan -> out: lines of another.
// src/world/plan_parts.h
#include "src/world/plan_parts.h"

namespace pileus {

void note_media(const Plan& media, Plan& plan) {
    for (const std::string& what : media.needed) plan.needed.push_back(what);
    for (const LeftOut& l : media.left_out) plan.left_out.push_back(l);
}

}  // namespace pileus
