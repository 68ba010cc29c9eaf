// SPDX-License-Identifier: Apache-2.0
// What each variant errs by once its noise is gone, as measured.
// in: settings -> out: the row measured that is nearest to them.
// docs/collectors.md, "Error and time": tables and how they were made.
#include "src/methods/collectors.h"

namespace pileus {
namespace {

/// Mean difference from the reference, and squared bias as relMSE, of two views of one cloud.
struct BiasRow {
    const char* variant;
    const char *mean, *square;                  // default scene
    const char *against_mean, *against_square;  // against the sun
};

constexpr BiasRow kPaper = {"variant = \"paper\"", "+6.7 %", "0.1561", "-24.5 %", "0.1756"};
constexpr BiasRow kBillboards = {"billboards", "+3.1 %", "0.0081", "-8.6 %", "0.0628"};
constexpr BiasRow kMarch = {"march, 4 bands", "+2.5 %", "0.0024", "-8.8 %", "0.0067"};
constexpr BiasRow kNoSplit = {"march, no first-order split", "+3.0 %", "0.0066", "-21.7 %",
                              "0.0298"};
constexpr BiasRow kWindow = {"march, window", "+6.5 %", "0.0073", "-19.1 %", "0.0287"};
constexpr BiasRow kLobe = {"march, lobe", "+10.8 %", "0.0302", "-10.0 %", "0.0364"};
constexpr BiasRow kTwoBands = {"march, 2 bands", "+12.5 %", "0.0287", "-25.5 %", "0.0544"};
constexpr BiasRow kSixBands = {"march, 6 bands", "-4.9 %", "0.0029", "-2.7 %", "0.0023"};
constexpr BiasRow kCamera = {"march, camera cells of 4 voxels", "+0.7 %", "0.0008", "-0.0 %",
                             "0.0010"};

const BiasRow& row_of(const CollectorSettings& c) {
    if (c.camera_closure) return kCamera;
    if (c.paper) return kPaper;
    if (c.billboards) return kBillboards;
    if (c.lobe_closure) return kLobe;
    if (!c.first_order_split) return kNoSplit;
    if (c.window) return kWindow;
    if (c.bands < 4) return kTwoBands;
    return c.bands < 6 ? kMarch : kSixBands;
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
