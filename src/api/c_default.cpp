// SPDX-License-Identifier: Apache-2.0
// pileus.h: what pileus_*_default() make.
// in: the number of a struct, its size in the caller's header -> out: marked, with its defaults.
// docs/embedding.md, "Structs"
#include "src/api/c_types.h"

namespace {

/// Fills as much of a marked struct as the caller knows.
template <class T, class Fill>
void fill(void* given, std::uint32_t size, Fill set) {
    T own{};
    std::memcpy(&own, given, sizeof own.struct_size);
    set(own);
    std::memcpy(given, static_cast<const void*>(&own), size < sizeof own ? size : sizeof own);
}

void fill_particles(pileus_particles& p) {
    p.position_stride = p.velocity_stride = p.colour_stride = p.emission_stride = 3 * sizeof(float);
    p.radius_stride = p.density_stride = sizeof(float);
    p.id_stride = sizeof(std::uint64_t);
}

void fill_lamp(pileus_lamp& lamp) {
    lamp.direction[2] = -1;
    lamp.cone_deg = 40;
    lamp.elevation_deg = 45;
    for (float& c : lamp.light) c = 1;
}

void fill_detail(pileus_cloud_detail& d) {
    d.error_px = 0.5, d.near_px = 256, d.near_scale = 2, d.blend_frames = 8;
    d.sharpness = 1, d.frame_pixels = 60000, d.sun_deg = 0.5;
}

}  // namespace

extern "C" void pileus_default(uint32_t kind, void* pileus_struct, uint32_t size) {
    pileus_init(pileus_struct, size);
    if (!pileus::api::is_room(pileus_struct, size)) return;
    switch (kind) {
        case 1:
            return fill<pileus_particles>(pileus_struct, size, fill_particles);
        case 2:
            return fill<pileus_camera>(pileus_struct, size,
                                       [](pileus_camera& c) { c.up[2] = 1, c.fov_deg = 40; });
        case 3:
            return fill<pileus_sun>(pileus_struct, size, [](pileus_sun& sun) {
                sun.present = 1, sun.elevation_deg = 45;
                for (float& c : sun.irradiance) c = 1;
            });
        case 4:
            return fill<pileus_environment>(
                pileus_struct, size, [](pileus_environment& e) { e.present = 1, e.map_scale = 1; });
        case 5:
            return fill<pileus_ground>(pileus_struct, size,
                                       [](pileus_ground& g) { g.present = 1, g.albedo = 0.2; });
        case 6:
            return fill<pileus_lamp>(pileus_struct, size, fill_lamp);
        case 7:
            return fill<pileus_governor>(pileus_struct, size,
                                         [](pileus_governor& g) { g.target_s = 1.0 / 30; });
        case 8:
            return fill<pileus_cloud>(pileus_struct, size, [](pileus_cloud& c) { c.scale = 1; });
        case 9:
            return fill<pileus_cloud_detail>(pileus_struct, size, fill_detail);
        case 10:
            return fill<pileus_picture>(pileus_struct, size,
                                        [](pileus_picture& p) { p.channels = 3; });
        default:
            return;
    }
}
