// SPDX-License-Identifier: Apache-2.0
// The picture of a lit photon grid: light of the cells, march, parts, layers.
// in: PhotonGridRun after shooting, a camera -> out: Planes, Image.
// docs/photon-grid.md; docs/formats.md, "Pictures out".
#include "kernels_cpu/core/profile.h"
#include "src/base/digest.h"
#include "src/methods/photon_grid/photon_grid.h"
#include "src/photons/lit_march.h"
#include "src/picture/air_view.h"
#include "src/picture/finish_frame.h"

namespace pileus {

NodeGrid cell_nodes(const PhotonGridRun& run) {
    NodeGrid nodes{};
    for (int a = 0; a < 3; ++a) {
        nodes.size[a] = run.cells.size[a];
        nodes.per_metre[a] = float(run.cells.size[a] / run.world->medium.extent_m[a]);
    }
    return nodes;
}

namespace {

/// The picture's own digest, not those of its parts.
void tell_colours(const Context& context, const PhotonGridRun& run, const GridLightInput& in,
                  Span<const float> light) {
    if (!kPlans || !context.digests || in.lighting != &run.lighting) return;
    Digest digest;
    digest.floats(light);
    context.report->digests.emplace_back("colours", digest.hex());
}

/// What cells around the camera scatter in all directions, for the picture and each batch; nothing
/// where the camera is too far away.
Status light_near(const Context& context, PhotonGridRun& run, const GridLightInput& in,
                  MarchParams& k, NodeLight& light) {
    if (!shows_near(run)) return Status::ok();
    k.near = near_nodes(k.source, in.camera.origin);
    if (k.near.size[0] == 0) return Status::ok();
    const StageClock clock(context, "reconstruct");
    CellHarmonics sets;
    for (int part = 0; part <= in.batches; ++part)
        PILEUS_TRY(
            light_cell_harmonics(in, {part - 1, part, 1 + in.batches, stored_harmonics(in.deposit)},
                                 k.near, sets, run.near_light));
    set_harmonic_sets(in.deposit, sets.sets, sets.colour, k);
    light.near = run.near_light.data();
    return Status::ok();
}

/// Each cell's light towards the camera.
Status show_towards(const Context& context, PhotonGridRun& run, const GridLightInput& in,
                    Planes& planes) {
    Buffer<float> light;
    {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(light_cells(in, light));
    }
    tell_colours(context, run, in, light.span());
    MarchParams k = lit_march_params(run, in, cell_nodes(run));
    k.channels = 3 * (1 + in.batches);
    NodeLight lit{light.data()};
    PILEUS_TRY(light_near(context, run, in, k, lit));
    if (!kFilms || in.lighting == &run.lighting)
        return march_thinned(context, run.thin, lit, k, run, planes);
    return march_lit(context, run, lit, k, planes.colour.data(), planes);
}

/// Each cell's light in all directions: one march for the picture and one for each batch.
Status show_all_ways(const Context& context, PhotonGridRun& run, const GridLightInput& in,
                     Planes& planes) {
    MarchParams k = lit_march_params(run, in, cell_nodes(run));
    CellHarmonics sets;
    Buffer<float> light;
    const NearNodes all{{0, 0, 0}, {k.source.size[0], k.source.size[1], k.source.size[2]}, 0, 0};
    for (int batch = -1; batch < in.batches; ++batch) {
        {
            const StageClock clock(context, "reconstruct");
            PILEUS_TRY(light_cell_harmonics(in, {batch, 0, 1, stored_harmonics(in.deposit)}, all,
                                            sets, light));
        }
        if (batch < 0) tell_colours(context, run, in, light.span());
        set_harmonic_sets(in.deposit, sets.sets, sets.colour, k);
        float* target =
            planes.colour.data() + 3 * std::size_t(batch + 1) * planes.transmittance.size();
        PILEUS_TRY(!kFilms || (batch < 0 && in.lighting == &run.lighting)
                       ? march_thinned(context, run.thin, NodeLight{light.data()}, k, run, planes)
                       : march_lit(context, run, NodeLight{light.data()}, k, target, planes));
    }
    return Status::ok();
}

/// Without photons' light there is one dark node, so that the sun's first order is alone.
Status show_first_order(const Context& context, PhotonGridRun& run, const GridLightInput& in,
                        Planes& planes) {
    const float dark[3] = {};
    const MarchParams k = lit_march_params(run, in, NodeGrid{{1, 1, 1}, {0, 0, 0}});
    return march_lit(context, run, NodeLight{dark}, k, planes.colour.data(), planes);
}

Status display(const Context& context, PhotonGridRun& run, const GridLightInput& in,
               Planes& planes) {
    PILEUS_TRY(make_sun_shadow(context, run));
    if (kFilms && in.first_order_alone)
        PILEUS_TRY(show_first_order(context, run, in, planes));
    else
        PILEUS_TRY(shows_harmonics(run) ? show_all_ways(context, run, in, planes)
                                        : show_towards(context, run, in, planes));
    return add_lit_lamps(context, run, in, planes);
}

/// A picture of one part of the light, without batches.
Status show_part(const Context& context, PhotonGridRun& run, const GridLightInput& in,
                 Planes& part) {
    PILEUS_TRY(
        allocate_planes(in.camera.width, in.camera.height, 3, in.lighting->opaque(), false, part));
    PILEUS_TRY(fill_lit_background(context, run, in, 0, part));
    return display(context, run, in, part);
}

Status show_sun(const Context& context, PhotonGridRun& run, GridLightInput in, Planes& planes) {
    const Lighting light = sun_alone(*in.lighting);
    in.lighting = &light;
    in.batches = 0;
    Planes part;
    PILEUS_TRY(show_part(context, run, in, part));
    const std::size_t pixels = part.transmittance.size();
    for (std::size_t i = 0; i < 3 * pixels; ++i)
        part.colour[i] += part.transmittance[i % pixels] * part.background[i];
    planes.sun.swap(part.colour);
    return Status::ok();
}

/// Light that the media scattered once, straight from the sun and the lamps.
Status show_single(const Context& context, PhotonGridRun& run, GridLightInput in, Planes& planes) {
    if (!in.lighting->sunlit && in.lighting->lamps.empty())
        return allocate(arrays::picture_planes(3, planes.transmittance.size()), planes.single);
    Lighting light = sun_alone(*in.lighting);
    light.lamps = in.lighting->lamps;
    in.lighting = &light;
    in.batches = 0;
    in.first_order_alone = true;
    Planes part;
    PILEUS_TRY(show_part(context, run, in, part));
    planes.single.swap(part.colour);
    return Status::ok();
}

/// What layers of files show besides the picture.
Status add_layers(const Context& context, PhotonGridRun& run, const GridLightInput& in,
                  Planes& planes) {
    const OutputSettings& output = run.scene->output;
    PILEUS_TRY(add_ground_noise(context, run, in, planes));
    if (output.layer_optical_depth) PILEUS_TRY(show_optical_depth(context, run, in, planes));
    if (output.layer_light) PILEUS_TRY(show_sun(context, run, in, planes));
    return output.layer_order ? show_single(context, run, in, planes) : Status::ok();
}

}  // namespace

Status photon_grid_compose(const CameraParams& camera, const Context& context, PhotonGridRun& run,
                           Planes& planes) {
    {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(sum_ring(photon_grid_trace_input(context, run), run));
    }
    const GridLightInput in = photon_grid_light_input(camera, context, run);
    {
        const StageClock clock(context, "background");
        PILEUS_TRY(allocate_planes(camera.width, camera.height, 3 * (1 + in.batches),
                                   run.lighting.opaque(), run.scene->wants_depth(), planes));
    }
    PILEUS_TRY(fill_lit_background(context, run, in, 0, planes));
    PILEUS_TRY(display(context, run, in, planes));
    {
        // Noise may leave less than nothing in a pixel.
        const StageClock clock(context, "layers");
        const std::size_t pixels = planes.transmittance.size();
        for (std::size_t i = 0; i < 3 * pixels; ++i)
            if (planes.colour[i] < 0) planes.colour[i] = 0, ++planes.clamped;
    }
    if (kFilms) PILEUS_TRY(add_layers(context, run, in, planes));
    return show_air(context, *run.scene, run.world->medium, run.lighting, camera, run.environment,
                    planes);
}

Status photon_grid_show(double orbit_deg, const Context& context, PhotonGridRun& run,
                        Image& image) {
    const CameraParams camera = make_camera(run.scene->camera, orbit_deg, run.world->medium.low_m);
    Planes planes;
    PILEUS_TRY(photon_grid_compose(camera, context, run, planes));
    FinishedParts parts;
    parts.batches = true;
    return finish_frame(context, run.scene->output, *run.world, run.environment.depth, camera,
                        parts, planes, image, *context.report);
}

}  // namespace pileus
