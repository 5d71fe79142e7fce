"""Many runs of one scene, side by side: a grid of changes, several seeds each, one table with means and errors."""

from __future__ import annotations

import copy
import hashlib
import itertools
import math
import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from os import PathLike
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from carom import _arguments
from carom._errors import Interrupted, SceneError
from carom._progress import Progress, reporting
from carom._toml import value_text
from carom.results import Table, with_error
from carom.runs import Observables, Result, _with_observables, run
from carom.scene import Scene, SceneLike, as_scene, build
from carom.simulation import Simulation

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from matplotlib.axes import Axes

    from carom._finished_runs import FinishedRuns

#: Values by key, every combination being a point; or a list of points, each a mapping of keys to one value.
Points = Union[Mapping[str, Any], Sequence[Mapping[str, Any]]]

#: Numbers with a shorter name than in summary.json, as `carom.Result` has it.
_SHORT = {"pressure.Z": "Z"}


@dataclass(frozen=True, eq=False)
class Sweep:
    """The results of many runs of one scene.

    Attributes:
        scene: the scene that the points change.
        keys: what changes, as it was given.
        table: a row for each point: its values, how many runs are `finished` and `failed`, and for every number the mean over the
            seeds and its standard error, NAME_error; nan where there are too few. Numbers are called as in summary.json,
            "events.pair", and those of observables "observables.NAME.NUMBER"; "pressure.Z" is "Z".
        runs: a row for each run: its values, seed, state ("finished", "failed" or "missing"), why it stopped, the hash of its final
            state, the numbers, and the sentence of a failure.
    """

    scene: Scene
    keys: list[str]
    table: Table = field(repr=False)
    runs: Table = field(repr=False)

    @property
    def failed(self) -> int:
        """The number of runs that have failed; `runs` says why."""
        return int((self.runs["state"] == "failed").sum())

    @property
    def complete(self) -> bool:
        """Whether every run is finished."""
        return bool((self.runs["state"] == "finished").all())

    def plot(self, x: str | None = None, y: str | None = None, ax: Axes | None = None, **style: Any) -> Axes:
        """Draws a number with its errors over a key, a line for each combination of the other keys. Needs matplotlib.

        Args:
            x: the key along the axis; None: the first one.
            y: the number; None: "Z", or the first one.
            ax: where to draw; None: a figure of its own.
            style: what matplotlib's errorbar() takes besides.
        """
        import matplotlib.pyplot as plt

        x = x or self.keys[0]
        numbers = [name.removesuffix("_error") for name in self.table if name.endswith("_error")]
        y = y or ("Z" if "Z" in numbers else numbers[0])
        axes = plt.subplots()[1] if ax is None else ax
        others = [key for key in self.keys if key != x]
        lines: dict[str, list[int]] = {}
        for row in range(self.table.rows):
            lines.setdefault(", ".join(f"{key} = {self.table[key][row]}" for key in others), []).append(row)
        for label, rows in lines.items():
            errors = self.table[f"{y}_error"][rows] if f"{y}_error" in self.table else None
            drawn = {"label": label, "marker": "o", "capsize": 2, **style}
            axes.errorbar(self.table[x][rows], self.table[y][rows], errors, **drawn)
        axes.set_xlabel(self.table.label(x))
        axes.set_ylabel(self.table.label(y))
        if others:
            axes.legend()
        return axes

    def _in_words(self) -> Table:
        """The table with each number and its error in one cell."""
        columns: dict[str, npt.ArrayLike] = {}
        for name in self.table:
            error = f"{name}_error"
            if error in self.table:
                columns[name] = _column([_mean_in_words(*pair) for pair in zip(self.table[name], self.table[error], strict=True)])
            elif not name.endswith("_error"):
                columns[name] = self.table[name]
        return Table(columns, self.table.units, self.table.title)

    def __str__(self) -> str:
        return str(self._in_words())

    def _repr_html_(self) -> str:
        return self._in_words()._repr_html_()


def sweep(
    scene: SceneLike,
    points: Points,
    *,
    seeds: int | Iterable[int] = range(8),
    numbers: Sequence[str] | None = None,
    observables: Observables | None = None,
    engine: str = "auto",
    method: str | None = None,
    dt: float | None = None,
    stiffness: float | None = None,
    workers: int | None = None,
    executor: Executor | None = None,
    out: str | PathLike[str] | None = None,
    progress: Progress | None = None,
) -> Sweep:
    """Runs a scene at many points with several seeds each, and gives means over the seeds with their standard errors.

    >>> swept = carom.sweep(carom.Scene.preset("box"), {"disks.0.radius": [0.01, 0.02]}, seeds=[1, 2])
    >>> swept.table["disks.0.radius"].tolist(), swept.table["finished"].tolist()
    ([0.01, 0.02], [2, 2])

    Each run is `carom.run()` of the scene with the point's values and its seed. Results depend neither on the executor nor on the
    number of its workers.

    Args:
        scene: a Scene, the path of a scene file, or a mapping.
        points: values by key, {"packing_fraction": [0.1, 0.2]}: every combination is a point, and the first key changes last. Or a
            list of points, [{"disks.0.radius": 0.1, "disks.0.count": 50}, ...]. Keys are those of `Scene.set()`, or their ends
            where no other key of the scene ends so: "packing_fraction" for "disks.0.packing_fraction". Of points that have the same
            scene the first one stays, and a RuntimeWarning names the others.
        seeds: of the runs at every point; a number n: the scene's own seed and those after it.
        numbers: names of numbers of summary.json, such as "pressure.Z_error"; or of a table of an observable, the value of a column
            where its first column has a value, "observables.mean_square_displacement.diffusion@5"; None: the usual ones, and all
            scalars of observables.
        observables, engine, method, dt, stiffness: as for `carom.run()`. Each run has its own copy of an observable of one's own.
        workers: how many threads run side by side; None: one for each processor.
        executor: in place of threads, anything with the interface of `concurrent.futures.Executor`: a ProcessPoolExecutor, an
            MPIPoolExecutor, `get_executor()` of a dask.distributed client.
        out: a directory that keeps each finished run in runs.jsonl. The same call goes on from there after it was stopped or
            killed, and so does one with more seeds or values; a run that has failed is tried again.
        progress: True for a bar (needs tqdm), or a function of the fraction done.

    Raises:
        Interrupted: on Ctrl-C, after the workers have stopped; its `result` is a Sweep with the runs that are finished.
        SceneError: where a point makes a scene wrong; nothing has run then. ValueError: where another argument is wrong.
        OutputError: where `out` cannot be written, or holds runs of something else.
    """
    base, own = _with_observables(as_scene(scene), observables)
    keys, values = _points(points)
    full = _full_keys(base, keys)
    values, scenes = _different(values, [_scene_at(base, keys, full, point) for point in values])
    seed_list = _seeds(seeds, base)
    step = None if dt is None else _arguments.real(dt, "dt")
    spring = None if stiffness is None else _arguments.real(stiffness, "stiffness")
    if not (engine == "auto" and method is None and step is None and spring is None):
        first_step = scenes[0]._core.sample_every if step is None and method is not None else step
        # Whatever is wrong with these is said before anything runs.
        Simulation(scenes[0], engine=engine, method=method, dt=first_step, stiffness=spring)
    if numbers is not None:
        from carom import _files

        numbers = _arguments.list_of_words(numbers, "numbers")
        _files.require_numbers(scenes[0]._core, numbers)
    if executor is not None and workers is not None:
        raise ValueError("an executor has workers of its own; leave out one of the two")
    if workers is not None:
        workers = _arguments.whole(workers, "workers", 1)

    in_tables = tuple(name for name in numbers or () if "@" in name)
    settings = {"engine": engine, "method": method, "dt": step, "stiffness": spring, "observables": own}
    orders = [
        _Order(at, seed, tuple(value_text(point.get(key), key) if key in point else "" for key in keys), point_scene, settings, in_tables)
        for at, (point, point_scene) in enumerate(zip(values, scenes, strict=True))
        for seed in seed_list
    ]
    found: dict[tuple[int, int], _Found] = {}
    with _kept(out, base, full, settings, orders) as kept, reporting(progress, "sweep") as report_fraction:
        for order in orders:
            earlier = None if kept is None else kept.find(order.name(full))
            # One that was kept without a number that is now asked for runs again.
            if earlier is not None and all(name in earlier["numbers"] for name in in_tables):
                found[order.at, order.seed] = earlier

        def keep(order: _Order, outcome: _Found | None) -> None:
            if outcome is not None:
                found[order.at, order.seed] = outcome
                if kept is not None and outcome["state"] == "finished":
                    kept.add(order.name(full), outcome)
                if report_fraction is not None:
                    report_fraction(len(found) / len(orders))

        to_do = [order for order in orders if (order.at, order.seed) not in found]
        interrupted = False
        try:
            if to_do and executor is None:
                from concurrent.futures import ThreadPoolExecutor

                with ThreadPoolExecutor(workers or _processors(), thread_name_prefix="carom.sweep") as threads:
                    _run_all(threads, to_do, keep)
            elif to_do and executor is not None:
                _run_all(executor, to_do, keep)
        except KeyboardInterrupt:
            interrupted = True
    swept = _tables(base, keys, full, values, seed_list, found, numbers)
    if interrupted:
        raise Interrupted(swept)
    if swept.failed:
        failures = [failure for failure in swept.runs["failure"] if failure]
        sentence = f"{swept.failed} of {len(orders)} runs failed, as Sweep.runs says; the first: {failures[0]}"
        warnings.warn(sentence, RuntimeWarning, stacklevel=2)
    return swept


#: What is known of a run: state, and where it is finished stopped, state_hash, numbers and units by name; else failure.
_Found = dict[str, Any]


@dataclass(frozen=True)
class _Order:
    """One run, as it goes to a worker."""

    at: int  #: number of its point
    seed: int
    values: tuple[str, ...]  #: of the keys, in TOML; empty where the scene's own stays
    scene: Scene
    settings: dict[str, Any]  #: arguments of carom.run()
    in_tables: tuple[str, ...]  #: the numbers that come from tables of observables

    def name(self, keys: Sequence[str]) -> dict[str, Any]:
        """What tells this run from the others of the sweep."""
        return {"values": dict(zip(keys, self.values, strict=True)), "seed": self.seed}


class _Stop(Exception):
    """The sweep has been stopped."""


class _StopFlag:
    """Tells workers, threads or other processes, to stop once a file is no longer there. Workers on other machines, which cannot see
    the file, complete what they have begun."""

    def __init__(self, path: str) -> None:
        self.path, self.host = path, os.uname().nodename

    def check(self, fraction: float = 0.0) -> None:
        """Raises _Stop where the sweep has been stopped. It takes the fraction done, as a progress callback of `run()` does."""
        if os.uname().nodename == self.host and not os.path.exists(self.path):
            raise _Stop


def _carry_out(order: _Order, stop_flag: _StopFlag) -> _Found | None:
    """Does one run in a worker. None where it was stopped."""
    import json

    from carom import _files

    try:
        stop_flag.check()
        result = run(order.scene, seed=order.seed, threads=1, progress=stop_flag.check, **copy.deepcopy(order.settings))
    except (KeyboardInterrupt, _Stop):
        return None
    except (ValueError, RuntimeError, MemoryError) as error:
        return {"state": "failed", "failure": str(error) or type(error).__name__}
    if not result.summary.get("measured", True):
        return {"state": "failed", "failure": f"the run ended while it was still equilibrating ({result.stopped})"}
    numbers = _files.numbers_in(json.dumps(result.summary))
    return {
        "state": "finished",
        "stopped": str(result.stopped),
        "state_hash": result.state_hash,
        "numbers": {name: value for name, value, _ in numbers} | {name: _value_at(result, name)[0] for name in order.in_tables},
        "units": {name: unit for name, _, unit in numbers if unit}
        | {name: unit for name in order.in_tables if (unit := _value_at(result, name)[1])},
    }


def _value_at(result: Result, name: str) -> tuple[float | None, str]:
    """The number "observables.TABLE.COLUMN@VALUE" of a run, on a straight line between two rows of the table, and its unit."""
    title, _, rest = name.removeprefix("observables.").partition(".")
    column, _, where = rest.rpartition("@")
    for measured in result.observables.values():
        table = measured.tables.get(title)
        if table is None or column not in table:
            continue
        x, y, at = table[next(iter(table))], table[column], float(where)
        unit = table.units.get(column, "")
        near = np.flatnonzero(np.abs(x - at) <= 1e-9 * np.abs(at))
        if len(near):
            value = float(y[near[0]])
        elif len(x) and x[0] < at < x[-1] and bool((np.diff(x) > 0).all()):
            value = float(np.interp(at, x, y))
        else:
            return None, unit
        return (value if math.isfinite(value) else None), unit
    return None, ""


def _run_all(executor: Executor, orders: Sequence[_Order], keep: Callable[[_Order, _Found | None], None]) -> None:
    """Hands out all runs, and keeps each as it comes. Whatever is raised stops the others, and those that have come are kept."""
    import queue
    import tempfile

    ended: queue.SimpleQueue[Future[_Found | None]] = queue.SimpleQueue()
    futures: dict[Future[_Found | None], _Order] = {}
    with tempfile.NamedTemporaryFile(prefix="carom-sweep-") as file:
        stop_flag = _StopFlag(file.name)
        try:
            for order in orders:
                future = executor.submit(_carry_out, order, stop_flag)
                futures[future] = order
                future.add_done_callback(ended.put)
            while futures:
                future = ended.get()
                keep(futures[future], future.result())
                del futures[future]
        finally:
            for future in futures:
                future.cancel()
            for future, order in futures.items():
                if future.done() and not future.cancelled() and future.exception() is None:
                    keep(order, future.result())


def _mean_in_words(mean: float, error: float) -> str:
    """A mean with its error, unless that is what rounding leaves of seeds that agree."""
    if math.isnan(mean):
        return ""
    return with_error(mean, error) if error > 1e-9 * abs(mean) else f"{mean:.6g}"


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _points(points: Points) -> tuple[list[str], list[dict[str, Any]]]:
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


def _full_keys(scene: Scene, keys: Sequence[str]) -> list[str]:
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


def _scene_at(base: Scene, keys: Sequence[str], full: Sequence[str], point: Mapping[str, Any]) -> Scene:
    try:
        return base.set({name: point[key] for key, name in zip(keys, full, strict=True) if key in point})
    except SceneError as error:
        raise SceneError(f"the scene of the point {_point_text(point)} is refused: {error.sentence}") from None


def _different(points: Sequence[dict[str, Any]], scenes: Sequence[Scene]) -> tuple[list[dict[str, Any]], list[Scene]]:
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


def _seeds(seeds: int | Iterable[int], scene: Scene) -> list[int]:
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


@contextmanager
def _kept(
    out: str | PathLike[str] | None, scene: Scene, keys: Sequence[str], settings: Mapping[str, Any], orders: Sequence[_Order]
) -> Iterator[FinishedRuns | None]:
    """Opens the runs that are finished in `out`; None where nothing is kept."""
    out = None if out is None else _arguments.path_text(out, "out")
    if out is None:
        yield None
        return
    from carom._finished_runs import FinishedRuns

    own = [f"{type(observable).__module__}.{type(observable).__qualname__}" for observable in settings["observables"]]
    made = build()
    about = {
        "scene": scene.toml,
        "keys": list(keys),
        "settings": {**settings, "observables": own},
        "build": f"{made['version']} {made['commit']}",
    }
    with FinishedRuns(out, about, [order.name(keys) for order in orders]) as kept:
        yield kept


def _column(values: Sequence[Any]) -> npt.NDArray[Any]:
    """Numbers as numbers, nan where there is none; all else as it is."""
    if all(value is None or (isinstance(value, (int, float, np.number)) and not isinstance(value, bool)) for value in values):
        return np.array([math.nan if value is None else value for value in values])
    column = np.empty(len(values), dtype=object)
    column[:] = list(values)
    return column


def _tables(
    scene: Scene,
    keys: list[str],
    full: Sequence[str],
    points: Sequence[Mapping[str, Any]],
    seeds: Sequence[int],
    found: Mapping[tuple[int, int], _Found],
    wanted: Sequence[str] | None,
) -> Sweep:
    from carom import _files

    names = list(_numbers(found, keys) if wanted is None else wanted)
    units = {key: unit for key, name in zip(keys, full, strict=True) if (unit := _files.unit_of_key(name))}
    units |= {_SHORT.get(n, n): one["units"][n] for one in found.values() for n in names if n in one.get("units", ())}
    units |= {f"{name}_error": unit for name, unit in units.items() if name not in keys}
    missing: _Found = {"state": "missing"}
    all_runs = [(at, seed, found.get((at, seed), missing)) for at in range(len(points)) for seed in seeds]

    def number(one: _Found, name: str) -> float | None:
        value: float | None = one.get("numbers", {}).get(name)
        return value

    columns: dict[str, npt.ArrayLike] = {key: _column([points[at].get(key) for at, _, _ in all_runs]) for key in keys}
    columns["seed"] = [seed for _, seed, _ in all_runs]
    columns |= {what: _column([one.get(what, "") for _, _, one in all_runs]) for what in ("state", "stopped", "state_hash")}
    columns |= {_SHORT.get(name, name): _column([number(one, name) for _, _, one in all_runs]) for name in names}
    columns["failure"] = _column([one.get("failure", "") for _, _, one in all_runs])
    runs = Table(columns, units, "Runs")

    rows = [[one for here, _, one in all_runs if here == at] for at in range(len(points))]
    columns = {key: _column([point.get(key) for point in points]) for key in keys}
    columns |= {state: [sum(one["state"] == state for one in row) for row in rows] for state in ("finished", "failed")}
    for name in names:
        averages = [_files.average([number(one, name) for one in row]) for row in rows]
        columns[_SHORT.get(name, name)] = np.array([math.nan if mean is None else mean for mean, _ in averages])
        columns[f"{_SHORT.get(name, name)}_error"] = np.array([math.nan if error is None else error for _, error in averages])
    return Sweep(scene, keys, Table(columns, units, f"Means over {len(seeds)} seeds" if len(seeds) > 1 else "One seed"), runs)


def _numbers(found: Mapping[tuple[int, int], _Found], keys: Sequence[str]) -> list[str]:
    """The usual numbers that any run has, in the order of their runs; a key of the sweep is none."""
    from carom import _files

    ordered = (one.get("numbers", {}) for _, one in sorted(found.items()))
    names = dict.fromkeys(name for numbers in ordered for name, value in numbers.items() if value is not None)
    return [name for name in names if name not in keys and _files.is_usual_number(name)]
