"""Scenes as tables, whose numbers know how they go with units, and as the text of scene files."""

import copy
import json
import math


class Quantity(float):
    """A number and how it goes with the units of length, time and mass."""

    def __new__(cls, value, length=0, time=0, mass=0):
        self = float.__new__(cls, value)
        self.powers = (length, time, mass)
        return self

    def __deepcopy__(self, _):
        return self

    def like(self, value):
        return Quantity(value, *self.powers)

    def in_units(self, exponents):
        """The same quantity where units are smaller by these powers of two."""
        try:
            return math.ldexp(float(self), sum(p * e for p, e in zip(self.powers, exponents)))
        except OverflowError:
            return math.inf


def length(value):
    return Quantity(value, length=1)


def time(value):
    return Quantity(value, time=1)


def mass(value):
    return Quantity(value, mass=1)


def speed(value):
    return Quantity(value, length=1, time=-1)


def rate(value):
    return Quantity(value, time=-1)


def acceleration(value):
    return Quantity(value, length=1, time=-2)


def energy(value):
    return Quantity(value, length=2, time=-2, mass=1)


def load(value):
    return Quantity(value, time=-2, mass=1)


class Overrides(dict):
    """Keys with dots and their new values, which a change has as texts."""


def toml(value, units):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Quantity):
        return repr(value.in_units(units))
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, Overrides):
        return toml([f"{key}={toml(item, units)}" for key, item in value.items()], units)
    if isinstance(value, list):
        return "[" + ", ".join(toml(item, units) for item in value) + "]"
    return "{ " + ", ".join(f"{key} = {toml(item, units)}" for key, item in value.items()) + " }"


class Scene:
    """The tables of a scene file, its start files, and the units in which they are written."""

    def __init__(self):
        self.tables = {}
        self.start_files = {}  # name: (columns, rows)
        self.units = (0, 0, 0)
        self.bold = False

    def copy(self):
        return copy.deepcopy(self)

    def text(self):
        lines = []
        for name, table in self.tables.items():
            for one in table if isinstance(table, list) else [table]:
                lines.append(f"[[{name}]]" if isinstance(table, list) else f"[{name}]")
                lines += [f"{key} = {toml(value, self.units)}" for key, value in one.items()]
        empty = [f"{name} = []\n" for name in ("disks",) if not self.tables.get(name)]
        return "".join(empty) + "\n".join(lines) + "\n"

    def write(self, path):
        path.write_text(self.text())
        for name, (columns, rows) in self.start_files.items():
            lines = [",".join(columns)] + [",".join(toml(number, self.units) for number in row) for row in rows]
            (path.parent / name).write_text("\n".join(lines) + "\n")

    def table(self, name):
        return self.tables.get(name, {})

    def number(self, value):
        """A number of a table as the scene file has it."""
        return value.in_units(self.units) if isinstance(value, Quantity) else value

    def without(self, *names):
        other = self.copy()
        for name in names:
            table, _, key = name.partition(".")
            if key:
                other.tables.get(table, {}).pop(key, None)
            else:
                other.tables.pop(table, None)
        return other

    def stages(self):
        """The tables as the run begins, and after each change; obstacles that are removed are still there."""
        now = self.tables
        yield now
        for change in now.get("changes", []):
            now = copy.deepcopy(now)
            for key, value in change.get("set", {}).items():
                *path, last = key.split(".")
                table = now
                for name in path:
                    table = table.setdefault(name, {})
                table[last] = value
            if "add_obstacle" in change:
                now.setdefault("obstacles", []).append(change["add_obstacle"])
            yield now

    def set(self, table, **keys):
        other = self.copy()
        other.tables.setdefault(table, {}).update(keys)
        return other
