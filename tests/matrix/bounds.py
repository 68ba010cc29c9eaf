# SPDX-License-Identifier: Apache-2.0
"""What the support table promises, as numbers.

in: `pileus methods --json` -> out: for a row and a column its level, and the share of the mean by which
a picture may be too dark and too bright.
"""
import json
import re
import subprocess

NUMBER = r"[-+]?\d+(?:\.\d+)?"
RANGE = re.compile(rf"({NUMBER}) to ({NUMBER}) %")
ONE = re.compile(rf"({NUMBER}) %")
FACTOR = re.compile(rf"\bx ({NUMBER})(?: to ({NUMBER}))?")


# Known as too bright, by up to so much.
BRIGHT = (0.0, 1.0)
# Scenes that are beyond their bounds, and why: docs/accuracy.md, "What the short form finds".
KNOWN = [
    ("collectors", {"periodic", "no-resolution", "thick"}, "a deck of 100 optical depths seen along its top"),
    ("collectors", {"periodic"}, "a deck of thick cells seen along its top", (0.0, 0.2)),
    ("collectors-billboards", {"inside"}, "boards that the camera is in"),
    ("particles", {"inside"}, "a particle that the camera is in has one value of light"),
    ("particles-billboards", {"inside"}, "boards that the camera is in"),
    ("particles", {"down"}, "little light comes straight up, and few harmonics ring"),
    ("particles-billboards", {"down"}, "little light comes straight up, and few harmonics ring"),
    ("particles", {"map-patch"}, "a bright patch on particles", (-0.7, 0.7)),
    ("particles-billboards", {"map-patch"}, "a bright patch seen through boards"),
    ("collectors-billboards", {"down"}, "little light comes straight up, and few harmonics ring"),
    ("raymarch", {"inside", "coloured"}, "deep within a colour that is absorbed"),
    ("raymarch", {"thick", "coloured"}, "a colour that a thick medium absorbs", (-0.7, 3.0)),
    ("raymarch", {"detail", "thick"}, "nodes are coarser than the detail of a thick medium", (-0.4, 0.4)),
    ("particles-billboards", {"cloud"}, "a peak of droplets on boards", (-0.8, 1.0)),
    ("collectors-billboards", {"cloud"}, "a peak of droplets on boards", (-0.8, 3.0)),
    ("collectors-billboards", {"map-patch"}, "a bright patch seen through boards", (-0.8, 1.5)),
    ("collectors-billboards", {"one-cell"}, "a board is wider than a box of one cell", (-0.6, 1.0)),
    ("photon-grid", {"down"}, "little light comes straight up, and few harmonics ring", (0.0, 1.0)),
    ("raymarch", {"solid", "periodic"}, "walls on the ground below a deck"),
] + [(column, {"solid", "periodic"}, "surfaces below a deck have all of the sky")
     for column in ("collectors", "photon-grid", "optical-depth")
] + [(column, {"thick", cells}, "faces of a box that a high sun grazes") for column in ("collectors", "raymarch")
     for cells in ("no-resolution", "one-cell")
] + [(column, {"solid", other}, "a solid's shade on the ground before it", BRIGHT)
     for column in ("collectors", "photon-grid", "raymarch", "optical-depth", "particles", "particles-billboards")
     for other in ("depth", "ground-white")
] + [(column, {"depth", "coloured"}, "few harmonics ring where an image hides an absorbed colour's light", BRIGHT)
     for column in ("collectors", "photon-grid")
] + [(column, {"sun-corner"}, "an upright face that a low sun grazes") for column in ("collectors", "photon-grid")
] + [(column, {"hg-0.97", other}, "a narrow peak and few harmonics", (0.0, 3.0)) for column in ("collectors", "photon-grid")
     for other in ("map-patch", "coloured")
] + [("optical-depth", set(), "an appearance, as its report says")]


def explained(column, names, shares):
    """Why a scene with these features may be off by all of these shares of the mean; None: it may not."""
    for where, features, why, *limits in KNOWN:
        low, high = limits[0] if limits else (-1, float("inf"))
        if where == column and features <= set(names) and shares and all(low <= s <= high for s in shares):
            return why
    return None


class Table:
    def __init__(self, program):
        text = subprocess.run([program, "methods", "--json"], capture_output=True, text=True, check=True).stdout
        data = json.loads(text)
        self.columns = data["columns"]
        self.rows = {row["feature"]: row["by"] for row in data["features"]}

    def level(self, row, column):
        return self.rows[row][column]["level"]

    def text(self, row, column):
        return self.rows[row][column].get("text", "")

    def figure(self, row, column):
        """(too dark, too bright) as shares of the mean; None where the row has no figure."""
        if self.level(row, column) == "exact":
            return 0.0, 0.0
        # Octaves are a choice that no scene of these makes.
        text = "; ".join(part for part in self.text(row, column).split("; ") if not part.startswith("octaves"))
        other = re.search(r"\bas ([a-z-]+)", text)
        if other and other[1] in self.columns and other[1] != column:
            return self.figure(row, other[1])
        if text.startswith("as the sun"):
            return self.figure("sun, a point", column)
        low, high, found = 0.0, 0.0, False
        for match in RANGE.finditer(text):
            first, last = float(match[1]) / 100, float(match[2]) / 100
            low, high, found = min(low, first, last), max(high, first, last), True
        for match in FACTOR.finditer(text):
            for value in filter(None, match.groups()):
                low, high, found = min(low, float(value) - 1), max(high, float(value) - 1), True
        for match in ONE.finditer(RANGE.sub("", text)):
            value = float(match[1]) / 100
            signed = match[1][0] in "+-"
            low, high = min(low, value if signed else -value), max(high, value if signed else abs(value))
            found = True
        return (low, high) if found else None
