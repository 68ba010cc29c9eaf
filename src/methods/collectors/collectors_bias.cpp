// SPDX-License-Identifier: Apache-2.0
// What each variant errs by once its noise is gone, as measured.
// in: settings -> out: the row measured that is nearest to them.
// docs/collectors.md, "Error and time": tables and how they were made.
#include "src/methods/collectors/collectors_state.h"

namespace pileus {
namespace {

/// Mean difference from the reference, and squared bias as relMSE, of two views of one cloud.
struct BiasRow {
    const char* variant;
    const char *mean, *square;                  // default scene
    const char *against_mean, *against_square;  // against the sun
};

constexpr BiasRow kPaper = {"variant = \"paper\"", "+6.8 %", "0.1397", "-25.5 %", "0.1750"};
constexpr BiasRow kBillboards = {"billboards", "+1.2 %", "0.0065", "-0.4 %", "0.0801"};
constexpr BiasRow kMarch = {"march, 4 bands", "+0.7 %", "0.0010", "-0.7 %", "0.0045"};
constexpr BiasRow kAlone = {"march, bands alone", "+2.7 %", "0.0028", "-9.7 %", "0.0105"};
constexpr BiasRow kNoSplit = {"march, no first-order split", "-5.1 %", "0.0060", "-1.1 %",
                              "0.0107"};
constexpr BiasRow kWindow = {"march, window", "+6.6 %", "0.0077", "-20.0 %", "0.0315"};
constexpr BiasRow kLobe = {"march, lobe", "+10.9 %", "0.0304", "-10.9 %", "0.0392"};
constexpr BiasRow kTwoBands = {"march, 2 bands", "-4.6 %", "0.0055", "+0.2 %", "0.0066"};
constexpr BiasRow kSixBands = {"march, 6 bands", "+0.3 %", "0.0005", "-0.6 %", "0.0039"};
constexpr BiasRow kCamera = {"march, camera cells of 4 voxels", "+0.8 %", "0.0018", "-0.9 %",
                             "0.0047"};

const BiasRow& row_of(const CollectorSettings& c) {
    if (c.closure.camera) return kCamera;
    if (c.paper) return kPaper;
    if (c.display.billboards) return kBillboards;
    if (c.closure.lobe) return kLobe;
    if (!c.first_order_split) return kNoSplit;
    if (c.closure.window) return kWindow;
    if (c.closure.axis_degrees == 0 && c.closure.bands < 6) return kAlone;
    if (c.closure.bands < 4) return kTwoBands;
    return c.closure.bands < 6 ? kMarch : kSixBands;
}

}  // namespace

BiasNote collectors_bias(const CollectorSettings& settings) {
    const BiasRow& row = row_of(settings);
    BiasNote note;
    note.method = row.variant;
    note.size = std::string("mean ") + row.mean + ", relMSE " + row.square +
                " on the default cumulus; " + row.against_mean + ", " + row.against_square +
                " against the sun";
    note.page = "docs/collectors.md";
    return note;
}

}  // namespace pileus
