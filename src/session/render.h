// SPDX-License-Identifier: Apache-2.0
// One call from a checked scene to pictures: what programs and tests use.
// in: Scene, options -> out: an Image per frame and a Report.
// docs/architecture.md, "How a frame is made".
#pragma once
#include <functional>
#include <memory>

#include "src/base/limits.h"
#include "src/io/images/image.h"
#include "src/plan/budget.h"
#include "src/plan/part_light.h"
#include "src/plan/report.h"
#include "src/scene/scene.h"

namespace pileus {

/// As the build names it: "major.minor.patch".
extern const char* const kVersion;

struct HostMedia;
class MethodReport;
class WorkShare;
struct KernelTable;
struct MethodRow;
struct World;

struct RenderOptions {
    int threads = 0;                       ///< 0: all there are
    std::string isa;                       ///< empty: the widest this machine runs
    const KernelTable* kernels = nullptr;  ///< where set, instead of `isa`
    Budget budget;                         ///< instead of what the scene says
    std::int64_t verify = 0;               ///< pixels of each picture to trace by paths afterwards
    std::string show;  ///< empty: the picture; else a step of the method (docs/how-it-works.md)
    /// Finds what makes it, by the names of method and view: lab/views/view_list.h.
    Status (*find_view)(const std::string&, const std::string&, MethodRow&) = nullptr;
    const Image* sky = nullptr;          ///< in place of the sky map's file; null: that
    std::shared_ptr<const World> world;  ///< of the scene, where there is one; null: it is made
    const HostMedia* media = nullptr;    ///< likewise of the files and recipes of media
    bool layers = false;  ///< of a host's session: those of the scene's output.layers
    bool digests = true;  ///< the report names what each stage made by its bits; takes time
    int first_frame = 0, last_frame = 0;  ///< of the animation, inclusive
    WorkPart part;                        ///< of a frame, that a session of parts works on
    WorkShare* sharing = nullptr;         ///< of measure_flux
    /// Where set, a frame's light comes from it and none is traced: MethodReport::add_light.
    std::function<Status(MethodReport&)> parts;
    Limits limits;  ///< what the scene may ask for; docs/program.md
    /// Called now and then with a stage's name and the share done of it, 0..1.
    std::function<void(const char* stage, double share)> progress;
    /// Asked now and then whether to end with what there is; the report then says `interrupted`.
    std::function<bool()> interrupted;
    /// Told true before light is traced or files are written, which an end now would lose, and
    /// false once the frame's files are there. At all other times a program may simply end.
    std::function<void(bool)> holding;
};

/// Called once per frame, in order. The report holds all that is known so far. Returning an
/// error stops the rendering.
using FrameSink = std::function<Status(int frame, Image& image, Report& report)>;

/// Whether each frame is rendered by itself, over a density or below a sky of its own.
bool frames_stand_alone(const Scene& scene);

/// Frames after which a film begins anew, where its pictures depend on those before them: frame
/// f on those from f - f % film_run on, which are drawn first wherever a range of frames begins. 0:
/// none depends on others.
int film_run(const Scene& scene);
/// The first frame that is drawn so that `frame` is that of the whole film.
int film_begin(const Scene& scene, int frame);

/// Renders frames [first_frame, last_frame] (a still scene has frame 0 only) by the scene's
/// method; after an interrupted one no further frame comes. Errors: kBadInput (scene, files, isa,
/// show, a budget of another method, a foreign state), kLimit (memory), kIo, kCheckFailed
/// (interrupted before there was anything to show).
Status render(const Scene& scene, const RenderOptions& options, const FrameSink& sink);

/// What `render` would do, in the report's plan: needed, left out, bytes, bounds, bias, work. From
/// sizes alone, so that bytes are upper bounds, or `exact`, after preparing all but the light.
/// Errors: as render's; the limits are checked first.
Status plan_scene(const Scene& scene, const RenderOptions& options, bool exact, Report& report);

}  // namespace pileus
