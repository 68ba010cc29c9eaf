# SPDX-License-Identifier: Apache-2.0
"""Scenes and worlds."""

import json
import os

import numpy as np

from . import _core
from ._errors import BadInput


def _toml(value):
    """A value as TOML."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(v)}" for key, v in value.items()) + "}"
    raise BadInput(f"override: {value!r}, allowed: numbers, texts, lists and dicts of them")


def override_texts(overrides):
    """{"method.name": "path"} or ["method.name=path"] as texts of the program's --set."""
    if overrides is None:
        return []
    if isinstance(overrides, dict):
        return [f"{key}={_toml(value)}" for key, value in overrides.items()]
    if isinstance(overrides, str):
        raise BadInput(f"overrides: {overrides!r}, allowed: a dict, or a list of texts")
    return list(overrides)


class Scene:
    """A scene file (docs/scene.md), or the text of one: a str with a line break is text.

    overrides: {"sun.elevation_deg": 20, "method.name": "path"}, or a list of "key=value".
    directory: where relative paths of a text begin; left out: the current one.
    """

    def __init__(self, path_or_text, overrides=None, *, directory=""):
        texts = override_texts(overrides)
        if isinstance(path_or_text, str) and "\n" in path_or_text:
            self._handle = _core.parse_scene(path_or_text, os.fspath(directory), texts)
        else:
            self._handle = _core.read_scene(os.fspath(path_or_text), texts)

    def plan(self, threads=0):
        """Sizes before memory: cells, low, high, peak_bytes, world_bytes."""
        return _core.plan_scene(self._handle, threads)


class World:
    """What of a scene depends on neither camera, light nor method. Sessions and threads share it.

    density: {number of a medium: array [z, y, x]}, float32, instead of what the scene says; that
    medium has density = "uniform:box" and bounds_m. Copied.
    threads: 0: as many as there are processors. memory_limit: bytes; 0: the default.
    """

    def __init__(self, scene, *, threads=0, density=None, isa="", memory_limit=0):
        given = [(medium, np.require(values, np.float32, "CA")) for medium, values in
                 (density or {}).items()]
        self.scene = scene
        self._handle = _core.World(scene._handle, threads, isa or "", memory_limit, given)
