// SPDX-License-Identifier: Apache-2.0
// The fuzz targets, one row each: its name is that of its file, of its function and of its corpus.
// in: arbitrary bytes -> out: 0, or an abort that names the broken law.
// docs/testing.md, section Fuzzing
#pragma once
#include <cstddef>
#include <cstdint>

#define PILEUS_FUZZ_TARGETS(ROW) \
    ROW(blocks)                  \
    ROW(calls)                   \
    ROW(exr)                     \
    ROW(grib)                    \
    ROW(hash_list)               \
    ROW(heights)                 \
    ROW(les)                     \
    ROW(mesh)                    \
    ROW(metar)                   \
    ROW(netcdf)                  \
    ROW(nvdb)                    \
    ROW(overrides)               \
    ROW(packed)                  \
    ROW(part)                    \
    ROW(particles)               \
    ROW(pbrt)                    \
    ROW(pfm)                     \
    ROW(phase)                   \
    ROW(picture_scene)           \
    ROW(png)                     \
    ROW(raw)                     \
    ROW(render)                  \
    ROW(scene)                   \
    ROW(sensors)                 \
    ROW(sky_calls)               \
    ROW(study)                   \
    ROW(vdb)                     \
    ROW(vol)

namespace fuzz {
#define PILEUS_DECLARE(name) int name(const std::uint8_t* data, std::size_t size);
PILEUS_FUZZ_TARGETS(PILEUS_DECLARE)
#undef PILEUS_DECLARE
}  // namespace fuzz
