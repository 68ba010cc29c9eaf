# SPDX-License-Identifier: Apache-2.0
"""Pictures of scenes by each method, and how far they are from the reference.

in: a scene, a column of the support table -> out: means of regions with their standard errors, or the
line of a refusal.
"""
import copy
import math
import os
import subprocess

from scenes import read_pfm, write_toml

# Work of a picture: enough for half a per cent of the mean of a small picture. Paths go through the middles of
# pixels, as the other methods look.
METHODS = {
    "collectors": {"collectors": {"photons": 300_000}},
    "collectors-billboards": {"collectors": {"photons": 300_000, "display": "billboards"}},
    "photon-grid": {"photon_grid": {"photons": 300_000}},
    "path": {"path": {"samples_per_pixel": 256, "pixel": "centre"}},
    "raymarch": {},
    "optical-depth": {},
    "particles": {"particles": {"light": "exact"}},
    "particles-billboards": {"particles": {"display": "billboards"}},
}
# Under suns of irradiance 1: the darkest code of eight bits where sunlit clouds are white.
FAINT = 3e-4
REGIONS = ("picture", "cloud", "rest")


class Refused(Exception):
    pass


def run(program, folder, scene, name, arguments=(), warnings=None):
    """The picture's radiance, and in `warnings` what the program says of it; Refused with the program's line, AssertionError where it breaks a promise."""
    path = os.path.join(folder, name + ".toml")
    with open(path, "w") as file:
        file.write(write_toml(scene))
    out = os.path.join(folder, name + ".pfm")
    if os.path.exists(out):
        os.remove(out)
    done = subprocess.run([program, "render", path, "-o", out, "--threads", "1", "-q", *arguments], capture_output=True,
                          text=True, timeout=600, cwd=folder)
    if done.returncode == 0:
        if warnings is not None:
            warnings += [line for line in done.stderr.splitlines() if "warning" in line]
        return read_pfm(out)
    assert done.returncode in (1, 2, 3), f"exit status {done.returncode}: {done.stderr[-300:]}"
    lines = done.stderr.strip().splitlines()
    # What is set beside a scene may clash with several of its keys, a line for each.
    assert len(lines) == 1 or "--set" in arguments, f"a refusal of {len(lines)} lines: {done.stderr[-300:]}"
    assert not os.path.exists(out), "a refusal that leaves a picture"
    raise Refused(lines[0])


def with_method(scene, column):
    scene = copy.deepcopy(scene)
    scene["method"] = {"name": column.replace("-billboards", "")}
    for key, value in METHODS[column].items():
        scene.setdefault(key, {}).update(value)
    return scene


class Reference:
    """Means by path under `seeds` seeds; the standard error comes from their spread by pixel."""

    def __init__(self, program, folder, scene, samples=96, seeds=4):
        scene = with_method(scene, "path")
        scene["path"]["samples_per_pixel"] = samples
        pictures = []
        for seed in range(seeds):
            pictures.append(run(program, folder, scene, f"path{seed}", ["--seed", str(1000 + seed)])[2])
        self.alpha = self.covered(program, folder, scene)
        count = len(pictures[0])
        self.mean = [tuple(sum(p[i][c] for p in pictures) / seeds for c in range(3)) for i in range(count)]
        self.variance = [tuple(sum((p[i][c] - self.mean[i][c]) ** 2 for p in pictures) / (seeds * (seeds - 1))
                               for c in range(3)) for i in range(count)]
        width, height = scene["camera"]["resolution"]
        kept = list(range(count))
        inside = lambda i, holds: all(holds(self.alpha[j]) for j in around(i, width, height))
        self.regions = {"picture": kept,
                        "cloud": [i for i in kept if inside(i, lambda a: a > 0.5)],
                        "rest": [i for i in kept if inside(i, lambda a: a < 0.02)]}

    @staticmethod
    def covered(program, folder, scene):
        """Opacity of the media through the middle of each pixel."""
        out = os.path.join(folder, "alpha.exr")
        path = os.path.join(folder, "path0.toml")
        done = subprocess.run([program, "render", path, "-o", out, "--threads", "1", "-q", "--budget", "samples=1"],
                              capture_output=True, text=True, cwd=folder, timeout=600)
        assert done.returncode == 0, done.stderr
        return alpha_of(out)


def around(i, width, height):
    x, y = i % width, i // width
    return [v * width + u for u in range(max(0, x - 1), min(width, x + 2)) for v in range(max(0, y - 1), min(height, y + 2))]


def alpha_of(path):
    """The channel A of an uncompressed or zip-compressed scan line .exr as this program writes it."""
    import struct
    import zlib
    data = open(path, "rb").read()
    at, channels, window, compression = 8, [], None, 0

    def word(start):
        end = data.index(b"\0", start)
        return data[start:end].decode(), end + 1

    while data[at] != 0:
        name, at = word(at)
        kind, at = word(at)
        size, = struct.unpack_from("<i", data, at)
        at += 4
        if name == "channels":
            part = at
            while data[part] != 0:
                channel, part = word(part)
                pixel, = struct.unpack_from("<i", data, part)
                channels.append((channel, 2 if pixel == 1 else 4))
                part += 16
        elif name == "dataWindow":
            window = struct.unpack_from("<4i", data, at)
        elif name == "compression":
            compression = data[at]
        at += size
    at += 1
    width, height = window[2] - window[0] + 1, window[3] - window[1] + 1
    block = {0: 1, 2: 1, 3: 16}[compression]
    offsets = struct.unpack_from(f"<{(height + block - 1) // block}Q", data, at)
    alpha = [0.0] * (width * height)
    for offset in offsets:
        first, size = struct.unpack_from("<ii", data, offset)
        packed = data[offset + 8:offset + 8 + size]
        rows = min(block, height - (first - window[1]))
        length = rows * width * sum(bytes_ for _, bytes_ in channels)
        if compression and size < length:
            plain = bytearray(zlib.decompress(packed))
            for i in range(1, len(plain)):
                plain[i] = (plain[i - 1] + plain[i] - 128) & 255
            half = (len(plain) + 1) // 2
            packed = bytearray(len(plain))
            packed[0::2], packed[1::2] = plain[:half], plain[half:]
        part = 0
        for row in range(rows):
            for channel, size in channels:
                if channel == "A":
                    values = struct.unpack_from(f"<{width}{'e' if size == 2 else 'f'}", packed, part)
                    y = height - 1 - (first - window[1] + row)  # bottom row first, as in a .pfm
                    alpha[y * width:(y + 1) * width] = values
                part += size * width
    return alpha


def region_mean(picture, region, channel):
    return sum(picture[i][channel] for i in region) / len(region)


WIDEST = 0.2


def deviations(reference, picture, least=12, widest=WIDEST):
    """(region, channel, share of the mean, its standard error) of each region of at least `least` pixels, where that error is no more than `widest`."""
    found = []
    brightest = max(region_mean(reference.mean, r, 1) for r in reference.regions.values() if r)
    for name, region in reference.regions.items():
        # What is nearly black is so but for pixels that are cut by an edge; below FAINT nothing is seen, and few paths scatter.
        if len(region) < least or region_mean(reference.mean, region, 1) < max(0.1 * brightest, FAINT):
            continue
        for channel in range(3):
            mean = region_mean(reference.mean, region, channel)
            error = math.sqrt(sum(reference.variance[i][channel] for i in region)) / len(region)
            if mean <= 0 or error > widest * mean:
                continue
            found.append((name, channel, region_mean(picture, region, channel) / mean - 1, error / mean))
    return found
