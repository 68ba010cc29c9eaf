# SPDX-License-Identifier: Apache-2.0
# The files of the flight library: sessions over packed scenes and all that their pictures are made by. What of
# files, texts, clocks, reports and films these call stands in src/flight/bare, by the same names; headers there
# take the place of those of their path. The linker drops what no function reaches.
# in: nothing -> out: flight_sources. docs/flight.md, "Build"
set(flight_sources)
macro(flight_files folder)
    foreach(name ${ARGN})
        list(APPEND flight_sources "${PROJECT_SOURCE_DIR}/${folder}/${name}.cpp")
    endforeach()
endmacro()
flight_files(platform fp_mode memory threads)
flight_files(platform/team pieces team_serial)
flight_files(src/api c_default c_flight c_frame c_host c_session c_work)
flight_files(src/base buffer digest limits printable)
flight_files(src/flight/bare balance checks close films machine memory no_files own_bytes registry reports)
flight_files(src/flight block flight pack)
flight_files(src/io/images color_channels)
flight_files(src/methods governor most_units scenery support)
flight_files(src/methods/collectors/billboards billboard_spheres composite_billboards)
flight_files(src/methods/collectors
    collectors_bias collectors_choice collectors_display collectors_method collectors_plan collectors_show)
flight_files(src/methods/collectors/photons guided_grid reconstruct source_grid)
flight_files(src/methods/collectors/prepare
    field_stats gradient leaf_list leaves place_collectors prepare samples shares tree variance)
flight_files(src/methods/march
    march march_choice march_frame march_light march_media march_method march_ordinates march_units)
flight_files(src/methods/particles board_view lamp_balls particles_light particles_method particles_ordinates sun_tiles view_tiles)
flight_files(src/methods/path
    path_air path_blocks path_filter path_guide path_light path_method path_show path_sky trace_paths)
flight_files(src/methods/photon_grid
    cell_shares grid_light photon_grid_choice photon_grid_method photon_grid_plan photon_grid_show)
flight_files(src/methods/support runners)
flight_files(src/photons
    light_input lit_march photon_lights photon_method photon_counts photon_slot photon_state ring_sum
    scatter trace)
flight_files(src/picture
    air_view background blue_noise finish_frame late_rows layers march_view pixels sun_disc upsample)
flight_files(src/picture/errors pixel_errors)
flight_files(src/picture/filter features filter_error guides regression)
flight_files(src/picture/night night_view)
flight_files(src/picture/nodes
    ground_shadow lamp_light node_grid node_rows sky_light sky_nodes sky_view sun_depth sun_slices sweep_taps)
flight_files(src/picture/ordinates ordinate_directions ordinate_ground ordinate_half ordinate_medium ordinate_optics ordinate_own ordinate_ring
    ordinate_solve ordinate_turn ordinates sky_level sky_ordinates sky_turn)
flight_files(src/plan accumulation memory_table plan scene_limits work)
flight_files(src/run find_kernels)
flight_files(src/scene calendar frame_state method_column)
flight_files(src/scene/media medium_settings sky_types transfer)
flight_files(src/session run_context session session_set session_work version warnings)
flight_files(src/world/atmosphere air air_column air_orders air_sky air_tables atmosphere earth_turn moon_position night_light star_catalogue stars sun_position)
flight_files(src/world/camera matrices view)
flight_files(src/world/density noise_texture sky_field)
flight_files(src/world environment place_scene plan_parts world_digest)
flight_files(src/world/grid field mix_weights)
flight_files(src/world/light beam behind lamps lights sky_map sky_map_tables)
flight_files(src/world/majorant cell_majorants density_levels empty_blocks majorant majorants)
flight_files(src/world/medium detail medium mix_media resample sky_medium transfer_media)
flight_files(src/world/particles particle_tree)
flight_files(src/world/phase
    forward_share medium_phase mie_data phase_cloud phase_cornette_shanks phase_hg phase_hg_draine
    phase_moments phase_of_file phase_rayleigh phase_rows phase_table phase_two_lobe)
flight_files(src/world/solids camera_depth)
