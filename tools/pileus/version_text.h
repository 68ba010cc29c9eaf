// SPDX-License-Identifier: Apache-2.0
// Version and commit of this program, in words.
// in: the build -> out: texts. Never part of a digest.
// docs/program.md
#pragma once
#include <string>

namespace pileus {

/// `git describe` of the sources: "v0.9.0-3-gabcdef", "-dirty" behind it where they were changed.
/// Empty: built without git or outside the repository.
const char* commit_text();

/// "0.9.0 (v0.9.0-3-gabcdef)"; without a commit "0.9.0".
std::string version_text();

/// The same of any picture. Texts from files are made printable.
std::string version_text(const std::string& version, const std::string& commit);

}  // namespace pileus
