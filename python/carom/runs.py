"""A scene's whole schedule: equilibrate, measure, write files."""

from __future__ import annotations

import math
import re
import sys
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from os import PathLike
from typing import TYPE_CHECKING, Any

from carom import _core
from carom._arguments import path_text, real, require_steps_that_fit, shown, whole, words
from carom._errors import Interrupted, OutputError
from carom._hdf5 import hdf5
from carom._measured import measurements_of
from carom._progress import Progress, reporting
from carom.frames import Frames, State, frames_of
from carom.observables import Observable
from carom.results import Measurement, Number
from carom.scene import Scene, SceneLike, as_scene
from carom.simulation import Stop, as_stop

# Programs and pickles of earlier versions look for these names here.
from carom.stored_runs import Run as Run, StoredArray as StoredArray, StoredFrames as StoredFrames, open_run as open_run

if TYPE_CHECKING:
    from pathlib import Path

    import pandas

    from carom.pages import Page

#: Observables of a run: names of the scene format with their settings, {"pressure": True}; objects of one's own; or both in a list.
Observables = Mapping[str, Any] | Iterable[str | Observable]


@dataclass(eq=False)
class Result:
    """What a run has measured.

    Attributes:
        summary: everything in numbers, with the keys of summary.json (docs/output.md).
        observables: what the observables have measured, by name.
        stopped: why the run ended.
        state: the final state.
        scene: the scene that ran.
        frames: the samples; None where they were not asked for.
        directory: where the files are; None where none were written.
        files: their names, in the order in which they were completed.
        saved: whether there is a checkpoint, from which `carom.resume(directory)` goes on.
    """

    summary: dict[str, Any] = field(repr=False)
    observables: dict[str, Measurement]
    stopped: Stop
    state: State
    scene: Scene = field(repr=False)
    frames: Frames | None = field(default=None, repr=False)
    directory: Path | None = None
    files: list[str] = field(default_factory=list)
    saved: bool = False

    @property
    def time(self) -> float:
        """The time that the run has reached."""
        return float(self.summary["time"])

    @property
    def engine(self) -> str:
        """The engine, or the fixed-step method."""
        return str(self.summary["engine"])

    @property
    def state_hash(self) -> str:
        """16 hexadecimal digits of the final state: equal where the bits are equal."""
        return str(self.summary["state_hash"])

    @property
    def collisions(self) -> int:
        """The number of collisions of two disks."""
        return int(self.summary["events"]["pair"])

    @property
    def Z(self) -> Number:
        """The compressibility factor P A / (N kT) from the virial, with its standard error over blocks."""
        return _number(self.summary.get("pressure") or {}, "Z")

    @property
    def temperature(self) -> Number:
        """The mean kT of the samples, or of the final state where there are none; energy."""
        return Number(float(self.summary["temperature"]["mean"]), unit="energy")

    def to_series(self) -> pandas.Series[Any]:
        """Returns all numbers of the summary as a pandas Series; names are keys joined by dots. Needs pandas."""
        import pandas

        return pandas.Series(dict(_flat(self.summary)))

    def report(self) -> Page:
        """Returns the page of the run, as `carom report` makes it. Raises ValueError where the run has written no files."""
        if self.directory is None:
            raise ValueError("a report is made from the files of a run; run with out=\"directory\"")
        return open_run(self.directory).report()

    def __str__(self) -> str:
        lines = [
            f"{self.summary['disks']} disks, {self.collisions:,} collisions until time {self.time:g} ({self.stopped}), engine "
            f"{self.engine}",
            f"Z = {self.Z}, kT = {self.temperature}, state_hash {self.state_hash}",
        ]
        return "\n".join([*lines, *map(str, self.observables.values())])

    def _repr_html_(self) -> str:
        import html

        head = "".join(f"<p>{html.escape(line)}</p>" for line in str(self).split("\n")[:2])
        return head + "".join(measured._repr_html_() for measured in self.observables.values())


def _number(table: Mapping[str, Any], key: str) -> Number:
    value, error, note = table.get(key), table.get(f"{key}_error"), str(table.get(f"{key}_note") or table.get("note") or "")
    return Number(math.nan if value is None else float(value), None if error is None else float(error), note=note)


def _flat(value: Any, path: str = "") -> Iterable[tuple[str, float]]:
    """All numbers of nested mappings and lists, by their keys joined by dots."""
    if isinstance(value, Mapping):
        for key, entry in value.items():
            yield from _flat(entry, f"{path}.{key}" if path else str(key))
    elif isinstance(value, list):
        for k, entry in enumerate(value):
            yield from _flat(entry, f"{path}.{k}")
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield path, value


def _with_observables(scene: Scene, observables: Observables | None) -> tuple[Scene, list[Observable]]:
    """Returns the scene that asks for the observables of the scene format, and those of one's own."""
    if observables is None:
        return scene, []
    if isinstance(observables, (str, Observable)):
        observables = [observables]
    if not isinstance(observables, Iterable):
        raise TypeError(f"observables are {shown(observables)}; give names such as \"pressure\", a mapping of them, or carom.Observables")
    settings = dict(observables) if isinstance(observables, Mapping) else {o: True for o in observables if isinstance(o, str)}
    listed = [] if isinstance(observables, Mapping) else [o for o in observables if not isinstance(o, str)]
    changes = {f"observe.{words(name, 'an observable')}": value for name, value in settings.items()}
    given = scene.set(changes) if changes else scene
    return given, _own(listed, given._core.observables)


def _is_chosen(observable: Observable, attribute: str) -> bool:
    """Returns whether an observable or its class has an attribute of its own in place of the one that all have."""
    return attribute in vars(observable) or any(attribute in vars(c) for c in type(observable).__mro__ if c not in (Observable, object))


def _own(observables: Iterable[Any], taken: Iterable[str] = ()) -> list[Observable]:
    """Returns the observables as a list. Raises TypeError or ValueError for what is none, and for two of one name; `taken` are the names
    of the scene's."""
    if not isinstance(observables, Iterable):
        raise TypeError(f"observables are {shown(observables)}; give a list of carom.Observables")
    own = list(observables)
    names = set(taken)
    for observable in own:
        if not isinstance(observable, Observable):
            raise TypeError(f"{shown(observable)} is no observable; give a name such as \"pressure\", or a carom.Observable")
        name = words(observable.name, "the name of an observable")
        if not re.fullmatch(r"[A-Za-z0-9_]{1,100}", name):
            raise ValueError(f"an observable has the name {shown(name)}; take at most 100 letters, digits and underscores")
        if name in names:
            raise ValueError(f"two observables have the name {shown(name)}, and results are by name; give one of them another")
        names.add(name)
        if not 0.0 <= real(observable.step, f"the step of {name}") < math.inf:
            raise ValueError(f"the step of {name} is {shown(observable.step)}; give a time, or 0 where it takes no samples")
        if type(observable).sample is not Observable.sample and not _is_chosen(observable, "step"):
            raise ValueError(f"{name} has a sample(), and its step is 0, so that it would never be called; give it a step, the time between two samples")
        if type(observable).collisions is not Observable.collisions and not _is_chosen(observable, "follows_collisions"):
            raise ValueError(f"{name} has collisions(), and follows_collisions is False, so that it would never be called; set it to True")
        for attribute in ("needs_positions", "follows_collisions"):
            value = getattr(observable, attribute)
            if not isinstance(value, bool):
                raise TypeError(f"{attribute} of {name} is {shown(value)}; give True or False")
    return own


def run(
    scene: SceneLike,
    *,
    out: str | PathLike[str] | None = None,
    overwrite: bool = False,
    seed: int | None = None,
    engine: str = "auto",
    method: str | None = None,
    dt: float | None = None,
    stiffness: float | None = None,
    observables: Observables | None = None,
    events: bool = False,
    frames: bool = False,
    report: bool = False,
    threads: int | None = None,
    checkpoint_every: str | None = None,
    walltime: float | str | None = None,
    progress: Progress | None = None,
) -> Result:
    """Runs a scene's whole schedule: equilibrates, measures until its time or its collisions, and writes files where `out` is given.

    >>> result = carom.run(carom.Scene.preset("box"), observables={"pressure": True})
    >>> result.collisions, result.stopped == "time"
    (343, True)

    The bits are those of `carom run`, and so are the files.

    Args:
        scene: a Scene, the path of a scene file, or a mapping.
        out: a directory for summary.json, trajectory.h5md and whatever else the scene asks for; None: nothing is written.
        overwrite: whether results of an earlier run in that directory are replaced.
        seed: in place of the scene's run.seed.
        engine: "auto", or one of `carom.engines()`.
        method, dt: a fixed-step method in place of exact events, and its step; without dt it is the scene's run.sample_every.
        stiffness: of the springs of the method "soft", force per overlap; None: such that the shortest contact takes 30 steps.
        observables: besides those of the scene: {"pressure": True, "radial_distribution": {"range": 4.0}}, or a list of names and
            objects of carom.Observable.
        events: whether all collisions are written too.
        frames: whether the result keeps the samples in memory.
        report: whether the page report.html is made too.
        threads: how many cores compute the events, 1 to 32, to the same bits; None: one below 50,000 disks, and else all that are
            free. Observables have a thread of their own where there is a second processor; with 1 they have none.
        checkpoint_every: "10min" or "1e8 collisions"; with `out` a run that is stopped is saved in any case.
        walltime: ends the run, saved, after so much real time: seconds, or "1h30min".
        progress: True for a bar (needs tqdm), or a function of the fraction done.

    Raises:
        Interrupted: on Ctrl-C. Its `result` holds all until then, the files are complete, and `carom.resume(out)` goes on.
        SceneError: where the scene is wrong; OutputError: where a file cannot be written; ValueError: where arguments do not fit.
        MemoryError: where this machine has too little memory for the disks.
    """
    given = as_scene(scene)
    if seed is not None:
        given = given.set({"run.seed": seed})
    if events:
        given = given.set({"output.events": True})
    given, own = _with_observables(given, observables)
    if method is None and dt is not None:
        raise ValueError("dt is the step of a fixed-step method; exact events need none: leave it out, or give a method")
    require_steps_that_fit(method, engine, stiffness)
    if method is not None:
        if own or given._core.observables:
            raise ValueError(f'method="{method}": observables measure exact trajectories; leave out one of the two')
        dt = real(dt, "dt") if dt is not None else given._core.sample_every
        if dt is None:
            raise ValueError(f'method="{method}" needs a time step: give dt, or the scene a run.sample_every')
    if out is None and (checkpoint_every is not None or report):
        raise ValueError("checkpoints and reports are files; give out=\"directory\" too")
    from pathlib import Path

    from carom import _files

    place = None if out is None else path_text(out, "out")
    with reporting(progress, "run") as report_fraction:
        call = partial(
            _files.run,
            given._core,
            words(engine, "engine"),
            None if method is None else words(method, "method"),
            dt or 0.0,
            None if stiffness is None else real(stiffness, "stiffness"),
            place,
            bool(overwrite),
            own,
            None if checkpoint_every is None else words(checkpoint_every, "checkpoint_every"),
            _seconds(walltime),
            None if threads is None else whole(threads, "threads", least=1, most=32),
            bool(report),
            bool(frames),
        )
        if place is None:
            return _result(given, None, _call_on_thread(call, report_fraction, bool(own)))
        with _sentences():
            return _result(given, Path(place), _call_on_thread(_with_files(call), report_fraction, bool(own)))


def resume(
    directory: str | PathLike[str],
    *,
    time: float | None = None,
    collisions: int | None = None,
    observables: Sequence[Observable] = (),
    threads: int | None = None,
    checkpoint_every: str | None = None,
    walltime: float | str | None = None,
    report: bool = False,
    progress: Progress | None = None,
) -> Result:
    """Goes on with a run that was stopped, from its newest checkpoint, as if it had never stopped.

    Args:
        directory: of the run.
        time, collisions: a later end than that of the scene; a run that has come to its end needs one.
        observables: objects of the classes of one's own with which the run began, in the same order; they go on from what they had.
        threads, checkpoint_every, walltime, report, progress: as for `carom.run()`.

    Raises:
        OutputError: where there is nothing to go on from; ValueError: where the end does not lie ahead.
    """
    import json
    from pathlib import Path

    from carom import _files

    with reporting(progress, "run") as report_fraction:
        own = _own(observables)
        place = path_text(directory, "directory")
        call = partial(
            _files.resume,
            place,
            None if time is None else real(time, "time"),
            None if collisions is None else whole(collisions, "collisions"),
            own,
            None if checkpoint_every is None else words(checkpoint_every, "checkpoint_every"),
            _seconds(walltime),
            None if threads is None else whole(threads, "threads", least=1, most=32),
            bool(report),
        )
        with _sentences():
            parts = _call_on_thread(_with_files(call), report_fraction, bool(own))
        scene = Scene.parse(json.loads(parts[0])["resolved_scene"])
        return _result(scene, Path(place), parts)


#: Words of the program's sentences about files, and what stands for them in Python.
_IN_PYTHON = {
    "with --force": "with overwrite=True",
    "with --out": "with out=",
    "--checkpoint-every has": "checkpoint_every= has",
    "carom resume ": "carom.resume() of ",
}


@contextmanager
def _sentences() -> Iterator[None]:
    """Lets the program's sentences about files name arguments of Python in place of its options."""
    try:
        yield
    except OutputError as error:
        sentence = str(error)
        for program, python in _IN_PYTHON.items():
            sentence = sentence.replace(program, python)
        raise OutputError(sentence) from None


def _with_files(call: Callable[[Any], tuple[Any, ...]]) -> Callable[[Any], tuple[Any, ...]]:
    """Returns the call with HDF5 to itself, on whatever thread it is made: observables may use h5py there too."""

    def guarded(report_fraction: Any) -> tuple[Any, ...]:
        with hdf5():
            return call(report_fraction)

    return guarded


def _call_on_thread(call: Callable[[Any], tuple[Any, ...]], report_fraction: Any, has_own: bool) -> tuple[Any, ...]:
    """Makes the call, on another thread where observables are written in Python. Python raises KeyboardInterrupt in the main thread
    alone, and in the middle of an observable it would lose the collisions at hand."""
    raised: list[BaseException] = []  # by handlers of signals; they come out when the run has completed its files
    outcome: list[Any] = []

    def callback(fraction: float) -> bool:
        if report_fraction is not None:
            report_fraction(fraction)
        return not raised

    if not has_own or threading.current_thread() is not threading.main_thread():
        return call(None if report_fraction is None else callback)
    from carom import _files

    def work() -> None:
        sys.settrace(threading.gettrace())  # the thread is not one of `threading`, which would do so for debuggers and coverage
        sys.setprofile(threading.getprofile())
        try:
            outcome.append(call(callback))
        except BaseException as error:
            outcome.append(error)

    _files.call_on_thread(work, raised.append)
    failure = outcome[0] if isinstance(outcome[0], BaseException) else None
    for error in raised:
        if not isinstance(error, KeyboardInterrupt):
            raise error from failure
    if failure is not None:
        raise failure
    parts: tuple[Any, ...] = outcome[0]
    return (*parts[:_INTERRUPTED], bool(raised) or parts[_INTERRUPTED], *parts[_INTERRUPTED + 1 :])


#: The place of `interrupted` in what the library returns of a run.
_INTERRUPTED = 6


def _seconds(walltime: float | str | None) -> float | None:
    if walltime is None:
        return None
    seconds = _core.seconds_in(words(walltime, "walltime")) if isinstance(walltime, str) else real(walltime, "walltime")
    if not seconds > 0:
        raise ValueError(f"walltime is {seconds:g} s; it must be positive")
    return seconds


def _result(scene: Scene, directory: Path | None, parts: tuple[Any, ...]) -> Result:
    import json

    summary_text, measured, disks, files, sampled, state, interrupted, saved, remarks, properties = parts
    summary = json.loads(summary_text)
    for remark in remarks:
        warnings.warn(remark, stacklevel=3)
    frames = None
    if sampled is not None:
        frames = frames_of(sampled, properties, scene, summary["state_hash"], interrupted)
    result = Result(
        summary=summary,
        observables=measurements_of(measured),
        stopped=as_stop(summary["stopped"], summary["time"], disks),
        state=State._of(state),
        scene=scene,
        frames=frames,
        directory=directory,
        files=files,
        saved=saved,
    )
    if interrupted:
        raise Interrupted(result)
    return result
