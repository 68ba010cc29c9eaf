# SPDX-License-Identifier: Apache-2.0
"""Small random scenes: a base, features to put into it, and their text.

in: names of features, a random generator -> out: a scene as a dictionary, files beside it, TOML.
docs/accuracy.md, "How it is measured"
"""
import math
import struct


def write_toml(scene):
    """The scene as text: tables one level deep, everything below as inline values."""
    lines = []
    for key, value in scene.items():
        if not isinstance(value, (dict, list)) or (isinstance(value, list) and not is_tables(value)):
            lines.append(f"{key} = {inline(value)}")
    for key, value in scene.items():
        for table in [value] if isinstance(value, dict) else value if is_tables(value) else []:
            lines.append(f"[{key}]" if isinstance(value, dict) else f"[[{key}]]")
            lines += [f"{name} = {inline(item)}" for name, item in table.items()]
    return "\n".join(lines) + "\n"


def is_tables(value):
    return isinstance(value, list) and value and isinstance(value[0], dict)


def inline(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(inline(item) for item in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{name} = {inline(item)}" for name, item in value.items()) + "}"
    return str(value)


def write_pfm(path, width, height, colour):
    """colour(x, y) from the top row, as a map of the sky or a depth image has it."""
    rows = []
    for y in range(height - 1, -1, -1):
        for x in range(width):
            rows += colour(x, y)
    kind = b"PF" if len(rows) == 3 * width * height else b"Pf"
    with open(path, "wb") as file:
        file.write(kind + f"\n{width} {height}\n-1.0\n".encode())
        file.write(struct.pack(f"<{len(rows)}f", *rows))


def read_pfm(path):
    """Width, height and one tuple for each pixel, bottom row first."""
    data = open(path, "rb").read()
    kind, size, scale, rest = data.split(b"\n", 3)
    width, height = map(int, size.split())
    channels = 3 if kind == b"PF" else 1
    order = "<" if float(scale) < 0 else ">"
    values = struct.unpack(f"{order}{width * height * channels}f", rest[: 4 * width * height * channels])
    return width, height, [values[i:i + channels] for i in range(0, len(values), channels)]


def base(random):
    """One medium, a sun and a constant sky over a ground; each number by chance."""
    depth = 10 ** random.uniform(-1, 1.7)  # of the medium's height, where it is densest
    cells = random.choice([6, 10, 16, 24])
    return {
        "seed": random.randrange(1, 1 << 30),
        "camera": {
            "position_m": [random.uniform(-800, 800), -3200.0, random.uniform(150, 1500)],
            "target_m": [0.0, 0.0, 900.0],
            "fov_deg": random.uniform(26, 44),
            "resolution": random.choice([[16, 16], [24, 16], [20, 24]]),
        },
        "sun": {"azimuth_deg": random.uniform(0, 360), "elevation_deg": random.uniform(8, 85), "irradiance": [1.0, 0.95, 0.9]},
        "sky": {"radiance": [0.05, 0.07, 0.11]},
        "ground": {"altitude_m": 0.0, "albedo": random.choice([0.0, 0.2, 0.5])},
        "medium": [{
            "density": random.choice(["procedural:cumulus", "uniform:ellipsoid", "uniform:box"]),
            "bounds_m": [[-800.0, -800.0, 500.0], [800.0, 800.0, 1400.0]],
            "resolution": [cells, cells, max(4, cells * 3 // 4)],
            "extinction_per_m": depth / 900,
            "albedo": random.choice([1.0, 0.99, 0.9]),
            "phase": {"type": "henyey-greenstein", "g": random.choice([0.0, 0.4, 0.6])},
        }],
    }
