// SPDX-License-Identifier: Apache-2.0
// What makes a finished picture doubtful, in lines for a person.
// in: a picture and the report of its run -> out: the report's warnings.
// docs/report.md, "Accidents"
#pragma once
#include "src/base/span.h"
#include "src/io/images/image.h"
#include "src/picture/finish_frame.h"
#include "src/plan/report.h"
#include "src/scene/scene.h"
#include "src/world/world.h"

namespace pileus {

/// A counter that is 0 in every sound run.
struct Accident {
    const char* counter;
    const char* meaning;
};

/// All of them; a constant table. Counters that are not in it merely count.
Span<const Accident> accidents();

/// As warnings and logs tell of it.
std::string accident_line(const Accident& accident, std::uint64_t times);

/// Sets report.warnings: one line for each accident that happened, and one where a scene has media
/// that no pixel shows. `seen`: another part of the picture shows them.
void find_warnings(const Scene& scene, const Image& image, Report& report, bool seen = false);

/// Whether the picture has an alpha and it is 0 everywhere.
bool shows_nothing(const Image& image);

/// Adds a line where cells of scattered light, `cell_m` along their shortest edge, are so thick
/// that it is far off.
void warn_of_cells(const Medium& medium, double cell_m, Report& report);
/// The same, and a line where phase functions are narrower than what cells or particles hold.
void warn_of_light(const World& world, const FinishedParts& parts, Report& report);

}  // namespace pileus
