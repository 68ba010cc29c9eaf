# SPDX-License-Identifier: Apache-2.0
"""How far one picture is from another."""

from typing import NamedTuple

import numpy as np

from . import _core
from ._errors import BadInput


class Figures(NamedTuple):
    """As `pileus compare` prints them: docs/compare.md, "Figures"."""

    identical: bool
    pixels: int
    cloud_pixels: int
    not_finite: int
    mean: float
    mean_reference: float
    rmse: float
    relmse: float
    relmse_trimmed: float
    bias: float
    largest: float
    largest_at: tuple  # (x, y)
    percentile_999: float
    relative_percentile_999: float
    flip: float  # NaN where it is left out, and so for the next two
    flip_percentile_99: float
    flip_largest: float


def _radiances(name, picture):
    picture = np.asarray(picture)
    if picture.dtype.kind != "f":
        raise BadInput(f"{name}: {picture.dtype}, allowed: radiances, float32 or float16")
    return np.require(picture, np.float32, "CA")


def compare(a, reference, *, alpha_least=0.02, flip=True, threads=0):
    """Measures `a` against `reference`, arrays [height, width, 3 or 4] of linear radiance.

    Pixels count whose alpha in the reference is above alpha_least; below 0, or without alpha, all.
    """
    return Figures(**_core.compare(_radiances("a", a), _radiances("reference", reference),
                                   alpha_least, flip, threads))
