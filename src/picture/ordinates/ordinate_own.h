// SPDX-License-Identifier: Apache-2.0
// Light of lamps and of the media themselves, as sources of discrete ordinates.
// in: lamps with their optical depths on nodes -> out: what nodes send into each direction.
// docs/ordinates.md, "Lamps"
#pragma once
#include "src/picture/ordinates/ordinates.h"

namespace pileus {

/// `fixed`: [direction][filled], in `work`; null: there is none. kLimit: out of memory.
Status own_light(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                 const OrdinateAsk& ask, const OrdinateSet& set, Buffer<float>& work,
                 const float*& fixed);

}  // namespace pileus
