"""Scenes: what is to be simulated."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from os.path import dirname
from typing import TYPE_CHECKING, Any, NamedTuple, TypeGuard, Union, cast

import numpy as np

from carom import _core
from carom._arguments import absolute, list_of_words, numbers, pairs, path_text, shown, words
from carom._errors import SceneError
from carom._toml import scene_text, value_text

if TYPE_CHECKING:
    import numpy.typing as npt

    from carom.starts import Start

#: Whatever stands for a scene: a Scene, the path of a scene file, or a mapping with the keys of the scene format.
SceneLike = Union["Scene", str, "PathLike[str]", Mapping[str, Any]]

#: What errors call a scene that was made from values of Python; there is no file in which to look for a line.
_MADE = "scene"


def presets() -> list[str]:
    """Returns the names of the scenes that come with carom, for `Scene.preset()`; "box" is the first."""
    return _core.preset_names()


class Check(NamedTuple):
    """What a scene would simulate, by which engine, and at what cost.

    Attributes:
        what: pairs of a quantity and its value in words, as `carom check` prints them.
        engine, reason: the engine, and why that one.
        cost: the expected cost on this machine in words, from a trial run of a fifth of a second.
        seconds, collisions: the expected cost in numbers; None where the trial does not determine it.
    """

    what: tuple[tuple[str, str], ...]
    engine: str
    reason: str
    cost: str
    seconds: float | None
    collisions: float | None

    def __str__(self) -> str:
        rows = [*self.what, ("engine", f"{self.engine}: {self.reason}"), ("cost", self.cost)]
        return "\n".join(f"{quantity:<11} {value}" for quantity, value in rows)

    def __repr__(self) -> str:
        return str(self)


class Scene:
    """A scene: box, disks, effects, how long it runs and what it samples. Scenes are immutable; equal scenes are equal.

    >>> scene = carom.Scene(
    ...     box={"x": (-1, 1), "y": (-1, 1), "boundary": "walls"},
    ...     disks={"count": 64, "radius": 0.03, "mass": 1, "positions": "random", "velocities": {"uniform": 1}},
    ...     collision={"rule": "reversal"}, run={"time": 5, "sample_every": 0.001})
    >>> scene.count
    64

    The keys are those of the scene format (docs/scene-format.md), and nothing is renamed: what is a table there is a mapping here,
    a list of tables a mapping or a list of mappings. numpy's numbers and arrays count as Python's. A key whose value is None is
    left out.

    Raises:
        SceneError: where the scene format does not allow it; the sentence names the key and what would be right, or the
            line of the start file.
        TypeError: where a value is none that a scene can hold.
    """

    __slots__ = ("_core", "_directory", "_toml")

    def __init__(self, mapping: Mapping[str, Any] | None = None, /, **tables: Any) -> None:
        if mapping is not None and not isinstance(mapping, Mapping):
            raise TypeError(f"a scene is {shown(mapping)}; give a mapping, or the path of a scene file to Scene.load()")
        self._core = _parsed(scene_text({**(mapping or {}), **tables}), _MADE, [], ".")
        self._directory = absolute(".")
        self._toml: str | None = None

    @classmethod
    def _of(cls, core: _core.Scene, directory: str) -> Scene:
        scene = cls.__new__(cls)
        scene._core, scene._directory, scene._toml = core, directory, None
        return scene

    @classmethod
    def load(cls, path: str | PathLike[str], overrides: list[str] | None = None) -> Scene:
        """Reads a scene file. `overrides` are those of the program's --set, such as "run.time=2"."""
        place = path_text(path, "path")
        return cls._of(_core.Scene.load(place, list_of_words(overrides or [], "overrides")), dirname(absolute(place)))

    @classmethod
    def parse(cls, text: str, directory: str | PathLike[str] = ".") -> Scene:
        """Reads a scene from TOML text. Start files that it names are searched in `directory`."""
        place = path_text(directory, "directory")
        return cls._of(_core.Scene.parse(words(text, "the text"), _MADE, [], place), absolute(place))

    @classmethod
    def preset(cls, name: str) -> Scene:
        """Returns one of the scenes that come with carom, such as "box"; `carom.presets()` lists them."""
        return cls._of(_core.Scene.parse(_core.preset(words(name, "the name")), f"{name}.toml", [], "."), absolute("."))

    def set(self, changes: Mapping[str, Any]) -> Scene:
        """Returns the scene with other values for some keys.

        >>> carom.Scene.preset("box").set({"run.seed": 7, "disks.0.radius": 0.02}).to_dict()["run"]["seed"]
        7

        Args:
            changes: values of Python by dotted key; "disks.0.radius" is the radius of the first species.
        """
        if not isinstance(changes, Mapping):
            raise TypeError(f"the changes are {shown(changes)}; give a mapping of keys to values, such as {{'run.time': 2}}")
        overrides = [f"{key}={value_text(value, str(key))}" for key, value in changes.items()]
        core = _parsed(self._core.text, self._core.source, [*self._core.overrides, *overrides], self._directory)
        return Scene._of(core, self._directory)

    def with_disks(
        self,
        positions: npt.ArrayLike | Start,
        velocities: npt.ArrayLike | None = None,
        radii: npt.ArrayLike | None = None,
        masses: npt.ArrayLike | None = None,
    ) -> Scene:
        """Returns the scene with its disks at these places.

        Args:
            positions: shape (N, 2), length. A scene of one species takes any N; with several, N is the number of all disks, those of
                the first species first. A Start, which `carom.read_start()` returns, brings all that it has; what is given besides
                takes the place of that.
            velocities: shape (N, 2), length / time; None: as the scene draws them.
            radii: shape (N,), length; None: those of the scene.
            masses: shape (N,); None: those of the scene.

        Raises:
            SceneError: where disks overlap, lie outside of the box, or the arrays do not fit together.
            ValueError: where an array has another shape; TypeError: where it holds no numbers.
        """
        if _is_start(positions):
            start = positions
            velocities = start.velocities if velocities is None else velocities
            radii = start.radii if radii is None else radii
            masses = start.masses if masses is None else masses
            positions = start.positions
        core = self._core.with_disks(
            pairs(cast("npt.ArrayLike", positions), "positions"),
            None if velocities is None else pairs(velocities, "velocities"),
            None if radii is None else numbers(radii, "radii"),
            None if masses is None else numbers(masses, "masses"),
        )
        return Scene._of(core, self._directory)

    @property
    def toml(self) -> str:
        """The scene in TOML with every default filled in."""
        if self._toml is None:
            self._toml = self._core.toml
        return self._toml

    @property
    def text(self) -> str:
        """The TOML text that the scene was read from."""
        return self._core.text

    @property
    def title(self) -> str:
        """The title, which may be empty."""
        return self._core.title

    @property
    def count(self) -> int:
        """The number of disks of all species."""
        return self._core.count

    @property
    def packing_fraction(self) -> float:
        """The sum of pi r^2 of all disks over the area of the box."""
        return self._core.packing_fraction

    @property
    def species(self) -> list[str]:
        """The names of the species; `Simulation.species` holds numbers of them."""
        return self._core.species

    @property
    def box(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The box as ((x_low, x_high), (y_low, y_high)); length."""
        (x0, y0), (x1, y1) = self._core.lower, self._core.upper
        return (x0, x1), (y0, y1)

    @property
    def periodic(self) -> tuple[bool, bool]:
        """Whether the box is periodic along x and along y."""
        x, y = self._core.periodic
        return x, y

    @property
    def circle(self) -> tuple[tuple[float, float], float] | None:
        """The centre and the radius of a circular box, for which `box` is the square round it; None for a rectangle."""
        if self._core.circle is None:
            return None
        (x, y), radius = self._core.circle
        return (x, y), radius

    def to_dict(self) -> dict[str, Any]:
        """Returns the scene with every default as nested dicts, with the keys of the scene format."""
        import tomllib

        return tomllib.loads(self.toml)

    def check(self, engine: str = "auto") -> Check:
        """Draws the start and lets it run for a fifth of a second. Returns what would be simulated, by which engine, at what cost."""
        from carom import _files

        name, reason, cost, seconds, collisions = _files.expected_cost(self._core, words(engine, "engine"))
        return Check(tuple(_files.describe(self._core)), name, reason, cost, seconds, collisions)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.toml == other.toml

    def __hash__(self) -> int:
        return hash(self.toml)

    def __repr__(self) -> str:
        title = f"{self.title!r}, " if self.title else ""
        return f"<carom.Scene {title}{self.count} disks, packing fraction {self.packing_fraction:.4g}>"

    def parts(self) -> tuple[str, str, list[str], str]:
        """Returns the text, its source, its overrides and its directory: `scene_of_parts()` of these is this scene."""
        return self._core.text, self._core.source, self._core.overrides, self._directory

    def __reduce__(self) -> tuple[Any, ...]:
        return scene_of_parts, self.parts()


def _parsed(text: str, source: str, overrides: list[str], directory: str) -> _core.Scene:
    """Reads TOML text of which the user has not seen the lines: errors are without them, and name the key all the same. Those in a start
    file keep its name, line and column."""
    try:
        return _core.Scene.parse(text, source, overrides, directory)
    except SceneError as error:
        if error.line and error.source != source:
            raise
        raise SceneError(error.sentence) from None


def scene_of_parts(text: str, source: str, overrides: list[str], directory: str) -> Scene:
    """Returns the scene of which `Scene.parts()` has told the parts."""
    return Scene._of(_core.Scene.parse(text, source, overrides, directory), directory)


def as_scene(scene: SceneLike) -> Scene:
    """Returns the scene that a path or a mapping stands for."""
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, Mapping):
        return Scene(scene)
    if isinstance(scene, (str, PathLike)):
        return Scene.load(scene)
    raise TypeError(f"{shown(scene)} is no scene; give a carom.Scene, the path of a scene file, or a mapping")


def _is_start(positions: npt.ArrayLike | Start) -> TypeGuard[Start]:
    return hasattr(positions, "positions")


def build() -> dict[str, str]:
    """Returns the facts about this build: version, commit, compiler, flags, instructions."""
    return _core.build()
