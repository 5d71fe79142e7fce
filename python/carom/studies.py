"""What accuracy costs, where two runs part, and whether the engine holds against theory and hard cases.

The studies are the program's, `carom compare`, `diff`, `validate` and `hardcases`, with the same numbers and sentences.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from os import PathLike
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from carom import _arguments
from carom._errors import Interrupted
from carom._hdf5 import hdf5
from carom._progress import Progress, reporting
from carom._study_tools import column_of_numbers, column_of_words, naming_arguments, paragraphs

# Programs and pickles of earlier versions look for these names here.
from carom.horizons import Horizon as Horizon, LyapunovSpectrum as LyapunovSpectrum
from carom.horizons import horizon as horizon, lyapunov_spectrum as lyapunov_spectrum
from carom.pages import Page
from carom.results import Table
from carom.scene import SceneLike, as_scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from carom.runs import Result
    from carom.stored_runs import Run

    RunLike: TypeAlias = str | PathLike[str] | Run | Result


@dataclass(frozen=True, eq=False)
class Comparison:
    """What accuracy costs: one start moved by exact events and in fixed steps, each held against 113 bits.

    Attributes:
        summary: everything in numbers, with the keys of compare.json (docs/output.md).
        runs: a row for each run of a method from one start, with the columns of compare.csv. Errors are in mean diameters, clocks
            in seconds of processor time.
        prices: a row for each method and target: processor time over that of the exact engine.
    """

    summary: dict[str, Any] = field(repr=False)
    runs: Table = field(repr=False)
    prices: Table = field(repr=False)
    _text: str = field(repr=False)
    _html: str = field(repr=False)

    @property
    def sentences(self) -> list[str]:
        """The answer in sentences, the most important first."""
        return list(self.summary["sentences"])

    @property
    def answers(self) -> dict[str, Any]:
        """The answers in numbers: the exact engine, its time and error, the order of the fixed steps, where they are cheaper."""
        return dict(self.summary["answers"])

    @property
    def best_fixed_step(self) -> str | None:
        """The fixed-step method that is cheapest for an error of 1e-6 diameters; None where none comes so far."""
        best: str | None = self.summary["best_fixed_step"]
        return best

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws error against cost, a line for each method: how long it computes for which error. Needs matplotlib.

        Args:
            ax: where to draw; None: a figure of its own. The legend is to the right of it.
        """
        import matplotlib.pyplot as plt

        axes = plt.subplots(figsize=(8, 4.8), layout="constrained")[1] if ax is None else ax
        methods: dict[str, list[tuple[float, float]]] = {}
        for one in self.summary["summary"]:
            error, seconds = one["error_early"]["median"], one["seconds_early"]
            if error and seconds:  # an error of 0 has no place on a logarithmic axis
                methods.setdefault(one["method"], []).append((seconds, error))
        exact = {one["method"] for one in self.summary["summary"] if one["dt"] == 0}
        for name, points in methods.items():
            seconds, errors = zip(*points, strict=True)
            style: dict[str, Any] = {"linestyle": "none", "marker": "*", "markersize": 11} if name in exact else {"marker": "."}
            axes.plot(seconds, errors, label=name, **style)
        axes.set(xscale="log", yscale="log")
        until = self.summary["plan"]["early_time"]
        axes.set_xlabel(f"processor time until t = {until:.4g} (s)")
        axes.set_ylabel("rms error of positions there (mean diameters)")
        axes.legend(fontsize="small", loc="center left", bbox_to_anchor=(1.0, 0.5))  # inside it would cover points
        return axes

    def page(self) -> Page:
        """Returns the page that `carom compare` writes as report.html."""
        return Page(self._html)

    def __repr__(self) -> str:
        return f"<carom.Comparison: {self.sentences[0]}>"

    def __str__(self) -> str:
        return self._text.rstrip("\n")

    def _repr_html_(self) -> str:
        return paragraphs(self.sentences) + self.prices._repr_html_()


@dataclass(frozen=True, eq=False)
class Difference:
    """Two runs of the same disks, side by side.

    Attributes:
        summary: everything in numbers, as `carom diff --json` prints it (docs/output.md).
        distances: a row for each sample time that both have: the rms and the largest distance of the disks, and which is farthest
            apart.
    """

    summary: dict[str, Any] = field(repr=False)
    distances: Table = field(repr=False)
    _text: str = field(repr=False)

    @property
    def same(self) -> bool:
        """Whether the final states and all samples are equal to the last bit."""
        return bool(self.summary["same"])

    @property
    def sentence(self) -> str:
        """Whether they are the same run, and up to where."""
        return self._text.split("\n", 1)[0]

    def __repr__(self) -> str:
        return f"<carom.Difference: {self.sentence}>"

    def __str__(self) -> str:
        return self._text.rstrip("\n")

    def _repr_html_(self) -> str:
        return paragraphs([self.sentence]) + self.distances._repr_html_()


@dataclass(frozen=True, eq=False)
class Validation:
    """The engine held against kinetic theory and the literature.

    Attributes:
        summary: everything in numbers, with the keys of validation.json (docs/output.md).
        checks: a row for each check. `z` is the whole difference in standard errors; the verdict allows for the `allowance`, the
            bound on the error of the theory itself.
        sentence: how many checks there are, and whether all hold.
        complete: whether every trial has run.
    """

    summary: dict[str, Any] = field(repr=False)
    checks: Table = field(repr=False)
    sentence: str
    complete: bool
    _html: str = field(repr=False)

    @property
    def failed(self) -> int:
        """The number of checks that do not hold."""
        return int(self.summary["failed"])

    @property
    def passed(self) -> bool:
        """Whether every trial has run and every check holds."""
        return self.complete and self.failed == 0

    def page(self) -> Page:
        """Returns the page that `carom validate` writes as report.html."""
        return Page(self._html)

    def __str__(self) -> str:
        return f"{self.checks}\n\n{self.sentence}"

    def _repr_html_(self) -> str:
        return paragraphs([self.sentence]) + self.checks._repr_html_()


def compare(
    scene: SceneLike,
    *,
    seeds: int | None = None,
    dts: float | Sequence[float] | None = None,
    longest: float = 0.3,
    stiffness: float | None = None,
    engine: str = "auto",
    costs: bool = True,
    progress: Progress | None = None,
) -> Comparison:
    """Measures what accuracy costs: exact events in four precisions, and all fixed-step methods over a ladder of steps.

    A run of a minute or more for some dozens of disks; `dts=0.001` is the short study.

    Args:
        scene: a Scene, the path of a scene file, or a mapping.
        seeds: the number of starts, the scene's seed and those after it; None: 8, or 1 with a single step.
        dts: time steps; None: three per decade, from two mean free times down. A single one is the short study: one start, and no
            other sizes and densities.
        longest: seconds of processor time that one run may take; longer ones are left out.
        stiffness: of the springs of the method "soft", force per overlap; None: such that the shortest contact takes 30 steps.
        engine: of the scene's own run: "auto", "fast" or "textbook".
        costs: whether the cost of other sizes and densities is measured too.
        progress: True for a bar (needs tqdm), or a function of the fraction done.

    Raises:
        SceneError: where the scene is wrong; ValueError: where an argument is, or something acts that fixed steps do not know.
    """
    import csv
    import io
    import json

    from carom import _files

    steps = [] if dts is None else _arguments.numbers(np.atleast_1d(dts), "dts").tolist()
    starts = None if seeds is None else _arguments.whole(seeds, "seeds")
    limit = _arguments.real(longest, "longest")
    spring = None if stiffness is None else _arguments.real(stiffness, "stiffness")
    core = as_scene(scene)._core
    with naming_arguments(), reporting(progress, "compare") as report_fraction:
        parts = _files.compare(core, steps, starts, limit, spring, _arguments.words(engine, "engine"), bool(costs), report_fraction)
    summary: dict[str, Any] = json.loads(parts[0])
    header, *rows = csv.reader(io.StringIO(parts[1]))
    runs = {name: _column([row[k] for row in rows], name) for k, name in enumerate(header)}
    return Comparison(summary, Table(runs, _UNITS_OF_RUNS, "Runs"), _prices(summary["prices"]), parts[2], parts[3])


def diff(a: RunLike, b: RunLike) -> Difference:
    """Says whether two runs of the same disks are equal to the last bit, and where they part.

    Args:
        a, b: directories of runs, trajectory files, or what `carom.run(out=...)` and `carom.open_run()` return.

    Raises:
        OutputError: where there is no such run, or the disks, the boxes or all sample times of the two differ.
    """
    import json

    from carom import _files

    paths = _path_of(a), _path_of(b)
    with hdf5():
        text, words = _files.difference(*paths)
    summary: dict[str, Any] = json.loads(text)
    columns = {name: [row[name] for row in summary["distances"]] for name in ("time", "rms", "largest", "disk")}
    units = {"time": "time", "rms": "diameters", "largest": "diameters"}
    return Difference(summary, Table(columns, units, "Distances of the disks"), words)


def _path_of(run: RunLike) -> str:
    directory = getattr(run, "directory", run)
    if directory is None:
        raise ValueError("this run has written no files; give it out=\"directory\"")
    return _arguments.path_text(directory, "a run")


def beside(
    scene: SceneLike,
    method: str = "guarded",
    *,
    stiffness: float | None = None,
    engine: str = "auto",
    progress: Progress | None = None,
) -> Page:
    """Returns a page on which exact events and a fixed-step method fly side by side from one start, to be watched.

    Args:
        scene: a Scene, the path of a scene file, or a mapping.
        method: "naive:0.001": one of `carom.fixed_step_methods()`, and after a colon its step; else one that lets errors be seen.
        stiffness: of the springs of the method "soft", force per overlap; None: such that the shortest contact takes 30 steps.
        engine: of the exact side: "auto", "fast" or "textbook".
        progress: True for a bar (needs tqdm), or a function of the fraction done.

    Raises:
        ValueError: where there is no such method or step, disks are too many to be told apart, or their flights are not straight.
    """
    from carom import _files

    core = as_scene(scene)._core
    method, engine = _arguments.words(method, "method"), _arguments.words(engine, "engine")
    spring = None if stiffness is None else _arguments.real(stiffness, "stiffness")
    if spring is not None and method.split(":")[0] != "soft":
        raise ValueError('a stiffness is that of the springs of method="soft"; leave it out, or give both')
    with naming_arguments(play="method"), reporting(progress, "beside") as report_fraction:
        return Page(_files.side_by_side(core, method, spring, engine, report_fraction))


def validate(
    *,
    full: bool = False,
    only: Sequence[str] = (),
    seed: int = 1,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Validation:
    """Holds the engine against kinetic theory and the literature. Takes one to two minutes on two cores; a full one takes one to two hours.

    Args:
        full: twenty times the collisions, and seven trials more.
        only: names of trials, of `carom.validation_trials()`, and of their groups; none: all.
        seed: of the random numbers, 0 to 9e12.
        threads: how many trials run side by side, 1 to 4096, which find the same; None: one for each processor.
        progress: True for a bar (needs tqdm), or a function of the fraction done.

    Raises:
        Interrupted: on Ctrl-C; its `result` is a Validation that holds the finished trials.
        ValueError: where an argument is wrong.
    """
    import json

    from carom import _files

    names = _arguments.list_of_words(only, "only")
    number = _arguments.whole(seed, "seed")
    at_a_time = None if threads is None else _arguments.whole(threads, "threads", least=1, most=4096)
    with naming_arguments(), reporting(progress, "validate") as report_fraction:
        text, verdicts, sentence, page, complete = _files.validate(bool(full), names, number, at_a_time, report_fraction)
    summary: dict[str, Any] = json.loads(text)
    checks = [{"trial": trial["trial"], **check} for trial in summary["trials"] for check in trial["checks"]]
    columns: dict[str, npt.ArrayLike] = {name: column_of_words(check[name] for check in checks) for name in ("trial", "name")}
    columns |= {name: column_of_numbers(check[name] for check in checks) for name in ("expected", "measured", "error", "z")}
    columns["verdict"] = column_of_words(verdicts)
    columns["holds"] = np.array([check["holds"] for check in checks], dtype=bool)
    columns["allowance"] = column_of_numbers(check["allowance"] for check in checks)
    columns |= {name: column_of_words(check[name] for check in checks) for name in ("theory", "source")}
    validation = Validation(summary, Table(columns, title="Checks"), sentence, complete, page)
    if not complete:
        raise Interrupted(validation)
    return validation


def validation_trials(full: bool = False) -> list[str]:
    """Returns the names of the trials of a quick or a full validation, for `carom.validate(only=...)`."""
    from carom import _files

    return _files.validation_trials(full)


def hardcases(
    names: str | PathLike[str] | Sequence[str | PathLike[str]] | None = None,
    *,
    engine: str = "auto",
    progress: Progress | None = None,
) -> Table:
    """Runs hard cases, and says of each whether what must hold does.

    >>> carom.hardcases("all_at_rest")["verdict"].tolist()
    ['holds']

    Args:
        names: of `carom.hard_case_names()`, or paths of files of one's own that end in .toml; None: all but those that take long.
        engine: every case in this one alone; "auto": in each that covers it.
        progress: True for a bar (needs tqdm), or a function of the fraction done.

    Returns:
        A row for each case: its name, family and statement, the engines, the number of checks, what was nearest to its bound or
        beyond, the verdict ("holds", "FAILS" or "not run"), and seconds.

    Raises:
        ValueError: where there is no such case or engine; SceneError: where a file is none.
    """
    from carom import _files

    chosen = _arguments.list_of_words([names] if isinstance(names, PathLike) else names or [], "names")
    with naming_arguments(), reporting(progress, "hardcases") as report_fraction:
        rows, sentence = _files.hard_cases(chosen, _arguments.words(engine, "engine"), report_fraction)
    columns: dict[str, npt.ArrayLike] = {
        name: column_of_words(row[k] for row in rows) for k, name in enumerate(("case", "family", "statement", "engines"))
    }
    columns["checks"] = [row[4] for row in rows]
    columns |= {name: column_of_words(row[k] for row in rows) for k, name in ((5, "nearest_to_its_bound"), (6, "verdict"))}
    columns["seconds"] = [row[7] for row in rows]
    return Table(columns, {"seconds": "s"}, sentence)


def hard_case_names() -> list[str]:
    """Returns the names of all hard cases, for `carom.hardcases()`."""
    from carom import _files

    return _files.hard_case_names()


#: Units of the columns of compare.csv; counts, ratios and errors in diameters have none.
_UNITS_OF_RUNS = {
    "dt": "time",
    "time": "time",
    "setup_seconds": "s",
    "seconds_early": "s",
    "seconds": "s",
    "error_early": "diameters",
    "error_end": "diameters",
    "collision_rate": "1 / time",
    "mean_free_path": "length",
}

def _column(cells: list[str], name: str) -> npt.NDArray[Any]:
    """A column of compare.csv: words, whole numbers, or numbers with nan for an empty cell."""
    if name == "method":
        return column_of_words(cells)
    if name in ("seed", "pair"):
        return np.array([int(cell) for cell in cells])
    return column_of_numbers(float(cell) if cell else None for cell in cells)


def _prices(prices: list[dict[str, Any]]) -> Table:
    columns: dict[str, npt.ArrayLike] = {name: column_of_words(price[name] for price in prices) for name in ("method", "target")}
    columns["ratio"] = column_of_numbers(price["ratio"] for price in prices)
    for k, name in enumerate(("lowest", "highest")):
        columns[name] = column_of_numbers(price["spread"] and price["spread"][k] for price in prices)
    columns |= {name: column_of_numbers(price[name] for price in prices) for name in ("dt", "seconds", "extrapolation")}
    columns["at_most"] = np.array([price["at_most"] for price in prices], bool)
    columns["remark"] = column_of_words(price["remark"] for price in prices)
    return Table(columns, {"dt": "time", "seconds": "s"}, "Price: processor time over that of the exact engine")
