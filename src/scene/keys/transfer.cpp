// SPDX-License-Identifier: Apache-2.0
// The key of a medium's transfer function: a list of rows, whose keys have rows of their own.
// in: checked values <-> out: MediumOptics::transfer.
// docs/scene.md, "A transfer function".
#include "src/scene/media/transfer.h"

#include "src/scene/keys/all_keys.h"

namespace pileus {
namespace {

Node row_node(const TransferRow& row) {
    Node node;
    node.children = {named("value", node_of(row.value)),
                     named("extinction_per_m", node_of(row.extinction_per_m)),
                     named("albedo", node_of(row.albedo))};
    return node;
}

constexpr KeyField kTransfer{KeyKind::kRows,
                             [](const KeySource& s) {
                                 Node list;
                                 list.kind = NodeKind::kArray;
                                 for (const TransferRow& row : s.medium.optics.transfer)
                                     list.children.push_back(row_node(row));
                                 return list;
                             },
                             [](const KeyTarget& t, const Node& n) {
                                 t.medium.optics.transfer.clear();
                                 for (const Node& child : n.children) {
                                     TransferRow row;
                                     take(*child.find("value"), row.value);
                                     take(*child.find("extinction_per_m"), row.extinction_per_m);
                                     if (const Node* albedo = child.find("albedo"))
                                         take(*albedo, row.albedo);
                                     t.medium.optics.transfer.push_back(row);
                                 }
                             }};

constexpr KeyRow kRows[] = {
    {"value", KeyKind::kNumber, from_to(-1e30, 1e30), "", "", kRequired},
    {"extinction_per_m", KeyKind::kNumber, from_to(0, 1e12), "1/m", "", kRequired},
    {"albedo", KeyKind::kColor, from_to(0, 1), "", ""},
};

Span<const KeyRow> row_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }
constexpr RowList kList{row_keys, "value", 2, kMaxTransferRows};

constexpr KeyRow kKey{"medium.N.transfer",
                      kTransfer,
                      any(),
                      "",
                      "by rising values, what the medium is at a value of its density or variable, "
                      "linear between and constant beyond; in place of the medium's extinction and "
                      "albedo",
                      kNoNote,
                      &kList};

}  // namespace

const KeyRow& transfer_key() { return kKey; }

}  // namespace pileus
