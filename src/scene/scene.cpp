// SPDX-License-Identifier: Apache-2.0
// See scene.h.
#include "src/scene/scene.h"

namespace pileus {

MediumSettings::MediumSettings() = default;
MediumSettings::MediumSettings(const MediumSettings&) = default;
MediumSettings& MediumSettings::operator=(const MediumSettings&) = default;
MediumSettings::~MediumSettings() = default;

}  // namespace pileus
