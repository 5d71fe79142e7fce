"""Points and seeds of a sweep, and the scenes that they make."""

from __future__ import annotations

import hashlib
import itertools
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Union

import numpy as np

from carom import _arguments
from carom._errors import SceneError
from carom.scene import Scene

#: Values by key, every combination being a point; or a list of points, each a mapping of keys to one value.
Points = Union[Mapping[str, Any], Sequence[Mapping[str, Any]]]


def points_of(points: Points) -> tuple[list[str], list[dict[str, Any]]]:
    """Returns the keys and the points of a grid or a list."""
    if isinstance(points, Mapping):
        grid = {key: _values(key, values) for key, values in points.items()}
        return _checked_keys(grid), [dict(zip(grid, combination, strict=True)) for combination in itertools.product(*grid.values())]
    if not isinstance(points, Sequence) or not all(isinstance(point, Mapping) for point in points):
        example = '{"packing_fraction": [0.1, 0.2]}'
        raise TypeError(f"{_arguments.shown(points)} are no points; give values by key, such as {example}, or a list of points")
    keys = list(dict.fromkeys(key for point in points for key in point))
    if not points:
        raise ValueError("there are no points; give one at least")
    return _checked_keys(keys), [dict(point) for point in points]


def _values(key: str, values: Any) -> list[Any]:
    if isinstance(values, (str, bytes, Mapping)) or not isinstance(values, Iterable):
        return [values]
    listed = values.tolist() if isinstance(values, np.ndarray) else list(values)
    if not listed:
        raise ValueError(f"{key}: there are no values; give one at least")
    return listed


def _checked_keys(keys: Iterable[Any]) -> list[str]:
    listed = list(keys)
    for key in listed:
        if not isinstance(key, str):
            raise TypeError(f"the key {_arguments.shown(key)} is no string; keys are those of Scene.set(), such as \"disks.0.radius\"")
        if key in ("run.seed", "seed"):
            raise ValueError("run.seed cannot be swept; use seeds")
    return listed


def full_keys(scene: Scene, keys: Sequence[str]) -> list[str]:
    """Returns the whole of keys of which only the end was given."""
    import tomllib

    # A key that was given need not be among those with every default: "packing_fraction" has become a radius there.
    changed = [change.split("=")[0].strip() for change in scene._core.overrides]
    known = list(dict.fromkeys([*_keys_in(scene.to_dict()), *_keys_in(tomllib.loads(scene.text)), *changed]))
    tops = {key.split(".")[0] for key in known}

    def full(key: str) -> str:
        if key in known or key.split(".")[0] in tops:
            return key
        ends = [other for other in known if other.endswith(f".{key}")]
        if len(ends) > 1:
            raise ValueError(f"{key}: {len(ends)} keys of the scene end so: {', '.join(ends)}; give one of them")
        if not ends and "." not in key:
            raise ValueError(f"{key}: no key of the scene ends so; give a whole one, with its table, such as \"disks.0.radius\"")
        return ends[0] if ends else key

    return [full(key) for key in keys]


def _keys_in(value: Any, path: str = "") -> Iterator[str]:
    """All keys of nested mappings and lists of mappings, joined by dots."""
    entries = value.items() if isinstance(value, Mapping) else enumerate(value)
    for key, entry in entries:
        here = f"{path}.{key}" if path else str(key)
        yield here
        if isinstance(entry, Mapping) or (isinstance(entry, list) and entry and isinstance(entry[0], Mapping)):
            yield from _keys_in(entry, here)


def scene_at(base: Scene, keys: Sequence[str], full: Sequence[str], point: Mapping[str, Any]) -> Scene:
    """Returns the scene of a point. Raises SceneError, which names the point, where it is refused."""
    try:
        return base.set({name: point[key] for key, name in zip(keys, full, strict=True) if key in point})
    except SceneError as error:
        sentence = f"the scene of the point {_point_text(point)} is refused: {error.sentence}"
        raise SceneError(sentence, error.source, error.line, error.column) from None


def different(points: Sequence[dict[str, Any]], scenes: Sequence[Scene]) -> tuple[list[dict[str, Any]], list[Scene]]:
    """Returns the points whose scenes are all different, with them: of several that have one scene, such as those of 1 and 1.0, the
    first. A warning names the others."""
    first: dict[bytes, int] = {}
    repeated = []
    for at, scene in enumerate(scenes):
        earlier = first.setdefault(hashlib.sha256(scene._core.toml.encode()).digest(), at)
        if earlier != at:
            repeated.append(f"{_point_text(points[at])} (that of {_point_text(points[earlier])})")
    if repeated:
        more = f" and {len(repeated) - 3} more" if len(repeated) > 3 else ""
        sentence = f"points whose scene another one has already are left out: {'; '.join(repeated[:3])}{more}"
        warnings.warn(sentence, RuntimeWarning, stacklevel=3)
    return [points[at] for at in first.values()], [scenes[at] for at in first.values()]


def _point_text(point: Mapping[str, Any]) -> str:
    return ", ".join(f"{key} = {_arguments.shown(value)}" for key, value in point.items())


def seeds_of(seeds: int | Iterable[int], scene: Scene) -> list[int]:
    """Returns the seeds of a list, or so many of them from the scene's own on. Raises TypeError and ValueError for what is none."""
    if isinstance(seeds, (int, np.integer)):
        first = int(scene._core.seed)
        seeds = range(first, first + _arguments.whole(seeds, "seeds", 0, 1_000_000))
    if isinstance(seeds, str) or not isinstance(seeds, Iterable):
        raise TypeError(f"seeds is {_arguments.shown(seeds)}; give a list of whole numbers, or how many there are to be")
    listed = [_arguments.whole(seed, "a seed") for seed in seeds]
    if not listed:
        raise ValueError("there are no seeds; give one at least")
    if len(set(listed)) < len(listed):
        raise ValueError(f"the seeds {listed} hold one twice; leave it out")
    return listed
