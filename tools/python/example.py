# SPDX-License-Identifier: Apache-2.0
"""A cumulus at three heights of the sun, side by side in one array.

in: [PICTURE.png] -> out: the picture; without a name nothing is written. docs/python.md
"""

import struct
import sys
import zlib
from pathlib import Path

import numpy as np
import pileus

WIDTH, HEIGHT, SUNS = 320, 240, (60, 20, 4)
SCENE = Path(__file__).parents[2] / "assets/scenes/cumulus.toml"

world = pileus.World(pileus.Scene(SCENE, {
    "camera.resolution": [WIDTH, HEIGHT], "collectors.photons": 1_000_000,
    "collectors.generations": 10}))
session = pileus.Session(world)
strip = np.empty((HEIGHT, WIDTH * len(SUNS), 4), np.uint8)
for i, elevation in enumerate(SUNS):
    session.set_sun(65, elevation)
    session.step()  # a whole ring of photons for each sun
    session.render(strip[:, i * WIDTH:(i + 1) * WIDTH], exposure=1)
strip[..., 3] = 255  # the sky is part of the picture

if len(sys.argv) > 1:
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    rows = np.insert(strip.reshape(HEIGHT, -1), 0, 0, axis=1).tobytes()
    head = struct.pack(">IIBBBBB", strip.shape[1], HEIGHT, 8, 6, 0, 0, 0)
    Path(sys.argv[1]).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) +
                                  chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
