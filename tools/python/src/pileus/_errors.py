# SPDX-License-Identifier: Apache-2.0
"""What goes wrong, by the codes of pileus.h."""


class Error(Exception):
    """Any fault that the library tells; its text has one line for each."""


class CheckFailed(Error):
    """Kernels that give other bits than they must, or work that was stopped."""


class BadInput(Error, ValueError):
    """An argument, a scene or a file of it."""


class Limit(Error, MemoryError):
    """Out of memory, or more than a limit allows."""


class Io(Error, OSError):
    """Reading or writing failed half way."""


class PictureWarning(UserWarning):
    """What makes a picture doubtful: docs/report.md, "Accidents"."""


CLASSES = {1: CheckFailed, 2: BadInput, 3: Limit, 4: Io}
