// SPDX-License-Identifier: Apache-2.0
// See support.h. The rows as one table.
#include "src/methods/support.h"

#include "src/methods/support/light_rows.h"
#include "src/methods/support/media_rows.h"
#include "src/methods/support/view_rows.h"
#include "src/methods/support/work_rows.h"

namespace pileus {
namespace {

template <std::size_t N>
constexpr std::size_t count_of(const FeatureRow (&)[N]) {
    return N;
}

constexpr std::size_t kLight = count_of(support_rows::kLightRows);
constexpr std::size_t kView = kLight + count_of(support_rows::kViewRows);
constexpr std::size_t kMedia = kView + count_of(support_rows::kMediaRows);
static_assert(kMedia + count_of(support_rows::kWorkRows) == kSupportFeatures,
              "a row for every feature");

constexpr const FeatureRow& row_at(std::size_t i) {
    return i < kLight   ? support_rows::kLightRows[i]
           : i < kView  ? support_rows::kViewRows[i - kLight]
           : i < kMedia ? support_rows::kMediaRows[i - kView]
                        : support_rows::kWorkRows[i - kMedia];
}

constexpr bool in_order() {
    for (std::size_t i = 0; i < kSupportFeatures; ++i)
        if (row_at(i).feature != Feature(i)) return false;
    return true;
}
static_assert(in_order(), "rows are in the order of Feature");

constexpr bool columns_in_order() {
    for (std::size_t i = 0; i < kMethodColumns; ++i)
        if (kColumnRows[i].column != MethodColumn(i)) return false;
    return true;
}
static_assert(columns_in_order(), "columns are in the order of MethodColumn");

constexpr const char* kLevelNames[] = {"exact", "bounded", "refused"};
static_assert(sizeof kLevelNames / sizeof kLevelNames[0] == std::size_t(SupportLevel::kRefused) + 1,
              "a name for every level");

constexpr const char* kGroupNames[] = {
    "Light",  "Ground and solids",      "Camera", "Media", "Phase functions",
    "Layers", "Work, budgets, sessions"};
static_assert(sizeof kGroupNames / sizeof kGroupNames[0] == std::size_t(FeatureGroup::kCount),
              "a name for every group");

}  // namespace

const char* level_name(SupportLevel level) { return kLevelNames[std::size_t(level)]; }

const char* group_name(FeatureGroup group) { return kGroupNames[std::size_t(group)]; }

const FeatureRow& feature_row(Feature feature) { return row_at(std::size_t(feature)); }

const Support& support(Feature feature, MethodColumn column) {
    return feature_row(feature).by[std::size_t(column)];
}

}  // namespace pileus
