// SPDX-License-Identifier: Apache-2.0
// Other optics of a live session's media: what else the session holds stays.
// in: media of a scene -> out: a world of them and the method over it, or the session as it was.
// docs/embedding.md, "What may change"
#include <filesystem>

#include "platform/fp_mode.h"
#include "platform/fs_path.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/density_row.h"
#include "src/session/session.h"

namespace pileus {
namespace {

Status refuse(const std::string& what, const char* allowed) {
    return Status::bad_input("media: " + what + ", allowed: " + allowed);
}

/// Cells that the scene's recipe makes, or a host gave, so that another world of it may have them:
/// no extinction is in them, and nothing was done with them since. Null: the world has none.
const Volume* kept_cells(const Scene& scene, const World& world) {
    if (scene.media.size() != 1 || world.direct_sky || world.shows_particles) return nullptr;
    const MediumSettings& medium = scene.media[0];
    const DensityRow* row = density_row(medium.density);
    if (row == nullptr || row->make_particles != nullptr || !medium.box.has_bounds ||
        medium.detail.present() || !medium.optics.transfer.empty())
        return nullptr;
    if (!world.refined) return &world.medium.volume;
    return world.unrefined.density.empty() ? nullptr : &world.unrefined;
}

/// What made `world` asked of it.
WorldUse use_of(const World& world) {
    if (world.direct_sky) return WorldUse::kSkyInPlace;
    if (world.shows_particles) return WorldUse::kParticles;
    return world.data_cells ? WorldUse::kDataCells : WorldUse::kGrid;
}

/// The world of `scene`, whose densities are those of `base`.
Status vary_world(const Scene& scene, const World& base, const Context& context,
                  WeatherFiles* weather, std::shared_ptr<World>& made) {
    HostMedia given;
    given.weather = weather;
    if (const Volume* cells = kept_cells(scene, base)) {
        MediumValues values;
        values.cells = cells->density.data();
        values.size = cells->size;
        given.media.push_back(values);
    } else if (base.given) {
        return refuse("densities of a host's memory, which the world keeps for one medium alone",
                      "another world");
    }
    PILEUS_TRY(outline_own_world(scene, use_of(base), given, context, made));
    PILEUS_TRY(check_limit(
        context.limits, LimitId::kMemory,
        bytes_of_world(base) + bytes_of(made->direct_sky ? 0 : std::uint64_t(made->medium.count),
                                        voxel_count(made->medium.grid) * sizeof(float)),
        scene.file));
    // What other media begin from is the first world.
    made->given = false;
    PILEUS_TRY(load_world(scene, given, context, *made));
    const Medium &before = base.medium, &after = made->medium;
    bool same = before.low_m == after.low_m;
    for (std::size_t a = 0; a < 3; ++a) same = same && before.extent_m[a] == after.extent_m[a];
    if (same) return Status::ok();
    return refuse("one without extinction leaves another box to the others", "another world");
}

/// Of a medium of `from`, for one of `to`, whose files may begin in another folder.
MediumOptics optics_for(const MediumSettings& medium, const Scene& from, const Scene& to) {
    MediumOptics optics = medium.optics;
    std::string& file = optics.phase.file;
    if (!file.empty() && from.directory != to.directory)
        file = path_text(std::filesystem::absolute(path_of(scene_path(from.directory, file))));
    return optics;
}

/// Puts back what was swapped, however a function ends, unless it is kept.
template <class Back>
class Undo {
public:
    explicit Undo(Back back) : back_(std::move(back)) {}
    Undo(const Undo&) = delete;
    Undo& operator=(const Undo&) = delete;
    ~Undo() {
        if (!kept_) back_();
    }
    void keep() { kept_ = true; }

private:
    Back back_;
    bool kept_ = false;
};

}  // namespace

Status Session::set_media(const Scene& given) {
    const FpModeGuard guard;
    const PoolGuard lent(*threads_);
    const std::size_t count = scene_.media.size();
    if (seal_.on) return refuse("a flight's stay as they are packed", "none");
    if (given.media.size() != count)
        return refuse("the scene has " + std::to_string(given.media.size()) + ", the session " +
                          std::to_string(count),
                      "as many");
    Scene next = scene_;
    // Checked with the view that the session began with: what a host set since is checked by
    // itself.
    static_cast<FrameState&>(next) = *opened_;
    bool same = true;
    for (std::size_t i = 0; i < count; ++i) {
        MediumOptics optics = optics_for(given.media[i], given, scene_);
        same = same && next.media[i].optics == optics;
        next.media[i].optics = std::move(optics);
    }
    if (same) return Status::ok();
    PILEUS_TRY(check_changed("medium", next, [](Scene&) {}));
    PILEUS_TRY(row_.check(next, options_.budget));
    if (base_world_ == nullptr) base_world_ = scenery_.world;
    std::shared_ptr<World> made;
    PILEUS_TRY(vary_world(next, *base_world_, context_, scenery_.weather.get(), made));
    return take_world(next.media, std::move(made));
}

void Session::keep_opened() {
    opened_ = std::make_shared<const FrameState>(static_cast<const FrameState&>(scene_));
}

/// Both are the session's afterwards, or it is as it was.
Status Session::take_world(std::vector<MediumSettings>& media, std::shared_ptr<const World> world) {
    Plan plan = plan_;
    FrameState now = scene_;
    Lighting lighting = scenery_.lighting;
    MadeMethod method;
    const auto swap_world = [&] {
        scene_.media.swap(media);
        scenery_.world.swap(world);
    };
    swap_world();
    Undo undo([&] {
        swap_world();
        if (method.method != nullptr) std::swap(made_, method);
        plan_ = std::move(plan);
        static_cast<FrameState&>(scene_) = std::move(now);
        scenery_.lighting = std::move(lighting);
    });
    MadeMethod fresh = row_.make({scene_, options_.budget, true});
    method = std::exchange(made_, std::move(fresh));
    // What a method chooses by camera and lights it chooses for those that the session began with.
    static_cast<FrameState&>(scene_) = *opened_;
    scenery_.light(0);
    PILEUS_TRY(make_plan(made_, context_, scenery_, plan_));
    PILEUS_TRY(made_.method->prepare(context_, scenery_.view(0)));
    PILEUS_TRY(make_plan(made_, context_, scenery_, plan_));
    PILEUS_TRY(made_.method->set_limits(work_));
    undo.keep();
    static_cast<FrameState&>(scene_) = std::move(now);
    last_.planes = nullptr;
    late_ = LateRows{};
    fading_.reset();
    report_.plan = plan_;
    report_.errors = {};
    changed_.stale = true;
    return Status::ok();
}

}  // namespace pileus
