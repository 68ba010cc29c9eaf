// SPDX-License-Identifier: Apache-2.0
// The figures of a comparison as JSON and as lines for people.
// in: Metrics -> out: text.
// docs/compare.md, "Figures"
#pragma once
#include <string>

#include "lab/compare/flip.h"
#include "lab/compare/metrics.h"

namespace pileus {

/// What was compared with what, for the text.
struct ComparisonText {
    std::string a, reference;            ///< as the user named them
    std::string said_a, said_reference;  ///< what reading did to them; may be empty
    bool halves = false;                 ///< the reference is the mean of two
    double alpha_least = 0.02;
    int width = 0, height = 0;
};

/// One JSON object and a final newline; keys of docs/compare.md, unknown figures null.
/// `flip`: null where it was not measured.
std::string metrics_json(const ComparisonText& text, const Metrics& metrics,
                         const FlipResult* flip);

/// The same in a few aligned lines.
std::string metrics_lines(const ComparisonText& text, const Metrics& metrics,
                          const FlipResult* flip);

}  // namespace pileus
