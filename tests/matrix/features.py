# SPDX-License-Identifier: Apache-2.0
"""The features that scenes of the differential test have: which row of the table each tries, and how.

A feature: (name, row of `pileus methods`, group, put). Of a group a scene has one. put(scene, random,
folder) changes the scene and writes files into the folder. docs/accuracy.md
"""
import math

from scenes import write_pfm


def sun_disc(s, r, d):
    s["sun"]["angular_radius_deg"] = r.choice([0.27, 2.0])


def no_sun(s, r, d):
    s.pop("sun", None)


def low_sun(s, r, d):
    s["sun"]["elevation_deg"] = r.choice([0.0, 2.0, 90.0])


def bright_sky(s, r, d):
    s["sky"]["radiance"] = [0.3, 0.5, 1.0]


def even_map(s, r, d):
    write_pfm(f"{d}/even.pfm", 2, 1, lambda x, y: (0.2, 0.3, 0.5))
    s["sky"] = {"map": "even.pfm"}


def patch_map(s, r, d):
    at = r.randrange(16)
    write_pfm(f"{d}/patch.pfm", 16, 8, lambda x, y: (6.0, 5.0, 4.0) if x == at and y == 2 else (0.1, 0.15, 0.25))
    s["sky"] = {"map": "patch.pfm"}


def air(s, r, d):
    s.pop("sky", None)
    s["sun"].pop("irradiance", None)
    s["atmosphere"] = {"turbidity": r.choice([2.0, 4.0])}


def directional(s, r, d):
    s.setdefault("light", []).append({"type": "directional", "azimuth_deg": r.uniform(0, 360),
                                      "elevation_deg": r.choice([20.0, 60.0, 90.0]), "irradiance": 0.4})


def lamp_place(r):
    return [r.choice([-1300.0, 1300.0]), r.choice([-1300.0, 0.0, 1300.0]), r.uniform(200, 1700)]


def point(s, r, d):
    s.setdefault("light", []).append({"type": "point", "position_m": lamp_place(r), "intensity": 4e5})


def spot(s, r, d):
    s.setdefault("light", []).append({"type": "spot", "position_m": lamp_place(r), "target_m": [0.0, 0.0, 900.0],
                                      "cone_deg": 35.0, "intensity": 8e5})


def beside_camera(s, r, d):
    at = [s["camera"]["position_m"][0] + 20, s["camera"]["position_m"][1], s["camera"]["position_m"][2]]
    s.setdefault("light", []).append({"type": "spot", "position_m": at, "target_m": [0.0, 0.0, 900.0],
                                      "cone_deg": 10.0, "intensity": 1e7})


def sphere(s, r, d):
    s.setdefault("light", []).append({"type": "point", "position_m": lamp_place(r), "intensity": 4e5, "radius_m": 60.0,
                                      "shadow_samples": 3})


def emission(s, r, d):
    s["medium"][0]["emission"] = [2e-4, 1e-4, 5e-5]


def solid(s, r, d):
    with open(f"{d}/wall.obj", "w") as file:
        file.write("v -300 0 0\nv 300 0 0\nv 300 0 400\nv -300 0 400\nv -300 300 0\nv 300 300 0\n"
                   "f 1 2 3\nf 1 3 4\nf 4 3 6\nf 4 6 5\n")
    s.setdefault("solid", []).append({"file": "wall.obj", "position_m": [r.uniform(-300, 300), -1200.0, 0.0],
                                      "albedo": 0.4})


def solid_within(s, r, d):
    """A closed box that reaches into the medium from its foot."""
    with open(f"{d}/tower.obj", "w") as file:
        for z in (0, 450):
            file.write(f"v -250 -250 {z}\nv 250 -250 {z}\nv 250 250 {z}\nv -250 250 {z}\n")
        file.write("f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
    s.setdefault("solid", []).append({"file": "tower.obj", "position_m": [r.uniform(-200, 200), r.uniform(-200, 200), 500.0],
                                      "albedo": r.choice([0.0, 0.5, 0.9])})


def depth_image(s, r, d):
    w, h = s["camera"]["resolution"]
    edge = r.randrange(w)
    write_pfm(f"{d}/depth.pfm", w, h, lambda x, y: (3000.0,) if x < edge else (1e9,))
    s["camera"]["depth"] = "depth.pfm"


def white_ground(s, r, d):
    s["ground"]["albedo"] = 1.0


def no_ground(s, r, d):
    s.pop("ground", None)


def ground_map(s, r, d):
    """Squares of two colours, over part of what is seen or all of it."""
    write_pfm(f"{d}/squares.pfm", 8, 8, lambda x, y: (0.5, 0.3, 0.1) if (x + y) % 2 else (0.05, 0.2, 0.3))
    s["ground"].update(map="squares.pfm", map_low_m=[-1600.0, -1600.0], map_size_m=[3200.0, 3200.0],
                       map_repeats=r.choice([True, False]))


def sea(s, r, d):
    s["ground"].pop("albedo")
    s["ground"].update(surface="sea", sea_wind_m_s=r.choice([0.0, 5.0, 15.0]))


def orthographic(s, r, d):
    s["camera"].pop("fov_deg", None)
    s["camera"].update(projection="orthographic", height_m=2200.0)


def lens(s, r, d):
    s["camera"].update(aperture_radius_m=10.0, focus_distance_m=3000.0)


def inside(s, r, d):
    s["camera"].update(position_m=[10.0, -200.0, 900.0], target_m=[0.0, 800.0, 950.0])


def straight_down(s, r, d):
    s["camera"].update(position_m=[0.0, 0.0, 4000.0], target_m=[0.0, 0.0, 0.0], up=[0.0, 1.0, 0.0])


def two_media(s, r, d):
    s["medium"].append({"density": "uniform:ellipsoid", "bounds_m": [[-900.0, -700.0, 450.0], [600.0, 900.0, 1200.0]],
                        "resolution": [11, 10, 9], "extinction_per_m": 0.002, "albedo": 0.95,
                        "phase": {"type": "rayleigh"}})


def coloured(s, r, d):
    s["medium"][0]["albedo"] = [0.6, 0.9, 1.0]


def periodic(s, r, d):
    orthographic(s, r, d)
    for medium in s["medium"]:
        medium["boundary"] = "periodic"
        medium["bounds_m"] = [[-800.0, -800.0, medium["bounds_m"][0][2]], [800.0, 800.0, medium["bounds_m"][1][2]]]


def constant(s, r, d):
    for medium in s["medium"]:
        medium["interpolation"] = "constant"


def one_cell(s, r, d):
    s["medium"][0].update(density="uniform:box", resolution=[1, 1, 1])


def left_out(s, r, d):
    s["medium"][0].update(density="uniform:box")
    s["medium"][0].pop("resolution")


def thick(s, r, d):
    s["medium"][0]["extinction_per_m"] = 100 / 900


def thin(s, r, d):
    s["medium"][0]["extinction_per_m"] = 0.02 / 900


def transfer(s, r, d):
    extinction = s["medium"][0].pop("extinction_per_m")
    s["medium"][0].pop("albedo")
    s["medium"][0].update(density="procedural:cumulus")
    s["medium"][0]["transfer"] = [{"value": 0.1, "extinction_per_m": 0.0},
                                  {"value": 0.5, "extinction_per_m": extinction, "albedo": [0.4, 0.7, 1.0]},
                                  {"value": 1.0, "extinction_per_m": 2 * extinction, "albedo": [1.0, 0.6, 0.3]}]


def detail(s, r, d):
    s["medium"][0]["detail"] = {"tile_m": 300.0, "octaves": 2, "cells": 16, "refine": 2}


def sky_grid(s, r, d):
    s["medium"][0].update(density="procedural:sky", sky={"type": "cumulus", "size": 32, "evaluate": "grid"},
                          bounds_m=[[-1500.0, -1500.0, 600.0], [1500.0, 1500.0, 1500.0]])


def balls(s, r, d):
    with open(f"{d}/balls.csv", "w") as file:
        file.write("x,y,z,radius\n")
        for i in range(60):
            file.write(f"{r.gauss(0, 300)},{r.gauss(0, 300)},{r.gauss(950, 120)},{r.uniform(120, 220)}\n")
    s["medium"][0].update(density="balls.csv")
    s["medium"][0].pop("bounds_m")


def moved(s, r, d):
    s["animation"] = {"frames": 1, "keys": [{"frame": 0, "media_offset_m": [120.0, 60.0, 80.0], "media_yaw_deg": 30.0}]}


def phase(**words):
    def put(s, r, d):
        s["medium"][0]["phase"] = words
    return put


def table(s, r, d):
    with open(f"{d}/phase.txt", "w") as file:
        for i in range(0, 181, 3):
            file.write(f"{i} {0.2 + math.exp(-i / 20.0)}\n")
    s["medium"][0]["phase"] = {"type": "table", "file": "phase.txt"}


HG = "isotropic, rayleigh, henyey-greenstein, two-lobe, cornette-shanks to g 0.9"
PEAKED = "hg-draine, cloud, table, moments, g above 0.9"
AIR = "[atmosphere]: sky, sunlight, haze before things"
FEATURES = [
    ("sun", "sun, a point", "sun", lambda s, r, d: None),
    ("sun-disc", "sun.angular_radius_deg", "sun", sun_disc),
    ("sun-none", "sun, a point", "sun", no_sun),
    ("sun-corner", "sun, a point", "sun", low_sun),
    ("sky-bright", "constant sky on media", "sky", bright_sky),
    ("map-even", "sky.map on media", "sky", even_map),
    ("map-patch", "sky.map on media", "sky", patch_map),
    ("air", AIR, "sky", air),
    ("directional", "[[light]] directional", "", directional),
    ("point", "[[light]] point", "", point),
    ("spot", "[[light]] spot", "", spot),
    ("spot-beside-camera", "[[light]] spot", "", beside_camera),
    ("sphere", "[[light]] with radius_m, shadow_samples", "", sphere),
    ("emission", "medium.emission", "", emission),
    ("solid", "[[solid]]", "", solid),
    ("solid-within", "[[solid]]", "", solid_within),
    ("depth", "camera.depth, set_depth", "", depth_image),
    ("ground-white", "[ground]", "ground", white_ground),
    ("ground-none", "[ground]", "ground", no_ground),
    ("ground-map", "ground.map, ground.colour", "ground", ground_map),
    ("sea", "ground.surface sea", "ground", sea),
    ("orthographic", "camera.projection orthographic", "camera", orthographic),
    ("lens", "camera.aperture_radius_m, camera.shutter_s", "camera", lens),
    ("inside", "camera within media", "camera", inside),
    ("down", "sun, a point", "camera", straight_down),
    ("two-media", "several [[medium]]", "", two_media),
    ("coloured", "coloured albedo", "", coloured),
    ("constant", 'interpolation = "constant"', "cells", constant),
    ("periodic", 'boundary = "periodic"', "", periodic),
    ("one-cell", "sun, a point", "density", one_cell),
    ("no-resolution", "sun, a point", "density", left_out),
    ("thick", "sun, a point", "depth", thick),
    ("thin", "sun, a point", "depth", thin),
    ("transfer", "medium.transfer", "density", transfer),
    ("detail", "medium.detail, refine >= 1", "density", detail),
    ("sky-grid", 'procedural sky, evaluate = "grid"', "density", sky_grid),
    ("balls", "a medium of particles", "density", balls),
    ("moved", "media moved by keys or set_placement", "", moved),
    ("rayleigh", HG, "phase", phase(type="rayleigh")),
    ("hg-0.85", HG, "phase", phase(type="henyey-greenstein", g=0.85)),
    ("hg-back", HG, "phase", phase(type="henyey-greenstein", g=-0.5)),
    ("two-lobe", HG, "phase", phase(type="two-lobe", g1=0.8, g2=-0.3, weight=0.8)),
    ("cornette-shanks", HG, "phase", phase(type="cornette-shanks", g=0.6)),
    ("hg-0.97", PEAKED, "phase", phase(type="henyey-greenstein", g=0.97)),
    ("hg-draine", PEAKED, "phase", phase(type="hg-draine", droplet_diameter_um=15.0)),
    ("cloud", PEAKED, "phase", phase(type="cloud", effective_radius_um=10.0)),
    ("table", PEAKED, "phase", table),
]

# Rows that are of sessions, budgets or layers, or of files that a small scene cannot make: the tests that try them.
ELSEWHERE = {
    "set_sky, or set_sun without one, under [atmosphere]": "embed.refusals",
    "the ground under sky.map": "map-even, map-patch",
    "the air's sky on media": "air",
    "the ground under [atmosphere]": "air",
    "light from the ground into media": "ground-white",
    "light that media scatter onto the ground": "ground-white",
    "shadow of media on the ground": "ground-white",
    "camera.projection flux": "theory",
    "off-centre projection of a host": "embed",
    "camera that moves while light stays": "embed",
    "medium.detail, refine = 0": "law",
    'procedural sky, evaluate = "direct"': "sky",
    "colours, emission, velocities of particles": "law",
    "weather data": "weather",
    "sequences of files, wind": "guard, films",
}
