// SPDX-License-Identifier: Apache-2.0
// The words that the rows of the support table are written in. For src/methods/support alone.
// in: entries -> out: a row; one with an entry too few or too many does not compile.
// src/methods/support.h
#pragma once
#include "src/methods/support.h"

namespace pileus {
namespace support_rows {

constexpr Support exact(const char* text = "") { return {SupportLevel::kExact, text, ""}; }
constexpr Support bounded(const char* text) { return {SupportLevel::kBounded, text, ""}; }

/// Without words: "not for method NAME".
constexpr Support refused(const char* text = "", const char* allowed = "") {
    return {SupportLevel::kRefused, text, allowed};
}

template <class... Entries>
constexpr FeatureRow row(Feature feature, FeatureGroup group, const char* name, const char* key,
                         const char* note, Entries... entries) {
    static_assert(sizeof...(Entries) == kMethodColumns, "an entry for every column");
    return {feature, group, name, key, note, {entries...}};
}

template <class... Entries>
constexpr RunnerRow runner_row(const char* feature, Entries... entries) {
    static_assert(sizeof...(Entries) == kRunners, "an entry for every runner");
    return {feature, {entries...}};
}

}  // namespace support_rows
}  // namespace pileus
