// SPDX-License-Identifier: Apache-2.0
// The keys that a study may hold, and the check of a table against them.
// in: a table of untrusted TOML -> out: sound values, or faults with their places.
// docs/study.md, "The file"
#pragma once
#include <string>

#include "src/scene/checks/fault_list.h"
#include "src/scene/keys/all_keys.h"

namespace pileus {

/// Rows of one table of a study; their paths are names within it, their setters are null.
struct StudyTable {
    const char* heading;  ///< "[reference]"
    Span<const KeyRow> rows;
    const char* tables;  ///< names of tables within it, parted by '|'; empty: none
};

StudyTable study_top_table();
StudyTable study_reference_table();
StudyTable study_scene_table();
StudyTable study_method_table();
StudyTable study_setting_table();

/// Adds a fault for every unknown or missing key and every value that its row does not allow.
/// `path` names the table in messages; empty for the top.
void check_study_table(const StudyTable& table, const Node& node, const std::string& path,
                       FaultList& faults);

/// "path.name", or "name" at the top.
std::string study_path(const std::string& path, const std::string& name);

}  // namespace pileus
