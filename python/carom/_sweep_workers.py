"""The runs of a sweep, as threads or other processes carry them out."""

from __future__ import annotations

import copy
import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.runs import Result, run
from carom.scene import Scene

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

#: What is known of a run: state, and where it is finished stopped, state_hash, numbers and units by name; else failure.
Found = dict[str, Any]


@dataclass(frozen=True)
class Order:
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


def carry_out(order: Order, stop_flag: _StopFlag) -> Found | None:
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


def run_all(executor: Executor, orders: Sequence[Order], keep: Callable[[Order, Found | None], None]) -> None:
    """Hands out all runs, and keeps each as it comes. Whatever is raised stops the others, and those that have come are kept."""
    import queue
    import tempfile

    ended: queue.SimpleQueue[Future[Found | None]] = queue.SimpleQueue()
    futures: dict[Future[Found | None], Order] = {}
    with tempfile.NamedTemporaryFile(prefix="carom-sweep-") as file:
        stop_flag = _StopFlag(file.name)
        try:
            for order in orders:
                future = executor.submit(carry_out, order, stop_flag)
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
