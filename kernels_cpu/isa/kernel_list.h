// SPDX-License-Identifier: Apache-2.0
// Every kernel, once. The table, the objects of each instruction set, what a library is built
// without and the launches of a device are made from these rows.
// in: PILEUS_RANGE and PILEUS_CALL, which stand undefined at the end -> out: one of them per
// kernel. docs/architecture.md, "Kernels: written once"; docs/contributing.md, "Add a kernel"
//
// PILEUS_RANGE(name, Params, Buffers, group, where):
//     void name(const Params&, const Buffers&, begin, end), both std::uint32_t
// PILEUS_CALL(name, Result, (parameters), (their names), group, where): any other shape
// name: of one template<int W> in the group's headers
// group: isa_GROUP.cpp, an object per instruction set, which includes those headers by hand. What
//     large or rare kernels cost, others do not pay. A flight is built without the groups that none
//     of its methods calls (cmake/PileusFlight.cmake); `Always` is in every library.
// where: Device (whole launches go there, too) or Host
//
// No include guard: who includes it wants all the rows.

// clang-format off

// Photons. Which of the three traces: trace_kernel of src/photons/trace.h
PILEUS_RANGE(trace,                TraceParams,         TraceBuffers,          Photons,      Device)
PILEUS_RANGE(trace_solids,         TraceParams,         TraceBuffers,          PhotonSolids, Device)
PILEUS_RANGE(trace_cells,          TraceParams,         TraceBuffers,          Cells,        Device)
// Packs sets of sums, and brings the total up to date; adds packed sets to the total.
PILEUS_CALL(pack_sets, void,
            (const PackParams& k, const PackBuffers& b, std::uint64_t begin, std::uint64_t end),
            (k, b, begin, end), Photons, Host)
PILEUS_CALL(add_sets, void,
            (const PackParams& k, const PackBuffers& b, std::uint64_t begin, std::uint64_t end),
            (k, b, begin, end), Photons, Host)

// Pictures
PILEUS_RANGE(shadow_rows,          ShadowParams,        ShadowBuffers,         Always,       Device)
PILEUS_RANGE(march_rows,           MarchParams,         MarchBuffers,          March,        Device)
PILEUS_RANGE(background_rows,      BackgroundParams,    BackgroundBuffers,     Always,       Device)
// As background_rows where there are solid meshes; with BackgroundBuffers::shadow their shadow.
PILEUS_RANGE(solid_rows,           SolidRowsParams,     BackgroundBuffers,     Solids,       Device)
PILEUS_RANGE(blend_tile,           BlendParams,         BlendBuffers,          Billboards,   Device)
// Rows of which a lattice of pixels was marched; the same with what is behind them, as 8 bits.
PILEUS_RANGE(upsample_rows,        UpsampleParams,      UpsampleBuffers,       Upsampling,   Device)
PILEUS_RANGE(finish_rows,          FinishParams,        FinishBuffers,         Upsampling,   Host)
PILEUS_RANGE(pixel_rows,           PixelParams,         PixelBuffers,          Always,       Host)
PILEUS_RANGE(air_rows,             AirRowsParams,       AirRowsBuffers,        Air,          Device)

// Paths: samples [begin, end) of the launch, each stored by itself. Of scenes with lamps, media that
// emit, solids or an image of them, the sun's disc or paths guided to it: the full one.
PILEUS_RANGE(trace_paths,          PathParams,          PathBuffers,           Path,         Device)
PILEUS_RANGE(trace_paths_full,     PathParams,          PathBuffers,           PathFull,     Device)
// With PathParams::importance, of one medium under sun and sky.
PILEUS_RANGE(trace_paths_importance, PathParams,        PathBuffers,           PathImportance, Host)

// Marches
PILEUS_RANGE(raymarch_rows,        RaymarchParams,      RaymarchBuffers,       Raymarch,     Device)
// Discrete ordinates: nodes; directions, which are swept; nodes; rows of pixels.
PILEUS_RANGE(ordinate_sources,     OrdinatesParams,     OrdinatesBuffers,      Raymarch,     Host)
PILEUS_RANGE(ordinate_directions,  OrdinatesParams,     OrdinatesBuffers,      Raymarch,     Host)
PILEUS_RANGE(ordinate_moments,     OrdinatesParams,     OrdinatesBuffers,      Raymarch,     Host)
PILEUS_RANGE(ordinates_rows,       OrdinatesMarchParams, OrdinatesMarchBuffers, Raymarch,   Host)
// Nodes of skylight as a camera sees it.
PILEUS_RANGE(turn_sky,             SkyTurnParams,       SkyTurnBuffers,        Sweep,        Device)
// Blocks of one diagonal of the sun's optical depth; those nearer the sun must be done.
PILEUS_RANGE(sweep_blocks,         SweepParams,         SweepBuffers,          Sweep,        Device)
// Rows of one slice of a periodic medium; the slice above it must be done.
PILEUS_RANGE(sweep_layer_rows,     SweepLayerParams,    SweepBuffers,          Sweep,        Device)
// Rows of nodes along x: nodes.size[1] * nodes.size[2] of them for every lamp; rows of pixels.
PILEUS_RANGE(lamp_depth_rows,      LampMarchParams,     LampMarchBuffers,      Lamps,        Device)
PILEUS_RANGE(lamp_march_rows,      LampMarchParams,     LampMarchBuffers,      Lamps,        Device)
// Of one medium whose MediumView::detail is set, without constant cells.
PILEUS_RANGE(detail_shadow_rows,   ShadowParams,        ShadowBuffers,         Detail,       Device)
PILEUS_RANGE(detail_march_rows,    MarchParams,         MarchBuffers,          Detail,       Device)
PILEUS_RANGE(detail_raymarch_rows, RaymarchParams,      RaymarchBuffers,       Detail,       Device)
PILEUS_RANGE(detail_ordinates_rows, OrdinatesMarchParams, OrdinatesMarchBuffers, Detail,     Host)

// Rows of a raymarched picture of the sky itself; rows of nodes of sunlight in it.
PILEUS_RANGE(raymarch_sky_rows,    RaymarchSkyParams,   RaymarchBuffers,       Sky,          Device)
PILEUS_RANGE(sky_light_rows,       SkyLightParams,      SkyLightBuffers,       Sky,          Device)
// Discrete ordinates of it: rows of pixels, of samples within nodes, of nodes towards the camera.
PILEUS_RANGE(ordinates_sky_rows,   OrdinatesSkyParams,  OrdinatesMarchBuffers, Sky,          Host)
PILEUS_RANGE(sky_sample_rows,      SkySampleParams,     SkySampleBuffers,      Sky,          Host)
PILEUS_RANGE(sky_turn_rows,        SkyNodeTurnParams,   SkyNodeTurnBuffers,    Sky,          Host)

// Procedural media: rows of noise and of cells, columns in multiples of 16, rows of blocks.
PILEUS_RANGE(noise_rows,           NoiseParams,         NoiseBuffers,          Sky,          Device)
PILEUS_RANGE(bake_sky_rows,        BakeParams,          BakeBuffers,           Sky,          Device)
PILEUS_RANGE(sky_columns,          ColumnParams,        ColumnBuffers,         Sky,          Device)
PILEUS_RANGE(fill_cumulus,         CumulusParams,       CumulusBuffers,        Sky,          Device)
// Rows of blocks of a cloud by its type.
PILEUS_RANGE(fill_cloud,           CloudParams,         CloudBuffers,          Detail,       Host)
// Rows of columns along x of a layer: size[1] of them.
PILEUS_RANGE(fill_cloud_layer,     CloudLayerParams,    CloudLayerBuffers,     Detail,       Host)
// Rows along x of a lens: size[1] size[2] of them.
PILEUS_RANGE(fill_cloud_lens,      CloudLensParams,     CloudLensBuffers,      Detail,       Host)
// Rows along x of the rain below a cloud: size[1] layers of them.
PILEUS_RANGE(fill_cloud_rain,      CloudRainParams,     CloudRainBuffers,      Detail,       Host)

// Particles
PILEUS_RANGE(particle_depths,      ParticleDepthParams, ParticleDepthBuffers,  Particles,    Device)
PILEUS_RANGE(particle_tiles,       ParticleMarchParams, ParticleTileBuffers,   Particles,    Device)
PILEUS_RANGE(board_tiles,          ParticleBoardParams, ParticleBoardTileBuffers, Particles, Device)
PILEUS_RANGE(board_colours,        ParticleMarchParams, ParticleColourBuffers, Particles,    Device)
PILEUS_RANGE(particle_lamp_depths, ParticleLampDepths,  ParticleLampDepthBuffers, Particles, Device)
PILEUS_RANGE(particle_lamp_light,  ParticleMarchParams, ParticleLampLight,     Particles,    Device)

// Mathematics: FNV-1a 64 of every function on 64 fixed inputs, the same on every machine.
PILEUS_CALL(self_test, std::uint64_t, (), (), Always, Device)

// clang-format on

#undef PILEUS_RANGE
#undef PILEUS_CALL
