# SPDX-License-Identifier: Apache-2.0
"""Changes of a scene that leave its picture as it is, or mirror it.

in: a column of the support table -> out: pairs of scenes whose pictures must agree.
A law: (name, columns it is not for, change). change(scene, folder) returns the second scene and how its
picture is read: "same" or "mirrored". docs/accuracy.md
"""
import copy
import math
import struct

PARTICLES = ("particles", "particles-billboards")


def start(g=0.6, depth=8.0):
    """Two overlapping ellipsoids that no mirror or turn leaves alone, sun from the side, sky and ground."""
    return {
        "seed": 5,
        "camera": {"position_m": [300.0, -3200.0, 700.0], "target_m": [0.0, 0.0, 900.0], "fov_deg": 34.0,
                   "resolution": [24, 20]},
        "sun": {"azimuth_deg": 250.0, "elevation_deg": 35.0, "irradiance": [1.0, 1.0, 1.0]},
        "sky": {"radiance": [0.05, 0.07, 0.11]},
        "ground": {"altitude_m": 0.0, "albedo": 0.3},
        "medium": [medium([-700.0, -500.0, 500.0], [500.0, 600.0, 1300.0], depth / 800, g),
                   medium([-100.0, -600.0, 700.0], [800.0, 200.0, 1400.0], depth / 700, g)],
    }


def medium(low, high, extinction, g):
    return {"density": "uniform:ellipsoid", "bounds_m": [low, high], "resolution": [16, 16, 16],
            "extinction_per_m": extinction, "phase": {"type": "henyey-greenstein", "g": g}}


def places(scene, move):
    """Applies move to every place of the scene."""
    for key in ("position_m", "target_m"):
        scene["camera"][key] = move(scene["camera"][key])
    for one in scene["medium"]:
        a, b = (move(corner) for corner in one["bounds_m"])
        one["bounds_m"] = [[min(p) for p in zip(a, b)], [max(p) for p in zip(a, b)]]
    for light in scene.get("light", []):
        if "position_m" in light:
            light["position_m"] = move(light["position_m"])
    return scene


def mirror(scene, folder):
    scene = places(scene, lambda p: [-p[0], p[1], p[2]])
    scene["sun"]["azimuth_deg"] = (360 - scene["sun"]["azimuth_deg"]) % 360
    return scene, "mirrored"


def turn(scene, folder):
    """By 90 degrees about z, from north towards east."""
    scene = places(scene, lambda p: [p[1], -p[0], p[2]])
    scene["sun"]["azimuth_deg"] = (scene["sun"]["azimuth_deg"] + 90) % 360
    return scene, "same"


def move(scene, folder):
    return places(scene, lambda p: [p[0] + 1e6, p[1] - 1e6, p[2]]), "same"


def scale(scene, folder):
    scene = places(scene, lambda p: [2 * v for v in p])
    for one in scene["medium"]:
        one["extinction_per_m"] /= 2
    return scene, "same"


def split(scene, folder):
    halves = []
    for one in scene["medium"]:
        for _ in range(2):
            half = copy.deepcopy(one)
            half["extinction_per_m"] /= 2
            halves.append(half)
    scene["medium"] = halves
    return scene, "same"


def sun_as_light(scene, folder):
    sun = scene.pop("sun")
    scene["light"] = [{"type": "directional", "azimuth_deg": sun["azimuth_deg"], "elevation_deg": sun["elevation_deg"],
                       "irradiance": sun["irradiance"]}]
    return scene, "same"


def box(scene):
    scene["medium"] = [medium([-600.0, -500.0, 500.0], [600.0, 500.0, 1300.0], 0.01, 0.6)]
    scene["medium"][0].update(density="uniform:box", resolution=[24, 20, 16])
    return scene


def box_as_file(scene, folder):
    with open(f"{folder}/ones.raw", "wb") as file:
        file.write(struct.pack("<7680f", *([1.0] * 7680)))
    one = scene["medium"][0]
    del one["resolution"]
    one["density"] = {"file": "ones.raw", "type": "float32", "size": [24, 20, 16]}
    return scene, "same"


def box_by_default(scene, folder):
    del scene["medium"][0]["resolution"]
    return scene, "same"


LAWS = [
    ("mirror", PARTICLES, None, mirror),
    ("turn by 90 degrees", PARTICLES, None, turn),
    ("move by 1e6 m", PARTICLES, None, move),
    ("lengths x 2, extinction / 2", PARTICLES, None, scale),
    ("two halves of each medium", PARTICLES + ("collectors-billboards",), None, split),
    # optical-depth is a look: its ambient light is the sun's.
    ("the sun as [[light]]", PARTICLES + ("collectors-billboards", "optical-depth"), None, sun_as_light),
    ("a box as a file", PARTICLES, box, box_as_file),
    ("a box by default cells", PARTICLES, box, box_by_default),
]


def difference(first, second, how):
    """(mean, rms over blocks of 4 x 4 pixels) of the difference, as shares of the first picture's mean."""
    width, height, a = first
    b = second[2]
    if how == "mirrored":
        b = [b[i - i % width + width - 1 - i % width] for i in range(len(b))]
    total = sum(sum(p) for p in a)
    mean = (sum(sum(p) for p in b) - total) / total
    squares, blocks = 0.0, 0
    for y in range(0, height, 4):
        for x in range(0, width, 4):
            cells = [v * width + u for v in range(y, min(height, y + 4)) for u in range(x, min(width, x + 4))]
            squares += ((sum(sum(b[i]) - sum(a[i]) for i in cells)) / len(cells)) ** 2
            blocks += 1
    return mean, math.sqrt(squares / blocks) / (total / len(a))
