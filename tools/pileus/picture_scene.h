// SPDX-License-Identifier: Apache-2.0
// A picture as a scene: what its file says of the run that made it.
// in: an .exr file that nobody vouches for -> out: the scene's text and the options of the run.
// docs/program.md, "A picture made again"; docs/formats.md, "OpenEXR"
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "src/io/images/image.h"
#include "src/session/render.h"

namespace pileus {

struct PictureScene {
    std::string file, text;              ///< without the remarks of --set
    std::string directory;               ///< where names in the scene start
    std::string version, method, show;   ///< of the run
    std::string commit;                  ///< of the program's sources; empty: not known
    std::string hash;                    ///< of the pixels in the file
    bool edited = false;                 ///< they are not those whose hash the file names
    std::vector<std::string> overrides;  ///< --set of the run, and what a time chose
    std::vector<std::string> budgets;    ///< that make it again
    std::string unrepeatable;            ///< why no budget does; empty: one does
    std::int64_t seed = 0;
    int frame = 0, first_frame = 0;
    bool ended = false;  ///< by a time, an error or the user
};

/// Whether the name is that of a picture that may hold a scene.
bool is_picture_scene(const std::string& path);

/// `folder`: where names in the scene start instead of where the picture says. Errors: those of
/// read_image; kBadInput: an attribute that is missing or malformed, named in the line.
Status read_picture_scene(const std::string& path, const std::optional<std::string>& folder,
                          PictureScene& out);

/// The same of a picture that was read from `path`.
Status take_picture_scene(const std::string& path, const Image& image,
                          const std::optional<std::string>& folder, PictureScene& out);

/// What a file of a run tells beside pixels: its scene_text and its origin.
Status take_run(const std::string& path, const Image& image,
                const std::optional<std::string>& folder, PictureScene& out);

/// The frame of the picture, and those before it that its bits depend on. kBadInput: the scene has
/// no such frame.
Status picture_frames(const PictureScene& picture, const Scene& scene, int& first, int& last);

/// kBadInput: a file that the scene reads is missing, with the folder where it was looked for.
Status check_scene_files(const PictureScene& picture, const Scene& scene);

/// The way from a picture's folder to that of its scene, told without the names of folders above
/// both: "..", "../scenes". Empty where there is none.
std::string scene_folder_from(const std::string& scene_directory, const std::string& picture);

}  // namespace pileus
