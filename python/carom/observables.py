"""Observables of one's own, and standard errors of correlated series."""

from __future__ import annotations

import math
import pickle
import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from carom import _core
from carom._arguments import numbers, shown, words
from carom.frames import State
from carom.results import Number, Table

#: The fields of a collision in the batches that `Observable.collisions()` gets; their memory is the library's own.
COLLISION = np.dtype(
    {
        "names": [
            "time",
            "disk",
            "partner",
            "separation",
            "impulse",
            "velocity_before",
            "velocity",
            "partner_velocity_before",
            "partner_velocity",
            "contact",
        ],
        "formats": ["f8", "i4", "i4", *[("f8", 2)] * 6, "?"],
        "offsets": [0, 8, 12, 16, 32, 48, 64, 80, 96, 112],
        "itemsize": 144,
    }
)


class Blocking:
    """The mean of a series of correlated samples, with its standard error by blocking (Flyvbjerg and Petersen, 1989).

    Samples are equidistant in time, or in number of collisions. Memory grows with the logarithm of their number.

    >>> series = carom.Blocking()
    >>> series.add(np.random.default_rng(1).normal(size=10_000))
    >>> abs(float(series.estimate())) < 0.05
    True
    """

    def __init__(self) -> None:
        self._core = _core.Blocking()

    def add(self, values: npt.ArrayLike, weights: npt.ArrayLike | None = None) -> None:
        """Adds samples, a number or an array of shape (n,). With weights the mean is that of values over that of weights."""
        series = numbers(np.atleast_1d(np.asarray(values)), "values")
        weight = None if weights is None else numbers(np.atleast_1d(np.asarray(weights)), "weights")
        if weight is not None and len(weight) != len(series):
            raise ValueError(f"there are {len(weight)} weights and {len(series)} values; give one for each")
        self._core.add(series, weight)

    @property
    def samples(self) -> int:
        """The number of samples."""
        return self._core.samples

    def estimate(self, unit: str = "", step: float | None = None) -> Number:
        """Returns mean and standard error. `step` is the time between samples, from which the integrated correlation time follows."""
        found = self._core.estimate()
        if found is None:
            return Number(math.nan, unit=unit, note="there are no samples")
        mean, error, inefficiency, lower_bound = found
        time = None if step is None or inefficiency is None else 0.5 * inefficiency * step
        return Number(mean, error, unit, time, "the error is a lower bound: the run is too short" if lower_bound else "")

    def __getstate__(self) -> bytes:
        return self._core.levels()

    def __setstate__(self, levels: bytes) -> None:
        self._core = _core.Blocking()
        self._core.set_levels(levels)


class Observable:
    """A quantity to be measured while a scene runs: derive from it, and give objects to `carom.run(observables=[...])`.

    Override what you need. A run measures in its own thread; an observable must not ask the simulation that runs.

    Attributes:
        name: the key of the results; letters, digits and underscores.
        step: the time between two calls of `sample()`; 0: it is never called.
        needs_positions: whether `sample()` reads more of a state than velocities; without, samples cost a fraction.
        follows_collisions: whether `collisions()` is called. A run raises SceneError for an observable that follows them in a scene
            with [growth], [thermostat], [tumbling], [brownian], [shear] or [drag], which change velocities between collisions.
    """

    name: str = "observable"
    step: float = 0.0
    needs_positions: bool = True
    follows_collisions: bool = False

    def start(self, state: State) -> None:
        """Is called with the state at the start of the measured run."""

    def sample(self, state: State, collisions: int, virial: float) -> None:
        """Is called at the times k `step`, with the state and the pair collisions and their virial up to then."""

    def collisions(self, batch: npt.NDArray[Any]) -> None:
        """Is called with the meetings of two disks since the last call, some 4,096 at a time, and all before a sample.

        `batch` is a structured array of dtype `carom.COLLISION`: time, disk, partner, separation (2, from the partner to the disk),
        impulse (2, that the disk got), velocity_before (2), velocity (2), partner_velocity_before (2), partner_velocity (2), contact.

        `contact` is True where the disks touched. It is False where they met the edge of a well or of a step round each other, which
        they passed or which turned them back: scenes with [square_well] or [stepped_potential] have these rows too. The number of
        pair collisions is that of the rows with `contact`; in other scenes it is `len(batch)`.
        """

    def finish(self, time: float, collisions: int, virial: float) -> Mapping[str, Any]:
        """Is called when the run has ended. Returns the results by name: Numbers, plain numbers, and Tables.

        Where two tables of a run have one name, the later becomes OBSERVABLE_NAME.
        """
        return {}

    # What the library calls.

    def _start(self, state: _core.State) -> None:
        self.start(State._of(state))

    def _sample(self, state: _core.State, collisions: int, virial: float) -> None:
        self.sample(State._of(state), collisions, virial)

    def _collisions(self, memory: npt.NDArray[np.uint8]) -> None:
        self.collisions(memory.view(COLLISION))

    def _finish(self, time: float, collisions: int, virial: float) -> tuple[list[Any], list[Any]]:
        scalars, tables = [], []
        results = self.finish(time, collisions, virial)
        if not isinstance(results, Mapping):
            raise TypeError(f"{self.name}.finish() returned {shown(results)}; give a mapping of names to Numbers, plain numbers and Tables")
        for name, found in results.items():
            what = f"{self.name}.{_result_name(name, self.name, taken=('note', 'tables'))}"
            if isinstance(found, Table):
                if not re.fullmatch(r"[A-Za-z0-9_]{1,100}", name):
                    raise ValueError(f"a table of {self.name} has the name {shown(name)}, and a file of its own; take at most 100 letters, digits and underscores")
                columns = []
                for c in found:
                    unit = words(found.units.get(c, ""), f"the unit of {what}.{_result_name(c, what)}")
                    columns.append((c, unit, [_float(v, f"{what}.{c}") for v in found[c]]))
                tables.append((name, columns))
            elif isinstance(found, Number):
                error = None if found.error is None else _float(found.error, f"the error of {what}")
                correlation = found.integrated_correlation_time
                correlation = None if correlation is None else _float(correlation, f"the correlation time of {what}")
                unit, note = words(found.unit, f"the unit of {what}"), words(found.note, f"the note of {what}")
                scalars.append((name, _float(found.value, what), error, unit, correlation, note))
            else:
                scalars.append((name, _float(found, what), None, "", None, ""))
        return scalars, tables

    def _save(self) -> bytes:
        return pickle.dumps(self.__dict__)

    def _load(self, saved: bytes) -> None:
        self.__dict__.update(pickle.loads(saved))


def _result_name(name: Any, of: str, taken: tuple[str, ...] = ()) -> str:
    """Returns the name of a number, a table or a column, which is one in files too. Raises ValueError for what cannot be."""
    if words(name, f"a name of what {of}.finish() returned") in ("", ".", "..") or re.search(r'[/,"\x00-\x1f]', name):
        raise ValueError(f"a result of {of} has the name {shown(name)}; take a word without / , \" and control characters")
    if name in taken:
        raise ValueError(f"a result of {of} has the name {shown(name)}, which the summary uses itself; take another")
    return str(name)


def _float(value: Any, name: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is a {type(value).__name__}; results are Numbers, plain numbers and Tables") from None
    except OverflowError:
        raise ValueError(f"{name} is beyond the range of a double") from None
