"""Many runs of one scene, side by side: a grid of changes, several seeds each, one table with means and errors."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from carom import _arguments
from carom._errors import Interrupted
from carom._progress import Progress, reporting
from carom._sweep_points import Points, different, full_keys, points_of, scene_at, seeds_of
from carom._sweep_workers import Found, Order, run_all
from carom._toml import value_text
from carom.results import Table, with_error
from carom.runs import Observables, _with_observables
from carom.scene import Scene, SceneLike, as_scene, build
from carom.simulation import Simulation

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from matplotlib.axes import Axes

    from carom._finished_runs import FinishedRuns
    from carom.observables import Observable

#: Numbers with a shorter name than in summary.json, as `carom.Result` has it.
_SHORT = {"pressure.Z": "Z"}

#: Columns of the tables that say how runs went.
_OF_RUNS = ("seed", "state", "stopped", "state_hash", "failure", "finished", "failed")


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
    keys, values = points_of(points)
    full = full_keys(base, keys)
    values, scenes = different(values, [scene_at(base, keys, full, point) for point in values])
    seed_list = seeds_of(seeds, base)
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
        _require_columns_of_their_own(numbers, keys)
    if executor is not None and workers is not None:
        raise ValueError("an executor has workers of its own; leave out one of the two")
    if workers is not None:
        workers = _arguments.whole(workers, "workers", 1)

    in_tables = tuple(name for name in numbers or () if "@" in name)
    settings = {"engine": engine, "method": method, "dt": step, "stiffness": spring, "observables": own}
    orders = [
        Order(at, seed, tuple(value_text(point.get(key), key) if key in point else "" for key in keys), point_scene, settings, in_tables)
        for at, (point, point_scene) in enumerate(zip(values, scenes, strict=True))
        for seed in seed_list
    ]
    found: dict[tuple[int, int], Found] = {}
    with _kept(out, base, full, settings, orders) as kept, reporting(progress, "sweep") as report_fraction:
        for order in orders:
            earlier = None if kept is None else kept.find(order.name(full))
            # One that was kept without a number that is now asked for runs again.
            if earlier is not None and all(name in earlier["numbers"] for name in in_tables):
                found[order.at, order.seed] = earlier

        def keep(order: Order, outcome: Found | None) -> None:
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
                    run_all(threads, to_do, keep)
            elif to_do and executor is not None:
                run_all(executor, to_do, keep)
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


def _mean_in_words(mean: float, error: float) -> str:
    """A mean with its error, unless that is what rounding leaves of seeds that agree."""
    if math.isnan(mean):
        return ""
    return with_error(mean, error) if error > 1e-9 * abs(mean) else f"{mean:.6g}"


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def _kept(
    out: str | PathLike[str] | None, scene: Scene, keys: Sequence[str], settings: Mapping[str, Any], orders: Sequence[Order]
) -> Iterator[FinishedRuns | None]:
    """Opens the runs that are finished in `out`; None where nothing is kept."""
    out = None if out is None else _arguments.path_text(out, "out")
    if out is None:
        yield None
        return
    from carom._finished_runs import FinishedRuns

    own = [_in_words_and_digest(observable) for observable in settings["observables"]]
    made = build()
    about = {
        "scene": scene.toml,
        "keys": list(keys),
        "settings": {**settings, "observables": own},
        "build": f"{made['version']} {made['commit']}",
    }
    with FinishedRuns(out, about, [order.name(keys) for order in orders]) as kept:
        yield kept


def _in_words_and_digest(observable: Observable) -> str:
    """Returns the class of an observable and a checksum of what it holds: of other settings it measures something else."""
    import hashlib

    name = f"{type(observable).__module__}.{type(observable).__qualname__}"
    try:
        return f"{name} {hashlib.sha256(observable._save()).hexdigest()[:16]}"
    except Exception:  # which pickle raises of many kinds
        return name


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
    found: Mapping[tuple[int, int], Found],
    wanted: Sequence[str] | None,
) -> Sweep:
    from carom import _files

    names = list(_numbers(found, keys) if wanted is None else wanted)
    units = {key: unit for key, name in zip(keys, full, strict=True) if (unit := _files.unit_of_key(name))}
    units |= {_SHORT.get(n, n): one["units"][n] for one in found.values() for n in names if n in one.get("units", ())}
    units |= {f"{name}_error": unit for name, unit in units.items() if name not in keys}
    missing: Found = {"state": "missing"}
    all_runs = [(at, seed, found.get((at, seed), missing)) for at in range(len(points)) for seed in seeds]

    def number(one: Found, name: str) -> float | None:
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


def _require_columns_of_their_own(numbers: Sequence[str], keys: Sequence[str]) -> None:
    """Raises ValueError for a number whose column would take the place of another one."""
    taken = dict.fromkeys(keys, "the values of that key") | dict.fromkeys(_OF_RUNS, "runs")
    taken |= {f"{_SHORT.get(name, name)}_error": f"the standard error of {name} over seeds" for name in numbers}
    for name in numbers:
        if (what := taken.get(_SHORT.get(name, name))) is not None:
            raise ValueError(f"numbers: the table has a column {_SHORT.get(name, name)} for {what}; leave {name} out, or ask for it in another sweep")


def _numbers(found: Mapping[tuple[int, int], Found], keys: Sequence[str]) -> list[str]:
    """The usual numbers that any run has, in the order of their runs; a key of the sweep is none."""
    from carom import _files

    ordered = (one.get("numbers", {}) for _, one in sorted(found.items()))
    names = dict.fromkeys(name for numbers in ordered for name, value in numbers.items() if value is not None)
    return [name for name in names if name not in keys and _files.is_usual_number(name)]
