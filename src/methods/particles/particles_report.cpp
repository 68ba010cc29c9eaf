// SPDX-License-Identifier: Apache-2.0
// What people are told of method `particles`: what it needs, memory, counts, digests.
// in: its state, outlined or prepared -> out: a plan, a report.
// docs/report.md, "Plan"; docs/particles.md
#include "src/base/digest.h"
#include "src/methods/particles/particles_method.h"
#include "src/methods/particles/sun_tiles.h"
#include "src/methods/particles/view_tiles.h"
#include "src/picture/finish_frame.h"
#include "src/picture/nodes/node_grid.h"
#include "src/picture/ordinates/ordinate_plan.h"
#include "src/picture/whole_rays.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr Stage kUnused[] = {Stage::kSamples, Stage::kTree,  Stage::kCollectors,  Stage::kLeafGrid,
                             Stage::kPhotons, Stage::kPaths, Stage::kReconstruct, Stage::kSplat};

std::uint64_t pixels_of(const Scene& scene) {
    return std::uint64_t(scene.camera.resolution[0]) * std::uint64_t(scene.camera.resolution[1]);
}

const char* scattering_text(ParticleScattering kind) {
    switch (kind) {
        case ParticleScattering::kAuto:
        case ParticleScattering::kSingle:
            break;
        case ParticleScattering::kEffective:
            return "forward scattering as less extinction, by a cone: approximation";
        case ParticleScattering::kSimilarity:
            return "forward scattering as less extinction, by the mean cosine: approximation";
        case ParticleScattering::kOctaves:
            return "light scattered more than once as octaves of the first: approximation";
        case ParticleScattering::kByNodes:
            return "light scattered any number of times, by discrete ordinates on nodes";
    }
    return nullptr;
}

const char* light_text(ParticleLight kind) {
    switch (kind) {
        case ParticleLight::kCentre:
            return "sunlight at each particle's centre: approximation";
        case ParticleLight::kLinear:
            return "sunlight at four places of each particle, linear between: approximation";
        case ParticleLight::kExact:
            break;
    }
    return "sunlight by a walk from each bin";
}

/// Of `linear` as docs/particles.md, "Light", has measured it.
std::string bias_text(const ParticlesSettings& s) {
    std::string text = "light scattered more than once is missing or approximate";
    if (s.scattering == ParticleScattering::kByNodes)
        text = "light scattered more than once is of coarse nodes";
    if (s.light == ParticleLight::kLinear && !s.billboards)
        text +=
            "; single pixels by light = \"linear\": 2 % where a particle is 0.1 deep, 7 % at "
            "0.3, 20 % at 1";
    return text;
}

void note_plan(const FrameView& view, const ParticlesState& state, Plan& plan) {
    const Scene& scene = view.scene;
    const ParticlesSettings& s = state.settings;
    plan.bias = {"particles", bias_text(s), "docs/particles.md"};
    plan.need("an octree of particles");
    if (!s.billboards) plan.need("rays through particles, in bins");
    if (s.billboards) plan.need("particles as billboards, one colour each: approximation");
    if (scene.lens.aperture_radius_m > 0)
        plan.need("depth of field by wider billboards: approximation");
    if (scene.lens.shutter_s > 0 && (state.outlined_only || moves(view, state)))
        plan.need("motion blur by longer billboards: approximation");
    else if (scene.lens.shutter_s > 0)
        plan.leave_out("motion blur", "the particles have no velocities");
    if (view.lighting.sunlit || (scene.sun.present && moves_sun(scene)))
        plan.need(light_text(s.light));
    else
        plan.leave_out("sunlight",
                       scene.sun.present ? "below the ground's horizon, or dark" : "no sun");
    if (const char* text = scattering_text(s.scattering))
        plan.need(text);
    else
        plan.leave_out("light scattered more than once", "scattering = \"single\"");
    if (s.scattering == ParticleScattering::kByNodes)
        plan.leave_out("skylight from 24 directions", "scattering = \"ordinates\"");
    else if (sky_node_sets(view.lighting) == 0)
        plan.leave_out("skylight in the particles", "no sky, no ground");
    else if (s.sky_ambient)
        plan.need("skylight from 24 directions on coarse nodes: approximation");
    else
        plan.leave_out("skylight in the particles", "sky_light = \"none\"");
    if (view.lighting.sunlit && scene.sun.angular_radius_deg > 0)
        plan.leave_out("the sun's disc", "a point to this method: path alone knows it");
    if (view.world.solids.meshes) plan.need("shadows of solids on particles");
    const std::size_t lamps = view.lighting.lamps.size();
    if (lamps > 0) plan.need((std::to_string(lamps) + " lights of [[light]]").c_str());
    if (lamps > 0 && view.world.solids.meshes) plan.need("light of [[light]] on solids");
    if (state.outlined_only || !state.tree.colour.empty())
        plan.need("colours of particles");
    else
        plan.leave_out("colours of particles", "all alike");
    if (emits(view.world.medium))
        plan.need("emission of particles");
    else
        plan.leave_out("emission of particles", "medium.emission is 0");
    note_solids(view.world.solids, view.environment.depth, plan);
    const bool nodes = state.settings.scattering == ParticleScattering::kByNodes;
    note_surface_light(view.world.solids, nodes, nodes && view.lighting.has_bright_ground(), plan);
    note_depths(view.lighting, view.wants_depth(), plan);
    if (!scene.output.layer_optical_depth)
        plan.leave_out("optical depth", "no optical_depth layer");
    if (scene.output.layer_occlusion)
        plan.need("occlusion of the sky from 24 directions at each particle: approximation");
    else
        plan.leave_out("occlusion of the sky", "no occlusion layer");
    for (Stage stage : kUnused) plan.skip(stage);
}

void weigh_memory(const Context& context, const FrameView& view, const ParticlesState& state,
                  Plan& plan) {
    const Scene& scene = view.scene;
    const OutputSettings& output = scene.output;
    const Grid& grid = view.world.medium.grid;
    const std::uint64_t pixels = pixels_of(scene);
    MemoryTable t;
    add_density_rows(grid, view.world.source, std::uint64_t(view.world.medium.count),
                     phase_bytes(view.world.medium), std::uint64_t(context.threads),
                     sky_map_bytes(view.environment.sky_map, view.environment.look), t);
    add_majorant_rows(grid, state.outlined_only ? 1 : state.majorants.tracking.size(),
                      std::uint64_t(context.threads), Stage::kWrite, t);
    // Before the file is read its bytes, which hold all children too, bound the particles.
    const std::uint64_t particles = !state.outlined_only ? state.particles
                                    : scene.media[0].density.empty()
                                        ? view.world.source.reading_bytes / 12
                                        : std::uint64_t(scene.media[0].particles.count);
    add(t, arrays::particle_balls(particles));
    if (state.outlined_only)
        add(t, arrays::particle_nodes(particles));
    else
        t.add("octree", Stage::kDensity, Stage::kWrite, state.tree.nodes.bytes());
    // Places, radii, densities.
    t.add("particles as they are read", Stage::kDensity, Stage::kWrite, bytes_of(particles, 20));
    // Twice: in the order of the file and of the tree.
    const ParticleSet& set = view.world.particles;
    for (const Buffer<float>* own : {&set.velocity, &set.colour, &set.emission})
        if (state.outlined_only || !own->empty())
            t.add("vectors of particles", Stage::kDensity, Stage::kWrite,
                  bytes_of(particles, 2 * 12));
    if (state.outlined_only || !set.id.empty())
        t.add("numbers of particles", Stage::kDensity, Stage::kWrite, bytes_of(particles, 2 * 8));
    t.add("particles while they are sorted", Stage::kMajorants, Stage::kMajorants,
          bytes_of(particles, 2 * 16));
    if (state.settings.light != ParticleLight::kExact) {
        add(t, arrays::particle_shades(particles));
        add(t, arrays::particle_depths(particles, light_samples(state.settings)));
    }
    if (state.settings.light != ParticleLight::kExact || !view.lighting.lamps.empty()) {
        if (state.settings.shadows.occluders < 1) add(t, arrays::particle_occluders(particles));
        add(t, arrays::tile_balls(particles));
        add(t, arrays::tile_places(particles));
        t.add("tiles", Stage::kShadow, Stage::kShadow,
              bytes_of(std::uint64_t(context.threads), sun_tile_scratch_bytes()));
    }
    const std::size_t lamps = view.lighting.lamps.size();
    const bool solids = view.world.solids.meshes;
    if (solids && state.orders > 0) add(t, arrays::particle_seen(particles));
    if (lamps > 0) {
        add(t, arrays::particle_lamps((solids ? 3u : 2u) * particles, lamps));
        if (state.settings.light == ParticleLight::kExact)
            add(t, arrays::particle_depths(particles, 4));
    }
    if (lamps > 0 || state.outlined_only || has_own_light(view, state))
        add(t, arrays::particle_around(particles));
    if (state.settings.scattering == ParticleScattering::kByNodes) {
        OrdinateSizes sizes = lit_ordinate_sizes(view.world.medium, view.lighting,
                                                 view.world.solids, state.ordinates);
        sizes.moments = false;
        sizes.sunlit = view.lighting.sunlit;
        sizes.points = state.hosted || !scene.lights.empty();
        add_ordinate_rows(sizes, t);
        add(t, arrays::particle_sky(particles));
    } else if (state.settings.sky_ambient) {
        const std::uint64_t nodes = node_count(sky_node_grid(view.world.medium));
        const int sets = sky_node_sets(view.lighting);
        add(t, arrays::sky_light(nodes, sets, Stage::kWrite));
        if (sets > 0) add(t, arrays::sky_seen(nodes, kSkyParts));
        if (sets > 0) add(t, arrays::particle_sky(particles));
    }
    const std::uint64_t shown = plane_count(3, view.lighting.opaque(), view.wants_depth()) +
                                (output.layer_optical_depth ? 1u : 0u);
    add(t, arrays::picture_planes(shown, pixels));
    const std::uint64_t rays =
        whole_ray_planes(output, {state.settings.stop_below, false}, view.wants_depth());
    if (rays > 0 && !state.hosted)
        add(t, renamed(arrays::picture_planes(rays, pixels), "planes of whole rays",
                       Stage::kDisplay, Stage::kLayers));
    add(t, arrays::view_balls(particles));
    t.add("tiles of the picture", Stage::kDisplay, Stage::kDisplay,
          bytes_of(std::uint64_t(context.threads), view_tile_scratch_bytes()));
    if (state.settings.billboards)
        add(t, arrays::particle_boards(particles));
    else
        add(t, arrays::particle_bins(std::uint64_t(context.threads), state.settings.bins));
    if (output.layer_occlusion) add(t, arrays::particle_occlusion(particles, pixels));
    add_image_rows(std::uint64_t(scene.camera.resolution[0]),
                   std::uint64_t(scene.camera.resolution[1]),
                   4 + extra_layers(output, view.depths, false), t);
    add_solid_rows(scene, context.limits, view.world.solids, view.environment.depth, t);
    plan.memory = t;
    plan.exact = !state.outlined_only;
}

/// The digest of what the kernels read.
std::string digest_of(const ParticleTree& tree) {
    Digest digest;
    for (const ParticleBall& ball : tree.balls.span()) {
        const float numbers[] = {ball.centre[0], ball.centre[1], ball.centre[2], ball.per_radius,
                                 ball.depth};
        digest.floats({numbers, 5});
    }
    return digest.hex();
}

class ParticlesReport final : public MethodReport {
public:
    explicit ParticlesReport(ParticlesMethod& of) : of_(of) {}

    void explain(const Context& context, const FrameView& view, Plan& plan) const override {
        note_plan(view, of_.state(), plan);
        weigh_memory(context, view, of_.state(), plan);
        note_limits(view.scene, view.world.medium.grid, context.limits,
                    {LimitId::kVoxels, LimitId::kPixels, LimitId::kFrames, LimitId::kMemory}, plan);
    }

    void report(Report& report) const override {
        const ParticlesState& state = of_.state();
        report.executed.emplace_back("particles", state.particles);
        report.executed.emplace_back("octree_nodes", std::uint64_t(state.tree.count()));
        report.executed.emplace_back("octree_leaves", state.tree.leaves);
        if (by_ordinates(state)) tell_ordinates(state.ordinates, report);
    }

    void digest(const FrameView& view, Digests& digests) const override {
        digests = {{"density", density_digest(view.world)},
                   {"particles", digest_of(of_.state().tree)}};
    }

    Status add_layers(const Context& context, const FrameView& view) override {
        if (view.scene.output.layer_occlusion)
            PILEUS_TRY(show_occlusion(context, view, of_.state()));
        return follow_particles(context, view, of_.state());
    }

    FinishedParts finished() const override {
        FinishedParts parts;
        parts.colours = true;
        parts.media = false;
        return parts;
    }

    void put_work(const FrameWork& work, MethodTables& tables) const override {
        if (work.steps > 0) tables.particles.bins = work.steps;
    }

private:
    ParticlesMethod& of_;
};

}  // namespace

std::unique_ptr<MethodReport> particles_report(ParticlesMethod& method) {
    return std::make_unique<ParticlesReport>(method);
}

}  // namespace pileus
