// SPDX-License-Identifier: Apache-2.0
// See bands.h. Light that belongs to no pixel is traced once.
#include "src/session/parts/bands.h"

#include <algorithm>
#include <map>

#include "platform/fp_mode.h"
#include "platform/threads.h"
#include "src/base/digest.h"
#include "src/io/images/image_file.h"
#include "src/plan/crop.h"
#include "src/session/deliver.h"
#include "src/session/run_context.h"
#include "src/session/session.h"
#include "src/session/warnings.h"

namespace pileus {
namespace {

Status check_bands(const Scene& scene, const RenderOptions& options) {
    const auto refuse = [](const std::string& what, const char* allowed) {
        return Status::bad_input("--tiles: " + what + ", allowed: " + allowed);
    };
    if (const char* why = whole_for_crop(scene)) return refuse(why, "without");
    if (scene.crop[2] > 0) return refuse("together with camera.crop", "one of both");
    if (scene.animation.is_film())
        return refuse("a film", "--frames A of it, rendered without, or a still scene");
    if (options.verify > 0 || !options.show.empty())
        return refuse("together with --verify or --show", "a picture's light");
    if (!options.budget.state.empty() || options.budget.error > 0 || options.budget.seconds > 0)
        return refuse("a state, an error or a time is of the whole picture",
                      "a number of samples, photons or steps");
    return check_crop(scene, options.budget, false);
}

/// The camera's window for rows [first, first + count) of all columns.
Shown band_window(const Scene& described, int first, int count, Camera& camera) {
    Scene band;
    band.method = described.method;
    static_cast<MethodTables&>(band) = described;
    band.camera = camera;
    band.crop = {0, first, camera.resolution[0], first + count};
    const Shown shown = take_window(band);
    camera = band.camera;
    return shown;
}

}  // namespace

Status render_bands(const Scene& described, const RenderOptions& options, int rows,
                    const BandSink& sink) {
    const FpModeGuard guard;
    ThreadPool threads;
    const PoolGuard lent(threads);
    const RunStart start;
    PILEUS_TRY(check_bands(described, options));
    const int height = described.camera.resolution[1], frame = options.first_frame;
    Scene scene = described;
    Shown shown = band_window(described, 0, std::min(rows, height), scene.camera);
    Session session;
    PILEUS_TRY(session.open_film(scene, opened_at(scene, frame), options, true, nullptr));
    Report& report = session.report();
    std::map<std::string_view, std::uint64_t> counts;
    Digest hash;
    bool seen = false;
    for (int y = 0; y < height; y += rows) {
        Camera camera = described.camera;
        shown = band_window(described, y, std::min(rows, height - y), camera);
        PILEUS_TRY(session.set_window(camera));
        const bool last = y + rows >= height;
        Image band;
        PILEUS_TRY(draw_frame(scene, session, {frame, y == 0, last}, band));
        for (const auto& [name, count] : report.counters) counts[name] += count;
        PILEUS_TRY(cut_image(session.camera(), shown, band));
        add_pixels(band, hash);
        seen = seen || !shows_nothing(band);
        if (session.context().interrupted && session.context().interrupted() && !last)
            return {Code::kCheckFailed,
                    "interrupted before the picture was whole; no file written"};
        session.context().tell("picture", double(y + band.height) / double(height));
        band.scene_text = described.text;
        if (last) {
            report.counters.clear();
            for (const auto& [name, count] : counts) report.counters.emplace_back(name, count);
            session.finish_report();
            report.hash = hash.hex();
            report.digests = {{"image", report.hash}};
            report.errors = {};
            find_warnings(scene, band, report, seen);
        }
        report.frame = frame;
        note_origin(report, band);
        finish_clocks(start, report);
        PILEUS_TRY(sink(y, last, band, report));
    }
    return Status::ok();
}

}  // namespace pileus
