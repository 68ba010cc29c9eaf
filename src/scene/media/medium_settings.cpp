// SPDX-License-Identifier: Apache-2.0
// See medium_settings.h.
#include "src/scene/media/medium_settings.h"

namespace pileus {

MediumSettings::MediumSettings() = default;
MediumSettings::MediumSettings(const MediumSettings&) = default;
MediumSettings& MediumSettings::operator=(const MediumSettings&) = default;
MediumSettings::~MediumSettings() = default;

}  // namespace pileus
