# SPDX-License-Identifier: Apache-2.0
"""Clouds rendered on the CPU, the same bits everywhere: scenes, worlds, sessions.

    import pileus
    picture = pileus.render("assets/scenes/cumulus.toml", size=(320, 180))

docs/python.md has the rest.
"""

from . import _core
from ._compare import Figures, compare
from ._core import orbit
from ._errors import BadInput, CheckFailed, Error, Io, Limit, PictureWarning
from ._scene import Scene, World, override_texts
from ._session import LayeredPicture, Picture, Progress, Session, Stats
from ._sky import Sky

Light = Progress  # an older name
__version__ = _core.version
__all__ = ["BadInput", "CheckFailed", "Error", "Figures", "Io", "LayeredPicture", "Light", "Limit", "Picture",
           "PictureWarning", "Progress", "Scene", "Session", "Sky", "Stats", "World", "compare", "orbit", "render"]


def render(scene, colour=None, *, overrides=None, density=None, size=None, units=None, threads=0,
           **how):
    """A scene's picture with all its light: what the program's `render` makes.

    scene: a Scene, or what makes one together with `overrides`. size: (width, height). units: of
    light, instead of the whole. `density` as of World; `colour` and all others as of Session.render.
    """
    if not isinstance(scene, Scene):
        texts = override_texts(overrides)
        if size is not None:
            texts.append(f"camera.resolution=[{size[0]}, {size[1]}]")
        scene = Scene(scene, texts)
    elif overrides or size is not None:
        raise BadInput("overrides, size: of a Scene that is made, allowed: with a path or a text")
    session = Session(World(scene, threads=threads, density=density), threads=threads)
    session.step(units)
    return session.render(colour, **how)
