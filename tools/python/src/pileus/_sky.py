# SPDX-License-Identifier: Apache-2.0
"""The whole sky over what a host has drawn: docs/whole-sky.md."""

import warnings

import numpy as np

from . import _core
from ._errors import BadInput, PictureWarning
from ._session import _BLENDS, _DEPTHS, Picture, Session, _buffers, _choice, _depths, _three

_SHADOWS = {"r8": (0, np.uint8), "rgba8": (1, np.uint8), "r16f": (2, np.float16), "r32f": (3, np.float32)}
_MOST_TEXELS = 16384
_CLOUD = {"kind": 0, "offset": (0, 0, 0), "yaw_deg": 0.0, "scale": 1.0, "presence": 1.0}


def _cloud(index, cloud):
    """Numbers of one cloud, in the order of tools/python/sky.cpp."""
    for key in cloud:
        if key not in _CLOUD:
            raise BadInput(f"clouds[{index}].{key}: unknown, allowed: {', '.join(_CLOUD)}")
    given = {**_CLOUD, **cloud}
    # In pileus.h 0 is left out; here one says so by leaving it out.
    for key in ("scale", "presence"):
        if given[key] == 0:
            raise BadInput(f"clouds[{index}].{key}: 0, allowed: above 0")
    return given["kind"], [*_three(f"clouds[{index}].offset", given["offset"]), given["yaw_deg"],
                           given["scale"], given["presence"]]


def _two(name, value):
    numbers = np.asarray(value, np.float64)
    if numbers.shape not in ((), (2,)):
        raise BadInput(f"{name}: shape {numbers.shape}, allowed: a number, or two")
    return np.broadcast_to(numbers, 2).tolist()


class Sky:
    """Air, layers and clouds of a Scene without media, in one picture with what a host has drawn.

    One thread at a time. Lengths are metres, angles degrees; x points east, y north, z up.
    """

    def __init__(self, scene, *, threads=0, isa="", memory_limit=0):
        self._core = _core.Sky(scene._handle, threads, isa or "", memory_limit)

    # Those of the sky's session, on the same core.
    size = Session.size
    set_camera = Session.set_camera
    set_matrices = Session.set_matrices
    set_sun = Session.set_sun
    set_environment = Session.set_environment
    set_ground = Session.set_ground
    set_frame = Session.set_frame

    def set_time(self, hours):
        """Places the sun so many hours after the scene's date and time, which it must have."""
        self._core.set_time(hours)

    def set_weather(self, metar, seed=0, elevation=0.0):
        """Clouds, haze, fog and rain of a METAR or SPECI in place of all there are.

        seed: other clouds of the same report. elevation: of the station. A report that cannot be
        read changes nothing.
        """
        self._core.set_weather(metar, seed, elevation)

    def move(self, offset):
        """Puts all clouds and layers beside their places: wind, or an origin that moves."""
        self._core.move(_three("offset", offset))

    def add_layer(self, world, scene=None):
        """One more sheet of clouds, up to 8, drawn by the method of its scene."""
        scene = world.scene if scene is None else scene
        self._core.add_layer(world._handle, scene._handle)

    def add_kind(self, world, scene=None):
        """A kind of cloud; returns its number, from 0 on."""
        scene = world.scene if scene is None else scene
        return self._core.add_kind(world._handle, scene._handle)

    def place(self, clouds):
        """All clouds by number, up to 1000, in place of those that there were.

        Each is a dict: {"kind": 0, "offset": (x, y, z), "yaw_deg": 0, "scale": 1, "presence": 1}.
        presence: above 0 to 1, a factor on alpha and light.
        """
        self._core.place([_cloud(i, cloud) for i, cloud in enumerate(clouds)])

    def render(self, colour=None, *, format=None, blend="replace", exposure=0.0, depth=None,
               depth_kind="distance", hash=False, bottom_up=False, host_depth=None,
               host_kind="distance", host_bottom_up=False):
        """Draws all of it, into arrays of yours or new ones, as Session.render does.

        blend: "over" what colour holds, which is seen through air and clouds where host_depth has
        something; "media": the same to be laid over it later; "replace": sky, ground and clouds.
        host_depth: what you have drawn, an array [height, width] for the camera as it is, infinity:
        nothing; None: as it was given last. host_kind: "distance", "view_z" or "buffer".
        """
        mode = _choice("blend", blend, _BLENDS)
        solid = None
        if host_depth is not None:
            solid = _depths(host_depth), _choice("host_kind", host_kind, _DEPTHS), host_bottom_up
        colour, chosen, depth = _buffers(self.size, colour, format, blend, depth)
        bits = self._core.render(colour, chosen, mode, exposure, depth,
                                 _choice("depth_kind", depth_kind, _DEPTHS), hash, bottom_up, solid)
        for line in self._core.take_lines():
            warnings.warn(line, PictureWarning, stacklevel=2)
        if depth is None and not hash:
            return colour
        return Picture(colour, depth, None if bits is None else f"{bits:016x}")

    def light_at(self, points):
        """Light at points [n, 3], by the light and shadows of the last picture: a dict of arrays.

        "sun_share" [n]: of sunlight that clouds let through. "sun" [n, 3]: irradiance on a plane
        that faces the sun. "level" [n, 3]: irradiance of the sky on level ground.
        "extinction_per_m" [n]: of clouds there. "around" [n, 3, 9]: irradiance over pi by channel,
        the sum of these times 1, x, y, z, xy, yz, zx, xx - yy, 3 zz - 1 of a normal.
        """
        return self._core.light_at(np.asarray(points, np.float64))

    def shadow(self, low, size, shape=None, *, altitude=0.0, format="r32f", bottom_up=False,
               out=None, first_row=0, rows=0):
        """Sunlight that clouds let through to a map, by the light and shadows of the last picture.

        low: x, y of the south-west corner; size: extents; shape: (rows, columns). Rows run from the
        north, with bottom_up from the south. altitude: a number, or an array of `shape` with the
        rows of the map. format: "r32f", "r16f", "r8" (255: all of the sun), "rgba8".
        out: an array of yours to write to; first_row, rows: the part of it to write; 0: the rest.
        """
        number, dtype = _choice("format", format, _SHADOWS)
        channels = (4,) if format == "rgba8" else ()
        if out is None:
            shape = tuple(np.atleast_1d(shape).tolist()) if shape is not None else ()
            if len(shape) != 2 or not all(type(n) is int and 1 <= n <= _MOST_TEXELS for n in shape):
                raise BadInput(f"shape: {shape}, allowed: (rows, columns), 1 to {_MOST_TEXELS} each")
            out = np.zeros(shape + channels, dtype)
        elif not isinstance(out, np.ndarray):
            raise BadInput(f"out: {type(out).__name__}, allowed: an array, or None")
        elif shape is not None and tuple(shape) + channels != out.shape:
            raise BadInput(f"shape: {tuple(shape)}, allowed: that of out, or left out")
        heights = None
        if np.ndim(altitude) > 0:
            heights, altitude = np.require(altitude, np.float32, "CA"), 0.0
        self._core.shadow(_two("low", low), _two("size", size), out, number, altitude, heights,
                          bottom_up, first_row, rows)
        return out

    def air(self, direction, metres):
        """What air and haze do between the camera and something so far away: left[3], light[3].

        left: the share of what lies behind; light: what is added. Infinity: the sky there.
        """
        return self._core.air(_three("direction", direction), metres)
