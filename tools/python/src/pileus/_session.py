# SPDX-License-Identifier: Apache-2.0
"""Sessions: what changes from picture to picture."""

import json
import warnings
from typing import NamedTuple, Optional

import numpy as np

from . import _core
from ._errors import BadInput, PictureWarning

_FORMATS = {"rgba8": 0, "rgba16f": 1, "rgba32f": 2}
_DTYPES = (np.uint8, np.float16, np.float32)
_BLENDS = {"replace": 0, "over": 1, "media": 2}
_DEPTHS = {"distance": 0, "view_z": 1, "buffer": 2}
_CLIPS = {"minus_one": 0, "zero": 1}
_LIGHTS = {"point": 0, "spot": 1, "directional": 2}
_LIGHT_KEYS = {
    "point": {"position", "intensity", "radius", "shadow_samples"},
    "spot": {"position", "intensity", "radius", "shadow_samples", "direction", "cone_deg",
             "penumbra_deg"},
    "directional": {"azimuth_deg", "elevation_deg", "irradiance"},
}


class Progress(NamedTuple):
    """Units of light: docs/embedding.md."""

    whole: int  # that a first picture should have; 0: the method traces none
    unit_photons: int  # photons or paths of one
    units: int  # that the next picture shows
    unit: str  # "generation", "sample" or ""


class Stats(NamedTuple):
    """Counts of what was done."""

    prepared: int
    pictures: int
    units: int
    shared_bytes: int
    own_bytes: int
    render_s: float
    stages_s: float


class Picture(NamedTuple):
    """What render gives where depth or hash is asked for."""

    colour: Optional[np.ndarray]
    depth: Optional[np.ndarray]
    hash: Optional[str]  # 16 hex digits, as of `pileus hash`


class LayeredPicture(NamedTuple):
    """What render gives where layers are asked for."""

    colour: Optional[np.ndarray]
    depth: Optional[np.ndarray]
    hash: Optional[str]
    layers: dict  # arrays [height, width] by their names


def _choice(name, value, table):
    if value in table:
        return table[value]
    raise BadInput(f"{name}: {value!r}, allowed: {', '.join(table)}")


def _warn_of_name(old, new):
    warnings.warn(f"{old} is an older name of {new}", DeprecationWarning, stacklevel=3)


def _three(name, value):
    numbers = np.asarray(value, np.float64)
    if numbers.shape not in ((), (3,)):
        raise BadInput(f"{name}: shape {numbers.shape}, allowed: a number, or three")
    return np.broadcast_to(numbers, 3).tolist()


def _light(light):
    """Numbers of one light, in the order of tools/python/session.cpp."""
    kind = light.get("type")
    number = _choice("light.type", kind, _LIGHTS)
    for key in light:
        if key != "type" and key not in _LIGHT_KEYS[kind]:
            raise BadInput(f"light.{key}: not of a {kind}, allowed: "
                           f"{', '.join(sorted(_LIGHT_KEYS[kind]))}")
    if kind != "directional" and "position" not in light:
        raise BadInput("light.position: missing, allowed: three numbers")
    strength = light.get("irradiance" if kind == "directional" else "intensity", 1.0)
    return [number, *_three("light.position", light.get("position", 0)),
            *_three("light.direction", light.get("direction", 0)),
            *_three("light.intensity", strength), light.get("cone_deg", 40.0),
            light.get("penumbra_deg", 0.0), light.get("radius", 0.0),
            light.get("azimuth_deg", 0.0), light.get("elevation_deg", 45.0),
            light.get("shadow_samples", 0)]


def _columns(name, matrix):
    """[row, column] as NumPy has it into columns one after the other, as pileus.h has them."""
    matrix = np.asarray(matrix, np.float64)
    if matrix.shape != (4, 4):
        raise BadInput(f"{name}: shape {matrix.shape}, allowed: (4, 4)")
    return matrix.T.ravel().tolist()


def _depths(values):
    """Depths of a host, whose pixels lie close in each row."""
    values = np.asarray(values, np.float32)
    return np.ascontiguousarray(values) if values.ndim == 2 and values.strides[1] != 4 else values


def _format_of(colour, name):
    """The format that an array's numbers say."""
    if not isinstance(colour, np.ndarray):
        raise BadInput(f"colour: {type(colour).__name__}, allowed: an array, None or False")
    kinds = [i for i, dtype in enumerate(_DTYPES) if colour.dtype == dtype]
    if not kinds or (name is not None and kinds[0] != _choice("format", name, _FORMATS)):
        wanted = f"of format {name}" if kinds else "uint8, float16 or float32"
        raise BadInput(f"colour: {colour.dtype}, allowed: {wanted}")
    return kinds[0]


def _buffers(size, colour, format, blend, depth):
    """Arrays to draw into, those of the caller or new ones: colour, its format, depth."""
    width, height = size
    if colour is None:
        chosen = _choice("format", format or "rgba32f", _FORMATS)
        make = np.zeros if blend == "over" else np.empty
        colour = make((height, width, 4), _DTYPES[chosen])
    elif colour is False:
        chosen, colour = 0, None
    else:
        chosen = _format_of(colour, format)
    if depth is True:
        depth = np.empty((height, width), np.float32)
    elif depth is False:
        depth = None
    return colour, chosen, depth


class Session:
    """One camera, one light and one method over a world; it begins as its scene says.

    One thread at a time; for more threads make more sessions. Lengths are metres, angles degrees;
    x points east, y north, z up.
    """

    def __init__(self, world, scene=None, *, threads=0, isa="", memory_limit=0, layers=False):
        """layers: pictures can have what output.layers of the scene names."""
        scene = world.scene if scene is None else scene
        self.world = world
        self._core = _core.Session(world._handle, scene._handle, threads, isa or "", memory_limit,
                                   layers)

    @property
    def size(self):
        """Pixels of the camera: (width, height)."""
        return tuple(self._core.size())

    def set_camera(self, position, target, up=(0, 0, 1), *, fov_deg=40.0, height=None, size=None,
                   near=0.0, far=0.0):
        """A perspective camera, or with `height` (of the picture, metres) an orthographic one.

        fov_deg: vertical. size: (width, height) in pixels; left out: as before. near, far: for
        depth buffers alone; far 0: infinite.
        """
        self._core.set_camera(_three("position", position), _three("target", target),
                              _three("up", up), fov_deg, height or 0.0, size or (0, 0), near, far)

    def set_matrices(self, view, projection, *, clip="minus_one", size=None):
        """The same from arrays [row, column]: world to view (looks along -z), view to clip.

        A point is a column, as in view @ [x, y, z, 1]. clip: depth from -1 ("minus_one", OpenGL)
        or from 0 ("zero", Vulkan, Direct3D).
        """
        self._core.set_matrices(_columns("view", view), _columns("projection", projection),
                                _choice("clip", clip, _CLIPS), size or (0, 0))

    def set_sun(self, azimuth_deg, elevation_deg=None, irradiance=1.0):
        """Azimuth from north towards east. set_sun(None): no sun."""
        present = azimuth_deg is not None
        if present and elevation_deg is None:
            raise BadInput("sun: no elevation_deg, allowed: with azimuth_deg")
        self._core.set_sun(present, azimuth_deg or 0.0, elevation_deg or 0.0,
                           _three("irradiance", irradiance))

    def set_environment(self, light, *, scale=1.0, rotation_deg=0.0):
        """A radiance (a number or three), a map [rows, columns, 3] or None: no sky.

        Rows of a map run from the zenith down; scale and rotation_deg are the map's.
        """
        radiance, sky_map = [0.0] * 3, None
        if np.ndim(light) > 1:
            sky_map = np.require(light, np.float32, "CA")
        elif light is not None:
            radiance = _three("sky", light)
        self._core.set_environment(light is not None, radiance, sky_map, scale, rotation_deg)

    def set_ground(self, albedo, *, altitude=0.0):
        """A flat ground. set_ground(None): none."""
        self._core.set_ground(albedo is not None, altitude, albedo or 0.0)

    def set_lamps(self, lamps):
        """Points, spots and parallel lights in place of all that there were; []: none.

        Each is a dict as a scene's [[light]]: {"type": "point", "position": (x, y, z),
        "intensity": 1e5, "radius": 0}; {"type": "spot", "position", "direction", "cone_deg",
        "penumbra_deg", "intensity"}; {"type": "directional", "azimuth_deg", "elevation_deg",
        "irradiance"}. Lights are a number or three. "shadow_samples": on a sphere, 0 for the usual.
        """
        self._core.set_lamps([_light(lamp) for lamp in lamps])

    def set_media(self, scene):
        """Extinction, albedo, emission and phase functions of a Scene with as many media."""
        self._core.set_media(scene._handle)

    def set_placement(self, offset=(0, 0, 0), yaw_deg=0.0):
        """Turns all media about the z axis, then shifts them. Nothing is prepared again."""
        self._core.set_placement(_three("offset", offset), yaw_deg)

    def set_depth(self, values, kind="distance", *, bottom_up=False):
        """Opaque things that end rays, [height, width], for the camera as it is now; None: none.

        kind: "distance" (along each ray), "view_z" or "buffer" (of the camera's projection).
        """
        if values is not None:
            values = _depths(values)
        self._core.set_depth(values, _choice("kind", kind, _DEPTHS), bottom_up)

    def set_frame(self, number):
        """Number of the picture, which jitter and the noise of paths go by."""
        self._core.set_frame(number)

    @property
    def progress(self):
        """How much light there is, and what a step counts: Progress."""
        return Progress(*self._core.progress())

    def set_sky(self, light, **how):
        """An older name of set_environment."""
        _warn_of_name("set_sky", "set_environment")
        self.set_environment(light, **how)

    def set_lights(self, lights):
        """An older name of set_lamps."""
        _warn_of_name("set_lights", "set_lamps")
        self.set_lamps(lights)

    @property
    def light(self):
        """An older name of progress."""
        _warn_of_name("light", "progress")
        return self.progress

    @property
    def stats(self):
        """Counts: Stats."""
        return Stats(*self._core.stats())

    def report(self):
        """The report as the program writes it (docs/report.md), a dict."""
        return json.loads(self._core.report())

    def step(self, units=None):
        """Traces so many units of light; left out: as many as a first picture should have."""
        return self._core.step(self.progress.whole if units is None else units)

    def render(self, colour=None, *, format=None, blend="replace", exposure=0.0, depth=None,
               depth_kind="distance", hash=False, bottom_up=False, layers=()):
        """Draws what the session holds, into arrays of yours or new ones. Light is not traced.

        colour: an array [height, width, 4] of uint8, float16 or float32, written in place; gaps
        between its rows stay. None: a new one of `format` ("rgba8", "rgba16f", "rgba32f"). False: none.
        blend: "replace" (all, sky and ground too), "over" (the media over what is there), "media"
        (premultiplied by alpha). exposure: stops, of rgba8.
        depth: True, or an array [height, width] of float32. hash: True for the picture's.
        bottom_up: the first row is the picture's lowest.
        layers: names of channels (docs/formats.md, "Pictures out"), "R" or "tau".
        Returns colour; where depth or hash is asked for, a Picture; where layers, a LayeredPicture.
        """
        mode = _choice("blend", blend, _BLENDS)
        colour, chosen, depth = _buffers(self.size, colour, format, blend, depth)
        width, height = self.size
        planes = {str(name): np.empty((height, width), np.float32) for name in layers}
        bits = self._core.render(colour, chosen, mode, exposure, depth,
                                 _choice("depth_kind", depth_kind, _DEPTHS), hash, bottom_up,
                                 list(planes.items()))
        for line in self._core.take_lines():
            warnings.warn(line, PictureWarning, stacklevel=2)
        if depth is None and not hash and not planes:
            return colour
        picture = Picture(colour, depth, None if bits is None else f"{bits:016x}")
        return LayeredPicture(*picture, planes) if planes else picture
