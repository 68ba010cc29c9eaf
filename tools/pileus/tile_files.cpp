// SPDX-License-Identifier: Apache-2.0
// See tile_files.h.
#include "tools/pileus/tile_files.h"

#include <fmt/format.h>

#include "src/base/file.h"
#include "src/io/images/exr_tiles.h"
#include "src/plan/report_json.h"
#include "src/session/parts/bands.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"
#include "tools/pileus/picture_scene.h"
#include "tools/pileus/version_text.h"

namespace pileus {

Status read_tiles(const std::vector<std::string>& files, PartArguments& arguments) {
    if (!arguments.tiles) return Status::ok();
    std::int64_t pixels = 0;
    PILEUS_TRY(read_integer("--tiles", *arguments.tiles, 8, 4096, pixels));
    arguments.tile_side = int(pixels);
    if (files.size() == 1 && file_extension(files[0]) == ".exr") return Status::ok();
    return Status::bad_input("--tiles: writes one picture, allowed: -o FILE.exr");
}

Status render_tiles(const Scene& scene, const RenderOptions& options, const Outputs& outputs,
                    int side) {
    const std::string& path = outputs.files.at(0);
    const int height = scene.camera.resolution[1];
    TiledExr file;
    PILEUS_TRY(file.begin(path, side));
    Report told;
    const BandSink sink = [&](int y, bool last, Image& band, Report& report) {
        const std::string folder = scene_folder_from(scene.directory, path);
        if (!folder.empty()) band.origin.emplace_back("folder", folder);
        if (*commit_text() != '\0') band.origin.emplace_back("commit", commit_text());
        PILEUS_TRY(file.add(y, height, band));
        if (last) told = report;
        return Status::ok();
    };
    PILEUS_TRY(render_bands(scene, options, side, sink));
    for (const std::string& warning : told.warnings)
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    if (options.holding) options.holding(true);
    PILEUS_TRY(file.end(told.hash));
    if (!outputs.report.empty()) {
        const std::string json = report_json(told);
        PILEUS_TRY(write_file(outputs.report, {json.data(), json.size()}));
    }
    PILEUS_TRY(print(outputs.report_printed ? report_json(told)
                                            : fmt::format("{} {}\n", told.hash, path)));
    return check_frame_hash(scene, outputs, options.first_frame, {told.hash});
}

}  // namespace pileus
