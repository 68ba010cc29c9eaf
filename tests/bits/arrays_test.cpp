// SPDX-License-Identifier: Apache-2.0
// The plan's exact bytes are those of the buffers that a run holds, method by method.
// in: two small scenes a method, prepared -> out: each planned row against its buffers.
// docs/contributing.md, "Add an array"
#include <map>

#include "src/methods/collectors/collectors_method.h"
#include "src/methods/march/march_method.h"
#include "src/methods/particles/particles_method.h"
#include "src/methods/particles/view_tiles.h"
#include "src/methods/path/path_method.h"
#include "src/methods/path/path_sky.h"
#include "src/methods/photon_grid/photon_grid_method.h"
#include "src/methods/registry.h"
#include "src/picture/whole_rays.h"
#include "tests/bits/ordinate_bytes.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

using Bytes = std::map<std::string, std::uint64_t>;

/// Two media on one grid: their parts and shares are arrays, too.
constexpr const char* kTwoMedia = R"(
seed = 2
sun.elevation_deg = 40
sky.radiance = [0.1, 0.2, 0.3]
collectors = { photons = 4000, generations = 4, samples = 400 }
[camera]
position_m = [0, -300, 60]
target_m = [0, 0, 60]
resolution = [20, 12]
[[medium]]
density = "uniform:sphere"
resolution = [12, 10, 14]
bounds_m = [[-50, -50, 10], [50, 50, 110]]
extinction_per_m = 0.05
albedo = 0.9
[[medium]]
density = "uniform:box"
resolution = [6, 6, 6]
bounds_m = [[-30, -30, 10], [30, 30, 60]]
extinction_per_m = 0.02
[output]
layers = ["radiance", "alpha", "depth", "optical_depth"]
)";

struct Fixture {
    Scene scene;
    Report report;
    Context context;

    Fixture(const Fixture&) = delete;
    Fixture(const char* text, const char* method, const std::vector<std::string>& overrides = {}) {
        std::vector<std::string> all = overrides;
        all.push_back(std::string("method.name = \"") + method + "\"");
        scene = scene_from(text, all);
        context.kernels = kernel_table(nullptr);
        context.threads = 2;
        context.report = &report;
    }
};

/// Every row that lives in `stage` has the bytes of its buffers, and every buffer has a row.
void check_rows(const MemoryTable& table, Stage stage, Bytes held) {
    Bytes planned;
    for (const MemoryRow& row : table.rows())
        if (row.first <= stage && stage <= row.last) planned[row.item] += row.bytes;
    for (const auto& row : planned) {
        CAPTURE(row.first);
        CHECK(held.count(row.first) == 1);
        CHECK(row.second == held[row.first]);
        held.erase(row.first);
    }
    for (const auto& row : held) {
        CAPTURE(row.first);
        CHECK(row.second == 0);
    }
}

struct Run : Scenery {
    Plan plan;
    Status open(const MethodRow& row, const MadeMethod& made, const Scene& of,
                const Context& context) {
        show(of, of);
        return open_method(row, made, context, true, nullptr, nullptr, *this, plan);
    }
};

Bytes held_by(const Run& run, const Majorants& majorants) {
    const World& world = *run.world;
    return {{"density", world.medium.volume.density.bytes()},
            {"parts of the media", world.medium.parts.bytes()},
            {"tile of detail", world.medium.detail.tile.bytes()},
            {"phase functions", phase_bytes(world.medium)},
            {"sky map", run.environment.sky_map.bytes()},
            {"majorants", majorants.tracking.bytes()},
            {"blocks to skip", majorants.skipping.bytes()}};
}

std::uint64_t bytes_held(const Planes& p) {
    return p.transmittance.bytes() + p.colour.bytes() + p.half_depth.bytes() +
           p.background.bytes() + p.opaque_depth.bytes() + p.optical_depth.bytes();
}

std::uint64_t bytes_held(const PhotonSlot& slot) {
    return slot.sums.bytes() + slot.packed.sets.bytes() + slot.packed.ground.bytes();
}
/// Freed with their march, but for one number a pixel.
std::uint64_t whole_rays_held(const FrameView& view, const RayEnds& ends) {
    const auto& size = view.scene.camera.resolution;
    return 4 * std::uint64_t(size[0]) * std::uint64_t(size[1]) *
           whole_ray_planes(view.scene.output, ends, view.wants_depth());
}
/// Up to 256 bytes keep threads' sums apart. A ring is packed from one set of sums at least.
std::uint64_t sums_bound(const PhotonState& state, const Plan& plan) {
    std::uint64_t sums = state.ring.scratch.sums.bytes(), bound = plan.accumulation.bytes;
    if (bound == 0 && sums_ring(state)) bound = sums;
    CHECK((sums <= bound && bound <= sums + 2 * 256));
    return bound;
}

/// What all methods of photons hold.
void add_photons(const PhotonState& state, const Plan& plan, Bytes& held) {
    for (const PhotonSlot& slot : state.ring.photons.slots) held["photon map"] += bytes_held(slot);
    if (sums_ring(state)) held["photon map of the ring"] = state.ring.sum.sum.sums.bytes();
    held["photon tallies per thread"] = state.ring.scratch.tallies.bytes();
    held["photon sums per thread"] = sums_bound(state, plan);
}

/// A method of photons over an open run.
template <class Of>
struct Opened {
    Run run;
    MadeMethod made;
    const Of& method;

    Opened(const MethodRow& row, const Fixture& f, const Budget& budget = {})
        : made(row.make({f.scene, budget, false})), method(static_cast<Of&>(*made.method)) {
        const Status status = run.open(row, made, f.scene, f.context);
        REQUIRE_MESSAGE(status, status.message);
    }
};

void check_collectors(const Fixture& f) {
    Budget budget;
    budget.photons = 4000;
    const Opened<CollectorsMethod> opened(collectors_row(), f, budget);
    const Run& run = opened.run;
    const CollectorsState& state = opened.method.state();
    REQUIRE(run.plan.exact);
    Bytes held = held_by(run, state.majorants);
    held["leaves"] = state.prepared.leaves.bytes();
    held["collector of voxel"] = state.prepared.collector_of_voxel.bytes();
    held["collectors"] = state.prepared.collectors.bytes();
    held["shares of the media"] = state.prepared.shares.bytes();
    add_photons(state, run.plan, held);
    check_rows(run.plan.memory, Stage::kPhotons, held);
}

void check_photon_grid(const Fixture& f) {
    Budget budget;
    budget.photons = 4000;
    const Opened<PhotonGridMethod> opened(photon_grid_row(), f, budget);
    const Run& run = opened.run;
    const PhotonGridState& state = opened.method.state();
    REQUIRE(run.plan.exact);
    Bytes held = held_by(run, state.majorants);
    held["cells near medium"] = state.near.marks.bytes();
    held["shares of the media"] = state.shares.bytes();
    add_photons(state, run.plan, held);
    check_rows(run.plan.memory, Stage::kPhotons, held);
}

void check_path(const Fixture& f) {
    Run run;
    MadeMethod made;
    Budget budget;
    budget.samples = 2;
    const PathState& state = make_path({f.scene, budget}, made).state();
    REQUIRE(run.open(path_row(), made, f.scene, f.context));
    REQUIRE(run.plan.exact);
    std::uint64_t done = 0;
    REQUIRE(made.method->accumulate(f.context, run.view(0), 2, done));
    Bytes held = held_by(run, state.majorants);
    held["directions to the sky map"] = state.scratch.sky.bytes();
    held["film"] = state.film.sum.bytes() + state.film.square.bytes();
    held["blocks that flights cross"] = state.scratch.blocks.bytes();
    held["path samples"] = state.scratch.radiance.bytes();
    held["picture planes"] = bytes_held(state.planes);
    check_rows(run.plan.memory, Stage::kPaths, held);
}

void check_march(const MethodRow& row, const Fixture& f) {
    const MadeMethod made = row.make({f.scene, {}});
    const MarchState& state = static_cast<MarchMethod&>(*made.method).state();
    Run run;
    REQUIRE(run.open(row, made, f.scene, f.context));
    Planes* planes = nullptr;
    REQUIRE(made.method->render(f.context, run.view(0), {}, planes));
    REQUIRE(made.report->add_layers(f.context, run.view(0)));
    Bytes held = held_by(run, state.media.majorants);
    held["sunlight's optical depth on nodes"] = state.light.sun.nodes.optical_depth.bytes();
    held["skylight on nodes"] = state.light.sky.nodes.light.bytes();
    held["sky seen from nodes"] = state.light.sky.nodes.seen.bytes();
    held["blue noise"] = state.picture.noise.bytes();
    held["sunlight on nodes of the sky"] = state.light.sky.layer.words.bytes();
    for (const DensityLevel& level : state.media.coarse) {
        held["coarser density"] += level.density.bytes();
        held["its blocks"] += level.majorants.bytes();
    }
    held["blocks to skip"] += state.media.lit_majorants.skipping.bytes();
    held["density below the largest extinction"] = state.media.capped.volume.density.bytes();
    held["density on the cells of the buffer"] = state.media.lit.volume.density.bytes();
    held["picture planes"] = bytes_held(*planes);
    held["shadow on the ground"] = state.light.ground_shadow.depth.bytes();
    const std::uint64_t rows = std::uint64_t(f.scene.camera.resolution[1]);
    held["counts of rows"] = 8 * rows * std::uint64_t(kRaymarchCounts);  // freed with the march
    const bool thin = f.scene.raymarch.thin.scale > 1;
    held["marched pixels"] = bytes_held(state.picture.upsample.few) + (thin ? 8 * rows : 0);
    held["planes of whole rays"] =
        whole_rays_held(run.view(0), {state.choice.settings.march.stop_below, thin});
    add_ordinates(state.light.ordinates.nodes, held);
    check_rows(run.plan.memory, Stage::kDisplay, held);
}

void check_particles(const Fixture& f) {
    const test::TempFolder folder;
    folder.put("p.csv", "x y z radius density\n0 0 900 300 0.01\n100 50 1000 200 0.02\n");
    Scene scene = f.scene;
    scene.directory = folder.path("");
    const MethodRow row = particles_row();
    const MadeMethod made = row.make({scene, {}});
    const ParticlesState& state = static_cast<ParticlesMethod&>(*made.method).state();
    Run run;
    REQUIRE(run.open(row, made, scene, f.context));
    REQUIRE(run.plan.exact);
    Planes* planes = nullptr;
    REQUIRE(made.method->render(f.context, run.view(0), {}, planes));
    REQUIRE(made.report->add_layers(f.context, run.view(0)));
    Bytes held = held_by(run, state.majorants);
    held["particles"] = state.tree.balls.bytes();
    const ParticleSet& set = run.world->particles;
    CHECK(set.colour.empty());
    held["particles as they are read"] =
        set.position.bytes() + set.radius.bytes() + set.density.bytes();
    held["velocities of particles"] = set.velocity.bytes() + state.tree.velocity.bytes();
    held["octree"] = state.tree.nodes.bytes();
    held["particles' depths towards the sun"] = state.shade.bytes();
    held["particles' skylight"] = state.sky.bytes();
    held["particles' depths towards lights"] =
        state.lamp_depth.bytes() + state.lamp_reach.bytes() + state.lamp_seen.bytes();
    held["particles' light around"] = state.around_balls.bytes();
    held["skylight on nodes"] = state.sky_nodes.light.bytes();
    held["sky seen from nodes"] = state.sky_nodes.seen.bytes();
    held["picture planes"] = bytes_held(*planes);
    held["planes of whole rays"] =
        whole_rays_held(run.view(0), {scene.particles.stop_below, false});
    // Freed with the march, but for one number a pixel.
    if (scene.output.layer_occlusion)
        held["occlusion"] = arrays::particle_occlusion(2, planes->occlusion.size()).bytes();
    if (scene.particles.billboards)
        held["billboards"] = arrays::particle_boards(state.particles).bytes();
    else
        held["bins along rays"] =
            4 * particle_scratch_floats(scene.particles.bins) * std::uint64_t(f.context.threads);
    // Filled as far as a picture needs them.
    held["particles by tiles of the picture"] = arrays::view_balls(state.particles).bytes();
    held["tiles of the picture"] = view_tile_scratch_bytes() * std::uint64_t(f.context.threads);
    check_rows(run.plan.memory, Stage::kDisplay, held);
}

}  // namespace

TEST_CASE("arrays: what collectors hold once they are prepared is what the plan says") {
    check_collectors({kSmallCumulus, "collectors"});
    check_collectors({kTwoMedia, "collectors"});
}

TEST_CASE("arrays: what a photon grid holds once it is prepared is what the plan says") {
    check_photon_grid({kSmallCumulus, "photon-grid"});
    check_photon_grid({kTwoMedia, "photon-grid", {"photon_grid.closure = \"published\""}});
}

/// Bytes of the rows of this name.
std::uint64_t planned(const MemoryTable& table, const char* item) {
    std::uint64_t bytes = 0;
    for (const MemoryRow& row : table.rows())
        if (row.item == std::string(item)) bytes += row.bytes;
    return bytes;
}

template <class Of>
void check_lamps(const MethodRow& row, const Fixture& f) {
    Opened<Of> opened(row, f);
    Method& method = *opened.made.method;
    const FrameView view = opened.run.view(0);
    Planes* planes = nullptr;
    std::uint64_t done = 0;
    REQUIRE(method.set_view(f.context, view, {}));
    REQUIRE(method.accumulate(f.context, view, method.progress().whole, done));
    REQUIRE(method.render(f.context, view, {}, planes));
    const Buffer<float>& depths = opened.method.state().picture.lamps.optical_depth;
    CHECK(depths.bytes() > 0);
    CHECK(depths.bytes() == planned(opened.run.plan.memory, "optical depths to lights"));
}

TEST_CASE("arrays: what lights of marched photons hold is what the plan says") {
    const std::string lit = std::string(kSmallCumulus) +
                            "\n[[light]]\ntype = \"point\"\nposition_m = [0, 0, 2000]\n"
                            "[[light]]\ntype = \"directional\"\nelevation_deg = 20\n";
    check_lamps<CollectorsMethod>(collectors_row(), {lit.c_str(), "collectors"});
    check_lamps<PhotonGridMethod>(photon_grid_row(), {lit.c_str(), "photon-grid"});
}

TEST_CASE("arrays: what path holds while it traces is what the plan says") {
    check_path({kSmallCumulus, "path", {"output.layers = [\"radiance\", \"light\", \"depth\"]"}});
    check_path({kTwoMedia, "path"});
}

TEST_CASE("arrays: what raymarch holds while it marches is what the plan says") {
    const char* const layers = "output.layers = [\"radiance\", \"alpha\", \"depth\"]";
    const std::vector<std::string> fine{layers, "raymarch.light = \"buffer\"", "raymarch.steps = 4",
                                        "raymarch.jitter = \"blue-noise\"",
                                        "raymarch.detail = true"};
    check_march(raymarch_row(), {kSmallCumulus, "raymarch", fine});
    check_march(raymarch_row(), {kTwoMedia, "raymarch", {"raymarch.scale = 2"}});
    const std::vector<std::string> look{layers, "optical_depth.resolution = [9, 0, 5]",
                                        "optical_depth.max_extinction_per_m = 0.01",
                                        "medium.0.detail.tile_m = 9"};
    check_march(optical_depth_row(), {kSmallCumulus, "optical-depth", look});
}

TEST_CASE("arrays: what particles hold while they are shown is what the plan says") {
    const std::string text = std::string(kSmallCumulus);
    const std::size_t from = text.find("[[medium]]"), to = text.find("[photon_grid]");
    const std::string scene =
        text.substr(0, from) +
        "[[medium]]\ndensity = \"p.csv\"\nphase = { type = \"isotropic\" }\n" + text.substr(to) +
        "\n[particles]\nscattering = \"single\"\n";
    const char* const layers = "output.layers = [\"radiance\", \"alpha\", \"depth\"]";
    check_particles({scene.c_str(), "particles", {layers, "particles.bins = 50"}});
    check_particles({scene.c_str(), "particles", {layers, "particles.light = \"linear\""}});
    const std::string lit =
        scene +
        "\n[[light]]\ntype = \"point\"\nposition_m = [0, 0, 2000]\nintensity = 1\n"
        "[[light]]\ntype = \"directional\"\nelevation_deg = 20\nirradiance = 1\n";
    const std::string boards = "particles.display = \"billboards\"";
    check_particles({scene.c_str(), "particles", {layers, boards}});
    check_particles({lit.c_str(), "particles", {layers, boards}});
    check_particles({lit.c_str(), "particles", {"output.layers = [\"alpha\", \"occlusion\"]"}});
    check_particles({lit.c_str(), "particles", {layers, "particles.light = \"linear\""}});
}

TEST_CASE("arrays: one declaration gives the plan's row and the buffer, and no product wraps") {
    const Array<double> array{"sums", 12, Stage::kTree, Stage::kPhotons};
    const Array<float> beside{"beside", 3, Stage::kDensity, Stage::kWrite};
    MemoryTable table;
    add(table, array, beside);
    add(table, several(4, array));
    add(table, renamed(array, "others", Stage::kSplat, Stage::kLayers));
    add(table, Array<float>{"nothing", 0, Stage::kTree, Stage::kTree});
    REQUIRE(table.rows().size() == 3);
    CHECK(table.rows()[0].item == "sums");
    CHECK(table.rows()[0].first == Stage::kTree);
    CHECK(table.rows()[0].last == Stage::kPhotons);
    CHECK(table.rows()[0].bytes == 12 * 8 + 3 * 4);
    CHECK(table.rows()[1].bytes == 4 * 12 * 8);
    CHECK(table.rows()[2].item == "others");
    CHECK(table.rows()[2].first == Stage::kSplat);

    Buffer<double> buffer;
    REQUIRE(allocate(array, buffer));
    CHECK(buffer.bytes() == array.bytes());
    buffer[0] = 5;
    REQUIRE(allocate_once(array, buffer));
    CHECK(buffer[0] == 5);
    REQUIRE(allocate(array, buffer));
    CHECK(buffer[0] == 0);

    constexpr std::uint64_t kMax = ~std::uint64_t{0};
    const Array<double> huge{"huge", kMax / 4};
    CHECK(huge.bytes() == kMax);
    CHECK(several(8, huge).count == kMax);
    MemoryTable most;
    add(most, huge, beside);
    CHECK(most.rows()[0].bytes == kMax);
    const Status refused = allocate(huge, buffer);
    CHECK(refused.code == Code::kLimit);
    CHECK(refused.message.rfind("huge: ", 0) == 0);
}
