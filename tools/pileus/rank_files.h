// SPDX-License-Identifier: Apache-2.0
// Files of a scene for ranks of MPI on machines that have none of them.
// in: at rank 0 a scene that it can read -> out: at the others copies of all that it names.
// docs/farm.md, "Files that one machine has"
#pragma once
#include "tools/pileus/scene_options.h"

namespace pileus {

/// Adds --stage to a subcommand.
void add_stage_option(CLI::App& command, std::optional<std::string>& folder);

/// Copies of this rank, which go with it.
class StagedFiles {
public:
    StagedFiles() = default;
    StagedFiles(const StagedFiles&) = delete;
    StagedFiles& operator=(const StagedFiles&) = delete;
    ~StagedFiles();

    /// All ranks call it, before they read the scene. Rank 0 reads its files and sends them; every
    /// other one keeps them below `folder`, and its scene becomes the copy. Without `folder`: each
    /// reads the scene where it is. kBadInput: one rank, a picture in place of a scene, names that
    /// lead out of the copies; kIo: a copy that cannot be written. `beside`: another file,
    /// likewise.
    Status stage(const std::optional<std::string>& folder, SceneArguments& arguments,
                 std::optional<std::string>* beside = nullptr);

private:
    Status make_folder(const std::string& folder);
    std::string copy_of(const std::string& path) const;
    void make_steps(const std::string& path) const;
    Status take_file(const std::string& path, std::uint64_t size);
    Status take_files();
    Status check_names(const SceneArguments& arguments) const;

    std::string own_;  ///< folder of the copies; empty: none
    Buffer<char> piece_;
};

}  // namespace pileus
