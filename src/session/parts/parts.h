// SPDX-License-Identifier: Apache-2.0
// A frame worked on by several runs, on one machine or many, and put together to the bits of one.
// in: a scene, the number of a part -> out: its light or its rows; in: all parts -> out: the
// picture. docs/farm.md
#pragma once
#include <string>
#include <vector>

#include "src/session/render.h"

namespace pileus {

struct Part {
    std::string name;  ///< of its file, for messages
    Division division = Division::kRows;
    WorkPart part;
    int frame = 0;
    PartLight light;  ///< of paths and photons
    Image rows;  ///< else the picture's, with its layers; scene_text and origin are always there
    std::vector<std::pair<std::string, std::uint64_t>> counters;
    /// That it was made over, for a merge by the same process; in no file.
    std::shared_ptr<const World> world;

    /// What its run was told, by name; empty where it was not.
    std::string told(const std::string& name) const;
};

/// Works on a part of frame options.first_frame; options.part says which. kBadInput: what no part
/// of a picture can know, such as an error to reach.
Status render_part(const Scene& scene, const RenderOptions& options, Part& part);

/// What parts of one work have in common: the scene's text and the options of its run.
void note_part(const Scene& scene, const Report& report, Image& told);

/// A part as bytes, and back from a file that nobody vouches for. kBadInput: damaged, of another
/// form; kLimit: out of memory.
Status encode_part(const Part& part, Buffer<char>& bytes);
Status decode_part(const std::string& name, Span<const char> bytes, Part& part);

/// `part` of the same work as `first`, but for its number. kBadInput: another scene, option,
/// version.
Status check_one_work(const Part& part, const Part& first);

/// Whether they are all parts of one work, each once; with `means` of several works that differ in
/// their seeds. Sorts them by seed and number. kBadInput: what is missing, doubled or foreign.
Status check_parts(bool means, std::vector<Part>& parts);

/// Adds the photons of the last part to an earlier one's of the same work, so that many files take
/// the memory of one; nothing where there is none. kLimit: too much for the sums.
Status fold_photons(std::vector<Part>& parts);

/// The picture of sorted parts of `scene`, as render hands it over. kBadInput: the scene's files
/// have changed since.
Status merge_parts(const Scene& scene, const RenderOptions& options, const std::vector<Part>& parts,
                   const FrameSink& sink);

}  // namespace pileus
