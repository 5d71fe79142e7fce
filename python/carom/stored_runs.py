"""Finished runs in their directories, read back."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, TypeVar, overload

import numpy as np
import numpy.typing as npt
from numpy.lib.mixins import NDArrayOperatorsMixin

from carom._arguments import absolute, frame_number, list_of_words, path_text, whole
from carom._errors import OutputError
from carom._events import events_in
from carom._frame_memory import require_memory
from carom._hdf5 import hdf5
from carom._measured import measurements_of
from carom._toml import value_text
from carom.frames import Frames, State, frames_of
from carom.results import Measurement
from carom.scene import Scene

if TYPE_CHECKING:
    from pathlib import Path

    from carom import _files
    from carom.pages import Page, Player

T = TypeVar("T")


class Run:
    """A finished run in a directory, as `carom run` or `carom.run(out=...)` have written it. `carom.open_run()` makes it."""

    def __init__(self, directory: str | PathLike[str]) -> None:
        import json
        from pathlib import Path

        self.directory = Path(absolute(path_text(directory, "directory")))
        file = self.directory / "summary.json"
        try:
            self.summary: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        except FileNotFoundError:
            raise OutputError(
                f"{self.directory}: this is no directory of a finished run (no summary.json); name one that carom run has written"
            ) from None
        except OSError as error:
            raise OutputError(f"{file}: cannot read this file: {error.strerror}") from None
        except ValueError:
            self.summary = {}
        if not isinstance(self.summary, dict) or "resolved_scene" not in self.summary:
            raise OutputError(f"{file}: this is not the summary of a run; copy it anew or run again")

    def _read(self, action: Callable[[_files.RunReader], T]) -> T:
        """Returns what `action` reads. The file is open only meanwhile: all of a program share an open file as it was when it was opened."""
        from carom import _files

        with hdf5():
            return action(_files.RunReader(fspath(self.directory)))

    @property
    def scene(self) -> Scene:
        """The scene that ran, with every default."""
        return Scene.parse(self.summary["resolved_scene"])

    @property
    def state_hash(self) -> str:
        """16 hexadecimal digits of the final state."""
        return str(self.summary["state_hash"])

    @property
    def frames(self) -> StoredFrames:
        """The samples in trajectory.h5md, which are read when they are asked for. Needs h5py (pip install carom[files])."""
        return StoredFrames(self)

    def state(self, k: int = -1) -> State:
        """Returns sample k, the last one by default: another simulation can begin with it. It is right to the last bit, positions of a
        run with output.unwrapped to rounding."""

        def state(reader: _files.RunReader) -> State:
            if reader.samples == 0:
                raise ValueError(f"{self.directory}: this run kept no samples; run it with run.sample_every and its trajectory")
            at = whole(k, "k", least=-reader.samples, most=reader.samples - 1)
            return State._of(reader.sample(at % reader.samples))

        return self._read(state)

    @property
    def events(self) -> npt.NDArray[Any]:
        """All collisions, a structured array as `Simulation.record()` returns it. Raises ValueError where none were written."""

        def events(reader: _files.RunReader) -> npt.NDArray[Any]:
            if not reader.has_event_log:
                raise ValueError(f"{self.directory}: this run has written no collisions; run with events=True")
            return events_in(reader.event_log())

        return self._read(events)

    @property
    def observables(self) -> dict[str, Measurement]:
        """What the run has measured, as its files have it."""
        from carom import _files

        with hdf5():
            return measurements_of(_files.observables_in(fspath(self.directory)))

    def analyze(self, observables: Mapping[str, Any] | Iterable[str] | None = None) -> dict[str, Measurement]:
        """Measures observables of the scene format in the samples and collisions that the run has kept; None: those of its own scene.

        Where samples are taken at the same times, the numbers are those of the run to the last bit.

        Raises ValueError where the run has not kept what one of them needs.
        """
        from carom import _files

        wanted = []
        if observables is not None:
            names = list_of_words(observables, "observables")
            settings = observables if isinstance(observables, Mapping) else dict.fromkeys(names, True)
            wanted = [name if value is True else f"{name}={value_text(value, name)}" for name, value in settings.items()]
        with hdf5():
            return measurements_of(_files.analyse(fspath(self.directory), wanted))

    def verify(self) -> list[str]:
        """Runs the scene again. Returns one sentence for each difference from what is in the directory: none, if all is the same.

        Observables of one's own are left out: the scene does not ask for them."""
        import tempfile
        from pathlib import Path

        from carom import _files
        from carom.runs import run

        dt = self.summary.get("dt")
        if self.summary["stopped"] == "interrupted":
            raise ValueError(f"{self.directory}: this run was interrupted, and another one would not end there")
        name = self.summary.get("engine_asked", self.summary["engine"])
        with tempfile.TemporaryDirectory(prefix="carom-") as place, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            again = Path(place) / "again"
            if dt is None:
                run(self.scene, out=again, engine=name)
            else:
                run(self.scene, out=again, method=name, dt=dt, stiffness=self.summary.get("stiffness"))
            with hdf5():
                return _files.compare_results(fspath(self.directory), fspath(again))

    def play(self) -> Player:
        """Returns the run as a player: exact, where its collisions were written."""
        from carom.player import player_of

        with hdf5():
            return player_of(self.directory)

    def report(self) -> Page:
        """Returns the page of the run, as `carom report` makes it."""
        from carom.player import report_of

        with hdf5():
            return report_of(self.directory)

    def __repr__(self) -> str:
        return f"<carom.Run in {self.directory}: {self.summary['disks']} disks until time {self.summary['time']:g}>"


def _states(numbers: range, reader: _files.RunReader) -> list[State]:
    return [State._of(reader.sample(k)) for k in numbers]


class StoredFrames:
    """The samples of a run in its file. Arrays behave as h5py's: `frames.positions[::100]` reads every hundredth frame.

    `frames[:]` reads all frames and `frames[::100]` every hundredth, as `Frames` in memory: unwrapped, for `to_xarray()`,
    `to_mdanalysis()`, `animate()`.

    Each index opens the file anew, so that frames which a resumed run has added are there.

    Attributes:
        scene: the scene that ran.
    """

    def __init__(self, run: Run) -> None:
        self.scene = run.scene
        self._run = run
        self._path = run.directory / "trajectory.h5md"
        if not self._path.exists():
            raise OutputError(f"{self._path}: there is no such file: this run kept no trajectory")

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Times, shape (F,)."""
        return self._dataset("time")[:]

    @property
    def positions(self) -> StoredArray:
        """Positions, shape (F, N, 2)."""
        return self._dataset("position")

    @property
    def velocities(self) -> StoredArray:
        """Velocities, shape (F, N, 2)."""
        return self._dataset("velocity")

    def __len__(self) -> int:
        return self._run._read(lambda reader: int(reader.samples))

    @overload
    def __getitem__(self, k: int) -> State: ...

    @overload
    def __getitem__(self, k: slice) -> Frames: ...

    def __getitem__(self, k: int | slice) -> State | Frames:
        """Returns frame k, counted from the end where k is negative, as `Run.state(k)` does; for a slice its frames.

        Raises MemoryError where the frames of a slice cannot fit into this machine."""
        if isinstance(k, slice):
            return self._run._read(partial(self._part, k))
        return self._run._read(lambda reader: State._of(reader.sample(frame_number(k, reader.samples) % reader.samples)))

    def _part(self, k: slice, reader: _files.RunReader) -> Frames:
        numbers = range(reader.samples)[k]
        properties = reader.disks()
        disks = len(properties[0])
        require_memory(len(numbers), disks, 48 * disks + 104, "read fewer of them with a step, frames[::10]")
        sampled = reader.samples_of(max(0, numbers.start), numbers.step, len(numbers))
        return frames_of(sampled, properties, self.scene, self._run.state_hash)

    def __iter__(self) -> Iterator[State]:
        frames = len(self)
        most = max(1, min(64, 1_000_000 // max(1, self.scene.count)))
        read, at_once = 0, 1
        while read < frames:  # ever more at once: to open the file takes as long as to read thousands of disks
            numbers = range(read, min(read + at_once, frames))
            yield from self._run._read(partial(_states, numbers))
            read, at_once = numbers.stop, min(2 * at_once, most)

    def __repr__(self) -> str:
        return f"<carom.StoredFrames in {self._path}>"

    def _dataset(self, name: str) -> StoredArray:
        return StoredArray(self._path, name)


def _parts_of(index: Any) -> tuple[Any, Any, Any] | None:
    """Returns an index by frame, disk and axis, or None where it is of another kind."""
    parts: tuple[Any, ...] = index if isinstance(index, tuple) else (index,)
    if any(part is None for part in parts) or len(parts) - sum(part is Ellipsis for part in parts) > 3:
        return None
    if (at := next((k for k, part in enumerate(parts) if part is Ellipsis), None)) is not None:
        parts = parts[:at] + (slice(None),) * (4 - len(parts)) + parts[at + 1 :]
    frames, disks, axis = parts + (slice(None),) * (3 - len(parts))
    return frames, disks, axis


def _is_simple(part: Any) -> bool:
    """Returns whether a file is read by this part of an index as an array is."""
    if isinstance(part, slice):
        return part.step is None or part.step > 0
    return isinstance(part, (int, np.integer)) and not isinstance(part, bool)


def _turned_round(backward: slice, length: int) -> slice:
    """Returns the slice of the same numbers in rising order."""
    numbers = range(length)[backward][::-1]
    return slice(numbers.start, numbers.stop, numbers.step) if len(numbers) > 0 else slice(0, 0)


class StoredArray(NDArrayOperatorsMixin):
    """One array of a trajectory file, read piece by piece; the file is open only meanwhile. It is indexed as numpy's arrays are, and
    `array[:]`, `np.asarray(array)` and arithmetic read all of it."""

    def __init__(self, path: Path, name: str) -> None:
        self._path, self._name = path, name
        self.ndim = len(self.shape)

    def _read(self, action: Any) -> Any:
        import h5py

        with hdf5(), h5py.File(self._path, "r") as file:
            group = file["particles"]
            particles = group[next(iter(group))]
            dataset = particles["position/time"] if self._name == "time" else particles[f"{self._name}/value"]
            return action(dataset)

    def __getitem__(self, index: Any) -> npt.NDArray[np.float64]:
        if self.ndim < 3:
            return np.asarray(self._read(lambda dataset: dataset[index]))
        parts = _parts_of(index)
        if parts is not None and all(_is_simple(part) for part in parts):
            frames, disks, axis = parts
            return self._planes((frames, disks))[..., axis]
        if parts is None or isinstance(parts[0], (bool, np.bool_)) or np.ndim(0 if isinstance(parts[0], slice) else parts[0]) > 1:
            return np.asarray(self._planes((slice(None),))[index])
        frames, *rest = parts
        if isinstance(frames, slice):
            forward = frames if _is_simple(frames) else _turned_round(frames, len(self))
            read = self._planes((forward,))
            return np.asarray((read if forward is frames else read[::-1])[(slice(None), *rest)])
        wanted = np.arange(len(self))[frames]
        rows, places = np.unique(wanted, return_inverse=True)
        read = self._planes((rows,)) if len(rows) > 0 else np.empty((0, *self.shape[1:]))
        return np.asarray(read[(0 if np.ndim(wanted) == 0 else places, *rest)])

    def _planes(self, index: tuple[Any, ...]) -> npt.NDArray[np.float64]:
        """Reads frames, or disks of frames. H5MD has three coordinates; a box has two."""
        return np.ascontiguousarray(np.asarray(self._read(lambda dataset: dataset[index]))[..., :2])

    __hash__ = object.__hash__

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        if method == "at" or any(isinstance(one, StoredArray) for one in options.get("out", ())):
            return NotImplemented  # files are read, not written
        return getattr(ufunc, method)(*(one[:] if isinstance(one, StoredArray) else one for one in inputs), **options)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape now: a run that is resumed gains frames."""
        shape: tuple[int, ...] = self._read(lambda dataset: dataset.shape)
        return (*shape[:2], min(2, shape[-1])) if len(shape) == 3 else shape

    @property
    def dtype(self) -> np.dtype[np.float64]:
        return np.dtype(np.float64)

    def __len__(self) -> int:
        return self.shape[0]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[np.float64]:
        return np.asarray(self[:], dtype=dtype)


def open_run(directory: str | PathLike[str]) -> Run:
    """Opens a finished run: its summary now, its trajectory when it is asked for.

    Raises OutputError where `directory` is none that `carom run` has finished writing.
    """
    return Run(directory)
