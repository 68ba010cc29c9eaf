# SPDX-License-Identifier: Apache-2.0
"""Small scenes for the tests of the Python module, and sessions of them. docs/python.md"""

import pileus

CUMULUS = """
seed = 4
[camera]
position_m = [16, -4000, 256]
target_m = [0, 0, 1024]
fov_deg = 40
resolution = [24, 14]
[sun]
azimuth_deg = 120
elevation_deg = 35
[sky]
radiance = [0.0625, 0.125, 0.25]
[ground]
altitude_m = 0
albedo = 0.25
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-768, -768, 512], [768, 768, 1536]]
resolution = [24, 24, 16]
extinction_per_m = 0.0625
albedo = [0.9, 0.99, 1.0]
phase = { type = "henyey-greenstein", g = 0.85 }
[collectors]
photons = 12_000
generations = 4
samples = 1_000
[path]
samples_per_pixel = 3
"""
BOX = """
[camera]
position_m = [0, -300, 0]
target_m = [0, 0, 0]
resolution = [9, 7]
[sun]
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -50, -50], [50, 50, 50]]
extinction_per_m = 0.02
[method]
name = "raymarch"
"""
RAYMARCH = {"method.name": "raymarch"}
POSITION, TARGET = (16, -4000, 256), (0, 0, 1024)


def open_session(method="raymarch", **more):
    scene = pileus.Scene(CUMULUS, {"method.name": method, **more})
    # One thread: these pictures are too small for more, and the machine may be busy.
    return pileus.Session(pileus.World(scene, threads=1), threads=1)
