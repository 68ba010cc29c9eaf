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


# Scenes that are beyond their bounds, and why: docs/accuracy.md, "What the short form finds".
KNOWN = [
    ("collectors", {"periodic", "no-resolution", "thick"}, "a deck of 100 optical depths seen along its top"),
    ("collectors-billboards", {"inside"}, "boards that the camera is in"),
    ("particles", {"inside"}, "a particle that the camera is in has one value of light"),
    ("particles-billboards", {"inside"}, "boards that the camera is in"),
    ("particles", {"down"}, "little light comes straight up, and few harmonics ring"),
    ("particles-billboards", {"down"}, "little light comes straight up, and few harmonics ring"),
    ("particles-billboards", {"map-patch"}, "a bright patch seen through boards"),
    ("collectors-billboards", {"down"}, "little light comes straight up, and few harmonics ring"),
    ("raymarch", {"inside", "coloured"}, "deep within a colour that is absorbed"),
    ("raymarch", {"solid", "periodic"}, "walls on the ground below a deck"),
] + [(column, {"solid", "periodic"}, "surfaces below a deck have all of the sky")
     for column in ("collectors", "photon-grid", "optical-depth")
] + [(column, {"thick", cells}, "faces of a box that a high sun grazes") for column in ("collectors", "raymarch")
     for cells in ("no-resolution", "one-cell")]


def explained(column, names):
    """Why a scene with these features may be beyond its bound; None: it may not."""
    return next((why for where, features, why in KNOWN if where == column and features <= set(names)), None)


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
