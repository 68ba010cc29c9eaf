// SPDX-License-Identifier: Apache-2.0
// The report of a run as JSON text, for people and programs.
// in: a Report -> out: UTF-8 JSON with the keys of docs/report.md, two spaces a level.
// RFC 8259; docs/report.md explains each key.
#pragma once
#include <string>

#include "src/plan/report.h"

namespace pileus {

/// The whole report, one JSON object and a final newline. Numbers that are infinite or not numbers
/// become null; bytes that are not UTF-8 become U+FFFD. The same report gives the same text.
std::string report_json(const Report& report);

/// What is known before rendering: `version scene method isa threads seed plan`, as above.
std::string plan_json(const Report& report);

}  // namespace pileus
