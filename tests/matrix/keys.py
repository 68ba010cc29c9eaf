# SPDX-License-Identifier: Apache-2.0
"""Keys that a method takes and that change nothing: what is accepted changes the picture or the report.

in: docs/scene.md (keys, ranges, choices), a column of the support table, scenes with features
-> out: of each key how it ended: changed, refused, nothing (with the values tried), untried.
docs/accuracy.md, "Keys that change nothing"
"""
import copy
import json
import os
import re

from runs import Refused, run, with_method

# Tables of methods and their tools: other columns leave them as they are, so that one scene serves all.
OWN = {"collectors": {"collectors"}, "photon_grid": {"photon-grid"}, "path": {"path"}, "raymarch": {"raymarch"},
       "optical_depth": {"optical-depth"}, "particles": {"particles"}, "filter": {"path"}}
# What a report says of the run itself, not of the picture.
RUN = re.compile(r"(^|_)(s|ms|seconds)$|time|version|^scene$|^overrides$|^memory$")
WORK = {"collectors": {"photons": 3000, "generations": 2, "samples": 200}, "photon_grid": {"photons": 3000, "generations": 2},
        "path": {"samples_per_pixel": 2}}
# Scenes that a key is tried in until it changes something: by the features of each.
SCENES = [[], ["point", "solid"], ["two-media", "coloured"], ["air"], ["map-patch"], ["spot", "sphere"], ["emission", "detail"],
          ["sky-grid"], ["balls"], ["moved"], ["periodic"], ["orthographic"], ["directional"], ["transfer"], ["lens"],
          ["two-lobe"], ["hg-draine"], ["cloud"], ["depth"]]


def rows(page):
    """(key, kind of value, default) of the page's tables."""
    for line in open(page, encoding="utf-8"):
        cells = [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line)]
        if len(cells) > 5 and re.match(r"`[a-z_A-Z0-9.]+`$", cells[1]) and "not in this version" not in cells[2]:
            yield cells[1].strip("`"), cells[2], cells[4].strip("`")


def values(kind, default):
    """TOML values to try in place of what a scene has."""
    if kind.startswith("true"):
        return [word for word in ("true", "false") if word != default]
    span = re.search(r"in ([\[(])([^,\[\]()]+), ([^,\[\]()]+)[\])]", kind)
    if span:
        low, high = float(span[2]), float(span[3])
        if "whole" in kind:
            numbers = {int(low), int(low) + 1, int(low) + 2, 3, 7, 16, 40, min(int(high), 300)}
        else:
            numbers = {low, 0.5 * low + 0.5 * high if high < 1e4 else 1.0, 0.3, 2.5, 35.0, 400.0, 0.01, 1e-4}
        try:
            numbers |= {type(next(iter(numbers)))(float(default) * k) for k in (0.5, 2, 3)}
        except ValueError:
            pass
        numbers = spread(n for n in numbers if low <= n <= high and repr(n) != default and str(float(n)) != default + ".0")
        count = re.match(r"(\d) ", kind)
        if count:
            return [str([n + (i if n + i <= high else 0) for i in range(int(count[1]))]) for n in numbers]
        return [repr(n) for n in numbers]
    if re.match(r"[a-z0-9-]+(, [a-z0-9-]+)+$", kind):
        return [f'"{word}"' for word in kind.split(", ") if f'"{word}"' != default]
    return []


def spread(numbers, most=4):
    """At most so many of them, the least and the greatest among these."""
    numbers = sorted(numbers)
    if len(numbers) <= most:
        return numbers
    return [numbers[i * (len(numbers) - 1) // (most - 1)] for i in range(most)]


def without_run(value):
    if isinstance(value, dict):
        return {k: without_run(v) for k, v in value.items() if not RUN.search(k)}
    return [without_run(v) for v in value] if isinstance(value, list) else value


class Stage:
    """A scene of one method, and what comes of it with a key set to something."""

    def __init__(self, program, folder, name, scene, column):
        self.program, self.folder, self.name = program, folder, name
        scene = with_method(scene, column)
        scene["camera"]["resolution"] = [12, 10]
        for table, keys in WORK.items():
            if table in scene or table == scene["method"]["name"].replace("-", "_"):
                scene.setdefault(table, {}).update(keys)
        self.scene, self.always = scene, []
        self.plain = self.outcome([])

    def beside(self, setting):
        """The same with another key set, too."""
        other = copy.copy(self)
        other.always = self.always + [setting]
        other.name = f"{self.name}, {setting}"
        other.plain = other.outcome([])
        return other

    def outcome(self, settings):
        """The picture, the report without times, and the warnings; None where it is refused."""
        report = os.path.join(self.folder, "report.json")
        arguments, warnings = ["--report", report], []
        for setting in self.always + settings:
            arguments += ["--set", setting]
        try:
            picture = run(self.program, self.folder, self.scene, "keys", arguments, warnings)
        except Refused:
            return None
        with open(report) as file:
            return picture, without_run(json.load(file)), warnings


def applies(key, column):
    """Whether a key is one of this column's; films have pictures of other names and are not tried."""
    table = key.split(".")[0]
    if table == "animation":
        return False
    return table not in OWN or column.replace("-billboards", "") in OWN[table]


def first_of(key):
    """The key of the first of its list: a lamp, a medium, a solid."""
    return key.replace(".N.", ".0.")


def companions(key, page_rows):
    """Settings of the same table that may be what a key waits for: other choices, switches, numbers above 0 where 0 is none."""
    for other, kind, default in page_rows:
        if other == key or other.rsplit(".", 1)[0] != key.rsplit(".", 1)[0]:
            continue
        tried = values(kind, default)
        if kind.startswith("true") or tried and tried[0].startswith('"'):
            yield from (f"{first_of(other)}={value}" for value in tried)
        elif default in ("0", "1") and tried:
            yield f"{first_of(other)}={tried[-2] if len(tried) > 2 else tried[-1]}"


def try_key(key, tried, stages):
    """(how it ended, values taken without a change): changed, refused, nothing or untried."""
    accepted, refused = [], 0
    for stage in stages:
        if stage.plain is None or (".N." in key and key.split(".")[0] not in stage.scene):
            continue
        for value in tried:
            found = stage.outcome([f"{first_of(key)}={value}"])
            if found is None:
                refused += 1
            elif found != stage.plain:
                return "changed", []
            else:
                accepted.append(f"{value} ({stage.name})")
    return "nothing" if accepted else "refused" if refused else "untried", accepted


def try_keys(page, column, stages):
    """(key, how it ended, values taken without a change) of every key that the column takes."""
    out, page_rows = [], list(rows(page))
    for key, kind, default in page_rows:
        if not applies(key, column):
            continue
        tried = values(kind, default)
        how, accepted = try_key(key, tried, stages)
        if how == "nothing":
            # What waits for another key of its table is told as such.
            for setting in companions(key, page_rows):
                if try_key(key, tried[:2], [stage.beside(setting) for stage in stages[:2]])[0] == "changed":
                    how, accepted = "waits", [setting]
                    break
        out.append((key, how, accepted))
    return out
