// SPDX-License-Identifier: Apache-2.0
// What a run of method `particles` needs and leaves out, and its memory.
// in: ParticlesRun, outlined or prepared -> out: its plan; kLimit where something is too much.
// docs/report.md, "Plan"; docs/particles.md
#include "kernels_cpu/core/profile.h"
#include "src/methods/particles/particles_run.h"
#include "src/methods/particles/sun_tiles.h"
#include "src/methods/particles/view_tiles.h"
#include "src/picture/nodes/node_grid.h"
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
        case ParticleScattering::kSingle:
            break;
        case ParticleScattering::kEffective:
            return "forward scattering as less extinction, by a cone: approximation";
        case ParticleScattering::kSimilarity:
            return "forward scattering as less extinction, by the mean cosine: approximation";
        case ParticleScattering::kOctaves:
            return "light scattered more than once as octaves of the first: approximation";
    }
    return nullptr;
}

void note_plan(ParticlesRun& run) {
    const Scene& scene = *run.scene;
    const ParticlesSettings& s = run.settings;
    Plan& plan = run.plan;
    plan = Plan{};
    plan.bias = {"particles", "light scattered more than once is missing or approximate",
                 "docs/particles.md"};
    plan.need("an octree of particles");
    if (!s.billboards) plan.need("rays through particles, in bins");
    if (s.billboards) plan.need("particles as billboards, one colour each: approximation");
    if (scene.lens.aperture_radius_m > 0)
        plan.need("depth of field by wider billboards: approximation");
    if (scene.lens.shutter_s > 0 && (run.outlined_only || moves(run)))
        plan.need("motion blur by longer billboards: approximation");
    else if (scene.lens.shutter_s > 0)
        plan.leave_out("motion blur", "the particles have no velocities");
    if (run.lighting.sunlit || (scene.sun.present && moves_sun(scene)))
        plan.need(run.settings.light == ParticleLight::kExact ? "sunlight by a walk from each bin"
                                                              : "sunlight at each particle");
    else
        plan.leave_out("sunlight",
                       scene.sun.present ? "below the ground's horizon, or dark" : "no sun");
    if (const char* text = scattering_text(s.scattering))
        plan.need(text);
    else
        plan.leave_out("light scattered more than once", "scattering = \"single\"");
    if (sky_node_sets(run.lighting) == 0)
        plan.leave_out("skylight in the particles", "no sky, no ground");
    else if (s.sky_ambient)
        plan.need("skylight from 24 directions on coarse nodes: approximation");
    else
        plan.leave_out("skylight in the particles", "sky_light = \"none\"");
    if (run.lighting.sunlit && scene.sun.angular_radius_deg > 0)
        plan.leave_out("the sun's disc", "a point to this method: path alone knows it");
    if (run.world->solids.meshes && s.light == ParticleLight::kExact)
        plan.leave_out("the sun's shadow of solids on particles", "light = \"exact\"");
    else if (run.world->solids.meshes)
        plan.need("shadows of solids on particles");
    const std::size_t lamps = run.lighting.lamps.size();
    if (lamps > 0) plan.need((std::to_string(lamps) + " lights of [[light]]").c_str());
    if (lamps > 0 && run.world->solids.meshes)
        plan.leave_out("light of [[light]] on solids", "not in this version");
    if (run.outlined_only || !run.tree.colour.empty())
        plan.need("colours of particles");
    else
        plan.leave_out("colours of particles", "all alike");
    if (emits(run.world->medium))
        plan.need("emission of particles");
    else
        plan.leave_out("emission of particles", "medium.emission is 0");
    note_solids(run.world->solids, run.environment.depth, plan);
    if (!run.lighting.opaque()) plan.leave_out("depth test", "nothing solid: no ground");
    if (!scene.wants_depth()) plan.leave_out("depth of the medium", "no depth layer");
    if (!scene.output.layer_optical_depth)
        plan.leave_out("optical depth", "no optical_depth layer");
    if (scene.output.layer_occlusion)
        plan.need("occlusion of the sky from 24 directions at each particle: approximation");
    else
        plan.leave_out("occlusion of the sky", "no occlusion layer");
    for (Stage stage : kUnused) plan.skip(stage);
}

void weigh_memory(const Context& context, ParticlesRun& run) {
    const Scene& scene = *run.scene;
    const OutputSettings& output = scene.output;
    const Grid& grid = run.world->medium.grid;
    const std::uint64_t pixels = pixels_of(scene);
    MemoryTable t;
    add_density_rows(grid, run.world->source, std::uint64_t(run.world->medium.count),
                     phase_bytes(run.world->medium), std::uint64_t(context.threads),
                     sky_map_bytes(run.environment.sky_map), t);
    add_majorant_rows(grid, run.outlined_only ? 1 : run.majorants.tracking.size(),
                      std::uint64_t(context.threads), Stage::kWrite, t);
    // Before the file is read its bytes, which hold all children too, bound the particles.
    const std::uint64_t particles = !run.outlined_only ? run.particles
                                    : scene.media[0].density.empty()
                                        ? run.world->source.reading_bytes / 12
                                        : std::uint64_t(scene.media[0].particles.count);
    add(t, arrays::particle_balls(particles));
    if (run.outlined_only)
        add(t, arrays::particle_nodes(particles));
    else
        t.add("octree", Stage::kDensity, Stage::kWrite, run.tree.nodes.bytes());
    // Places, radii, densities.
    t.add("particles as they are read", Stage::kDensity, Stage::kWrite, bytes_of(particles, 20));
    // Twice: in the order of the file and of the tree.
    const ParticleSet& set = run.world->particles;
    for (const Buffer<float>* own : {&set.velocity, &set.colour, &set.emission})
        if (run.outlined_only || !own->empty())
            t.add("vectors of particles", Stage::kDensity, Stage::kWrite,
                  bytes_of(particles, 2 * 12));
    if (run.outlined_only || !set.id.empty())
        t.add("numbers of particles", Stage::kDensity, Stage::kWrite, bytes_of(particles, 2 * 8));
    t.add("particles while they are sorted", Stage::kMajorants, Stage::kMajorants,
          bytes_of(particles, 2 * 16));
    if (run.settings.light != ParticleLight::kExact) {
        add(t, arrays::particle_shades(particles));
        add(t, arrays::particle_depths(particles, light_samples(run.settings)));
    }
    if (run.settings.light != ParticleLight::kExact || !run.lighting.lamps.empty()) {
        if (run.settings.occluders < 1) add(t, arrays::particle_occluders(particles));
        add(t, arrays::tile_balls(particles));
        add(t, arrays::tile_places(particles));
        t.add("tiles", Stage::kShadow, Stage::kShadow,
              bytes_of(std::uint64_t(context.threads), sun_tile_scratch_bytes()));
    }
    const std::size_t lamps = run.lighting.lamps.size();
    const bool solids = run.world->solids.meshes;
    if (solids && run.orders > 0 && run.settings.light != ParticleLight::kExact)
        add(t, arrays::particle_seen(particles));
    if (lamps > 0) {
        add(t, arrays::particle_lamps((solids ? 3u : 2u) * particles, lamps));
        if (run.settings.light == ParticleLight::kExact)
            add(t, arrays::particle_depths(particles, 4));
    }
    if (lamps > 0 || run.outlined_only || has_own_light(run))
        add(t, arrays::particle_around(particles));
    if (run.settings.sky_ambient) {
        const std::uint64_t nodes = node_count(sky_node_grid(run.world->medium));
        const int sets = sky_node_sets(run.lighting);
        add(t, arrays::sky_light(nodes, sets, Stage::kWrite));
        if (sets > 0) add(t, arrays::sky_seen(nodes, kSkyParts));
        if (sets > 0) add(t, arrays::particle_sky(particles));
    }
    const std::uint64_t shown = plane_count(3, run.lighting.opaque(), scene.wants_depth()) +
                                (output.layer_optical_depth ? 1u : 0u);
    add(t, arrays::picture_planes(shown, pixels));
    add(t, arrays::view_balls(particles));
    t.add("tiles of the picture", Stage::kDisplay, Stage::kDisplay,
          bytes_of(std::uint64_t(context.threads), view_tile_scratch_bytes()));
    if (run.settings.billboards)
        add(t, arrays::particle_boards(particles));
    else
        add(t, arrays::particle_bins(std::uint64_t(context.threads), bins_of(run)));
    if (output.layer_occlusion) add(t, arrays::particle_occlusion(particles, pixels));
    add_image_rows(std::uint64_t(scene.camera.resolution[0]),
                   std::uint64_t(scene.camera.resolution[1]), 4 + extra_layers(output, false), t);
    add_solid_rows(scene, context.limits, run.world->solids, run.environment.depth, t);
    run.plan.memory = t;
    run.plan.exact = !run.outlined_only;
}

}  // namespace

Status plan_particles(const Context& context, ParticlesRun& run) {
    if (!kPlans) return Status::ok();
    note_plan(run);
    weigh_memory(context, run);
    note_limits(*run.scene, run.world->medium.grid, context.limits,
                {LimitId::kVoxels, LimitId::kPixels, LimitId::kFrames, LimitId::kMemory}, run.plan);
    return check_limit(context.limits, LimitId::kMemory, run.plan.memory.peak(), run.scene->file);
}

}  // namespace pileus
