// SPDX-License-Identifier: Apache-2.0
// The files of a rendering: what they are called, whether they may be written, and the writing.
// in: names, a scene, frames -> out: faults before the work is done; files that appear together.
// docs/program.md, "render"
#pragma once
#include <string>
#include <vector>

#include "src/session/render.h"
#include "tools/pileus/block_files.h"
#include "tools/pileus/output_set.h"

namespace pileus {

/// Everything a frame needs to be written.
struct Outputs {
    std::vector<std::string> files;
    std::vector<std::string> world_files;  ///< beside them; none, or one for each
    std::string report;
    bool report_printed = false;  ///< --report -: on the standard output, and nothing else there
    ToneSettings tone;
    bool says_exposure = false;  ///< a line for each frame on the standard error, measured stops
    BlockSettings blocks;
    std::vector<std::string> hashes;  ///< that the written frames should have; none, or one each
    std::string remark;               ///< behind the line of one that has another
    bool nothing = false;             ///< a picture is compared with what it was, and not written
    int first_frame = 0;              ///< that is written; frames before it only lead up to it
    bool numbered = false;  ///< the scene has several frames, so names carry the frame's number
};

/// The name of a file of one frame.
std::string frame_path(const std::string& path, int frame, bool numbered);

/// Refuses to write over what is read, or two outputs into one file, in any of the frames.
Status check_names(const std::vector<std::string>& all, bool numbered, int first_frame,
                   int last_frame, const Scene& scene);

/// Finds what would make writing fail before the work is done.
Status check_outputs(const Outputs& outputs, const Scene& scene, const RenderOptions& options);

/// Names a world file for each picture; kBadInput where the pictures are no maps.
Status add_world_files(const Scene& scene, Outputs& outputs);

/// kCheckFailed: none of a frame's hashes is that which it should have; none: it was not rendered.
Status check_frame_hash(const Scene& scene, const Outputs& outputs, int frame,
                        const std::vector<std::string>& hashes);

/// Writes all files of a frame and says so on the standard output. `hashes`: of the pixels in each
/// file, as hash prints them, and of the picture itself.
Status write_frame(const Outputs& outputs, const Scene& scene, int frame, Image& image,
                   const Report& report, std::vector<std::string>& hashes);

}  // namespace pileus
